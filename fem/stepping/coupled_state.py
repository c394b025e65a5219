"""Accepted states of block, contact and heat, and the steps between them."""

from dataclasses import dataclass

from fem.heat import HeatState
from fem.mechanics import (
    Iterate,
    MechanicalState,
    RigidProblem,
    StepEnergies,
    StepEvaluation,
    StepProblem,
)
from fem.newton import Failure
from fem.stepping.phases import Target
from fem.stepping.road_contact import RoadContact
from materials.arrays import BoolArray, FloatArray

Problem = StepProblem | RigidProblem


@dataclass(frozen=True, kw_only=True)
class CoupledState:
    """Accepted state of block, contact and heat."""

    time: float
    position: float
    mechanics: MechanicalState
    heat: HeatState
    contact: RoadContact
    mu: FloatArray


@dataclass(frozen=True, kw_only=True)
class AcceptedStep:
    """A solved step: its start, its end and what was done.

    Attributes
    ----------
    before, after : CoupledState
        States at both ends.
    target : Target
        Loads and motion of the step.
    evaluation : StepEvaluation
        Nodal forces and kinematics at the end.
    problem : StepProblem
        The mechanics problem (velocities, viscous term).
    iterations, hardest_pass : int
        Newton iterations of all passes, and of the pass that took most.
    lag_error : float
        Relative change of the friction force with the coefficient at the pressures, slip
        velocities and temperatures of the end of the step [-].
    power : (m,) float array
        Frictional power of the candidates, mean over the step [mJ/s].
    kappa : (m,) float array
        Share of it that heats the rubber [-].
    capped : (m,) bool array
        Where the partition was capped.
    self_friction : float
        Friction work of the block on itself in the step [mJ/mm].
    penetration : float
        Largest penetration of the block into itself, relative to the local element size [-].
    energies : StepEnergies
        Energies of the block.
    relaxed : bool
        Whether it is the end of a continuation, which dissipated too (`fem.stepping.relaxation`).
    """

    before: CoupledState
    after: CoupledState
    target: Target
    evaluation: StepEvaluation
    problem: Problem
    iterations: int
    hardest_pass: int
    lag_error: float
    power: FloatArray
    kappa: FloatArray
    capped: BoolArray
    self_friction: float
    penetration: float
    energies: StepEnergies
    relaxed: bool = False

    @property
    def solution(self) -> Iterate:
        """What an iteration of the same step with other damping can start from."""
        x = self.after.mechanics
        return Iterate(u=x.u, p=x.p, status=x.status)


@dataclass(frozen=True, kw_only=True)
class RejectedStep:
    """A step without a solution, and why."""

    failure: Failure
    detail: str
    iterations: int
