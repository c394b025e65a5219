"""Mechanics of a block that does not deform, with the face of `fem.mechanics.block`.

The pressure is the same along the whole bottom, which slips as the platen moves, and sticks without
friction where it stands. The forces of a step jump to their values at its start. Heat, friction
and tables are those of a deformable block, with a load that conduction columns can follow: a check
of the heat, and a fast estimate of T_max.
"""

from __future__ import annotations

from copy import copy
from dataclasses import replace

import numpy as np

from contact.active_set import OPEN, SLIP, STICK, ContactForces, ContactStatus
from contact.self_contact import Pairs
from fem.mechanics.account import CellFields, StepEnergies, Strains
from fem.mechanics.elements import NO_PAST, Past
from fem.mechanics.iterate import Iterate, StepEvaluation, StepLoad
from fem.mechanics.state import MechanicalState
from fem.mesh import BlockMesh
from fem.solvers import LinearSolver, SuperLUSolver
from materials.arrays import BoolArray, FloatArray
from materials.material import StepEnd


class RigidMechanics:
    """A rigid block between platen and road; see `fem.mechanics.block.BlockMechanics`."""

    deforms = False
    #: Weight of the forces at the start of a step in their mean over it.
    start_weight = 0.0
    #: Number of equations.
    size = 0

    def __init__(self, mesh: BlockMesh) -> None:
        self.mesh, self.candidates = mesh, mesh.candidates
        self.solver: LinearSolver = SuperLUSolver()
        self.lengths = np.zeros(self.candidates.size)
        self.lengths[mesh.on_bottom] = mesh.bottom_lengths

    def initial_state(self) -> MechanicalState:
        """Block at rest above the road."""
        zeros = np.zeros_like(self.mesh.points)
        return MechanicalState(
            u=zeros,
            velocity=zeros,
            p=np.zeros(len(self.mesh.cells)),
            status=ContactStatus.all_open(self.candidates.size),
        )

    def above_road(self, state: MechanicalState) -> MechanicalState:
        """The block as it comes down again."""
        return self.initial_state()

    def step(self, state: MechanicalState, load: StepLoad) -> RigidProblem:
        """The problem of one step, which is solved as it stands."""
        return RigidProblem(self, state, load)

    def contact_lengths(self, u: FloatArray, active: BoolArray) -> FloatArray:
        """Length of bottom that each candidate stands for, (m,) [mm]; 1 of those on faces."""
        return np.where(self.lengths > 0.0, self.lengths, 1.0)

    def energies(
        self, evaluation: StepEvaluation, velocity: FloatArray, past: Past, rubber: StepEnd
    ) -> StepEnergies:
        """None: the work of the platen is the friction work."""
        return StepEnergies()

    def strains(self, evaluation: StepEvaluation) -> Strains:
        """Of an undeformed point."""
        one = np.ones(1)
        return Strains(I1=3.0 * one, J=one, weights=one)

    def fields(self, state: MechanicalState, T_C: FloatArray) -> CellFields:
        """No stress of its own, no stretch."""
        cells = len(self.mesh.cells)
        return CellFields(cauchy=np.zeros((cells, 4)), stretch=np.ones(cells))

    def bulk_power(self, heat: FloatArray | None, dt: float) -> None:
        """No heat from deformation."""


class RigidProblem:
    """One step of a rigid block (see `fem.mechanics.step.StepProblem`)."""

    past = NO_PAST

    def __init__(self, system: RigidMechanics, state: MechanicalState, load: StepLoad) -> None:
        self.system, self.state, self.load = system, state, load

    def again(self, mu: FloatArray, pairs: Pairs | None) -> RigidProblem:
        """The same step with other friction coefficients."""
        other = copy(self)
        other.load = replace(self.load, mu=mu)
        return other

    def start(self) -> Iterate:
        """The solution."""
        kind, sense = OPEN, float(np.sign(self.load.sweep))
        if self.load.force > 0.0 and self.load.raised is None:
            kind = SLIP if sense else STICK
        on = self.system.mesh.on_bottom
        status = replace(
            self.state.status,
            kind=np.where(on, kind, OPEN),
            sense=np.full(on.size, sense or 1.0),
        )
        return Iterate(u=self.state.u, p=self.state.p, status=status)

    def evaluate(self, x: Iterate) -> StepEvaluation:
        """Nodal forces at the bottom and the top."""
        mesh, status = self.system.mesh, x.status
        share = self.system.lengths / self.system.lengths.sum()
        normal = np.where(status.active, self.load.force * share, 0.0)
        nodal = np.zeros_like(mesh.points)
        nodal[self.system.candidates, 1] = normal
        shear = np.where(status.slipping, -status.sense * self.load.mu * normal, 0.0)
        nodal[self.system.candidates, 0] = shear
        nodal[mesh.top, 0] = -shear.sum() * mesh.top_shares
        return StepEvaluation(
            merit=0.0, settled=True, status=status, nodal=nodal, residual=np.zeros(0), elements=None
        )

    def contact_forces(self, u: FloatArray, nodal: FloatArray) -> ContactForces:
        """Gaps, reactions and slips of the candidates."""
        nodes = self.system.candidates
        slip = np.full(nodes.size, self.load.sweep)
        gap = self.system.mesh.points[nodes, 1]
        return ContactForces(gap=gap, normal=nodal[nodes, 1], tangential=nodal[nodes, 0], slip=slip)

    def rubber_end(self, evaluation: StepEvaluation) -> StepEnd:
        """Nothing to remember."""
        return StepEnd(stored=np.zeros(0))

    def end(
        self, x: Iterate, rubber: StepEnd, self_shear: FloatArray | None = None
    ) -> MechanicalState:
        """State at the end of the step."""
        velocity = np.zeros_like(x.u)
        velocity[:, 0] = self.load.sweep / self.load.dt
        return MechanicalState(u=x.u, velocity=velocity, p=x.p, status=x.status)

    def direction(self, x: Iterate, evaluation: StepEvaluation) -> Iterate:
        """Never asked for."""
        raise ArithmeticError("a rigid step has no direction")

    def step_limit(self, x: Iterate, direction: Iterate) -> float:
        """Never asked for."""
        return 1.0

    def moved(
        self, x: Iterate, evaluation: StepEvaluation, direction: Iterate, alpha: float
    ) -> Iterate:
        """Never asked for."""
        return x
