"""Figure 3: cyclic tests of bars, series 1 and 2, and the parameter sets of Table 1."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from calibration.synthetic import synthetic_bar_cycles
from fem.files import write_table
from validation.drawing.style import GREY, PAGE_WIDTH, new_figure, save, styled
from validation.paper.stress_panels import (
    SYNTHETIC_NOTE,
    chosen_cycle,
    draw_chosen,
    draw_sets,
    draw_test,
    finish,
    set_table,
)

#: Limits of strain [%] and stress [N/mm^2] by series.
STRAIN = {1: (0.0, 190.0), 2: (0.0, 370.0)}
STRESS = {1: (-0.15, 4.5), 2: (-0.3, 9.0)}


def make(directory: Path) -> Path:
    """Draw figure 3 and write the synthetic tests and the curves of the sets beside it."""
    tests = {series: synthetic_bar_cycles(series) for series in STRAIN}
    marked = [
        test.assign(series=series, used=test["cycle"] == chosen_cycle(test))
        for series, test in tests.items()
    ]
    write_table(directory / "fig3_synthetic_tests.csv", pd.concat(marked))
    write_table(directory / "fig3.csv", set_table(STRAIN[2]))
    return save(draw(tests), directory / "fig3.png")


@styled
def draw(tests: dict[int, pd.DataFrame]) -> Figure:
    """Draw a row per series: the cycles, and the parameter sets over the chosen cycle."""
    figure = new_figure(PAGE_WIDTH, 172.0)
    for row, (series, test) in zip(figure.subplots(2, 2), tests.items(), strict=True):
        cycles, sets = row
        draw_test(cycles, test)
        cycles.legend(loc="upper left")
        cycles.set_title(f"Bars, series {series}: cycles and the one used")
        draw_chosen(sets, test)
        draw_sets(sets, STRAIN[series])
        sets.set_title(f"Series {series}: parameter sets of Table 1")
        for axes in row:
            finish(axes, strain=STRAIN[series], stress=STRESS[series])
    handles, labels = sets.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3)
    figure.suptitle(SYNTHETIC_NOTE, fontsize=7.5, color=GREY)
    return figure
