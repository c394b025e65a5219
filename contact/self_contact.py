"""Contact of the block's free boundary with itself: node to segment, both ways, with friction.

A boundary node s and a segment from a to b have the gap ``g = n.(s - a)``, open positive, with n
the outward normal of the segment. Penetration is resisted by a stiffness that is not guessed: a
multiple of the rubber's bulk stiffness over the local element size, so that pressures of the
order of the material's own can only press a small fraction of an element in. Friction follows
Coulomb with a share of that stiffness in stick; the slip is measured along the segment,
``gamma = L_n (xi - xi_n)``. The tangent is consistent [1]_.

During the Newton iteration the normal forces are unknowns of their own, updated by what the linear
system says (`PairMultipliers`), and pairs open by their sign: the forces of the penetrations at an
iterate are, before convergence, the stiffness times the error of the positions, so that walls that
meet along their length would open and close for ever. In a solution both are the same.

Which segment a node meets is chosen outside the Newton iteration and judged by the *accepted*
state: a node that is behind a segment there lies behind it through the material (a thin wedge
between two faces looks locally just like a penetration) and cannot meet it.

References
----------
.. [1] Wriggers, P., Computational Contact Mechanics, 2nd ed., Springer 2006, ch. 9 (node-to-segment
   discretisation and its linearisation).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from materials.arrays import FloatArray, IntArray

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
#: Tangential over normal stiffness [-]. Walls that meet along their length change between stick and
#: slip for ever with 1. At the mean pressure a pair that sticks gives way by some thousandths of an
#: element.
SHEAR_SHARE = 0.02
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
    joined: NDArray[np.bool_]

    @classmethod
    def of(
        cls,
        nodes: IntArray,
        orientation: int,
        points: FloatArray,
        size: FloatArray,
        joined: NDArray[np.bool_] | None = None,
    ) -> Boundary:
        """Boundary of the reference coordinates `points` (n, 2) with local sizes (m,)."""
        joined = np.ones(len(nodes) - 1, dtype=bool) if joined is None else joined
        edges = joined * np.linalg.norm(np.diff(points[nodes], axis=0), axis=1)
        halves = 0.5 * np.append(0.0, edges) + 0.5 * np.append(edges, 0.0)
        return cls(nodes=nodes, orientation=orientation, length=halves, size=size, joined=joined)


@dataclass(frozen=True, kw_only=True)
class Pairs:
    """Nodes and the segments they may meet during a step, arrays of length k.

    Attributes
    ----------
    place : (k,) int array
        Position of the node in the boundary chain.
    nodes : (k, 3) int array
        Mesh nodes s, a, b.
    xi_n, L_n : float arrays
        Projection on the segment and its length in the accepted state [-], [mm].
    stiffness : float array
        Force per penetration, per depth [N/mm^2].
    shear_n : float array
        Tangential force of the accepted state [N/mm].
    mu : float
        Friction coefficient of rubber on rubber [-].
    orientation : int
        See `Boundary`.
    """

    place: IntArray
    nodes: IntArray
    xi_n: FloatArray
    L_n: FloatArray
    stiffness: FloatArray
    shear_n: FloatArray
    mu: float
    orientation: int

    @property
    def shear_stiffness(self) -> FloatArray:
        """Tangential force per elastic slip of pairs that stick, per depth [N/mm^2]."""
        return SHEAR_SHARE * self.stiffness


@dataclass(frozen=True, kw_only=True)
class SegmentGeometry:
    """Node relative to segment: arrays (k,), vectors (k, 2)."""

    t: FloatArray
    n: FloatArray
    L: FloatArray
    xi: FloatArray
    gap: FloatArray

    @property
    def shares(self) -> FloatArray:
        """Shares of the three nodes s, a, b in what acts on the node and on the segment, (k, 3)."""
        xi = np.clip(self.xi, 0.0, 1.0)
        return np.column_stack([np.ones_like(xi), 1.0 - xi, xi])


@dataclass(frozen=True, kw_only=True)
class PairForces:
    """Forces of the pairs at an iterate.

    Attributes
    ----------
    geometry : SegmentGeometry
        Gaps and directions.
    normal : (k,) float array
        Compressive force [N/mm].
    shear : (k,) float array
        Tangential force, conjugate to the slip along the segment [N/mm].
    pressed, slipping : (k,) bool arrays
        Status asked for: whether the pair touches, and whether the friction limit is reached.
    drag : (k,) float array
        Shear per normal force of pairs that slip, with its sign; 0 for others [-].
    slip : (k,) float array
        Slip along the segment since the accepted state [mm].
    residual : (k, 6) float array
        Forces on s, a, b to be added to the internal forces [N/mm].
    of_gap : (k,) float array
        Normal force that the gap would make with this status [N/mm].
    mismatch : float
        Largest penetration by which the normal forces differ from those [mm].
    settled : bool
        Whether the pairs that touch are those that the forces were computed with.
    grad_gap, grad_slip : (k, 6) float arrays
        Gradients of gap and slip.
    """

    geometry: SegmentGeometry
    normal: FloatArray
    shear: FloatArray
    pressed: NDArray[np.bool_]
    slipping: NDArray[np.bool_]
    drag: FloatArray
    slip: FloatArray
    residual: FloatArray
    of_gap: FloatArray
    mismatch: float
    settled: bool
    grad_gap: FloatArray
    grad_slip: FloatArray

    @property
    def pending(self) -> FloatArray:
        """Forces on s, a, b that the gaps would make, less those there are, (k, 6) [N/mm]."""
        normal = self.of_gap - self.normal
        return normal[:, None] * (self.drag[:, None] * self.grad_slip - self.grad_gap)

    @property
    def signature(self) -> bytes:
        """Name of the status asked for."""
        return (self.pressed * (1 + self.slipping)).astype(np.int8).tobytes()


@dataclass(frozen=True, kw_only=True)
class PairMultipliers:
    """Normal forces of the pairs by the linear system that gave an iterate, arrays (k,).

    Attributes
    ----------
    normal : float array
        Forces [N/mm]; a negative one asks for the pair to open.
    pressed : bool array
        Pairs that the linear system held together.
    """

    normal: FloatArray
    pressed: NDArray[np.bool_]

    def carried(self, old: Pairs, new: Pairs) -> PairMultipliers:
        """The same forces for another set of pairs; none on pairs that `old` has not."""
        # One more entry, of nothing, for the pairs that are not among the old.
        none = len(old.nodes)
        places = {tuple(row): i for i, row in enumerate(old.nodes.tolist())}
        place = np.array(
            [places.get(tuple(row), none) for row in new.nodes.tolist()], dtype=np.int64
        )
        return PairMultipliers(
            normal=np.append(self.normal, 0.0)[place], pressed=np.append(self.pressed, False)[place]
        )


def segment_geometry(
    s: FloatArray, a: FloatArray, b: FloatArray, orientation: int
) -> SegmentGeometry:
    """Gap and projection of nodes s on segments a-b, all (k, 2) [mm]."""
    e = b - a
    L = np.hypot(e[:, 0], e[:, 1])
    t = e / L[:, None]
    n = orientation * np.column_stack([t[:, 1], -t[:, 0]])
    w = s - a
    return SegmentGeometry(
        t=t, n=n, L=L, xi=np.einsum("ki,ki->k", t, w) / L, gap=np.einsum("ki,ki->k", n, w)
    )


def _spread(v: FloatArray, shape: FloatArray) -> FloatArray:
    """Vectors v (k, 2) weighted on s, a, b with `shape` (k, 3), flattened to (k, 6)."""
    return (shape[:, :, None] * v[:, None, :]).reshape(-1, 6)


def _shapes(xi: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Weights of the relative displacement (1, xi-1, -xi) and of the edge (0, -1, 1)."""
    zero, one = np.zeros_like(xi), np.ones_like(xi)
    return np.column_stack([one, xi - 1.0, -xi]), np.column_stack([zero, -one, one])


