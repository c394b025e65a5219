"""Whether a boundary cuts itself, judged by its segments alone.

Self-contact acts between the pairs that its search has found. This looks at the outcome without
that search, so that what it missed cannot go unseen. Nor can an element that has turned inside out
at its nodes, between integration points that are all sound: at the leading corner that puts an edge
of the boundary across the next but one, which no search for pairs can prevent.
"""

import numpy as np
from scipy.spatial import cKDTree

from materials.arrays import BoolArray, FloatArray, IntArray


def crossing_segments(
    chain: FloatArray, joined: BoolArray | None = None
) -> tuple[IntArray, IntArray]:
    """Pairs of segments of a boundary that cut each other.

    Parameters
    ----------
    chain : (m, 2) float array
        Points along the boundary [mm]; segment i joins points i and i + 1.
    joined : (m - 1,) bool array, optional
        Which segments there are; all without it. Several curves may stand one after another.

    Returns
    -------
    first, second : (k,) int arrays
        Numbers of the segments. Segments that share a point do not count.
    """
    start, edge = chain[:-1], np.diff(chain, axis=0)
    there = np.arange(len(edge)) if joined is None else np.flatnonzero(joined)
    start_there, edge_there = start[there], edge[there]
    # Segments that cut each other have middles no further apart than the longer one is long.
    reach = float(np.hypot(edge_there[:, 0], edge_there[:, 1]).max())
    middles = cKDTree(start_there + 0.5 * edge_there)
    near = there[middles.query_pairs(reach, output_type="ndarray")]
    i, j = near[np.abs(near[:, 0] - near[:, 1]) > 1].astype(np.int64).T
    apart = _sides_differ(start[i], edge[i], chain[j], chain[j + 1])
    cut = apart & _sides_differ(start[j], edge[j], chain[i], chain[i + 1])
    return i[cut], j[cut]


def crossing_depth(chain: FloatArray, size: FloatArray, joined: BoolArray | None = None) -> float:
    """Depth to which a boundary cuts itself, relative to the local element size [-].

    Parameters
    ----------
    chain : (m, 2) float array
        Points along the boundary [mm].
    size : (m,) float array
        Local element size at the points [mm].
    joined : (m - 1,) bool array, optional
        See `crossing_segments`.

    Returns
    -------
    float
        Of each crossing the shortest way from an end of one segment to the other; the largest of
        all, 0 without a crossing.
    """
    i, j = crossing_segments(chain, joined)
    ends = ((i, j), (i + 1, j), (j, i), (j + 1, i))
    depths = [_distance(chain[k], chain[m], chain[m + 1]) / size[k] for k, m in ends]
    return float(np.min(depths, axis=0).max(initial=0.0))


def _sides_differ(start: FloatArray, edge: FloatArray, p: FloatArray, q: FloatArray) -> BoolArray:
    """Whether points p and q lie on different sides of lines along `edge`, all (k, 2)."""
    return np.asarray(_cross(edge, p - start) * _cross(edge, q - start) < 0.0)


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def _distance(s: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """Distance of points from segments, all (k, 2) [mm]."""
    e = b - a
    xi = np.clip(np.sum((s - a) * e, axis=1) / np.sum(e**2, axis=1), 0.0, 1.0)
    return np.asarray(np.linalg.norm(s - a - xi[:, None] * e, axis=1))
