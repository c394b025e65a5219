"""The free boundary of a mesh: curves from one end of the held top to the next, cut into chains.

Everything that touches the road, another part of the rubber or the air is a node of one of these
curves. A *chain* is a named piece of one: a bottom (the nodes on the road before the block is
pressed), or a face, which either leads or trails the bottom it belongs to.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from materials.arrays import FloatArray, IntArray

#: Height above the road, over that of the mesh, up to which a node belongs to a bottom [-].
ON_ROAD = 1e-9


@dataclass(frozen=True, kw_only=True)
class Chain:
    """A named piece of the free boundary.

    Attributes
    ----------
    name : str
        "trailing face", "bottom" (or "bottom 1", ...), "leading face", "sipe 1 rear", ...
    block : int
        Number of the block, counted from the trailing end, from 1.
    kind : {"bottom", "leading", "trailing"}
        A bottom, or a face at its leading or its trailing side.
    nodes : (m,) int array
        Free nodes, in order.
    s : (m,) float array
        Undeformed length along the chain from where the chain before it, or the top, ends [mm].
    """

    name: str
    block: int
    kind: Literal["bottom", "leading", "trailing"]
    nodes: IntArray
    s: FloatArray


def single_edges(cells: IntArray) -> IntArray:
    """Edges that belong to one cell only, (m, 2), the cell to their left."""
    edges = np.concatenate([cells[:, [i, (i + 1) % 4]] for i in range(4)])
    n = int(cells.max()) + 1
    keys = edges.min(axis=1) * n + edges.max(axis=1)
    _, first, counts = np.unique(keys, return_index=True, return_counts=True)
    return np.asarray(edges[np.sort(first[counts == 1])])


def free_curves(
    points: FloatArray, cells: IntArray, top: IntArray, direction: int
) -> list[IntArray]:
    """Nodes of the free boundary by curve, each with its two ends on the top, trailing end first.

    Raises
    ------
    ValueError
        If the boundary runs through a node twice, or a part of it does not end on the top.
    """
    edges = single_edges(cells)
    edges = edges[~np.isin(edges, top).all(axis=1)]
    if np.unique(edges[:, 0]).size < len(edges):
        node = edges[:, 0][np.argmax(np.bincount(edges[:, 0])[edges[:, 0]])]
        x, y = points[node]
        raise ValueError(f"cells that meet in the point ({x:.6g}, {y:.6g}) only")
    following = dict(edges.tolist())
    starts = sorted(set(following) - set(following.values()), key=lambda i: points[i, 0])
    curves = []
    for start in starts:
        nodes = [start]
        while nodes[-1] in following:
            nodes.append(following.pop(nodes[-1]))
        curves.append(np.array(nodes[::direction], dtype=np.int64))
    if following:
        x, y = points[next(iter(following))]
        raise ValueError(f"a hole, or a piece that is not held, at ({x:.6g}, {y:.6g})")
    return curves[::direction]


def named_chains(
    points: FloatArray, curves: Sequence[IntArray], breaks: Sequence[float], direction: int
) -> list[Chain]:
    """Chains of the curves of `free_curves`, in order; together they hold every free node once.

    Parameters
    ----------
    points : (n, 2) float array
        Reference coordinates, the road at y = 0 [mm].
    curves : sequence of int arrays
        Nodes of each curve, its ends on the top.
    breaks : sequence of float
        Where one block ends and the next begins [mm].
    direction : int
        +1 when the leading edge is at the largest x.
    """
    pieces = [p for curve in curves for p in _pieces(points, curve) if p.nodes.size]
    blocks = [_block(points[piece.nodes, 0].mean(), breaks, direction) for piece in pieces]
    bottoms = [i for i, piece in enumerate(pieces) if piece.kind == "bottom"]
    chains = []
    for i, piece in enumerate(pieces):
        own = min(bottoms, key=lambda j: (abs(j - i), -j if piece.kind == "trailing" else j))
        block = blocks[own if bottoms else i]
        siblings = [j for j in bottoms if blocks[j] == block]
        name = _name(piece.kind, siblings.index(own) + 1, len(siblings))
        chains.append(Chain(name=name, block=block, kind=piece.kind, nodes=piece.nodes, s=piece.s))
    return chains


@dataclass(frozen=True, kw_only=True)
class _Piece:
    """Free nodes between two corners, and their distance from the first of them."""

    kind: Literal["bottom", "leading", "trailing"]
    nodes: IntArray
    s: FloatArray


def _pieces(points: FloatArray, curve: IntArray) -> list[_Piece]:
    """Bottoms and faces of one curve; the face between two bottoms is two, cut at its height."""
    x, y = points[curve].T
    S = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    on = y <= ON_ROAD * points[:, 1].max()
    if not on.any():
        on = y <= y.min() + ON_ROAD * points[:, 1].max()
    ends = np.flatnonzero(np.diff(np.concatenate([[False], on, [False]])))
    runs = ends.reshape(-1, 2)
    pieces = [_piece("trailing", curve, S, 1, int(runs[0, 0]), 0)]
    for number, (start, stop) in enumerate(runs.tolist()):
        pieces.append(_piece("bottom", curve, S, start, stop, start))
        if number + 1 == len(runs):
            pieces.append(_piece("leading", curve, S, stop, len(curve) - 1, stop - 1))
            continue
        following = int(runs[number + 1, 0])
        highest = stop + np.flatnonzero(np.isclose(y[stop:following], y[stop:following].max()))
        middle = int(highest[(len(highest) - 1) // 2]) + 1
        pieces.append(_piece("leading", curve, S, stop, middle, stop - 1))
        pieces.append(_piece("trailing", curve, S, middle, following, middle - 1))
    return pieces


def _piece(
    kind: Literal["bottom", "leading", "trailing"],
    curve: IntArray,
    S: FloatArray,
    start: int,
    stop: int,
    origin: int,
) -> _Piece:
    return _Piece(kind=kind, nodes=curve[start:stop], s=S[start:stop] - S[origin])


def _block(x: float, breaks: Sequence[float], direction: int) -> int:
    return 1 + sum(bool(direction * (x - end) > 0.0) for end in breaks)


def _name(kind: str, number: int, count: int) -> str:
    """Name of the chain of bottom `number` of a block with `count` of them."""
    if kind == "bottom":
        return kind if count == 1 else f"bottom {number}"
    if kind == "trailing":
        return "trailing face" if number == 1 else f"sipe {number - 1} front"
    return "leading face" if number == count else f"sipe {number} rear"
