"""Figure 7: cross-section of the block, boundary conditions and finite-element mesh."""

from pathlib import Path

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import ConnectionPatch, Rectangle

from fem.case import Case
from fem.files import write_table
from fem.mesh import BlockMesh
from fem.stepping import mesh_of
from validation.drawing import (
    BLACK,
    BLUE,
    GREY,
    PAGE_WIDTH,
    RUBBER_GREY,
    VERMILLION,
    Window,
    draw_mesh,
    draw_outline,
    draw_road,
    mark_window,
    new_figure,
    save,
    set_window,
    styled,
)
from validation.paper.introductory import introductory_case

#: Side of the square detail at the leading edge [mm].
DETAIL = 1.6
_THIN_ARROW = {"arrowstyle": "-|>", "lw": 0.8, "mutation_scale": 7, "shrinkA": 0, "shrinkB": 0}


def make(directory: Path) -> Path:
    """Draw figure 7 and write the node coordinates beside it."""
    case = introductory_case()
    mesh = mesh_of(case)
    nodes = pd.DataFrame(mesh.points, columns=["X_mm", "Y_mm"]).rename_axis("node")
    write_table(directory / "fig7.csv", nodes.reset_index())
    return save(draw(case, mesh), directory / "fig7.png")


@styled
def draw(case: Case, mesh: BlockMesh) -> Figure:
    """Draw block, loads and supports on the left and the mesh at the leading corner beside it."""
    figure = new_figure(PAGE_WIDTH, 84.0)
    whole, detail = figure.subplots(1, 2, width_ratios=[2.05, 1.0])
    front = mesh.points[mesh.leading_corners[-1], 0]
    sides = sorted(front + mesh.direction * share * DETAIL for share in (-0.85, 0.15))
    window = (sides[0], sides[1], -0.15 * DETAIL, 0.85 * DETAIL)
    _draw_whole(whole, case, mesh, window)
    _draw_detail(detail, mesh, window)
    look = {"axesA": whole, "axesB": detail, "color": GREY, "lw": 0.5}
    for y in window[2:]:
        ends = (window[1], y), (window[0], y)
        figure.add_artist(ConnectionPatch(*ends, "data", "data", **look))
    return figure


def _draw_whole(axes: Axes, case: Case, mesh: BlockMesh, detail: Window) -> None:
    L, H = mesh.length, mesh.height
    view = (-0.16 * L, 1.14 * L, -0.46 * H, 1.66 * H)
    set_window(axes, view)
    axes.axis("off")
    draw_road(axes, (view[0], view[1], -0.10 * H, 0.0))
    draw_mesh(axes, mesh.points, mesh.cells, fill=RUBBER_GREY, linewidth=0.15)
    draw_outline(axes, mesh.points, mesh.cells, lw=0.9)
    _draw_platen(axes, L, H)
    _draw_pressure(axes, case, L, H)
    _draw_velocity(axes, case, mesh)
    _draw_dimensions(axes, L, H)
    _draw_axes_cross(axes, view)
    mark_window(axes, detail)
    axes.text(0.5 * L, -0.175 * H, "rigid road", ha="center", va="center", fontsize=7)
    axes.set_title("Block with loads and supports, dimensions in mm")


def _draw_platen(axes: Axes, L: float, H: float) -> None:
    look = {"facecolor": "#B8B8B8", "edgecolor": BLACK, "hatch": "\\\\\\\\", "linewidth": 0.7}
    axes.add_patch(Rectangle((0.0, H), L, 0.07 * H, **look))
    axes.text(1.02 * L, 1.035 * H, "rigid\nplaten", va="center", fontsize=7)


def _draw_pressure(axes: Axes, case: Case, L: float, H: float) -> None:
    low, high = 1.07 * H, 1.24 * H
    for i in range(13):
        x = L * (0.5 + i) / 13
        axes.annotate("", (x, low), (x, high), arrowprops={**_THIN_ARROW, "color": BLUE})
    axes.plot([L / 26, L * 25 / 26], [high, high], color=BLUE, lw=0.8)
    said = rf"(1)  $\bar p$ = {case.loading.mean_pressure_N_per_mm2:g} N/mm²"
    axes.text(0.5 * L, 1.27 * H, said, ha="center", va="bottom", color=BLUE)


def _draw_velocity(axes: Axes, case: Case, mesh: BlockMesh) -> None:
    L, H, v = mesh.length, mesh.height, abs(case.loading.velocity_mm_per_s)
    middle = 0.5 * L
    start, end = middle - mesh.direction * 0.14 * L, middle + mesh.direction * 0.14 * L
    arrow = {**_THIN_ARROW, "lw": 2.0, "mutation_scale": 13, "color": VERMILLION}
    axes.annotate("", (end, 1.46 * H), (start, 1.46 * H), arrowprops=arrow)
    said = rf"(2)  $v$ = {v:g} mm/s over $g_T$ = {case.loading.distance_mm:g} mm"
    axes.text(middle, 1.50 * H, said, ha="center", va="bottom", color=VERMILLION)


def _draw_dimensions(axes: Axes, L: float, H: float) -> None:
    arrow = {**_THIN_ARROW, "arrowstyle": "<|-|>", "color": BLACK, "lw": 0.6}
    y, x = -0.26 * H, -0.09 * L
    axes.annotate("", (0.0, y), (L, y), arrowprops=arrow)
    axes.text(0.5 * L, y - 0.02 * H, f"{L:g}", ha="center", va="top")
    axes.annotate("", (x, 0.0), (x, H), arrowprops=arrow)
    axes.text(x - 0.01 * L, 0.5 * H, f"{H:g}", ha="right", va="center", rotation=90)
    for end in (0.0, L):
        axes.plot([end, end], [-0.10 * H, y - 0.03 * H], color=BLACK, lw=0.4)
    for end in (0.0, H):
        axes.plot([-0.01 * L, x - 0.015 * L], [end, end], color=BLACK, lw=0.4)


def _draw_axes_cross(axes: Axes, view: Window) -> None:
    x, y, size = view[0] + 0.4, view[2] + 0.4, 1.5
    for dx, dy, name in ((size, 0.0, "$x$"), (0.0, size, "$y$")):
        axes.annotate("", (x + dx, y + dy), (x, y), arrowprops={**_THIN_ARROW, "color": BLACK})
        axes.text(x + 1.3 * dx, y + 1.3 * dy, name, ha="center", va="center")


def _draw_detail(axes: Axes, mesh: BlockMesh, window: Window) -> None:
    set_window(axes, window)
    draw_road(axes, window)
    draw_mesh(axes, mesh.points, mesh.cells, fill=RUBBER_GREY, linewidth=0.4)
    draw_outline(axes, mesh.points, mesh.cells, lw=1.0)
    for side in ("top", "right"):
        axes.spines[side].set_visible(True)
    axes.yaxis.tick_right()
    axes.yaxis.set_label_position("right")
    axes.set(xlabel="$X$ [mm]", ylabel="$Y$ [mm]")
    smallest = mesh.size.min()
    axes.set_title(f"Leading edge, {len(mesh.cells)} elements,\nsmallest edge {smallest:.2g} mm")
