"""One layer of bricks for the plane-strain block in an input deck, with its sets and surfaces.

The plane mesh is the front layer (nodes 1..n, at z = 0); the back layer (n + 1..2 n) lies 1 mm
behind, so that forces are per mm of depth. The back layer moves with the front layer, and no node
moves along z: plane strain with the unknowns of a plane problem.
"""

import numpy as np

from fem.mesh import BlockMesh
from materials.arrays import FloatArray, IntArray
from validation.calculix.deck_material import numbers

#: Depth of the layer [mm].
DEPTH = 1.0
#: Numbers on a line of a set.
PER_LINE = 12


def block_lines(mesh: BlockMesh, element: str) -> list[str]:
    """Nodes, elements and node sets of the block.

    The sets ``TOP`` and ``SURFACE`` (free boundary) hold the front layer, ``GLUED`` (bottom) and
    ``HELD`` (top) both layers.
    """
    n = len(mesh.points)
    corners = np.concatenate([mesh.cells, mesh.cells + n], axis=1) + 1
    return [
        "*NODE, NSET=BLOCK",
        *_node_rows(mesh.points, 0.0, first=1),
        *_node_rows(mesh.points, DEPTH, first=n + 1),
        f"*ELEMENT, TYPE={element}, ELSET=RUBBER",
        *_element_rows(corners, first=1),
        *_node_set("TOP", mesh.top),
        *_node_set("SURFACE", mesh.boundary),
        *_node_set("GLUED", np.concatenate([mesh.bottom, mesh.bottom + n])),
        *_node_set("HELD", np.concatenate([mesh.top, mesh.top + n])),
    ]


def tie_lines(mesh: BlockMesh, *, platen: bool, bonded: bool) -> list[str]:
    """Equations: the back layer follows the front; under a platen all of the top sinks alike."""
    n = len(mesh.points)
    top = mesh.top
    # What is prescribed on both layers must not be tied: x of the top, and a glued bottom.
    below = np.setdiff1d(np.arange(n), np.concatenate([top, mesh.bottom]) if bonded else top)
    lines = [*_equations(below + n, below, 1), *_equations(below + n, below, 2)]
    if not platen:
        return [*lines, *_equations(top + n, top, 2)]
    followers = np.concatenate([top[1:], top + n])
    return [*lines, *_equations(followers, np.full(followers.size, top[0]), 2)]


def road_lines(mesh: BlockMesh, distance: float) -> list[str]:
    """One brick, its top at y = 0, that reaches as far as the block slides and rolls.

    Parameters
    ----------
    mesh : BlockMesh
        Mesh of the block; the road's numbers follow on its numbers.
    distance : float
        Sliding distance [mm].
    """
    margin = 0.5 * mesh.length
    left = -margin - (distance if mesh.direction < 0 else 0.0)
    right = mesh.length + margin + (distance if mesh.direction > 0 else 0.0)
    thick = 0.25 * mesh.height
    plane = np.array([[left, -thick], [right, -thick], [right, 0.0], [left, 0.0]])
    node, element = 2 * len(mesh.points) + 1, len(mesh.cells) + 1
    # Wider than the block is deep, so that no node of the block lies on an edge of the road.
    return [
        "*NODE, NSET=ROAD",
        *_node_rows(plane, -DEPTH, first=node),
        *_node_rows(plane, 2.0 * DEPTH, first=node + 4),
        "*ELEMENT, TYPE=C3D8, ELSET=ROADBODY",
        *_element_rows(node + np.arange(8)[None, :], first=element),
        "*SURFACE, NAME=ROADTOP, TYPE=ELEMENT",
        f"{element}, S5",
    ]


def free_surface_lines(mesh: BlockMesh) -> list[str]:
    """Free boundary of the block as element faces: edge k of a cell is face k + 3 of its brick."""
    n = len(mesh.points)
    ends = np.stack([mesh.cells, np.roll(mesh.cells, -1, axis=1)], axis=2)
    keys = ends.min(axis=2) * n + ends.max(axis=2)
    wanted = mesh.boundary_edges.min(axis=1) * n + mesh.boundary_edges.max(axis=1)
    cell, edge = np.nonzero(np.isin(keys, wanted))
    faces = [f"{e + 1}, S{k + 3}" for e, k in zip(cell.tolist(), edge.tolist(), strict=True)]
    return ["*SURFACE, NAME=FREE, TYPE=ELEMENT", *faces]


def _equations(followers: IntArray, leaders: IntArray, component: int) -> list[str]:
    pairs = zip((followers + 1).tolist(), (leaders + 1).tolist(), strict=True)
    return [
        line
        for a, b in pairs
        for line in ("*EQUATION", "2", f"{a}, {component}, 1., {b}, {component}, -1.")
    ]


def _node_rows(plane: FloatArray, z: float, *, first: int) -> list[str]:
    return [f"{i}, {numbers(x, y, z)}" for i, (x, y) in enumerate(plane.tolist(), first)]


def _element_rows(corners: IntArray, *, first: int) -> list[str]:
    return [f"{i}, {', '.join(map(str, row))}" for i, row in enumerate(corners.tolist(), first)]


def _node_set(name: str, nodes: IntArray) -> list[str]:
    """Lines of a node set, from plane node numbers that count from zero."""
    listed = (nodes + 1).tolist()
    starts = range(0, len(listed), PER_LINE)
    rows = [", ".join(map(str, listed[start : start + PER_LINE])) for start in starts]
    return [f"*NSET, NSET={name}", *rows]
