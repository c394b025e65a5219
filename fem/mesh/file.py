"""Meshes from files of mesh generators: quadrilaterals in mm, the road at y = 0, held at `top`.

meshio reads the formats. Of gmsh and Abaqus the group `top` is a named set of lines or nodes, of
VTK, which has no groups, an array `top` at points or cells that is not zero there.
"""

from __future__ import annotations

import contextlib
import io
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from fem.mesh.block import BlockMesh
from fem.mesh.boundary import free_curves, single_edges
from materials.arrays import BoolArray, FloatArray, IntArray

#: Name of the group that the platen holds.
TOP = "top"
#: Lengths below this share of the shortest edge are zero.
TOLERANCE = 1e-3
#: Smallest and largest height of a block [mm].
HEIGHTS = (0.5, 500.0)
_FILES = "a mesh file of gmsh (.msh), Abaqus (.inp) or VTK (.vtk, .vtu)"


class MeshFileError(ValueError):
    """What is wrong with a mesh file, and what is expected instead."""

    def __init__(self, found: str, expected: str) -> None:
        super().__init__(f"{found}; expected {expected}")
        self.found, self.expected = found, expected


def read_mesh(path: str | Path, direction: int) -> BlockMesh:
    """Read a mesh, its leading edge on the side of the motion.

    Parameters
    ----------
    path : str or Path
        The file; its format follows from the ending.
    direction : {1, -1}
        Sense of sliding along x.

    Raises
    ------
    MeshFileError
        If it is not a mesh of one block, saying what was found and expected.
    """
    mesh = _read(Path(path))
    cells = _quads(mesh)
    points, cells, top = _used(np.asarray(mesh.points, dtype=float), cells, _top(mesh))
    _check_places(points, cells)
    _check_cells(points, cells)
    _check_joints(points, cells)
    top = _check_top(points, top)
    points = points - [points[:, 0].min(), 0.0]
    order = np.argsort(direction * points[top, 0], kind="stable")
    direction = 1 if direction > 0 else -1
    try:
        free_curves(points, cells, top, direction)
    except ValueError as error:
        raise MeshFileError(str(error), "one piece without holes, held at its top") from None
    return BlockMesh(points=points, cells=cells, top=top[order], direction=direction)


def _read(path: Path) -> Any:
    import meshio

    if not path.is_file():
        raise MeshFileError("no such file", _FILES)
    said = io.StringIO()
    try:
        # meshio prints what it does not understand, and ends the program on damaged files.
        with (
            contextlib.redirect_stdout(said),
            contextlib.redirect_stderr(said),
            warnings.catch_warnings(),
        ):
            warnings.simplefilter("ignore")
            return meshio.read(path)
    except SystemExit:
        raise MeshFileError("not readable", _FILES) from None
    except Exception as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise MeshFileError(f"not readable ({reason[:120]})", _FILES) from None


def _quads(mesh: Any) -> IntArray:
    """Quadrilaterals of the file; lines and points beside them are allowed."""
    counts: dict[str, int] = {}
    for block in mesh.cells:
        counts[block.type] = counts.get(block.type, 0) + len(block.data)
    others = {k: n for k, n in counts.items() if not k.startswith(("quad", "line", "vertex"))}
    if others:
        kind, count = next(iter(others.items()))
        raise MeshFileError(f"{count} cells of type {kind}", "quadrilaterals only (recombine)")
    curved = [kind for kind in counts if kind.startswith("quad") and kind != "quad"]
    if curved:
        raise MeshFileError(f"{counts[curved[0]]} cells of type {curved[0]}", "4 nodes per cell")
    if not counts.get("quad"):
        raise MeshFileError("no quadrilaterals", "a mesh of them")
    return np.concatenate(
        [np.asarray(b.data, dtype=np.int64) for b in mesh.cells if b.type == "quad"]
    )


