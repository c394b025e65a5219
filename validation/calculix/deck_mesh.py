"""Layers of bricks for the block in an input deck, with its sets and surfaces.

The plane mesh is repeated along z: nodes 1..n are the front layer at z = 0, n + 1..2 n the next
one, and so on. In plane strain there is one layer of bricks, 1 mm deep, so that forces are per mm
of depth; its back moves with its front, and no node moves along z: the unknowns are those of a
plane problem. A slab with free sides is written as its half: z = 0 is its plane of symmetry.
"""

from dataclasses import dataclass

import numpy as np

from fem.mesh import BlockMesh
from materials.arrays import FloatArray, IntArray
from validation.calculix.deck_material import numbers

#: Numbers on a line of a set.
PER_LINE = 12


@dataclass(frozen=True, kw_only=True)
class Layers:
    """Layers of bricks behind one another.

    Attributes
    ----------
    depth : float
        What they fill along z, all together [mm].
    cells : int
        Number of layers.
    free : bool
        They are half of a slab with free sides, the front its plane of symmetry; otherwise one
        layer in plane strain.
    """

    depth: float = 1.0
    cells: int = 1
    free: bool = False

    @property
    def z(self) -> FloatArray:
        """Where the layers of nodes lie, front first, (cells + 1,) [mm]."""
        return np.linspace(0.0, self.depth, self.cells + 1)

    @property
    def shares(self) -> FloatArray:
        """Depth that each layer of nodes carries the load of, (cells + 1,) [mm]."""
        if not self.free:
            # The front carries the back along.
            return np.array([self.depth, 0.0])
        half = np.full(self.cells, 0.5 * self.depth / self.cells)
        return np.append(half, 0.0) + np.append(0.0, half)

    def through(self, mesh: BlockMesh, nodes: IntArray) -> IntArray:
        """The nodes of the plane mesh and those behind them, layer by layer."""
        behind = len(mesh.points) * np.arange(self.cells + 1)
        return np.asarray((behind[:, None] + nodes).ravel())


#: One layer in plane strain.
PLANE = Layers()


def half_slab(depth_mm: float, cells: int) -> Layers:
    """Half of a slab `depth_mm` deep, in `cells` layers."""
    return Layers(depth=0.5 * depth_mm, cells=cells, free=True)


def block_lines(mesh: BlockMesh, element: str, layers: Layers = PLANE) -> list[str]:
    """Nodes, elements and node sets of the block.

    The sets ``TOP`` and ``SURFACE`` (free boundary) hold the front layer, ``GLUED`` (bottom) and
    ``HELD`` (top) all layers; a slab has ``MIDDLE`` (the front without its top) and ``SIDE`` (the
    free side), too.
    """
    n = len(mesh.points)
    front = np.concatenate([mesh.cells, mesh.cells + n], axis=1)
    corners = front + n * np.arange(layers.cells)[:, None, None] + 1
    plane = np.arange(n)
    sets = {
        "TOP": mesh.top,
        "SURFACE": mesh.boundary,
        "GLUED": layers.through(mesh, mesh.bottom),
        "HELD": layers.through(mesh, mesh.top),
    }
    if layers.free:
        sets |= {"MIDDLE": np.setdiff1d(plane, mesh.top), "SIDE": plane + n * layers.cells}
    nodes = (_node_rows(mesh.points, z, first=k * n + 1) for k, z in enumerate(layers.z.tolist()))
    return [
        "*NODE, NSET=BLOCK",
        *(row for layer in nodes for row in layer),
        f"*ELEMENT, TYPE={element}, ELSET=RUBBER",
        *_element_rows(corners.reshape(-1, 8), first=1),
        *(line for name, nodes in sets.items() for line in _node_set(name, nodes)),
    ]


def tie_lines(mesh: BlockMesh, *, platen: bool, bonded: bool, layers: Layers = PLANE) -> list[str]:
    """Equations: in plane strain the back follows the front; a platen's top sinks alike."""
    top, lines = mesh.top, []
    if not layers.free:
        n = len(mesh.points)
        # What is prescribed on both layers must not be tied: x of the top, and a glued bottom.
        held = np.concatenate([top, mesh.bottom]) if bonded else top
        below = np.setdiff1d(np.arange(n), held)
        lines = [*_equations(below + n, below, 1), *_equations(below + n, below, 2)]
        if not platen:
            lines += _equations(top + n, top, 2)
    if platen:
        followers = layers.through(mesh, top)[1:]
        lines += _equations(followers, np.full(followers.size, top[0]), 2)
    return lines


def held_lines(*, bonded: bool, layers: Layers = PLANE) -> list[str]:
    """What never moves: along z all of a plane block, of a slab its middle and its glued top."""
    z_held = ["MIDDLE, 3, 3", "HELD, 3, 3"] if layers.free else ["BLOCK, 3, 3"]
    glued = f"GLUED, 1, {3 if layers.free else 2}"
    return ["*BOUNDARY", *z_held, glued if bonded else "ROAD, 1, 3"]


def road_lines(mesh: BlockMesh, distance: float, layers: Layers = PLANE) -> list[str]:
    """One brick, its top at y = 0, that reaches as far as the block slides [mm] and rolls.

    Its numbers follow on those of the block.
    """
    margin = 0.5 * mesh.length
    left = -margin - (distance if mesh.direction < 0 else 0.0)
    right = mesh.length + margin + (distance if mesh.direction > 0 else 0.0)
    thick = 0.25 * mesh.height
    plane = np.array([[left, -thick], [right, -thick], [right, 0.0], [left, 0.0]])
    node = (layers.cells + 1) * len(mesh.points) + 1
    element = layers.cells * len(mesh.cells) + 1
    # Wider than the block is deep, so that no node of the block lies on an edge of the road.
    return [
        "*NODE, NSET=ROAD",
        *_node_rows(plane, -layers.depth, first=node),
        *_node_rows(plane, 2.0 * layers.depth, first=node + 4),
        "*ELEMENT, TYPE=C3D8, ELSET=ROADBODY",
        *_element_rows(node + np.arange(8)[None, :], first=element),
        "*SURFACE, NAME=ROADTOP, TYPE=ELEMENT",
        f"{element}, S5",
    ]


def free_surface_lines(mesh: BlockMesh, layers: Layers = PLANE) -> list[str]:
    """Free boundary of the plane mesh as faces: edge k of a cell is face k + 3 of its bricks."""
    n = len(mesh.points)
    ends = np.stack([mesh.cells, np.roll(mesh.cells, -1, axis=1)], axis=2)
    keys = ends.min(axis=2) * n + ends.max(axis=2)
    wanted = mesh.boundary_edges.min(axis=1) * n + mesh.boundary_edges.max(axis=1)
    cell, edge = np.nonzero(np.isin(keys, wanted))
    bricks = (cell + len(mesh.cells) * np.arange(layers.cells)[:, None] + 1).ravel().tolist()
    pairs = zip(bricks, np.tile(edge + 3, layers.cells).tolist(), strict=True)
    return ["*SURFACE, NAME=FREE, TYPE=ELEMENT", *(f"{e}, S{k}" for e, k in pairs)]


def _equations(followers: IntArray, leaders: IntArray, component: int) -> list[str]:
    return [
        line
        for a, b in zip((followers + 1).tolist(), (leaders + 1).tolist(), strict=True)
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
