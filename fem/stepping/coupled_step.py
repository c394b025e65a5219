"""One coupled step: friction coefficient, mechanics, then heat.

The friction coefficient is taken from the state before the step and corrected by an outer fixed
point (a law that weakens with speed makes a fully implicit coefficient stall: smaller steps then
make it worse). What remains of the lag is measured. Heat follows the accepted mechanics.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from contact.active_set import ContactForces
from contact.conductance import GapConductance
from contact.friction import ThermalFriction
from contact.interface import InterfaceState
from contact.partition import HeatPartition
from contact.self_contact import Pairs
from fem import newton
from fem.case import MOST_PASSES
from fem.heat import HeatLoad, HeatModel, HeatState
from fem.mechanics import (
    BlockMechanics,
    Iterate,
    MechanicalState,
    RigidMechanics,
    SnapDamping,
    StepEvaluation,
    StepLoad,
)
from fem.newton import Failure
from fem.stepping.coupled_state import AcceptedStep, CoupledState, Problem, RejectedStep
from fem.stepping.phases import Target
from fem.stepping.road_contact import RoadContact, friction_power, lag_error
from fem.stepping.self_contact import (
    PENETRATION_MAX,
    SelfContact,
    boundary_forces,
    friction_heat,
    penetration,
)
from materials.arrays import FloatArray, IntArray
from materials.material import StepEnd
from materials.units import W_PER_M2_K

#: Lag of the friction force below which no further pass is made [-].
LAG_TOLERANCE = 1e-3


@dataclass(frozen=True, kw_only=True)
class ContactLaws:
    """Friction, heat partition and gap conductance of the interface."""

    friction: ThermalFriction
    partition: HeatPartition
    conductance: GapConductance


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
            status=mechanics.status,
            length=zeros,
            normal=zeros,
            shear=zeros,
            pressure=zeros,
            slip_velocity=zeros,
            remembered_velocity=zeros,
            slip=zeros,
            T_before=heat.T[self.mechanics.candidates],
            mu=zeros,
        )
        contact = replace(
            contact, pressure=np.where(mechanics.status.active, self.mean_pressure, 0)
        )
        return CoupledState(
            time=time,
            position=0.0,
            mechanics=mechanics,
            heat=heat,
            contact=contact,
            mu=self._coefficient(contact, heat, 0.0),
        )

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
        load = self._load(state, target, help_level, guess)
        pairs = load.pairs
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
                return self._accept(
                    state, target, problem, result, contact, iterations=iterations, hardest=hardest
                )
            start = _carried(result.x, pairs, next_pairs)
            pairs = next_pairs
            problem = problem.again(problem.load.mu if mu_settled else mu_next, pairs)
        detail = "self-contact keeps changing its partners"
        return RejectedStep(failure=Failure.ITERATIONS, detail=detail, iterations=iterations)

    def _followed(self, state: CoupledState, pairs: Pairs | None, u: FloatArray) -> Pairs | None:
        if self.self_contact is None:
            return pairs
        return self.self_contact.followed(self.mechanics, state.mechanics, pairs, u)

    def _load(
        self, state: CoupledState, target: Target, help_level: float, guess: AcceptedStep | None
    ) -> StepLoad:
        """Loads of the first pass of a step."""
        if guess is not None:
            mu, pairs = guess.problem.load.mu, guess.problem.load.pairs
        else:
            mu, pairs, contact = state.mu, None, self.self_contact
            if contact is not None:
                pairs = contact.pairs(self.mechanics, state.mechanics, state.mechanics.u)
        return StepLoad(
            dt=target.dt,
            sweep=target.sweep,
            force=target.force,
            mu=mu,
            damping=None if self.damping is None else self.damping.rate(help_level, target.motion),
            damped_from=None if guess is None else guess.after.mechanics.u,
            pairs=pairs,
            T_C=state.heat.T,
            raised=target.raised,
            inertia=target.inertia,
        )

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
            status=x.status,
            length=np.where(active, length, 0.0),
            normal=normal,
            shear=np.where(active, forces.tangential, 0.0),
            pressure=np.maximum(normal, 0.0) / length,
            slip_velocity=forces.slip / problem.load.dt,
            remembered_velocity=remembered,
            slip=np.where(active, slip, 0.0),
            T_before=np.where(before.status.active, before.T_before, T),
            mu=problem.load.mu,
        )

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
            T_C=heat.T[nodes],
            T_road_C=self.heat.road_below(heat, nodes, position),
            slip=contact.slip,
            T_before_C=contact.T_before,
            **known,
        )

    def _accept(
        self,
        state: CoupledState,
        target: Target,
        problem: Problem,
        result: newton.NewtonResult[Iterate, StepEvaluation],
        contact: RoadContact,
        iterations: int,
        hardest: int,
    ) -> AcceptedStep | RejectedStep:
        """The step with its heat, unless the block penetrates itself."""
        x, evaluation, pairs = result.x, result.evaluation, problem.load.pairs
        depth = penetration(self.mechanics, pairs, x.u)
        if self.self_contact is not None and depth > PENETRATION_MAX:
            return _too_deep(depth, iterations)
        power = friction_power(state.contact, contact, self.mechanics.start_weight)
        interface = self._interface_of_step(state, contact)
        kappa = self.laws.partition.at(interface)
        nodes, work = friction_heat(pairs, evaluation)
        rubber = problem.rubber_end(evaluation)
        bulk = rubber.heat(viscous=self.viscosity_heats, damage=self.damage_heats)
        load = self._heat_load(target, x.u, contact, interface, kappa * power, (nodes, work))
        load = replace(load, bulk_power=self.mechanics.bulk_power(bulk, target.dt))
        after = self._after(state, load, contact, self._ended(problem, x, rubber, evaluation))
        velocity = after.mechanics.velocity
        return AcceptedStep(
            before=state,
            after=after,
            target=target,
            evaluation=evaluation,
            problem=problem,
            iterations=iterations,
            hardest_pass=hardest,
            lag_error=lag_error(contact, after.mu),
            power=power,
            kappa=kappa,
            capped=self.laws.partition.capped(interface),
            self_friction=float(work.sum()),
            penetration=depth,
            energies=self.mechanics.energies(evaluation, velocity, problem.past, rubber),
        )

    def _interface_of_step(self, state: CoupledState, contact: RoadContact) -> InterfaceState:
        """State of the candidates by which a step makes its heat."""
        # A node that has just opened made its heat under the pressure it had.
        pressure = np.where(contact.status.active, contact.pressure, state.contact.pressure)
        return self._interface(
            contact,
            state.heat,
            state.position,
            p=pressure,
            v=contact.slip_velocity,
            mean_pressure=state.contact.mean_pressure or self.mean_pressure,
        )

    def _ended(
        self, problem: Problem, x: Iterate, rubber: StepEnd, evaluation: StepEvaluation
    ) -> MechanicalState:
        shear, normal = boundary_forces(self.mechanics, problem.load.pairs, evaluation)
        return replace(problem.end(x, rubber, shear), self_normal=normal)

    def _after(
        self, state: CoupledState, load: HeatLoad, contact: RoadContact, mechanics: MechanicalState
    ) -> CoupledState:
        """State at the end of an accepted step, its heat advanced."""
        heat = self.heat.advance(state.heat, load, state.position)
        position = state.position + load.sweep
        return CoupledState(
            time=state.time + load.dt,
            position=position,
            mechanics=mechanics,
            heat=heat,
            contact=contact,
            mu=self._coefficient(contact, heat, position),
        )

    def _heat_load(
        self,
        target: Target,
        u: FloatArray,
        contact: RoadContact,
        interface: InterfaceState,
        power: FloatArray,
        own: tuple[IntArray, FloatArray],
    ) -> HeatLoad:
        """Heat that the road contact makes and lets through, and that of the block's `own` work."""
        active = contact.status.active
        opened = ~active & (power != 0.0)
        h = self.laws.conductance.at(interface)
        return HeatLoad(
            dt=target.dt,
            sweep=target.sweep,
            displacement=u,
            contact_nodes=self.mechanics.candidates[active],
            power=power[active],
            conductance=(W_PER_M2_K * h * contact.length)[active],
            surface_nodes=np.concatenate([self.mechanics.candidates[opened], own[0]]),
            surface_power=np.concatenate([power[opened], own[1] / target.dt]),
            convection=target.convection,
            parts=target.heat_parts,
        )


def _carried(x: Iterate, pairs: Pairs | None, following: Pairs | None) -> Iterate:
    """Start of the next pass: a solution, its forces of self-contact by the pairs that follow."""
    start = replace(x, reactions=None)
    if start.pairs is None or pairs is None or following is None:
        return start
    return replace(start, pairs=start.pairs.carried(pairs, following))


def _too_deep(depth: float, iterations: int) -> RejectedStep:
    detail = f"by {depth:.1%} of the local element size"
    return RejectedStep(failure=Failure.PENETRATION, detail=detail, iterations=iterations)
