"""The mechanics of a deformable block."""

from dataclasses import replace

import numpy as np

from contact.active_set import STICK, ContactStatus
from fem.mechanics.account import CellFields, StepEnergies, Strains
from fem.mechanics.elements import Past
from fem.mechanics.equations import BlockEquations
from fem.mechanics.iterate import StepEvaluation, StepLoad
from fem.mechanics.state import MechanicalState
from fem.mechanics.step import StepProblem
from fem.mesh import BlockMesh
from materials.arrays import BoolArray, FloatArray
from materials.material import MaterialStep, StepEnd


class BlockMechanics(BlockEquations):
    """A block of rubber between platen and road: its states, steps, energies and fields.

    Parameters are those of `BlockEquations`.
    """

    deforms = True
    #: Weight of the forces at the start of a step in their mean over it: the trapezoidal rule.
    start_weight = 0.5

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
        return StepProblem(self, state, load, self.material(state, load.T_C, load.dt))

    def contact_lengths(self, u: FloatArray, active: BoolArray) -> FloatArray:
        """Current contact length of each candidate, (m,) [mm].

        Half of each adjoining edge with both nodes in contact; a lone node has half of all its
        edges' projections on the road.
        """
        mesh, boundary = self.mesh, self.mesh.boundary
        x = mesh.points[boundary, 0] + u[boundary, 0]
        half = np.where(mesh.joined, 0.5 * np.abs(np.diff(x)), 0.0)
        on = np.zeros(boundary.size, dtype=bool)
        on[mesh.is_free] = active
        full = mesh.at_candidates(np.where(on[:-1] & on[1:], half, 0.0))
        lone = mesh.at_candidates(half)
        reference = self.boundary.length[mesh.is_free]
        return np.where(full > 0.0, full, np.maximum(lone, 0.1 * reference))


def platen_displacement(mesh: BlockMesh, u: FloatArray) -> float:
    """Vertical displacement of the top, mean over its length, positive downwards [mm].

    The force is spread over the length alike, so that its work is force times this displacement.
    """
    return float(-(mesh.top_shares @ u[mesh.top, 1]))
