"""Panels of one snapshot: deformed mesh, temperature, vertical stress, whole block or a detail."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from fem.results import BlockGeometry, Snapshot
from materials.arrays import FloatArray
from validation.drawing.block_drawing import (
    Window,
    cell_areas,
    draw_mesh,
    draw_outline,
    draw_road,
    draw_smooth,
    front_window,
    mark_window,
    nodal_average,
    set_window,
)
from validation.drawing.style import RUBBER_GREY, STRESS_MAP, TEMPERATURE_MAP

#: Depth of the road that is drawn under the whole block [mm].
ROAD_DEPTH = 0.9
#: Share of the area that may lie beyond each end of the stress scale: peaks at the front edge
#: would otherwise leave the block in one colour. The colour bar's arrows say that there is more.
BEYOND_SCALE = 0.01


@dataclass(frozen=True, kw_only=True)
class BlockState:
    """A snapshot with its reference mesh; `direction` is +1 if the block slides to the right."""

    geometry: BlockGeometry
    snapshot: Snapshot
    direction: int

    @property
    def points(self) -> FloatArray:
        """Current coordinates in the platen's frame, (n, 2) [mm]."""
        return np.asarray(self.geometry.points + self.snapshot.displacement)

    @property
    def whole(self) -> Window:
        """Window around the whole block and the upper road [mm]."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        margin = 0.04 * (high[0] - low[0])
        return (low[0] - margin, high[0] + margin, -ROAD_DEPTH, high[1] + margin)

    def front(self, aspect: float) -> Window:
        """Window around the front edge [mm]."""
        rest = self.geometry.points
        return front_window(rest, self.points, direction=self.direction, aspect=aspect)

    def seen(self, window: Window) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Which elements have a corner inside a window, (ne,)."""
        x, y = self.points[self.geometry.cells].transpose(2, 0, 1)
        inside = (x >= window[0]) & (x <= window[1]) & (y >= window[2]) & (y <= window[3])
        return np.asarray(inside.any(axis=1))


Panel = Callable[[Axes, BlockState, Window], ScalarMappable | None]


def mesh_panel(axes: Axes, state: BlockState, window: Window) -> None:
    """Draw the deformed mesh on the road."""
    width = 0.12 if window == state.whole else 0.3
    draw_road(axes, window)
    draw_mesh(axes, state.points, state.geometry.cells, fill=RUBBER_GREY, linewidth=width)
    draw_outline(axes, state.points, state.geometry.cells)


def temperature_panel(axes: Axes, state: BlockState, window: Window) -> ScalarMappable:
    """Draw the temperature of block and road, the scale covering what the window shows."""
    snapshot, cells = state.snapshot, state.geometry.cells
    shown = snapshot.temperature[cells[state.seen(window)]]
    low = min(float(snapshot.temperature.min()), float(snapshot.road_temperature.min()))
    norm = Normalize(low, max(float(shown.max()), low + 1.0))
    x_road = snapshot.road_points[:, 0]
    axes.set_facecolor("white")
    near = (x_road[snapshot.road_cells] > window[0] - 2.0).any(axis=1)
    near &= (x_road[snapshot.road_cells] < window[1] + 2.0).any(axis=1)
    road = (snapshot.road_points, snapshot.road_cells[near], snapshot.road_temperature)
    draw_smooth(axes, *road, norm, TEMPERATURE_MAP)
    field = draw_smooth(axes, state.points, cells, snapshot.temperature, norm, TEMPERATURE_MAP)
    draw_outline(axes, state.points, cells, colors="0.35", lw=0.4)
    axes.plot(window[:2], [0.0, 0.0], color="0.85", lw=0.5, ls=(0, (4, 3)))
    return field


def stress_panel(axes: Axes, state: BlockState, window: Window) -> ScalarMappable:
    """Draw the vertical normal stress, the scale covering 98 % of what the window shows."""
    return draw_stress(axes, state, window, stress_scale(state, window))


def draw_stress(axes: Axes, state: BlockState, window: Window, norm: Normalize) -> ScalarMappable:
    """Draw the vertical normal stress on a given scale."""
    cells, sigma_y = state.geometry.cells, vertical_stress(state)
    draw_road(axes, window)
    field = draw_smooth(axes, state.points, cells, sigma_y, norm, STRESS_MAP)
    draw_outline(axes, state.points, cells)
    return field


def vertical_stress(state: BlockState) -> FloatArray:
    """sigma_y at the nodes, averaged over the elements around each, (n,) [N/mm^2]."""
    geometry = state.geometry
    return nodal_average(geometry.points, geometry.cells, state.snapshot.cauchy_stress[:, 1])


def stress_scale(state: BlockState, window: Window) -> Normalize:
    """Limits between which 98 % of the visible area lie, rounded to 0.05 N/mm^2."""
    visible = state.seen(window)
    values = vertical_stress(state)[state.geometry.cells[visible]].mean(axis=1)
    area = cell_areas(state.points[state.geometry.cells[visible]])
    order = np.argsort(values)
    share = np.cumsum(area[order]) / area.sum()
    low = values[order][np.searchsorted(share, BEYOND_SCALE)]
    high = values[order][np.searchsorted(share, 1.0 - BEYOND_SCALE)]
    step = 0.05
    return Normalize(step * np.floor(low / step), step * np.ceil(high / step))


def draw_panel(
    axes: Axes,
    panel: Panel,
    state: BlockState,
    window: Window,
    *,
    title: str,
    detail: Window | None = None,
) -> ScalarMappable | None:
    """Draw one panel with limits, labels and title; mark a detail that is shown elsewhere."""
    field = panel(axes, state, window)
    set_window(axes, window)
    for side in ("top", "right"):
        axes.spines[side].set_visible(True)
    if detail is not None:
        mark_window(axes, detail)
    axes.set(title=title, ylabel="$y$ [mm]")
    axes.locator_params(nbins=6)
    return field


def colour_bar(
    figure: Figure, axes: Axes, field: ScalarMappable, label: str, *, extend: str = "neither"
) -> None:
    """Put a colour bar as high as the panel to its right."""
    place = axes.inset_axes((1.025, 0.0, 0.028, 1.0))
    bar = figure.colorbar(field, cax=place, label=label, extend=extend, extendfrac=0.06)
    bar.outline.set_linewidth(0.5)
    bar.ax.locator_params(nbins=6)