def _top(mesh: Any) -> BoolArray:
    """Points of the group `top`."""
    held = np.zeros(len(mesh.points), dtype=bool)
    found = sorted({*mesh.point_sets, *mesh.cell_sets, *mesh.field_data})
    for name, nodes in mesh.point_sets.items():
        if name.lower() == TOP:
            held[np.asarray(nodes, dtype=np.int64)] = True
    for block, numbers in zip(mesh.cells, _numbers_of_top(mesh), strict=True):
        if len(numbers):
            held[np.unique(np.asarray(block.data)[numbers])] = True
    for name, values in mesh.point_data.items():
        if name.lower() == TOP:
            held |= np.asarray(values).reshape(len(held), -1).any(axis=1)
    if not held.any():
        known = ", ".join(name for name in found if ":" not in name) or "none"
        raise MeshFileError(f"no group {TOP} (groups: {known})", f"a group {TOP} of lines or nodes")
    return held


def _numbers_of_top(mesh: Any) -> list[IntArray]:
    """Numbers of the cells of the group in each of the file's lists of cells."""
    empty = np.zeros(0, dtype=np.int64)
    for name, lists in mesh.cell_sets.items():
        if name.lower() == TOP:
            return [empty if n is None else np.asarray(n, dtype=np.int64) for n in lists]
    tags = {name.lower(): int(tag[0]) for name, tag in mesh.field_data.items()}
    if TOP in tags and "gmsh:physical" in mesh.cell_data:
        physical = mesh.cell_data["gmsh:physical"]
        return [
            np.flatnonzero(np.asarray(values) == tags[TOP]) if block.dim == 1 else empty
            for block, values in zip(mesh.cells, physical, strict=True)
        ]
    for name, lists in mesh.cell_data.items():
        if name.lower() == TOP:
            return [
                np.flatnonzero(np.asarray(values)) if block.dim == 1 else empty
                for block, values in zip(mesh.cells, lists, strict=True)
            ]
    return [empty for _ in mesh.cells]


def _used(
    points: FloatArray, cells: IntArray, held: BoolArray
) -> tuple[FloatArray, IntArray, IntArray]:
    """Plane points that belong to cells, cells with their new numbers, nodes of the top."""
    nodes, cells = np.unique(cells, return_inverse=True)
    used = points[nodes]
    if not np.isfinite(used).all():
        raise MeshFileError("coordinates that are not finite", "numbers in mm")
    if used.shape[1] > 2 and np.ptp(used[:, 2]) > 1e-9 * np.ptp(used[:, :2]):
        raise MeshFileError(f"z from {used[:, 2].min():g} to {used[:, 2].max():g}", "a plane mesh")
    return used[:, :2].copy(), cells.reshape(-1, 4), np.flatnonzero(held[nodes])


def _check_places(points: FloatArray, cells: IntArray) -> None:
    low, height = float(points[:, 1].min()), float(np.ptp(points[:, 1]))
    if not HEIGHTS[0] <= height <= HEIGHTS[1]:
        unit = ", which looks like metres" if HEIGHTS[0] <= 1e3 * height <= HEIGHTS[1] else ""
        raise MeshFileError(f"a height of {height:.4g}{unit}", "millimetres")
    if abs(low) > 1e-6 * height:
        raise MeshFileError(f"a lowest point at y = {low:.6g} mm", "the road at y = 0, y upwards")


def _check_cells(points: FloatArray, cells: IntArray) -> None:
    edge = np.roll(points[cells], -1, axis=1) - points[cells]
    cross = edge[..., 0] * np.roll(edge, -1, axis=1)[..., 1]
    cross -= edge[..., 1] * np.roll(edge, -1, axis=1)[..., 0]
    shortest = np.linalg.norm(edge, axis=2).min()
    if not shortest > 0.0:
        raise MeshFileError("a cell with an edge of no length", "four different corners per cell")
    wrong = np.flatnonzero((cross <= 0.0).all(axis=1))
    if wrong.size:
        found = (
            f"{wrong.size} cells of negative area, the first at {_place(points[cells[wrong[0]]])}"
        )
        raise MeshFileError(found, "corners counter-clockwise (normals along z)")
    wrong = np.flatnonzero((cross <= 0.0).any(axis=1))
    if wrong.size:
        place = _place(points[cells[wrong[0]]])
        found = f"{wrong.size} cells that are not convex, the first at {place}"
        raise MeshFileError(found, "convex quadrilaterals")