def pair_forces(
    pairs: Pairs, x: FloatArray, multipliers: PairMultipliers | None = None
) -> PairForces:
    """Forces of the pairs at current coordinates `x` (n, 2) [mm].

    Those of the multipliers, or of the gaps and slips without them.
    """
    geometry = _geometry(pairs, x)
    relative, edge = _shapes(geometry.xi)
    grad_gap = _spread(geometry.n, relative)
    ratio = (geometry.gap / geometry.L)[:, None]
    grad_xi = _spread(geometry.t, relative) + ratio * _spread(geometry.n, edge)
    grad_slip = (pairs.L_n / geometry.L)[:, None] * grad_xi
    slip = pairs.L_n * (geometry.xi - pairs.xi_n)
    of_gap = -pairs.stiffness * geometry.gap
    pressed, normal, settled = of_gap > 0.0, np.maximum(of_gap, 0.0), True
    if multipliers is not None:
        pressed = np.where(multipliers.pressed, multipliers.normal > 0.0, pressed)
        normal = np.where(multipliers.pressed & pressed, multipliers.normal, 0.0)
        settled = np.array_equal(pressed, multipliers.pressed)
    of_slip = pairs.shear_n + pairs.shear_stiffness * slip
    slipping, sense = np.abs(of_slip) > pairs.mu * normal, np.sign(of_slip)
    shear = np.where(pressed, np.where(slipping, sense * pairs.mu * normal, of_slip), 0.0)
    difference = np.where(pressed, np.abs(of_gap - normal) / pairs.stiffness, 0.0)
    residual = -normal[:, None] * grad_gap + shear[:, None] * grad_slip
    return PairForces(
        geometry=geometry, normal=normal, shear=shear, pressed=pressed, slipping=slipping,
        drag=np.where(pressed & slipping, sense * pairs.mu, 0.0), slip=slip, residual=residual,
        of_gap=np.where(pressed, of_gap, 0.0), mismatch=float(difference.max(initial=0.0)),
        settled=settled, grad_gap=grad_gap, grad_slip=grad_slip,
    )  # fmt: skip


