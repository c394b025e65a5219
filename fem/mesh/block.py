"""Graded quadrilateral mesh of the tread block, and the node sets its boundary conditions need."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from skfem import MeshQuad

from fem.mesh.grading import Grading

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class BlockMesh:
    """Mesh of the undeformed block with named boundary node sets.

    Attributes
    ----------
    points : (n, 2) float array
        Reference coordinates [mm]; the bottom is y = 0, the block spans 0 <= x <= L.
    cells : (ne, 4) int array
        Counter-clockwise corner nodes of each quadrilateral.
    bottom : int array
        Bottom nodes, ordered from the trailing to the leading corner.
    top : int array
        Top nodes, in the same order.
    front, rear : int array
        Nodes of the leading and the trailing face, from the bottom to the top.
    direction : int
        +1 when the leading edge is at x = L, -1 when it is at x = 0.
    """

    points: FloatArray
    cells: IntArray
    bottom: IntArray
    top: IntArray
    front: IntArray
    rear: IntArray
    direction: int = 1

    @cached_property
    def mesh(self) -> MeshQuad:
        """The same mesh for scikit-fem, node and element numbers unchanged."""
        return MeshQuad(self.points.T.copy(), self.cells.T.copy(), sort_t=False)

    @cached_property
    def grid(self) -> IntArray:
        """Node numbers by column and row, (nx + 1, ny + 1)."""
        return np.arange(len(self.points)).reshape(-1, len(self.rear))

    @cached_property
    def boundary(self) -> IntArray:
        """Free boundary nodes from the rear top corner over the bottom to the front top corner."""
        return np.concatenate([self.rear[::-1], self.bottom[1:-1], self.front])

    @cached_property
    def boundary_edges(self) -> IntArray:
        """Free boundary edges, (m, 2), in the order of `boundary`."""
        return np.column_stack([self.boundary[:-1], self.boundary[1:]])

    @cached_property
    def size(self) -> FloatArray:
        """Shortest edge of each cell, (ne,) [mm]."""
        corners = self.points[self.cells]
        edges = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        return np.asarray(edges.min(axis=1))

    @property
    def length(self) -> float:
        """Length of the block along the sliding direction [mm]."""
        return float(np.ptp(self.points[:, 0]))

    @property
    def height(self) -> float:
        """Height of the block [mm]."""
        return float(np.ptp(self.points[:, 1]))

    @cached_property
    def top_shares(self) -> FloatArray:
        """Share of the top's length that each of its nodes stands for, (m,) [-]."""
        halves = 0.5 * np.abs(np.diff(self.points[self.top, 0])) / self.length
        return np.asarray(np.append(halves, 0.0) + np.append(0.0, halves))

    @property
    def bottom_cell_height(self) -> float:
        """Largest height of the cells at the bottom [mm]."""
        y = self.points[self.grid[:, :2], 1]
        return float(np.max(y[:, 1] - y[:, 0]))

    @property
    def bottom_coordinate(self) -> FloatArray:
        """Distance of the bottom nodes from the trailing corner [mm]."""
        return np.abs(self.points[self.bottom, 0] - self.points[self.bottom[0], 0])


def graded_coordinates(length: float, cells: int, smallest: float) -> FloatArray:
    """Coordinates 0..length whose first cell has the given size and which grow geometrically.

    A smallest cell at or above the mean cell gives a uniform division.

    Parameters
    ----------
    length : float
        Total length [mm].
    cells : int
        Number of cells.
    smallest : float
        Size of the first cell [mm].

    Returns
    -------
    (cells + 1,) float array [mm]
    """
    if smallest * cells >= length * (1.0 - 1e-9):
        return np.linspace(0.0, length, cells + 1)
    target = length / smallest

    def excess(q: float) -> float:
        return float(np.expm1(cells * np.log(q)) / (q - 1.0) - target)

    # The last cell alone, q^(cells - 1) times the first, must not be longer than the whole.
    largest = target ** (1.0 / (cells - 1)) * (1.0 + 1e-9)
    ratio = brentq(excess, 1.0 + 1e-9, largest, xtol=1e-14)
    sizes = smallest * ratio ** np.arange(cells)
    coordinates = np.concatenate([[0.0], np.cumsum(sizes)])
    return np.asarray(coordinates * (length / coordinates[-1]))


def block_mesh(length: float, height: float, grading: Grading, direction: int = 1) -> BlockMesh:
    """Structured block mesh, fine at the bottom and at the leading edge.

    Parameters
    ----------
    length, height : float
        Dimensions of the block [mm].
    grading : Grading
        Cell counts and smallest cells.
    direction : {1, -1}
        Sense of sliding along x; the mesh for -1 is the mirror image of that for +1.

    Returns
    -------
    BlockMesh
    """
    x = length - graded_coordinates(length, grading.cells_x, grading.smallest_x)[::-1]
    y = graded_coordinates(height, grading.cells_y, grading.smallest_y)
    nx, ny = grading.cells_x, grading.cells_y
    # Numbering runs up the columns: the shorter side first keeps the bandwidth small.
    node = np.arange((nx + 1) * (ny + 1)).reshape(nx + 1, ny + 1)
    gx, gy = np.meshgrid(x, y, indexing="ij")
    corners = [node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]]
    if direction < 0:
        gx = length - gx
        corners = [corners[1], corners[0], corners[3], corners[2]]
    return BlockMesh(
        points=np.column_stack([gx.ravel(), gy.ravel()]),
        cells=np.column_stack([c.ravel() for c in corners]),
        bottom=node[:, 0].copy(),
        top=node[:, -1].copy(),
        front=node[-1, :].copy(),
        rear=node[0, :].copy(),
        direction=1 if direction > 0 else -1,
    )
