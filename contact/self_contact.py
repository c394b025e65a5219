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

Friction has a status, too, that changes as on the road: a pair that sticks slips when its force by
the linear system exceeds the limit, and one that slips sticks before it slips the other way. Where
the sense of slip just follows the iterate, pairs that stick in the solution slip to and fro for
ever.

`contact.pair_search` says which segments a node may meet.

References
----------
.. [1] Wriggers, P., Computational Contact Mechanics, 2nd ed., Springer 2006, ch. 9 (node-to-segment
   discretisation and its linearisation).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from materials.arrays import BoolArray, FloatArray, IntArray

#: Tangential over normal stiffness [-]. Walls that meet along their length change between stick and
#: slip for ever with 1. At the mean pressure a pair that sticks gives way by some thousandths of an
#: element.
SHEAR_SHARE = 0.02
#: Share of the friction limit by which a pair may fall below it before it sticks again.
ROUNDING = 1e-9


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
    pressed, sticks : (k,) bool arrays
        Status asked for: whether the pair touches, and whether friction holds it.
    sense : (k,) float array
        Sign of the slip asked for; 0 for pairs that do not slip [-].
    drag : (k,) float array
        Shear per normal force of pairs that slip, with its sign; 0 for others [-].
    slip : (k,) float array
        Slip along the segment since the accepted state [mm].
    of_gap, of_slip : (k,) float arrays
        Forces that gap and slip would make with this status [N/mm].
    settled : bool
        Whether the status asked for is the one that the forces were computed with.
    grad_gap, grad_slip : (k, 6) float arrays
        Gradients of gap and slip.
    """

    geometry: SegmentGeometry
    normal: FloatArray
    shear: FloatArray
    pressed: BoolArray
    sticks: BoolArray
    sense: FloatArray
    drag: FloatArray
    slip: FloatArray
    of_gap: FloatArray
    of_slip: FloatArray
    settled: bool
    grad_gap: FloatArray
    grad_slip: FloatArray

    @property
    def slipping(self) -> BoolArray:
        """Whether the friction limit is reached, (k,)."""
        return self.sense != 0.0

    @property
    def residual(self) -> FloatArray:
        """Forces on s, a, b to be added to the internal forces, (k, 6) [N/mm]."""
        return self.shear[:, None] * self.grad_slip - self.normal[:, None] * self.grad_gap

    @property
    def pending(self) -> FloatArray:
        """Forces on s, a, b by gaps and slips, less those there are, (k, 6) [N/mm]."""
        normal = self.of_gap - self.normal
        shear = self.of_slip - self.shear + self.drag * normal
        return shear[:, None] * self.grad_slip - normal[:, None] * self.grad_gap

    @property
    def signature(self) -> bytes:
        """Name of the status asked for."""
        return (self.pressed * (2.0 + self.sense)).astype(np.int8).tobytes()


@dataclass(frozen=True, kw_only=True)
class PairMultipliers:
    """Forces of the pairs by the linear system that gave an iterate, arrays (k,).

    Attributes
    ----------
    normal, shear : float arrays
        Forces [N/mm]; a negative normal force asks for the pair to open.
    pressed : bool array
        Pairs that the linear system held together.
    sense : float array
        Sign of the slip it let them have; 0 for pairs that it held along the segment.
    """

    normal: FloatArray
    shear: FloatArray
    pressed: BoolArray
    sense: FloatArray

    def carried(self, old: Pairs, new: Pairs) -> PairMultipliers:
        """The same forces for another set of pairs; none on pairs that `old` has not."""
        # One more entry, of nothing, for the pairs that are not among the old.
        none = len(old.nodes)
        places = {tuple(row): i for i, row in enumerate(old.nodes.tolist())}
        place = np.array(
            [places.get(tuple(row), none) for row in new.nodes.tolist()], dtype=np.int64
        )
        return PairMultipliers(
            normal=np.append(self.normal, 0.0)[place],
            shear=np.append(self.shear, 0.0)[place],
            pressed=np.append(self.pressed, False)[place],
            sense=np.append(self.sense, 0.0)[place],
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
    geometry = pair_geometry(pairs, x)
    slip = pairs.L_n * (geometry.xi - pairs.xi_n)
    of_gap = -pairs.stiffness * geometry.gap
    of_slip = pairs.shear_n + pairs.shear_stiffness * slip
    m = multipliers or _forces_of(of_gap, of_slip, pairs.mu)
    pressed = np.where(m.pressed, m.normal > 0.0, of_gap > 0.0)
    held = m.pressed & pressed
    normal = np.where(held, m.normal, 0.0)
    limit = pairs.mu * normal
    sense = np.where(pressed, _next_sense(m, of_slip, limit), 0.0)
    shear = np.where(m.sense == 0.0, np.clip(m.shear, -limit, limit), m.sense * limit)
    sticks = pressed & (sense == 0.0) & (limit > 0.0)
    return PairForces(
        geometry=geometry,
        normal=normal,
        shear=np.where(held, shear, 0.0),
        pressed=pressed,
        sticks=sticks,
        sense=sense,
        drag=sense * pairs.mu,
        slip=slip,
        of_gap=np.where(pressed, of_gap, 0.0),
        of_slip=np.where(sticks, of_slip, sense * limit),
        settled=np.array_equal(pressed, m.pressed) and not np.any((sense != m.sense)[limit > 0.0]),
        **_gradients(pairs, geometry),
    )


def _forces_of(of_gap: FloatArray, of_slip: FloatArray, mu: float) -> PairMultipliers:
    """Forces and status that gaps and slips make."""
    normal = np.maximum(of_gap, 0.0)
    slips = np.abs(of_slip) > mu * normal
    return PairMultipliers(
        normal=normal,
        shear=of_slip,
        pressed=of_gap > 0.0,
        sense=np.where(slips, np.sign(of_slip), 0.0),
    )


def _next_sense(m: PairMultipliers, of_slip: FloatArray, limit: FloatArray) -> FloatArray:
    """Sense of slip that the forces ask for, 0 where they hold."""
    # What the linear system held is judged by its force, what is new by its slip.
    force = np.where(m.pressed & (m.sense == 0.0), m.shear, of_slip)
    broken = np.where(np.abs(force) > limit, np.sign(force), 0.0)
    kept = np.where(m.sense * of_slip > (1.0 - ROUNDING) * limit, m.sense, 0.0)
    return np.where(m.pressed & (m.sense != 0.0), kept, broken)


def _gradients(pairs: Pairs, geometry: SegmentGeometry) -> dict[str, FloatArray]:
    """Gradients of gap and slip with respect to s, a, b, (k, 6)."""
    relative, edge = _shapes(geometry.xi)
    grad_gap = _spread(geometry.n, relative)
    ratio = (geometry.gap / geometry.L)[:, None]
    grad_xi = _spread(geometry.t, relative) + ratio * _spread(geometry.n, edge)
    return {"grad_gap": grad_gap, "grad_slip": (pairs.L_n / geometry.L)[:, None] * grad_xi}


def pair_mismatch(pairs: Pairs, forces: PairForces) -> float:
    """Largest penetration or slip by which the forces differ from those of gaps and slips [mm]."""
    gap = np.abs(forces.of_gap - forces.normal) / pairs.stiffness
    slip = np.where(forces.sticks, np.abs(forces.of_slip - forces.shear), 0.0)
    return float(np.maximum(gap, slip / pairs.shear_stiffness).max(initial=0.0))


def multiplier_step(pairs: Pairs, forces: PairForces, du: FloatArray) -> PairMultipliers:
    """Change of the forces to those that a displacement `du` (n, 2) leads to, linearised."""
    on_pairs = du[pairs.nodes].reshape(-1, 6)
    gap = np.sum(forces.grad_gap * on_pairs, axis=1)
    slip = np.sum(forces.grad_slip * on_pairs, axis=1)
    normal = np.where(forces.pressed, forces.of_gap - pairs.stiffness * gap, 0.0) - forces.normal
    held = np.where(forces.sticks, pairs.shear_stiffness * slip, forces.drag * normal)
    return PairMultipliers(
        normal=normal,
        shear=forces.of_slip + held - forces.shear,
        pressed=forces.pressed,
        sense=forces.sense,
    )


def multipliers_after(forces: PairForces, step: PairMultipliers, alpha: float) -> PairMultipliers:
    """Forces after a share `alpha` of a step of `multiplier_step`."""
    return PairMultipliers(
        normal=forces.normal + alpha * step.normal,
        shear=forces.shear + alpha * step.shear,
        pressed=step.pressed,
        sense=step.sense,
    )


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
    stiffness = np.where(forces.pressed, pairs.stiffness, 0.0)[:, None, None]
    K = stiffness * _outer(forces.grad_gap, forces.grad_gap)
    K -= forces.normal[:, None, None] * hess_gap
    K += (forces.shear * pairs.L_n)[:, None, None] * hess_xi
    along = np.where(forces.sticks, pairs.shear_stiffness, 0.0)[:, None, None]
    K += along * _outer(forces.grad_slip, forces.grad_slip)
    # Sliding friction follows the normal force: d(shear) = -sign mu k d(gap).
    K -= forces.drag[:, None, None] * stiffness * _outer(forces.grad_slip, forces.grad_gap)
    return K


def _outer(a: FloatArray, b: FloatArray) -> FloatArray:
    return a[:, :, None] * b[:, None, :]


def _symmetric(a: FloatArray, b: FloatArray) -> FloatArray:
    return _outer(a, b) + _outer(b, a)


def pair_geometry(pairs: Pairs, x: FloatArray) -> SegmentGeometry:
    """Nodes and segments of the pairs at coordinates `x` (n, 2) [mm]."""
    s, a, b = (x[pairs.nodes[:, i]] for i in range(3))
    return segment_geometry(s, a, b, pairs.orientation)
