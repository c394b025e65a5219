"""Mesh of the rubber between platen and road, and the graded mesh of a rectangular block."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import brentq
from skfem import MeshQuad

from fem.mesh.boundary import Chain, free_curves, named_chains, single_edges
from fem.mesh.grading import Grading
from materials.arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, kw_only=True)
class BlockMesh:
    """Mesh of undeformed rubber: quadrilaterals, the nodes that are held, and what follows.

    Attributes
    ----------
    points : (n, 2) float array
        Reference coordinates [mm]; the road is y = 0, the rubber begins at x = 0.
    cells : (ne, 4) int array
        Counter-clockwise corner nodes of each quadrilateral.
    top : int array
        Nodes that the platen holds, from the trailing to the leading end.
    direction : int
        +1 when the leading edge is at the largest x, -1 when it is at x = 0.
    breaks : tuple of float
        Where one block ends and the next begins [mm].
    """

    points: FloatArray
    cells: IntArray
    top: IntArray
    direction: int = 1
    breaks: tuple[float, ...] = ()

    @cached_property
    def mesh(self) -> MeshQuad:
        """The same mesh for scikit-fem, node and element numbers unchanged."""
        return MeshQuad(self.points.T.copy(), self.cells.T.copy(), sort_t=False)

    @cached_property
    def curves(self) -> list[IntArray]:
        """Free boundary by curve, from one end of the top to the next, trailing end first."""
        return free_curves(self.points, self.cells, self.top, self.direction)

    @cached_property
    def boundary(self) -> IntArray:
        """Nodes of all curves one after another, (m,)."""
        return np.concatenate(self.curves)

    @cached_property
    def joined(self) -> BoolArray:
        """Whether an edge joins a node of `boundary` and the next one, (m - 1,)."""
        ends = np.cumsum([len(curve) for curve in self.curves])[:-1]
        joined = np.ones(len(self.boundary) - 1, dtype=bool)
        joined[ends - 1] = False
        return joined

    @cached_property
    def boundary_edges(self) -> IntArray:
        """Free boundary edges, (k, 2), in the order of `boundary`."""
        return np.column_stack([self.boundary[:-1], self.boundary[1:]])[self.joined]

    @cached_property
    def is_free(self) -> BoolArray:
        """Which nodes of `boundary` the platen does not hold, (m,)."""
        return ~np.isin(self.boundary, self.top)

    @cached_property
    def candidates(self) -> IntArray:
        """Free nodes of `boundary`, which may come into contact, in its order."""
        return self.boundary[self.is_free]

    @cached_property
    def candidate_lengths(self) -> FloatArray:
        """Undeformed length of surface that each candidate stands for, (m,) [mm]."""
        edges = np.linalg.norm(np.diff(self.points[self.boundary], axis=0), axis=1)
        return self.at_candidates(np.where(self.joined, 0.5 * edges, 0.0))

    def at_candidates(self, halves: FloatArray) -> FloatArray:
        """Sum of what the two edges beside each candidate hold, given by edge of `boundary`."""
        beside = np.concatenate([[0.0], halves]) + np.concatenate([halves, [0.0]])
        return np.asarray(beside[self.is_free])

    @cached_property
    def chains(self) -> list[Chain]:
        """Named pieces of the free boundary; one after another they are the `candidates`."""
        return named_chains(self.points, self.curves, self.breaks, self.direction)

    @cached_property
    def bottoms(self) -> list[Chain]:
        """The chains that lie on the road, from the trailing to the leading one."""
        return [chain for chain in self.chains if chain.kind == "bottom"]

    @cached_property
    def bottom(self) -> IntArray:
        """Nodes of all bottoms, from the trailing to the leading corner."""
        return np.concatenate([chain.nodes for chain in self.bottoms])

    @cached_property
    def on_bottom(self) -> BoolArray:
        """Which candidates belong to a bottom."""
        return np.isin(self.candidates, self.bottom)

    @cached_property
    def bottom_lengths(self) -> FloatArray:
        """Length of bottom that each node of `bottom` stands for [mm]."""
        return np.concatenate([self._halves(chain.nodes) for chain in self.bottoms])

    @cached_property
    def leading_corners(self) -> IntArray:
        """The leading end of each bottom."""
        return np.array([chain.nodes[-1] for chain in self.bottoms])

    @cached_property
    def blocks(self) -> int:
        """Number of blocks on the platen."""
        return len(self.breaks) + 1

    @cached_property
    def size(self) -> FloatArray:
        """Shortest edge of each cell, (ne,) [mm]."""
        corners = self.points[self.cells]
        edges = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        return np.asarray(edges.min(axis=1))

    @cached_property
    def node_size(self) -> FloatArray:
        """Shortest edge of the cells around each node, (n,) [mm]."""
        size = np.full(len(self.points), np.inf)
        np.minimum.at(size, self.cells, self.size[:, None])
        return size

    @property
    def length(self) -> float:
        """Length along the sliding direction, grooves included [mm]."""
        return float(np.ptp(self.points[:, 0]))

    @property
    def height(self) -> float:
        """Height from the road to the platen [mm]."""
        return float(np.ptp(self.points[:, 1]))

    @cached_property
    def top_halves(self) -> FloatArray:
        """Half the length between a node of the top and the next one, 0 over a gap, (m - 1,)."""
        n, pairs = len(self.points), np.sort(np.column_stack([self.top[:-1], self.top[1:]]), axis=1)
        edges = np.sort(single_edges(self.cells), axis=1)
        joined = np.isin(pairs @ [n, 1], edges @ [n, 1])
        return np.where(joined, 0.5 * np.abs(np.diff(self.points[self.top, 0])), 0.0)

    @cached_property
    def top_length(self) -> float:
        """Length of the top, without gaps between its pieces [mm]."""
        x = self.points[self.top, 0]
        return float(np.ptp(x) - np.abs(np.diff(x))[self.top_halves == 0.0].sum())

    @cached_property
    def top_shares(self) -> FloatArray:
        """Share of the top's length that each of its nodes stands for, (m,) [-]."""
        halves = self.top_halves / self.top_length
        return np.asarray(np.append(halves, 0.0) + np.append(0.0, halves))

    @cached_property
    def bottom_cell_height(self) -> float:
        """Largest height of the cells at the bottom [mm]."""
        on = np.zeros(len(self.points), dtype=bool)
        on[self.bottom] = True
        y = self.points[self.cells[on[self.cells].sum(axis=1) == 2], 1]
        return float(np.ptp(y, axis=1).max())

    def from_trailing(self, nodes: IntArray) -> FloatArray:
        """Distance of nodes from the trailing end along the sliding direction [mm]."""
        x = self.points[:, 0]
        end = x.min() if self.direction > 0 else x.max()
        return np.abs(x[nodes] - end)

    def _halves(self, nodes: IntArray) -> FloatArray:
        halves = 0.5 * np.abs(np.diff(self.points[nodes, 0]))
        return np.asarray(np.append(halves, 0.0) + np.append(0.0, halves))


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
    if cells == 1 or smallest * cells >= length * (1.0 - 1e-9):
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
    node = np.arange((nx + 1) * (ny + 1)).reshape(nx + 1, ny + 1)
    gx, gy = np.meshgrid(x, y, indexing="ij")
    corners = [node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]]
    if direction < 0:
        gx = length - gx
        corners = [corners[1], corners[0], corners[3], corners[2]]
    return BlockMesh(
        points=np.column_stack([gx.ravel(), gy.ravel()]),
        cells=np.column_stack([c.ravel() for c in corners]),
        top=node[:, -1].copy(),
        direction=1 if direction > 0 else -1,
    )
