"""Figure 8: state of the block at the end of the introductory example, and how it got there."""

from pathlib import Path

from matplotlib.figure import Figure

from fem.files import write_table
from fem.results import Result
from validation.drawing import (
    PAGE_WIDTH,
    WIDTHS,
    draw_fields,
    draw_friction,
    draw_temperature,
    last_state,
    new_figure,
    reached,
    save,
    styled,
)
from validation.paper.introductory import introductory_run

SHOWN = ("time_s", "sliding_distance_mm", "friction_coefficient", "T_max_C", "T_edge_C")


def make(directory: Path) -> Path:
    """Draw figure 8 from the introductory run, which is simulated first if it is not there."""
    result = introductory_run(directory)
    write_table(directory / "fig8.csv", result.history[list(SHOWN)])
    return save(draw(result), directory / "fig8.png")


@styled
def draw(result: Result) -> Figure:
    """Draw mesh, temperature and stress, each with its detail, and the history below."""
    state = last_state(result)
    figure = new_figure(PAGE_WIDTH, 198.0)
    rows = figure.subplots(4, 2, width_ratios=WIDTHS, height_ratios=[1.0, 1.0, 1.0, 0.95])
    loading = result.case.loading
    figure.suptitle(
        f"Sliding distance {abs(state.snapshot.sliding_distance_mm):.4g} mm,  "
        rf"$v$ = {abs(loading.velocity_mm_per_s):g} mm/s,  "
        rf"$\bar p$ = {loading.mean_pressure_N_per_mm2:g} N/mm²{reached(result)}",
        fontsize=9.5,
    )
    draw_fields(figure, rows[:3], state)
    left, right = rows[3]
    draw_friction(left, result.history)
    left.set_title("(d) Friction coefficient")
    draw_temperature(right, result.history)
    right.set_title("(e) Bottom temperature")
    return figure
