"""One implicit step of the block's mechanics: equilibrium, inertia, platen and road contact.

Everything is written in the platen's frame: the block's top does not move along x, the road moves
below it by ``-sweep`` in a step. Equations and unknowns are the free displacements; the common
vertical displacement of the platen is one of them. For a rigid plane the normal constraint of a
node in contact replaces its vertical equation, its reaction is the nodal force of that equation,
and Coulomb friction is the row operation ``row_x + s mu row_y`` (s: sense of the slip).
"""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix, csc_matrix

from contact.active_set import SLIP, STICK, ContactForces, ContactStatus, next_status
from contact.self_contact import (
    Boundary,
    PairForces,
    PairMultipliers,
    Pairs,
    multiplier_step,
    multipliers_after,
    pair_forces,
    pair_tangents,
)
from fem.mechanics.account import CellFields, StepEnergies, Strains
from fem.mechanics.elements import ElementForces, Past, Q1P0Elements, Viscosity, tangent_entries
from fem.mechanics.state import MechanicalState
from fem.mesh import BlockMesh
from fem.solvers import LinearSolver, SparsePattern, SuperLUSolver, nested_dissection, summed
from materials.arrays import FloatArray, IntArray
from materials.material import MaterialStep, StepEnd

#: Largest change of a deformation gradient in one Newton iteration [-].
STRAIN_LIMIT = 1.0


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


