"""Figure 3: cyclic tests of bars, series 1 and 2, and the parameter sets of Table 1."""

from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from calibration import synthetic_bar_cycles
from fem.files import write_table
from validation.drawing import GREY, PAGE_WIDTH, new_figure, save, styled
from validation.paper.stress_panels import SYNTHETIC_NOTE, draw_row, marked, set_table

#: Limits of strain [%] and stress [N/mm^2] by series.
STRAIN = {1: (0.0, 190.0), 2: (0.0, 370.0)}
STRESS = {1: (-0.15, 4.5), 2: (-0.3, 9.0)}


def make(directory: Path) -> Path:
    """Draw figure 3 and write the synthetic tests and the curves of the sets beside it."""
    tests = {series: synthetic_bar_cycles(series) for series in STRAIN}
    used = [marked(test.assign(series=series)) for series, test in tests.items()]
    write_table(directory / "fig3_synthetic_tests.csv", pd.concat(used))
    write_table(directory / "fig3.csv", set_table(STRAIN[2]))
    return save(draw(tests), directory / "fig3.png")


@styled
def draw(tests: dict[int, pd.DataFrame]) -> Figure:
    """Draw a row per series: the cycles, and the parameter sets over the chosen cycle."""
    figure = new_figure(PAGE_WIDTH, 172.0)
    for row, (series, test) in zip(figure.subplots(2, 2), tests.items(), strict=True):
        titles = (
            f"Bars, series {series}: cycles and the one used",
            f"Series {series}: parameter sets of Table 1",
        )
        draw_row(row, test, STRAIN[series], STRESS[series], titles)
    handles, labels = row[1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3)
    figure.suptitle(SYNTHETIC_NOTE, fontsize=7.5, color=GREY)
    return figure
