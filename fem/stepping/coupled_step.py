"""One coupled step: friction coefficient, mechanics, then heat.

The friction coefficient is taken from the state before the step and corrected by an outer fixed
point (a law that weakens with speed makes a fully implicit coefficient stall: smaller steps then
make it worse). What remains of the lag is measured. Heat follows the accepted mechanics.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.active_set import ContactForces
from contact.conductance import GapConductance
from contact.friction import ThermalFriction
from contact.interface import InterfaceState
from contact.overlap import crossing_depth
from contact.pair_search import find_pairs, followed, pair_penetration
from contact.partition import HeatPartition
from contact.self_contact import Pairs, dissipation, heat_sources
from fem import newton
from fem.case import MOST_PASSES
from fem.heat import HeatLoad, HeatModel, HeatState
from fem.mechanics import (
    BlockMechanics,
    Iterate,
    MechanicalState,
    RigidMechanics,
    RigidProblem,
    SnapDamping,
    StepEnergies,
    StepEvaluation,
    StepLoad,
    StepProblem,
)
from fem.stepping.phases import Target
from fem.stepping.road_contact import RoadContact, friction_power, lag_error
from materials.arrays import FloatArray, IntArray
from materials.units import W_PER_M2_K

#: Lag of the friction force below which no further pass is made [-].
LAG_TOLERANCE = 1e-3
#: Deepest penetration of the block into itself in an accepted step, over the local element size.
PENETRATION_MAX = 0.01


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
    problem: StepProblem | RigidProblem
    iterations: int
    hardest_pass: int
    lag_error: float
    power: FloatArray
    kappa: FloatArray
    capped: NDArray[np.bool_]
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

    failure: newton.Failure
    detail: str
    iterations: int


@dataclass(frozen=True, kw_only=True)
class ContactLaws:
    """Friction, heat partition and gap conductance of the interface."""

    friction: ThermalFriction
    partition: HeatPartition
    conductance: GapConductance


@dataclass(frozen=True, kw_only=True)
class SelfContact:
    """Settings of the contact of the block with itself.

    Attributes
    ----------
    mu : float
        Friction coefficient of rubber on rubber [-].
    stiffness : float
        Contact modulus [N/mm^2]: force per penetration relative to the local element size.
    reach : float
        Search distance [mm].
    """

    mu: float
    stiffness: float
    reach: float


Problem = StepProblem | RigidProblem


class CoupledModel:
    """Mechanics and heat of one block, advanced step by step.

    Parameters
    ----------
    mechanics : BlockMechanics or RigidMechanics
        Mechanics of the block.
    heat : HeatModel
        Heat of block and road.
    laws : ContactLaws
        Laws of the interface.
    damping : SnapDamping, optional
        Damping of steps that need help; none without it.
    mean_pressure : float
        Pressure assumed for nodes that are about to touch the road, and as the mean pressure of
        the contact in the first step [N/mm^2].
    friction_passes : int
        Largest number of passes over the friction coefficient in a step.
    options : newton.NewtonOptions
        Limits of the Newton iteration.
    first_merit : float
        Merit that suffices in a pass whose friction coefficient is still to be corrected.
    self_contact : SelfContact, optional
        Contact of the block with itself; none without it.
    viscosity_heats, damage_heats : bool
        Whether what the rubber's viscosity dissipates and its damage consumes heats the block.
    """

    def __init__(
        self,
        mechanics: BlockMechanics | RigidMechanics,
        heat: HeatModel,
        laws: ContactLaws,
        *,
        damping: SnapDamping | None = None,
        mean_pressure: float,
        friction_passes: int,
        options: newton.NewtonOptions,
        first_merit: float = 1.0,
        self_contact: SelfContact | None = None,
        viscosity_heats: bool = True,
        damage_heats: bool = True,
    ) -> None:
        self.viscosity_heats, self.damage_heats = viscosity_heats, damage_heats
        self.self_contact, self.damping = self_contact, damping
        self.mechanics, self.heat, self.laws = mechanics, heat, laws
        self.mean_pressure, self.friction_passes = mean_pressure, friction_passes
        self.options = options
        self.first_options = replace(options, tolerance=max(options.tolerance, first_merit))

    def initial_state(self) -> CoupledState:
        """Block at rest, just touching the road, at ambient temperature."""
        return self._touching(self.mechanics.initial_state(), self.heat.initial_state(), 0.0)

    def touched_down(self, state: CoupledState, *, fresh_road: bool) -> CoupledState:
        """State of a block that hung in air and comes down on the road again, at rest."""
        mechanics = self.mechanics.above_road(state.mechanics)
        heat = self.heat.touched_down(state.heat, mechanics.u, fresh_road)
        return self._touching(mechanics, heat, state.time)

    def _touching(self, mechanics: MechanicalState, heat: HeatState, time: float) -> CoupledState:
        """State of a block that touches the road without a force."""
        zeros = np.zeros(self.mechanics.candidates.size)
        contact = RoadContact(
            status=mechanics.status, length=zeros, normal=zeros, shear=zeros, pressure=zeros,
            slip_velocity=zeros, remembered_velocity=zeros, slip=zeros,
            T_before=heat.T[self.mechanics.candidates], mu=zeros,
        )  # fmt: skip
        contact = replace(
            contact, pressure=np.where(mechanics.status.active, self.mean_pressure, 0)
        )
        return CoupledState(
            time=time, position=0.0, mechanics=mechanics, heat=heat, contact=contact,
            mu=self._coefficient(contact, heat, 0.0),
        )  # fmt: skip

    def advance(
        self,
        state: CoupledState,
        target: Target,
        help_level: float = 0.0,
        guess: AcceptedStep | None = None,
    ) -> AcceptedStep | RejectedStep:
        """Solve one step from an accepted state, with damping of a level; the state stays.

        Passes over the friction coefficient and over the pairs of self-contact, each from the
        solution of the last. The first starts from the state, or from a `guess`: the same step
        solved with other damping, from which the strains of the damping count then.
        """
        mu, pairs = state.mu, self._pairs(state, state.mechanics.u)
        if guess is not None:
            mu, pairs = guess.problem.load.mu, guess.problem.load.pairs
        damping = None if self.damping is None else self.damping.rate(help_level, target.motion)
        load = StepLoad(
            dt=target.dt,
            sweep=target.sweep,
            force=target.force,
            mu=mu,
            damping=damping,
            damped_from=None if guess is None else guess.after.mechanics.u,
            pairs=pairs,
            T_C=state.heat.T,
            raised=target.raised,
            inertia=target.inertia,
        )
        problem: Problem = self.mechanics.step(state.mechanics, load)
        start = problem.start() if guess is None else guess.solution
        iterations = hardest = 0
        self.mechanics.solver.forget()
        for number in range(1, MOST_PASSES + 1):
            last = number >= self.friction_passes
            options = self.options if last else self.first_options
            result = newton.solve(problem, start, options)
            iterations += result.iterations
            hardest = max(hardest, result.iterations)
            if result.failure is not None:
                return RejectedStep(
                    failure=result.failure, detail=result.detail, iterations=iterations
                )
            contact = self._contact(state, problem, result)
            mu_next = self._coefficient(contact, state.heat, state.position)
            lag = lag_error(contact, mu_next)
            mu_settled = lag < LAG_TOLERANCE or last
            next_pairs = self._followed(state, pairs, result.x.u)
            solved = result.evaluation.merit <= self.options.tolerance
            if mu_settled and next_pairs is pairs and solved:
                penetration = self._penetration(problem, result.x.u)
                if self.self_contact is not None and penetration > PENETRATION_MAX:
                    return RejectedStep(
                        failure=newton.Failure.PENETRATION, iterations=iterations,
                        detail=f"by {penetration:.1%} of the local element size",
                    )  # fmt: skip
                return self._accept(
                    state, target, problem, result, contact,
                    iterations=iterations, hardest=hardest, penetration=penetration,
                )  # fmt: skip
            start = replace(result.x, reactions=None)
            if start.pairs is not None and pairs is not None and next_pairs is not None:
                start = replace(start, pairs=start.pairs.carried(pairs, next_pairs))
            mu, pairs = mu if mu_settled else mu_next, next_pairs
            problem = problem.again(mu, pairs)
        return RejectedStep(
            failure=newton.Failure.ITERATIONS, detail="self-contact keeps changing its partners",
            iterations=iterations,
        )  # fmt: skip

    def _pairs(self, state: CoupledState, u: FloatArray) -> Pairs | None:
        """Pairs of self-contact between the accepted state and displacements `u`."""
        if self.self_contact is None or isinstance(self.mechanics, RigidMechanics):
            return None
        mechanics, settings = self.mechanics, self.self_contact
        shear = state.mechanics.self_shear
        points = mechanics.mesh.points
        return find_pairs(
            mechanics.boundary, points + state.mechanics.u, points + u,
            reach=settings.reach, stiffness=settings.stiffness, mu=settings.mu,
            shear_n=np.zeros(mechanics.boundary.nodes.size) if shear is None else shear,
        )  # fmt: skip

    def _followed(self, state: CoupledState, pairs: Pairs | None, u: FloatArray) -> Pairs | None:
        """Pairs to go on with at displacements `u`; the same object if they still hold."""
        found = self._pairs(state, u)
        if found is None or pairs is None or isinstance(self.mechanics, RigidMechanics):
            return pairs
        return followed(pairs, found, self.mechanics.mesh.points + u, self.mechanics.boundary)

    def _contact(
        self,
        state: CoupledState,
        problem: Problem,
        result: newton.NewtonResult[Iterate, StepEvaluation],
    ) -> RoadContact:
        """Contact quantities of a converged iterate of a step from `state`."""
        x, before = result.x, state.contact
        forces: ContactForces = problem.contact_forces(x.u, result.evaluation.nodal)
        active = x.status.active
        speed = np.abs(forces.slip) / problem.load.dt
        # A node that has just touched the road knows its present speed only.
        known = np.where(before.status.active, before.remembered_velocity, speed)
        remembered = self.laws.friction.remembered(known, speed, forces.slip)
        length = self.mechanics.contact_lengths(x.u, active)
        normal = np.where(active, forces.normal, 0.0)
        slip = np.where(before.status.active, before.slip, 0.0) + np.abs(forces.slip)
        T = state.heat.T[self.mechanics.candidates]
        return RoadContact(
            status=x.status, length=np.where(active, length, 0.0), normal=normal,
            shear=np.where(active, forces.tangential, 0.0),
            pressure=np.maximum(normal, 0.0) / length,
            slip_velocity=forces.slip / problem.load.dt, remembered_velocity=remembered,
            slip=np.where(active, slip, 0.0),
            T_before=np.where(before.status.active, before.T_before, T), mu=problem.load.mu,
        )  # fmt: skip

    def _coefficient(self, contact: RoadContact, heat: HeatState, position: float) -> FloatArray:
        """Friction coefficient of a contact at the temperatures and the place of a heat state."""
        p = np.where(contact.status.active, contact.pressure, self.mean_pressure)
        mean, v = contact.mean_pressure or self.mean_pressure, contact.remembered_velocity
        return self.laws.friction.at(
            self._interface(contact, heat, position, p=p, v=v, mean_pressure=mean)
        )

    def _interface(
        self, contact: RoadContact, heat: HeatState, position: float, **known: ArrayLike
    ) -> InterfaceState:
        """State of the candidates, for the laws, with the temperatures of a heat state."""
        nodes = self.mechanics.candidates
        return InterfaceState(
            T_C=heat.T[nodes], T_road_C=self.heat.road_below(heat, nodes, position),
            slip=contact.slip, T_before_C=contact.T_before, **known,
        )  # fmt: skip

    def _accept(
        self,
        state: CoupledState,
        target: Target,
        problem: Problem,
        result: newton.NewtonResult[Iterate, StepEvaluation],
        contact: RoadContact,
        *,
        iterations: int,
        hardest: int,
        penetration: float,
    ) -> AcceptedStep:
        x = result.x
        power = friction_power(state.contact, contact, self.mechanics.start_weight)
        # A node that has just opened made its heat under the pressure it had.
        pressure = np.where(contact.status.active, contact.pressure, state.contact.pressure)
        interface = self._interface(
            contact, state.heat, state.position, p=pressure, v=contact.slip_velocity,
            mean_pressure=state.contact.mean_pressure or self.mean_pressure,
        )  # fmt: skip
        kappa = self.laws.partition.at(interface)
        nodes, work = self._self_friction(problem, result.evaluation)
        rubber = problem.rubber_end(result.evaluation)
        heat = self._heat(
            state, target, x.u, contact, interface, kappa * power,
            surface=(nodes, work / target.dt),
            bulk=self.mechanics.bulk_power(
                rubber.heat(viscous=self.viscosity_heats, damage=self.damage_heats), target.dt
            ),
        )  # fmt: skip
        self_shear = self._self_shear(problem, result.evaluation)
        mechanics = replace(
            problem.end(x, rubber, self_shear),
            self_normal=self._self_normal(problem, result.evaluation),
        )
        after = CoupledState(
            time=state.time + target.dt, position=state.position + target.sweep,
            mechanics=mechanics, heat=heat, contact=contact,
            mu=self._coefficient(contact, heat, state.position + target.sweep),
        )  # fmt: skip
        return AcceptedStep(
            before=state, after=after, target=target, evaluation=result.evaluation,
            problem=problem, iterations=iterations, hardest_pass=hardest,
            lag_error=lag_error(contact, after.mu),
            power=power, kappa=kappa,
            capped=self.laws.partition.capped(interface), self_friction=float(work.sum()),
            penetration=penetration,
            energies=self.mechanics.energies(
                result.evaluation, mechanics.velocity, problem.past, rubber
            ),
        )  # fmt: skip

    def _self_friction(
        self, problem: Problem, evaluation: StepEvaluation
    ) -> tuple[IntArray, FloatArray]:
        """Nodes and friction work of self-contact [mJ/mm]; all of it becomes heat in the rubber."""
        pairs, forces = problem.load.pairs, evaluation.pairs
        if pairs is None or forces is None:
            return np.empty(0, dtype=np.int64), np.empty(0)
        return heat_sources(pairs, forces, dissipation(pairs, forces))

    def _penetration(self, problem: Problem, u: FloatArray) -> float:
        """Largest penetration relative to the local element size, of pairs and of others [-]."""
        if isinstance(self.mechanics, RigidMechanics):
            return 0.0
        x, boundary = self.mechanics.mesh.points + u, self.mechanics.boundary
        depth = crossing_depth(x[boundary.nodes], boundary.size, boundary.joined)
        if problem.load.pairs is None:
            return depth
        return max(depth, pair_penetration(problem.load.pairs, x, boundary))

    def _self_shear(self, problem: Problem, evaluation: StepEvaluation) -> FloatArray | None:
        """Tangential forces of self-contact by boundary node."""
        pairs, forces = problem.load.pairs, evaluation.pairs
        if pairs is None or forces is None or isinstance(self.mechanics, RigidMechanics):
            return None
        shear = np.zeros(self.mechanics.boundary.nodes.size)
        np.add.at(shear, pairs.place, forces.shear)
        return shear

    def _self_normal(self, problem: Problem, evaluation: StepEvaluation) -> FloatArray | None:
        """Normal forces of self-contact on each boundary node."""
        pairs, forces = problem.load.pairs, evaluation.pairs
        if pairs is None or forces is None or isinstance(self.mechanics, RigidMechanics):
            return None
        on_nodes = np.zeros(len(self.mechanics.mesh.points))
        np.add.at(on_nodes, pairs.nodes, forces.normal[:, None] * forces.geometry.shares)
        return on_nodes[self.mechanics.boundary.nodes]

    def _heat(
        self, state: CoupledState, target: Target, u: FloatArray, contact: RoadContact,
        interface: InterfaceState, power: FloatArray, *,
        surface: tuple[IntArray, FloatArray], bulk: FloatArray | None,
    ) -> HeatState:  # fmt: skip
        active = contact.status.active
        opened = ~active & (power != 0.0)
        h = self.laws.conductance.at(interface)
        load = HeatLoad(
            dt=target.dt, sweep=target.sweep, displacement=u,
            contact_nodes=self.mechanics.candidates[active], power=power[active],
            conductance=(W_PER_M2_K * h * contact.length)[active],
            surface_nodes=np.concatenate([self.mechanics.candidates[opened], surface[0]]),
            surface_power=np.concatenate([power[opened], surface[1]]),
            bulk_power=bulk, convection=target.convection, parts=target.heat_parts,
        )  # fmt: skip
        return self.heat.advance(state.heat, load, state.position)