class BlockMechanics:
    """Discrete equations of a block between platen and road.

    Parameters
    ----------
    mesh : BlockMesh
        Reference mesh.
    elements : Q1P0Elements
        Element kernel on that mesh.
    density : float
        Mass density [t/mm^3]; zero for quasi-static steps.
    top : {"platen", "pressure"}
        Rigid platen, or free uniform pressure with fixed horizontal displacement.
    tolerance : float
        Force residual [N/mm] that counts as converged.
    """

    deforms = True
    #: Weight of the forces at the start of a step in their mean over it: the trapezoidal rule.
    start_weight = 0.5

    def __init__(
        self,
        mesh: BlockMesh,
        elements: Q1P0Elements,
        *,
        density: float = 0.0,
        top: Literal["platen", "pressure"] = "platen",
        tolerance: float = 1e-8,
        solver: LinearSolver | None = None,
    ) -> None:
        self.mesh, self.elements, self.top = mesh, elements, top
        self.tolerance = tolerance
        self.solver: LinearSolver = solver or SuperLUSolver()
        n = len(mesh.points)
        self.mass = np.bincount(
            mesh.cells.ravel(), np.repeat(density * elements.volume / 4.0, 4), minlength=n
        )
        self.candidates = mesh.candidates
        size = mesh.node_size[mesh.boundary]
        self.boundary = Boundary.of(
            mesh.boundary, mesh.direction, mesh.points, size, joined=mesh.joined
        )
        self._number_equations()
        self._top_load = np.zeros(n)
        self._top_load[mesh.top] = mesh.top_shares

    def _number_equations(self) -> None:
        """Equation numbers of all dofs (-1: prescribed), in a fill-reducing order."""
        mesh, platen = self.mesh, self.top == "platen"
        free = np.ones((len(mesh.points), 2), dtype=bool)
        free[mesh.top, 0] = False
        free[mesh.top, 1] = not platen
        # The mirror image of a mesh has the same order.
        order = nested_dissection(mesh.points * [mesh.direction, 1.0], mesh.cells)
        dof = np.full(free.shape, -1)
        dof[order] = np.where(free[order], np.cumsum(free[order]).reshape(-1, 2) - 1, -1)
        size = int(free.sum()) + platen
        if platen:
            # Coupled with all nodes of the top, so it comes last.
            dof[mesh.top, 1] = size - 1
        self.equation = dof
        self.pattern = SparsePattern.from_entries(*tangent_entries(dof[mesh.cells]), size)
        self._diagonal = self.pattern.diagonal_slots()
        rows = self.equation[self.candidates]
        self._slots_x, self._owner = self.pattern.row_slots(rows[:, 0])
        self._slots_y, _ = self.pattern.row_slots(rows[:, 1])
        self._slots_platen, _ = self.pattern.row_slots(np.array([size - 1]))
        self._numbered = dof.ravel() >= 0

    @property
    def size(self) -> int:
        """Number of equations."""
        return self.pattern.size

    def initial_state(self) -> MechanicalState:
        """Undeformed block at rest, just above the road."""
        n = len(self.mesh.points)
        zeros = np.zeros((n, 2))
        return MechanicalState(
            u=zeros,
            velocity=zeros,
            p=np.zeros(len(self.mesh.cells)),
            status=self._touching(zeros),
            rubber=self.elements.virgin,
        )

    def _touching(self, u: FloatArray) -> ContactStatus:
        """Nodes on the road stick."""
        status = ContactStatus.all_open(self.candidates.size)
        return replace(status, kind=np.where(self.gap(u) <= 0.0, STICK, status.kind))

    def above_road(self, state: MechanicalState) -> MechanicalState:
        """A block that hangs free, lowered as a whole to just above the road, at rest.

        What is nearer to the road than a hundred-thousandth of the height touches it at once: a
        block that has sprung back is even to rounding and to what the last step left.
        """
        gap = self.gap(state.u)
        u = state.u - [0.0, gap.min()]
        near = gap - gap.min() < 1e-5 * self.mesh.height
        status = ContactStatus.all_open(self.candidates.size)
        status = replace(status, kind=np.where(near, STICK, status.kind))
        return replace(state, u=u, velocity=np.zeros_like(u), status=status, self_shear=None)

    def energies(
        self, evaluation: StepEvaluation, velocity: FloatArray, past: Past, rubber: StepEnd
    ) -> StepEnergies:
        """Energies of a solved step, and at its end with the nodal velocities (n, 2) [mm/s]."""
        elements, forces, viscosity = self.elements, evaluation.elements, past.viscosity
        assert forces is not None
        viscous = 0.0
        if viscosity is not None:
            # Kelvin-Voigt dissipation S:(E - E_n)
            S11, S22, S12 = viscosity.stress(forces.kinematics)
            density = (S11**2 + S22**2 + 2.0 * S12**2) / viscosity.rate
            viscous = float(np.sum(elements.weights * density))
        return StepEnergies(
            strain_energy=elements.strain_energy(forces.kinematics, rubber.stored),
            kinetic=0.5 * float(np.sum(self.mass[:, None] * velocity**2)),
            viscous=viscous,
            rubber=elements.integral(rubber.viscous),
            damage=elements.integral(rubber.damage),
        )

    def strains(self, evaluation: StepEvaluation) -> Strains:
        """Deformation of an evaluated iterate."""
        assert evaluation.elements is not None
        kin = evaluation.elements.kinematics
        return Strains(I1=kin.I1, J=kin.J, weights=self.elements.weights)

    def fields(self, state: MechanicalState, T_C: FloatArray) -> CellFields:
        """Stress and stretch of an accepted state."""
        elements, rubber = self.elements, self.material(state, T_C)
        kin = elements.kinematics(state.u)
        softening = rubber.end(kin).softening
        return CellFields(
            cauchy=elements.cauchy(kin, Past(material=rubber)),
            stretch=elements.largest_stretch(kin),
            softening=None if softening is None else elements.mean(softening),
        )

    def bulk_power(self, heat: FloatArray | None, dt: float) -> FloatArray | None:
        """Power of what became heat in the rubber in a step [N/mm^2], by node [mJ/s]."""
        return None if heat is None else self.elements.nodal_integral(heat) / dt

    def material(
        self, state: MechanicalState, T_C: FloatArray | None, dt: float = 0.0
    ) -> MaterialStep:
        """The rubber in a step of length `dt` [s] from an accepted state.

        `T_C` (n,) are the temperatures of that state [C].
        """
        if state.rubber is not None and T_C is not None:
            T_C = T_C[self.mesh.cells].mean(axis=1)[:, None]
        return self.elements.model.step(state.rubber, dt, T_C)

    def step(self, state: MechanicalState, load: StepLoad) -> StepProblem:
        """The nonlinear problem of one step from an accepted state."""
        return StepProblem(self, state, load)

    def gather(self, nodal: FloatArray) -> FloatArray:
        """Sum nodal values (n, 2) into the equations, (size,)."""
        return summed(
            self.equation.ravel()[self._numbered],
            nodal.ravel()[self._numbered],
            self.pattern.size,
        )

    def scatter(self, x: FloatArray) -> FloatArray:
        """Nodal values (n, 2) of an equation vector; zero where prescribed."""
        return np.where(self.equation >= 0, x[self.equation], 0.0)

    def gap(self, u: FloatArray) -> FloatArray:
        """Distance of the candidates from the road, (m,) [mm]."""
        return np.asarray(self.mesh.points[self.candidates, 1] + u[self.candidates, 1])

    def contact_lengths(self, u: FloatArray, active: NDArray[np.bool_]) -> FloatArray:
        """Current contact length of each candidate, (m,) [mm].

        Half of each adjoining edge with both nodes in contact; a lone node has half of all its
        edges' projections on the road.
        """
        mesh, boundary = self.mesh, self.mesh.boundary
        x = mesh.points[boundary, 0] + u[boundary, 0]
        half = np.where(mesh.joined, 0.5 * np.abs(np.diff(x)), 0.0)
        on = np.zeros(boundary.size, dtype=bool)
        on[mesh.is_free] = active
        full = self._at_candidates(np.where(on[:-1] & on[1:], half, 0.0))
        lone = self._at_candidates(half)
        reference = self.boundary.length[mesh.is_free]
        return np.where(full > 0.0, full, np.maximum(lone, 0.1 * reference))

    def _at_candidates(self, halves: FloatArray) -> FloatArray:
        """Sum of what the two edges beside each candidate hold, given by edge of the boundary."""
        beside = np.concatenate([[0.0], halves]) + np.concatenate([halves, [0.0]])
        return np.asarray(beside[self.mesh.is_free])