def multiplier_step(pairs: Pairs, forces: PairForces, du: FloatArray) -> PairMultipliers:
    """Change of the forces to those that a displacement `du` (n, 2) leads to, linearised."""
    gap = np.sum(forces.grad_gap * du[pairs.nodes].reshape(-1, 6), axis=1)
    normal = np.where(forces.pressed, forces.of_gap - pairs.stiffness * gap, 0.0)
    return PairMultipliers(normal=normal - forces.normal, pressed=forces.pressed)


def multipliers_after(forces: PairForces, step: PairMultipliers, alpha: float) -> PairMultipliers:
    """Forces after a share `alpha` of a step of `multiplier_step`."""
    return PairMultipliers(normal=forces.normal + alpha * step.normal, pressed=step.pressed)


def dissipation(pairs: Pairs, forces: PairForces) -> FloatArray:
    """Friction work of the pairs since the accepted state, (k,) [mJ/mm].

    The work of the tangential force less what its elastic part stores; never negative.
    """
    stored = (forces.shear**2 - pairs.shear_n**2) / (2.0 * pairs.shear_stiffness)
    work = 0.5 * (forces.shear + pairs.shear_n) * forces.slip
    return np.where(forces.slipping, np.maximum(work - stored, 0.0), 0.0)


def heat_sources(pairs: Pairs, forces: PairForces, heat: FloatArray) -> tuple[IntArray, FloatArray]:
    """Nodes and shares of the heat of the pairs (k,): half each side, (3 k,) both."""
    shares = 0.5 * heat[:, None] * forces.geometry.shares
    return pairs.nodes.ravel(), shares.ravel()


