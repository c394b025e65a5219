"""Figure 2: cyclic test of a dumbbell and the parameter sets of Table 1."""

from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from calibration import synthetic_dumbbell_cycles
from fem.files import write_table
from validation.drawing import GREY, PAGE_WIDTH, new_figure, save, styled
from validation.paper.stress_panels import SYNTHETIC_NOTE, draw_row, marked, set_table

STRAIN, STRESS = (-22.0, 52.0), (-1.2, 1.25)


def make(directory: Path) -> Path:
    """Draw figure 2 and write the synthetic test and the curves of the sets beside it."""
    test = synthetic_dumbbell_cycles()
    write_table(directory / "fig2_synthetic_test.csv", marked(test))
    write_table(directory / "fig2.csv", set_table(STRAIN))
    return save(draw(test), directory / "fig2.png")


@styled
def draw(test: pd.DataFrame) -> Figure:
    """Draw the cycles on the left and the parameter sets over the chosen one on the right."""
    figure = new_figure(PAGE_WIDTH, 95.0)
    row = figure.subplots(1, 2)
    titles = ("Dumbbell: cycles and the one used", "Parameter sets of Table 1")
    draw_row(row, test, STRAIN, STRESS, titles)
    row[1].legend(loc="lower right", fontsize=6.5)
    figure.suptitle(SYNTHETIC_NOTE, fontsize=7.5, color=GREY)
    return figure
