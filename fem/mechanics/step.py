"""The Newton problem of one implicit step: residual, status of the contact and direction."""

from __future__ import annotations

from copy import copy
from dataclasses import replace

import numpy as np
from scipy.sparse import csc_matrix

from contact.active_set import SLIP, STICK, ContactForces, ContactStatus, next_status
from contact.self_contact import (
    PairForces,
    Pairs,
    multiplier_step,
    multipliers_after,
    pair_forces,
    pair_mismatch,
    pair_tangents,
)
from fem.mechanics.elements import ElementForces, Past, Viscosity
from fem.mechanics.equations import BlockEquations
from fem.mechanics.iterate import Iterate, StepEvaluation, StepLoad, inadmissible
from fem.mechanics.state import MechanicalState
from fem.solvers import summed
from materials.arrays import FloatArray
from materials.material import MaterialStep, StepEnd

#: Largest change of a deformation gradient in one Newton iteration [-].
STRAIN_LIMIT = 1.0


class StepProblem:
    """Newton problem of one step (see `fem.newton.Problem`)."""

    def __init__(
        self,
        system: BlockEquations,
        state: MechanicalState,
        load: StepLoad,
        material: MaterialStep,
    ) -> None:
        self.system, self.state, self.load = system, state, load
        self.past = Past(viscosity=_viscosity(system, state, load), material=material)
        self.frame = np.array([load.sweep / load.dt, 0.0])
        self.mass = system.mass if load.inertia else np.zeros_like(system.mass)
        self._latest: tuple[FloatArray, FloatArray, ElementForces] | None = None

    def again(self, mu: FloatArray, pairs: Pairs | None) -> StepProblem:
        """The same step with other friction coefficients and pairs of self-contact."""
        other = copy(self)
        other.load = replace(self.load, mu=mu, pairs=pairs)
        return other

    def start(self) -> Iterate:
        """Start value: the last state, with the status predicted from its motion.

        Only nodes that already slip along the motion keep slipping; all others in contact stick.
        """
        status = self.state.status
        along = status.slipping & (status.sense * self.load.sweep > 0.0)
        kind = np.where(status.active, np.where(along, SLIP, STICK), status.kind)
        return Iterate(u=self.state.u, p=self.state.p, status=replace(status, kind=kind))

    def velocity(self, u: FloatArray) -> FloatArray:
        """Absolute nodal velocities at the end of the step, (n, 2) [mm/s]."""
        return np.asarray((u - self.state.u) / self.load.dt + self.frame)

    def slip(self, u: FloatArray) -> FloatArray:
        """Displacement of the candidates over the road in the step, (m,) [mm]."""
        nodes = self.system.candidates
        return np.asarray(u[nodes, 0] - self.state.u[nodes, 0] + self.load.sweep)

    def evaluate(self, x: Iterate) -> StepEvaluation:
        """Residual and status of an iterate."""
        return self._evaluate(x, first=x.u is self.state.u)

    def nodal_forces(self, u: FloatArray, elements: ElementForces) -> FloatArray:
        """Internal, viscous and inertial minus applied nodal forces, (n, 2) [N/mm]."""
        system, load = self.system, self.load
        n = len(u)
        nodal = summed(system.elements.dofs.ravel(), elements.residual.ravel(), 2 * n)
        nodal = nodal.reshape(n, 2)
        acceleration = (self.velocity(u) - self.state.velocity) / load.dt
        nodal += self.mass[:, None] * acceleration
        if load.raised is None:
            nodal[:, 1] += load.force * system.top_load
        return np.asarray(nodal)

    def rubber_end(self, evaluation: StepEvaluation) -> StepEnd:
        """What the rubber is left with if the step ends at an evaluated iterate."""
        assert evaluation.elements is not None
        return self.system.elements.material(self.past).end(evaluation.elements.kinematics)

    def end(
        self, x: Iterate, rubber: StepEnd, self_shear: FloatArray | None = None
    ) -> MechanicalState:
        """State at the end of the step, for a converged iterate."""
        velocity = self.velocity(x.u) if self.load.inertia else np.zeros_like(x.u)
        lost = None
        if rubber.viscous is not None:
            lost = self.system.elements.mean(rubber.viscous)
            lost = lost if self.state.lost is None else self.state.lost + lost
        return MechanicalState(
            u=x.u,
            velocity=velocity,
            p=x.p,
            status=x.status,
            self_shear=self_shear,
            rubber=rubber.state,
            lost=lost,
        )

    def _evaluate(self, x: Iterate, first: bool) -> StepEvaluation:
        system = self.system
        elements = self._element_forces(x)
        if elements is None:
            return inadmissible(x.status)
        nodal = self.nodal_forces(x.u, elements)
        pairs = None
        if self.load.pairs is not None:
            pairs = pair_forces(self.load.pairs, system.mesh.points + x.u, x.pairs)
            np.add.at(nodal, self.load.pairs.nodes, pairs.residual.reshape(-1, 3, 2))
        status = x.status if first else self._next_status(x, nodal)
        forces = self.contact_forces(x.u, nodal)
        residual = self._residual(nodal, forces, status, self._raised(x.u))
        mismatch = np.abs(elements.pressure_residual * np.sqrt(system.elements.volume)).max()
        merit = max(np.abs(residual).max(), mismatch) / system.tolerance
        settled = not first and status.same_as(x.status)
        if pairs is not None:
            assert self.load.pairs is not None
            off = pair_mismatch(self.load.pairs, pairs)
            merit = max(merit, off * system.elements.K_bulk / system.tolerance)
            settled = settled and pairs.settled
            if off > 0.0:
                of_gaps = nodal + self._pending(pairs)
                forces = self.contact_forces(x.u, of_gaps)
                residual = self._residual(of_gaps, forces, status, self._raised(x.u))
        return StepEvaluation(
            merit=float(merit),
            settled=settled,
            status=status,
            nodal=nodal,
            residual=residual,
            elements=elements,
            pairs=pairs,
        )

    def _pending(self, pairs: PairForces) -> FloatArray:
        """Nodal forces of self-contact by the gaps less those by the multipliers, (n, 2)."""
        assert self.load.pairs is not None
        pending = np.zeros_like(self.system.mesh.points)
        np.add.at(pending, self.load.pairs.nodes, pairs.pending.reshape(-1, 3, 2))
        return pending

    def _element_forces(self, x: Iterate) -> ElementForces | None:
        """Forces of the elements, those of the latest iterate kept; None if not admissible."""
        if self._latest is not None and self._latest[0] is x.u and self._latest[1] is x.p:
            return self._latest[2]
        elements = self.system.elements
        kin = elements.kinematics(x.u)
        if not elements.admissible(kin):
            return None
        forces = elements.forces(x.p, kin, self.past)
        self._latest = x.u, x.p, forces
        return forces

    def _next_status(self, x: Iterate, nodal: FloatArray) -> ContactStatus:
        """Status that the iterate asks for.

        Judged by the reactions of the linear system, the multipliers of the active set method:
        those of the nonlinear forces hold, before convergence, the bulk modulus times the error
        of the areas, which makes nodes pull that press in the solution.
        """
        forces = self.contact_forces(x.u, nodal)
        if x.reactions is not None:
            forces = replace(forces, normal=x.reactions[:, 1], tangential=x.reactions[:, 0])
        return next_status(
            x.status,
            forces,
            self.load.mu,
            force_tolerance=0.1 * self.system.tolerance,
            slip_tolerance=1e-12,
        )

    def contact_forces(self, u: FloatArray, nodal: FloatArray) -> ContactForces:
        """Gaps, reactions and slips of the candidates."""
        nodes = self.system.candidates
        return ContactForces(
            gap=self.system.gap(u),
            normal=nodal[nodes, 1],
            tangential=nodal[nodes, 0],
            slip=self.slip(u),
        )

    def _raised(self, u: FloatArray) -> float:
        """Rise of the platen in the step [mm]."""
        top = self.system.mesh.top[0]
        return float(u[top, 1] - self.state.u[top, 1])

    def _residual(
        self, nodal: FloatArray, forces: ContactForces, status: ContactStatus, platen: float
    ) -> FloatArray:
        """Residual of the equations [N/mm]: forces, gaps (active), slips (stick), platen (raised).

        Gaps and slips are multiplied by the bulk modulus, so that all have one unit and size.
        """
        r = self.system.gather(nodal)
        rows, stiffness = self.system.equation[self.system.candidates], self.system.elements.K_bulk
        slipping, sticking, active = status.slipping, status.sticking, status.active
        friction = forces.tangential + status.sense * self.load.mu * forces.normal
        r[rows[slipping, 0]] = friction[slipping]
        r[rows[sticking, 0]] = stiffness * forces.slip[sticking]
        r[rows[active, 1]] = stiffness * forces.gap[active]
        if self.load.raised is not None:
            r[-1] = stiffness * (platen - self.load.raised)
        return r

    def direction(self, x: Iterate, evaluation: StepEvaluation) -> Iterate:
        """Newton direction with the status asked for by the iterate."""
        system, elements = self.system, evaluation.elements
        assert elements is not None
        data, pairs = self._force_tangents(evaluation)
        matrix = self.system.matrix(data, pairs, evaluation.status, self.load)
        step = system.solver.solve(matrix, -evaluation.residual)
        held = self.system.held(evaluation.status, self.load)
        # Gaps and slips close exactly, however roughly the system is solved.
        step[held] = -evaluation.residual[held] / system.elements.K_bulk
        du = system.scatter(step)
        dp = system.elements.pressure_increment(elements, du)
        change = self._force_change(data, pairs, step)
        multipliers = None
        if self.load.pairs is not None and evaluation.pairs is not None:
            multipliers = multiplier_step(self.load.pairs, evaluation.pairs, du)
            change += self._pending(evaluation.pairs)[system.candidates]
        return Iterate(u=du, p=dp, status=evaluation.status, reactions=change, pairs=multipliers)

    def _force_change(
        self, data: FloatArray, pairs: FloatArray | None, step: FloatArray
    ) -> FloatArray:
        """Linear change of the candidates' nodal forces with a step, (m, 2) [N/mm]."""
        system, count = self.system, self.system.candidates.size
        change = np.empty((count, 2))
        for component, slots in enumerate((system._slots_x, system._slots_y)):
            terms = data[slots] * step[system.pattern.columns[slots]]
            change[:, component] = summed(system._owner, terms, count)
        if pairs is not None:
            assert self.load.pairs is not None
            du, nodes = system.scatter(step), self.load.pairs.nodes
            on_nodes, g = np.zeros_like(du), np.matmul(pairs, du[nodes].reshape(-1, 6, 1))
            np.add.at(on_nodes, nodes, g.reshape(-1, 3, 2))
            change += on_nodes[system.candidates]
        return change

    def tangent(self, evaluation: StepEvaluation) -> csc_matrix:
        """Tangent of the residual, with the status asked for by the iterate."""
        data, pairs = self._force_tangents(evaluation)
        return self.system.matrix(data, pairs, evaluation.status, self.load)

    def _force_tangents(self, evaluation: StepEvaluation) -> tuple[FloatArray, FloatArray | None]:
        """Tangents of the nodal forces: matrix data of the block, and of the pairs (np, 6, 6)."""
        system, elements, pairs = self.system, evaluation.elements, self.load.pairs
        assert elements is not None
        data = system.pattern.sum(system.elements.tangent(elements))
        system.add_to_diagonal(data, self.mass / self.load.dt**2)
        if pairs is None or evaluation.pairs is None or not evaluation.pairs.pressed.any():
            return data, None
        return data, pair_tangents(pairs, evaluation.pairs)

    def step_limit(self, x: Iterate, direction: Iterate) -> float:
        """Step in which no deformation gradient changes by more than `STRAIN_LIMIT`."""
        size = self.system.elements.largest_gradient(direction.u)
        return min(1.0, STRAIN_LIMIT / size) if size > 0.0 else 1.0

    def moved(
        self, x: Iterate, evaluation: StepEvaluation, direction: Iterate, alpha: float
    ) -> Iterate:
        """Iterate at ``x + alpha direction`` with the status of the direction."""
        reactions = None
        if direction.reactions is not None:
            reactions = evaluation.nodal[self.system.candidates] + alpha * direction.reactions
        pairs = None
        if evaluation.pairs is not None and direction.pairs is not None:
            pairs = multipliers_after(evaluation.pairs, direction.pairs, alpha)
        return Iterate(
            u=x.u + alpha * direction.u,
            p=x.p + alpha * direction.p,
            status=direction.status,
            reactions=reactions,
            pairs=pairs,
        )


def _viscosity(system: BlockEquations, state: MechanicalState, load: StepLoad) -> Viscosity | None:
    """Kelvin-Voigt term of a damped step."""
    if load.damping is None:
        return None
    u_n = state.u if load.damped_from is None else load.damped_from
    strain_n = system.elements.kinematics(u_n).green_lagrange
    return Viscosity(rate=load.damping, strain_n=strain_n)
