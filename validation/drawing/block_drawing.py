"""Drawing the block: cells coloured by a field, mesh lines, the road, outlines; 1:1 always."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize
from matplotlib.patches import Rectangle

from materials.arrays import FloatArray, IntArray
from validation.drawing.style import BLACK, GREY, ROAD_GREY

#: x_min, x_max, y_min, y_max [mm].
Window = tuple[float, float, float, float]
#: Part of the length and of the height, at the leading bottom corner, that a detail has to show.
EDGE_SEEN = (0.14, 0.25)


def draw_smooth(
    axes: Axes,
    points: FloatArray,
    cells: IntArray,
    nodal: FloatArray,
    norm: Normalize,
    colours: str,
) -> ScalarMappable:
    """Fill the cells with a field that is given at the nodes, interpolated inside."""
    triangles = np.vstack([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
    return axes.tripcolor(
        points[:, 0], points[:, 1], triangles, nodal, shading="gouraud", norm=norm, cmap=colours
    )


def nodal_average(points: FloatArray, cells: IntArray, values: FloatArray) -> FloatArray:
    """Area-weighted mean at each node of a field that is constant in each cell, (n,).

    It removes the checkerboard that element pressures carry where the mesh is coarse.
    """
    weights = cell_areas(points[cells])
    nodes, count = cells.ravel(), len(points)
    total = np.bincount(nodes, np.repeat(weights * values, 4), minlength=count)
    return np.asarray(total / np.bincount(nodes, np.repeat(weights, 4), minlength=count))


def cell_areas(corners: FloatArray) -> FloatArray:
    """Areas of quadrilaterals given by their corners, (ne, 4, 2) [mm^2]."""
    d1, d2 = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    return np.asarray(0.5 * np.abs(d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0]))


def draw_mesh(
    axes: Axes, points: FloatArray, cells: IntArray, *, fill: str = "none", linewidth: float = 0.2
) -> None:
    """Draw the edges of all cells."""
    look = {"facecolors": fill, "edgecolors": BLACK, "linewidths": linewidth}
    axes.add_collection(PolyCollection(points[cells], **look), autolim=False)


def outline(cells: IntArray) -> IntArray:
    """Edges that belong to one cell only, (m, 2) node numbers."""
    edges = np.vstack([cells[:, [i, (i + 1) % 4]] for i in range(4)])
    keys = np.sort(edges, axis=1)
    _, first, counts = np.unique(keys, axis=0, return_index=True, return_counts=True)
    return np.asarray(edges[first[counts == 1]])


def draw_outline(axes: Axes, points: FloatArray, cells: IntArray, **style: Any) -> None:
    """Draw the contour of the block."""
    lines = LineCollection(list(points[outline(cells)]), **({"colors": BLACK, "lw": 0.6} | style))
    axes.add_collection(lines, autolim=False)


def draw_road(axes: Axes, window: Window) -> None:
    """Draw the rigid road as a hatched band below y = 0."""
    x_min, x_max, y_min, _ = window
    look = {"facecolor": ROAD_GREY, "edgecolor": GREY, "hatch": "////", "linewidth": 0.0}
    axes.add_patch(Rectangle((x_min, y_min), x_max - x_min, -y_min, **look))
    axes.plot([x_min, x_max], [0.0, 0.0], color=BLACK, lw=0.8)


def set_window(axes: Axes, window: Window) -> None:
    """Set the limits and the 1:1 aspect."""
    axes.set(xlim=window[:2], ylim=window[2:])
    axes.set_aspect("equal", adjustable="box")


def mark_window(axes: Axes, window: Window, colour: str = BLACK) -> None:
    """Draw the frame of a detail that is shown elsewhere."""
    x_min, x_max, y_min, y_max = window
    size = (x_max - x_min, y_max - y_min)
    axes.add_patch(Rectangle((x_min, y_min), *size, fill=False, edgecolor=colour, lw=0.7))


def front_window(X: FloatArray, points: FloatArray, *, direction: int, aspect: float) -> Window:
    """Window of a height over width around the deformed front edge.

    `X` and `points` are reference and current coordinates, (n, 2) [mm]; `direction` is +1 if the
    block slides to the right.
    """
    from_front = (X[:, 0].max() - X[:, 0]) if direction > 0 else (X[:, 0] - X[:, 0].min())
    share_x, share_y = EDGE_SEEN
    corner = (from_front <= share_x * np.ptp(X[:, 0])) & (X[:, 1] <= share_y * np.ptp(X[:, 1]))
    low, high = points[corner].min(axis=0), points[corner].max(axis=0)
    width = max(high[0] - low[0], (high[1] - min(low[1], 0.0)) / aspect) * 1.1
    centre = 0.5 * (low[0] + high[0])
    bottom = min(low[1], 0.0) - 0.06 * width * aspect
    return (centre - width / 2, centre + width / 2, bottom, bottom + aspect * width)