class StepProblem:
    """Newton problem of one step (see `fem.newton.Problem`)."""

    def __init__(self, system: BlockMechanics, state: MechanicalState, load: StepLoad) -> None:
        self.system, self.state, self.load = system, state, load
        self.past = Past(
            viscosity=_viscosity(system, state, load),
            material=system.material(state, load.T_C, load.dt),
        )
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
            nodal[:, 1] += load.force * system._top_load
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
            merit = max(merit, pairs.mismatch * system.elements.K_bulk / system.tolerance)
            settled = settled and pairs.settled
            if pairs.mismatch > 0.0:
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
        matrix = self._constrained(data, pairs, evaluation.status)
        step = system.solver.solve(matrix, -evaluation.residual)
        held = self._held_equations(evaluation.status)
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

    def _held_equations(self, status: ContactStatus) -> IntArray:
        """Equations of a displacement: gaps (active), slips (sticking), platen (raised)."""
        rows = self.system.equation[self.system.candidates]
        held = np.concatenate([rows[status.active, 1], rows[status.sticking, 0]])
        return held if self.load.raised is None else np.append(held, self.system.size - 1)

    def tangent(self, evaluation: StepEvaluation) -> csc_matrix:
        """Tangent of the residual, with the status asked for by the iterate."""
        data, pairs = self._force_tangents(evaluation)
        return self._constrained(data, pairs, evaluation.status)

    def _force_tangents(self, evaluation: StepEvaluation) -> tuple[FloatArray, FloatArray | None]:
        """Tangents of the nodal forces: matrix data of the block, and of the pairs (np, 6, 6)."""
        system, elements, pairs = self.system, evaluation.elements, self.load.pairs
        assert elements is not None
        data = system.pattern.sum(system.elements.tangent(elements))
        inertia = np.repeat(self.mass / self.load.dt**2, 2)
        equations = system.equation.ravel()
        data[system._diagonal] += np.bincount(
            equations[system._numbered], inertia[system._numbered], minlength=system.pattern.size
        )
        if pairs is None or evaluation.pairs is None or not evaluation.pairs.pressed.any():
            return data, None
        return data, pair_tangents(pairs, evaluation.pairs)

    def _constrained(
        self, data: FloatArray, pairs: FloatArray | None, status: ContactStatus
    ) -> csc_matrix:
        """Matrix of the equations: force tangents with the rows of the contact status."""
        matrix = self.system.pattern.matrix(self._with_contact_rows(data, status))
        if pairs is None:
            return matrix
        return (matrix + self._pair_matrix(pairs, status)).tocsc()

    def _pair_matrix(self, tangents: FloatArray, status: ContactStatus) -> csc_matrix:
        """Tangents of self-contact (np, 6, 6) with the row operations of the road contact."""
        system, pairs = self.system, self.load.pairs
        assert pairs is not None
        pressed = tangents.any(axis=(1, 2))
        K = tangents[pressed]
        equations = system.equation[pairs.nodes[pressed]].reshape(-1, 6)
        row = np.repeat(equations, 6, axis=1).ravel()
        column = np.tile(equations, (1, 6)).ravel()
        kept = (row >= 0) & (column >= 0)
        row, column, value = row[kept], column[kept], K.ravel()[kept]
        rows = system.equation[system.candidates]
        slipping, size = status.slipping, system.pattern.size
        factor, partner = np.zeros(size), np.zeros(size, dtype=np.int64)
        factor[rows[slipping, 1]] = (status.sense * self.load.mu)[slipping]
        partner[rows[slipping, 1]] = rows[slipping, 0]
        free = np.ones(size, dtype=bool)
        free[self._held_equations(status)] = False
        passed = factor[row] != 0.0
        row_to = np.concatenate([row[free[row]], partner[row[passed]]])
        column_to = np.concatenate([column[free[row]], column[passed]])
        value_to = np.concatenate([value[free[row]], (factor[row] * value)[passed]])
        return coo_matrix((value_to, (row_to, column_to)), shape=(size, size)).tocsc()

    def _with_contact_rows(self, data: FloatArray, status: ContactStatus) -> FloatArray:
        """Matrix data with friction rows, stick rows and gap rows."""
        system, owner, data = self.system, self.system._owner, data.copy()
        factor = np.where(status.slipping, status.sense * self.load.mu, 0.0)[owner]
        data[system._slots_x] += factor * data[system._slots_y]
        data[system._slots_x[status.sticking[owner]]] = 0.0
        data[system._slots_y[status.active[owner]]] = 0.0
        if self.load.raised is not None:
            data[system._slots_platen] = 0.0
        data[system._diagonal[self._held_equations(status)]] = system.elements.K_bulk
        return data

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


def _viscosity(system: BlockMechanics, state: MechanicalState, load: StepLoad) -> Viscosity | None:
    """Kelvin-Voigt term of a damped step."""
    if load.damping is None:
        return None
    strain_n = system.elements.kinematics(state.u).green_lagrange
    return Viscosity(rate=load.damping, strain_n=strain_n)


def inadmissible(status: ContactStatus) -> StepEvaluation:
    """Evaluation of an iterate whose energy does not exist."""
    empty = np.zeros(0)
    return StepEvaluation(
        merit=np.inf, settled=False, status=status, nodal=empty, residual=empty, elements=None
    )


def platen_displacement(mesh: BlockMesh, u: FloatArray) -> float:
    """Vertical displacement of the top, mean over its length, positive downwards [mm].

    The force is spread over the length alike, so that its work is force times this displacement.
    """
    return float(-(mesh.top_shares @ u[mesh.top, 1]))