def pair_tangents(pairs: Pairs, forces: PairForces) -> FloatArray:
    """Derivative of the pair residuals with respect to s, a, b, (k, 6, 6) [N/mm^2]."""
    geo = forces.geometry
    relative, edge = _shapes(geo.xi)
    N_s, T_s = _spread(geo.n, relative), _spread(geo.t, relative)
    N_0, T_0 = _spread(geo.n, edge), _spread(geo.t, edge)
    L, g = geo.L[:, None, None], geo.gap[:, None, None]
    hess_gap = -_symmetric(T_s, N_0) / L - g / L**2 * _outer(N_0, N_0)
    grad_xi = (T_s + (geo.gap / geo.L)[:, None] * N_0) / geo.L[:, None]
    hess_xi = (
        _symmetric(N_s, N_0) / L**2 - _symmetric(T_0, grad_xi) / L - g / L**3 * _symmetric(N_0, T_0)
    )
    pressed = forces.pressed
    stiffness = np.where(pressed, pairs.stiffness, 0.0)[:, None, None]
    K = stiffness * _outer(forces.grad_gap, forces.grad_gap)
    K -= forces.normal[:, None, None] * hess_gap
    K += (forces.shear * pairs.L_n)[:, None, None] * hess_xi
    sticks = (pressed & ~forces.slipping)[:, None, None]
    K += np.where(sticks, SHEAR_SHARE * stiffness * _outer(forces.grad_slip, forces.grad_slip), 0.0)
    # Sliding friction follows the normal force: d(shear) = -sign mu k d(gap).
    K -= forces.drag[:, None, None] * stiffness * _outer(forces.grad_slip, forces.grad_gap)
    return K


def _outer(a: FloatArray, b: FloatArray) -> FloatArray:
    return a[:, :, None] * b[:, None, :]


def _symmetric(a: FloatArray, b: FloatArray) -> FloatArray:
    return _outer(a, b) + _outer(b, a)


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
    size = np.minimum(
        boundary.size[place], np.minimum(boundary.size[segment], boundary.size[segment + 1])
    )
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
        nodes=np.column_stack(
            [boundary.nodes[place], boundary.nodes[segment], boundary.nodes[segment + 1]]
        ),
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
    used = _geometry(pairs, x)
    left = (used.gap < 0.0) & (np.abs(used.xi - 0.5) > 0.5 + HOLD)
    depth = -_geometry(found, x).gap / boundary.size[found.place]
    known = {tuple(row) for row in pairs.nodes.tolist()}
    new = np.array([tuple(row) not in known for row in found.nodes.tolist()], dtype=bool)
    missed = (depth > UNSEEN) & new
    if not left.any() and not missed.any():
        return pairs
    return _joined(pairs, ~left, found, missed)


def _joined(a: Pairs, in_a: NDArray[np.bool_], b: Pairs, in_b: NDArray[np.bool_]) -> Pairs:
    """Chosen pairs of two sets."""

    def both(name: str) -> FloatArray:
        return np.concatenate([getattr(a, name)[in_a], getattr(b, name)[in_b]])

    return Pairs(
        place=np.concatenate([a.place[in_a], b.place[in_b]]),
        nodes=np.concatenate([a.nodes[in_a], b.nodes[in_b]]),
        xi_n=both("xi_n"), L_n=both("L_n"), stiffness=both("stiffness"), shear_n=both("shear_n"),
        mu=a.mu, orientation=a.orientation,
    )  # fmt: skip


def _geometry(pairs: Pairs, x: FloatArray) -> SegmentGeometry:
    s, a, b = (x[pairs.nodes[:, i]] for i in range(3))
    return segment_geometry(s, a, b, pairs.orientation)


def pair_penetration(pairs: Pairs, x: FloatArray, boundary: Boundary) -> float:
    """Largest penetration of the pairs relative to the local element size [-]."""
    if pairs.place.size == 0:
        return 0.0
    gap = _geometry(pairs, x).gap
    return float(np.max(np.maximum(-gap, 0.0) / boundary.size[pairs.place], initial=0.0))
