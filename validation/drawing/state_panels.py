"""Mesh, temperature and stress of a result's last state, each with its front edge."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fem.results import Result
from validation.drawing.field_panels import (
    BlockState,
    Panel,
    colour_bar,
    draw_panel,
    mesh_panel,
    stress_panel,
    temperature_panel,
)

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
    slid = result.history["sliding_distance_mm"]
    return f", stopped at {abs(slid.iloc[-1]) if len(slid) else 0.0:.3g} mm"


def draw_fields(figure: Figure, rows: list[list[Axes]], state: BlockState) -> None:
    """Draw as many of `PANELS` as there are rows: the whole block and its front edge."""
    whole, detail = state.whole, state.front(DETAIL_ASPECT)
    for (left, right), (panel, title, label, extend) in zip(rows, PANELS, strict=False):
        views = ((left, whole, detail, title), (right, detail, None, "Front edge"))
        for axes, window, inset, text in views:
            field = draw_panel(axes, panel, state, window, title=text, detail=inset)
            if field is not None and label is not None:
                colour_bar(figure, axes, field, label, extend=extend)
            if left is rows[-1][0]:
                axes.set_xlabel("$x$ in the platen's frame [mm]")
