"""Which nodes of the block's free boundary may meet which of its segments.

That is chosen outside the Newton iteration and judged by the *accepted* state: a node that is
behind a segment there lies behind it through the material (a thin wedge between two faces looks
locally just like a penetration) and cannot meet it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from contact.self_contact import Pairs, pair_geometry, segment_geometry
from materials.arrays import BoolArray, FloatArray, IntArray

#: The cosine between the normals of a node and a segment that can meet is below this: they oppose
#: each other. At the tip of a fold the boundary turns right round, so that the normal of one of the
#: node's own segments counts. A margin here loses nodes beside a corner that the fold has closed
#: on: they pass through at cosines of -0.1, deeper with every step.
OPPOSING = 0.0
#: Nodes this close to a segment along the boundary (in segments) do not meet it: only its own.
#: A crease starts between the next nodes. If those pass through each other, the loop grows from
#: node to node, and each one is behind the other face before it could meet it.
NEIGHBOURS = 0
#: Share of the local size by which a node may be behind a segment in the accepted state.
BEHIND = 0.05
#: Projections count on a segment extended by this share on both sides.
OVERHANG = 0.02
#: A closed pair is held until its projection leaves the segment by this share.
HOLD = 0.1
#: Penetration that may go unseen until the next step, relative to the local element size.
UNSEEN = 0.005


@dataclass(frozen=True, kw_only=True)
class Boundary:
    """The free boundary as a chain of nodes, of one curve or of several one after another.

    Attributes
    ----------
    nodes : (m,) int array
        Mesh nodes in order along the boundary.
    orientation : int
        +1 when the material lies to the left of the chain, -1 when to the right.
    length : (m,) float array
        Reference length each node stands for [mm].
    size : (m,) float array
        Local element size, which gaps are compared with [mm].
    joined : (m - 1,) bool array
        Whether a segment joins a node and the next one; False where one curve ends and another
        begins.
    """

    nodes: IntArray
    orientation: int
    length: FloatArray
    size: FloatArray
    joined: BoolArray

    @classmethod
    def of(
        cls,
        nodes: IntArray,
        orientation: int,
        points: FloatArray,
        size: FloatArray,
        joined: BoolArray | None = None,
    ) -> Boundary:
        """Boundary of the reference coordinates `points` (n, 2) with local sizes (m,)."""
        joined = np.ones(len(nodes) - 1, dtype=bool) if joined is None else joined
        edges = joined * np.linalg.norm(np.diff(points[nodes], axis=0), axis=1)
        halves = 0.5 * np.append(0.0, edges) + 0.5 * np.append(edges, 0.0)
        return cls(nodes=nodes, orientation=orientation, length=halves, size=size, joined=joined)


def find_pairs(
    boundary: Boundary,
    x_n: FloatArray,
    x: FloatArray,
    *,
    reach: float,
    stiffness: float,
    mu: float,
    shear_n: FloatArray,
) -> Pairs:
    """Pairs that may come into contact between an accepted state and an iterate.

    Parameters
    ----------
    boundary : Boundary
        Chain of free boundary nodes.
    x_n, x : (n, 2) float arrays
        Coordinates in the accepted state and at the iterate [mm].
    reach : float
        Largest distance between node and segment node that is looked at [mm].
    stiffness : float
        Contact modulus [N/mm^2]: force per penetration relative to the local size, per length.
    mu : float
        Friction coefficient of rubber on rubber [-].
    shear_n : (m,) float array
        Tangential forces of the accepted state, by place in the chain [N/mm].

    Returns
    -------
    Pairs
        Of the segments with opposing normals, a projection inside, and in front of which the node
        was: the nearest to each node, and those it touches. The nearest carries the tangential
        force of the accepted state.
    """
    place, segment = _near(boundary, x, reach)
    chain, n_n = x[boundary.nodes], x_n[boundary.nodes]
    now = segment_geometry(chain[place], chain[segment], chain[segment + 1], boundary.orientation)
    then = segment_geometry(n_n[place], n_n[segment], n_n[segment + 1], boundary.orientation)
    size = np.minimum.reduce([boundary.size[i] for i in (place, segment, segment + 1)])
    eligible = (
        (_facing(boundary, chain, place, now.n) < OPPOSING)
        & (np.abs(now.xi - 0.5) <= 0.5 + OVERHANG)
        & (then.gap > -BEHIND * size)
        & (np.abs(now.gap) < reach)
    )
    kept = np.flatnonzero(eligible)
    kept = kept[np.lexsort((np.abs(now.gap[kept]), place[kept]))]
    nearest = np.zeros(kept.size, dtype=bool)
    nearest[np.unique(place[kept], return_index=True)[1]] = True
    # In a crease a node touches the segments on both sides of it.
    chosen = nearest | ((now.gap[kept] < 0.0) & (now.gap[kept] > -BEHIND * size[kept]))
    kept, nearest = kept[chosen], nearest[chosen]
    place, segment = place[kept], segment[kept]
    return Pairs(
        place=place,
        nodes=np.column_stack([boundary.nodes[i] for i in (place, segment, segment + 1)]),
        xi_n=then.xi[kept],
        L_n=then.L[kept],
        stiffness=stiffness * boundary.length[place] / size[kept],
        shear_n=np.where(nearest, shear_n[place], 0.0),
        mu=mu,
        orientation=boundary.orientation,
    )


def _near(boundary: Boundary, x: FloatArray, reach: float) -> tuple[IntArray, IntArray]:
    """Places of nodes and numbers of segments closer than `reach`, neighbours left out."""
    chain = x[boundary.nodes]
    close = cKDTree(chain).query_pairs(reach, output_type="ndarray")
    close = close[np.abs(close[:, 0] - close[:, 1]) > NEIGHBOURS]
    both = np.concatenate([close, close[:, ::-1]])
    place = np.concatenate([both[:, 0], both[:, 0]])
    segment = np.concatenate([both[:, 1] - 1, both[:, 1]])
    apart = np.minimum(np.abs(place - segment), np.abs(place - segment - 1))
    valid = (segment >= 0) & (segment < len(chain) - 1) & (apart > NEIGHBOURS)
    valid[valid] = boundary.joined[segment[valid]]
    code = np.unique(place[valid] * len(chain) + segment[valid])
    return code // len(chain), code % len(chain)


def _facing(
    boundary: Boundary, chain: FloatArray, place: IntArray, normal: FloatArray
) -> FloatArray:
    """Smallest cosine between `normal` (k, 2) and the normals of the segments at nodes (k,)."""
    e = np.diff(chain, axis=0)
    n = boundary.orientation * np.column_stack([e[:, 1], -e[:, 0]])
    n /= np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None]
    before, after = np.vstack([n[:1], n]), np.vstack([n, n[-1:]])
    # The ends of a curve have one segment only.
    ends = np.flatnonzero(~boundary.joined)
    before[ends + 1], after[ends] = after[ends + 1], before[ends]
    cosines = [np.einsum("ki,ki->k", side[place], normal) for side in (before, after)]
    return np.minimum(*cosines)


def followed(pairs: Pairs, found: Pairs, x: FloatArray, boundary: Boundary) -> Pairs:
    """Pairs to go on with after a solution at coordinates `x`; `pairs` itself if they still hold.

    Closed pairs whose projection has left the segment are dropped, and pairs of `found` that have
    penetrated by more than `UNSEEN` of the local size are added. Pairs are otherwise kept, so
    that a node at a kink does not change between two segments for ever.
    """
    used = pair_geometry(pairs, x)
    left = (used.gap < 0.0) & (np.abs(used.xi - 0.5) > 0.5 + HOLD)
    depth = -pair_geometry(found, x).gap / boundary.size[found.place]
    known = {tuple(row) for row in pairs.nodes.tolist()}
    new = np.array([tuple(row) not in known for row in found.nodes.tolist()], dtype=bool)
    missed = (depth > UNSEEN) & new
    if not left.any() and not missed.any():
        return pairs
    return _joined(pairs, ~left, found, missed)


def _joined(a: Pairs, in_a: BoolArray, b: Pairs, in_b: BoolArray) -> Pairs:
    """Chosen pairs of two sets."""

    def both(name: str) -> FloatArray:
        return np.concatenate([getattr(a, name)[in_a], getattr(b, name)[in_b]])

    return Pairs(
        place=np.concatenate([a.place[in_a], b.place[in_b]]),
        nodes=np.concatenate([a.nodes[in_a], b.nodes[in_b]]),
        xi_n=both("xi_n"),
        L_n=both("L_n"),
        stiffness=both("stiffness"),
        shear_n=both("shear_n"),
        mu=a.mu,
        orientation=a.orientation,
    )


def pair_penetration(pairs: Pairs, x: FloatArray, boundary: Boundary) -> float:
    """Largest penetration of the pairs relative to the local element size [-]."""
    if pairs.place.size == 0:
        return 0.0
    gap = pair_geometry(pairs, x).gap
    return float(np.max(np.maximum(-gap, 0.0) / boundary.size[pairs.place], initial=0.0))