def _check_joints(points: FloatArray, cells: IntArray) -> None:
    """Nodes at one place, nodes on the edge of a cell they do not belong to, loose pieces."""
    edge = np.roll(points[cells], -1, axis=1) - points[cells]
    zero = TOLERANCE * float(np.linalg.norm(edge, axis=2).min())
    doubled = cKDTree(points).query_pairs(zero, output_type="ndarray")
    if len(doubled):
        place = _place(points[doubled[:1, 0]])
        found = f"{len(doubled)} pairs of nodes at one place, the first at {place}"
        raise MeshFileError(found, "cells that share their nodes")
    hanging = _hanging(points, single_edges(cells), zero)
    if hanging.size:
        found = f"{hanging.size} nodes on edges they do not belong to, the first at "
        raise MeshFileError(found + _place(points[hanging[:1]]), "cells that meet at their corners")
    n = len(points)
    ends = np.concatenate([cells[:, [i, (i + 1) % 4]] for i in range(4)])
    graph = coo_matrix((np.ones(len(ends)), ends.T), shape=(n, n))
    pieces = connected_components(graph, directed=False, return_labels=False)
    if pieces > 1:
        raise MeshFileError(f"{pieces} loose pieces", "one piece (several blocks: blocks = ...)")
    shared = np.sort(ends, axis=1) @ [n, 1]
    _, counts = np.unique(shared, return_counts=True)
    if counts.max() > 2:
        raise MeshFileError("an edge of more than two cells", "cells that do not lie on each other")


def _hanging(points: FloatArray, edges: IntArray, zero: float) -> IntArray:
    """Nodes of the boundary in the middle of boundary edges."""
    nodes = np.unique(edges)
    a, b = points[edges[:, 0]], points[edges[:, 1]]
    length = np.linalg.norm(b - a, axis=1)
    near = cKDTree(points[nodes]).query_ball_point(0.5 * (a + b), 0.5 * length)
    edge = np.repeat(np.arange(len(edges)), [len(n) for n in near])
    node = nodes[np.concatenate([np.asarray(n, dtype=np.int64) for n in near])]
    t = (b[edge] - a[edge]) / length[edge][:, None]
    w = points[node] - a[edge]
    off = np.abs(t[:, 0] * w[:, 1] - t[:, 1] * w[:, 0])
    along = np.sum(t * w, axis=1)
    inside = (off < zero) & (along > zero) & (along < length[edge] - zero)
    return np.unique(node[inside])


def _check_top(points: FloatArray, top: IntArray) -> IntArray:
    y, height = points[top, 1], float(points[:, 1].max())
    if not len(top):
        raise MeshFileError(
            f"a group {TOP} beside the mesh", f"a group {TOP} of its lines or nodes"
        )
    if np.ptp(y) > 1e-6 * height:
        found = f"a group {TOP} from y = {y.min():.4g} to {y.max():.4g} mm"
        raise MeshFileError(found, "a straight top along x")
    if y[0] < (1.0 - 1e-6) * height:
        found = f"a group {TOP} at y = {y[0]:.4g} mm and rubber up to {height:.4g} mm"
        raise MeshFileError(found, "the top above everything else, y upwards")
    if len(top) < 2:
        raise MeshFileError(f"a group {TOP} of one node", f"a group {TOP} of lines or nodes")
    return top


def _place(corners: FloatArray) -> str:
    x, y = corners.mean(axis=0)
    return f"({x:.4g}, {y:.4g})"
