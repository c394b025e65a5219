"""Figure 8: state of the block at the end of the introductory example, and how it got there."""

from __future__ import annotations

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fem.results import Result
from validation.field_panels import (
    BlockState,
    Panel,
    colour_bar,
    draw_panel,
    mesh_panel,
    stress_panel,
    temperature_panel,
)
from validation.history_panels import draw_friction, draw_temperature
from validation.introductory import introductory_run
from validation.style import PAGE_WIDTH, new_figure, save, styled

#: Height over width of the details.
DETAIL_ASPECT = 0.66
#: Widths of the columns, such that both panels of a row are about equally high.
WIDTHS = (1.6, 1.0)
#: Rows of fields: how to draw, title, label and ends of the colour bar.
PANELS: tuple[tuple[Panel, str, str | None, str], ...] = (
    (mesh_panel, "(a) Deformed mesh", None, "neither"),
    (temperature_panel, "(b) Temperature", "$T$ [°C]", "neither"),
    (stress_panel, "(c) Vertical normal stress", r"$\sigma_y$ [N/mm²]", "both"),
)
SHOWN = ("time_s", "sliding_distance_mm", "friction_coefficient", "T_max_C", "T_edge_C")


def make(directory: Path) -> Path:
    """Draw figure 8 from the introductory run, which is simulated first if it is not there."""
    result = introductory_run(directory)
    result.history[list(SHOWN)].to_csv(directory / "fig8.csv", index=False, lineterminator="\n")
    return save(draw(result), directory / "fig8.png")


def last_state(result: Result) -> BlockState:
    """The last snapshot of a result."""
    if not result.snapshots:
        raise ValueError("the result has no snapshot to draw (no step was accepted)")
    return BlockState(
        geometry=result.geometry,
        snapshot=result.snapshots[-1],
        direction=1 if result.case.loading.velocity_mm_per_s > 0.0 else -1,
    )


def reached(result: Result) -> str:
    """What to say beside a run that did not get to its end; nothing for one that did."""
    if result.summary["status"] == "ok":
        return ""
    return f", stopped at {last_distance(result):.3g} mm"


def last_distance(result: Result) -> float:
    """Sliding distance at the last accepted step [mm]."""
    distance = result.history["sliding_distance_mm"]
    return float(abs(distance.iloc[-1])) if len(distance) else 0.0


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
    _draw_history(rows[3], result)
    return figure


def draw_fields(figure: Figure, rows: list[list[Axes]], state: BlockState) -> None:
    """Draw as many of `PANELS` as there are rows: the whole block and its front edge."""
    whole, detail = state.whole, state.front(DETAIL_ASPECT)
    for (left, right), (panel, title, label, extend) in zip(rows, PANELS, strict=False):
        for axes, window, inset, text in (
            (left, whole, detail, title),
            (right, detail, None, "Front edge"),
        ):
            field = draw_panel(axes, panel, state, window, title=text, detail=inset)
            if field is not None and label is not None:
                colour_bar(figure, axes, field, label, extend=extend)
            if left is rows[-1][0]:
                axes.set_xlabel("$x$ in the platen's frame [mm]")


def _draw_history(row: list[Axes], result: Result) -> None:
    left, right = row
    draw_friction(left, result.history)
    left.set_title("(d) Friction coefficient")
    draw_temperature(right, result.history)
    right.set_title("(e) Bottom temperature")
