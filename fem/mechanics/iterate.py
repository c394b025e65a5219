"""What a step of the mechanics is given, what its iteration moves, and what it finds."""

from dataclasses import dataclass

import numpy as np

from contact.active_set import ContactStatus
from contact.self_contact import PairForces, PairMultipliers, Pairs
from fem.mechanics.elements import ElementForces
from materials.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class StepLoad:
    """Loads and prescribed motion of one step.

    Attributes
    ----------
    dt : float
        Length of the step [s].
    sweep : float
        Motion of the platen over the road in the step, signed [mm].
    force : float
        Force on the platen, downwards, per depth, at the end of the step [N/mm].
    mu : (m,) float array
        Friction coefficient of the candidates [-].
    damping : (ne, 1) float array or None
        Stress per strain increment of the step, by element [N/mm^2]; None without damping.
    damped_from : (n, 2) float array, optional
        Displacements that the strain increments of the damping count from [mm]; those of the last
        accepted step without it.
    pairs : Pairs or None
        Nodes and segments of the boundary that may meet; None without self-contact.
    T_C : (n,) float array or None
        Temperature of the nodes in the last accepted step, for rubber with a memory [C].
    raised : float or None
        Rise of the platen in the step, which takes the place of the force [mm].
    inertia : bool
        Whether the mass of the block counts; without it the block ends the step at rest.
    """

    dt: float
    sweep: float
    force: float
    mu: FloatArray
    damping: FloatArray | None = None
    damped_from: FloatArray | None = None
    pairs: Pairs | None = None
    T_C: FloatArray | None = None
    raised: float | None = None
    inertia: bool = True


@dataclass(frozen=True, kw_only=True)
class Iterate:
    """Unknowns of the Newton iteration; directions and their changes have the same form.

    Attributes
    ----------
    u, p : float arrays
        Displacements (n, 2) [mm] and element pressures (ne,) [N/mm^2].
    status : ContactStatus
        Status the iterate was computed with.
    reactions : (m, 2) float array or None
        Nodal forces of the candidates by the linear system that gave the iterate [N/mm].
    pairs : PairMultipliers or None
        Forces of self-contact by that system; None: those of the gaps.
    """

    u: FloatArray
    p: FloatArray
    status: ContactStatus
    reactions: FloatArray | None = None
    pairs: PairMultipliers | None = None


@dataclass(frozen=True, kw_only=True)
class StepEvaluation:
    """Residual of an iterate.

    Attributes
    ----------
    merit : float
        Largest residual over its tolerance scale; inf if the iterate is not admissible.
    settled : bool
        Whether the status asked for is the one the iterate was computed with.
    status : ContactStatus
        Status asked for by the iterate.
    nodal : (n, 2) float array
        Nodal forces: internal, viscous, inertial and of self-contact, minus the applied ones
        [N/mm].
    residual : (size,) float array
        Residual of the equations, with the forces of self-contact that the gaps would make.
    elements : ElementForces or None
        Element forces and kinematics; None if the iterate is not admissible.
    pairs : PairForces or None
        Forces of self-contact.
    """

    merit: float
    settled: bool
    status: ContactStatus
    nodal: FloatArray
    residual: FloatArray
    elements: ElementForces | None
    pairs: PairForces | None = None

    @property
    def signature(self) -> bytes:
        """Name of the status asked for."""
        road = self.status.kind.astype(np.int8).tobytes()
        return road if self.pairs is None else road + self.pairs.signature


def inadmissible(status: ContactStatus) -> StepEvaluation:
    """Evaluation of an iterate whose energy does not exist."""
    empty = np.zeros(0)
    return StepEvaluation(
        merit=np.inf, settled=False, status=status, nodal=empty, residual=empty, elements=None
    )
