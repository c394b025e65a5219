"""Damping of the snaps of the leading edge; a regularisation, not physics.

Under high friction the leading edge rolls under in snaps: at a limit point no equilibrium is near,
and the edge jumps to the next one. A step without a solution is solved again with a Kelvin-Voigt
stress ``S = eta (E - E_n)/dt`` that carries the jump; its strength, the *level*, rises with each
failure (`fem.stepping.step_control`). The step is then relaxed until nothing of it is left
(`fem.stepping.relaxation`). Steps that have a solution see none of it.

The relaxation time is stated as a sliding distance, so that the damping acts alike at all
velocities; most of it sits at the leading corners, where the surface folds. With too little of it
steps become small (`make convergence` goes to a hundredth of it). What it dissipates is audited:
`snap_share` in the steps that had no solution without, `regularisation_share` in others.

Viscoelastic rubber that loses enough at the rate of the snaps carries them itself: it gets none but
where no step length has a solution (the sudden lift of a block that slides may have none).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import cKDTree

from fem.case import Case
from fem.mesh import BlockMesh
from materials.arrays import FloatArray

#: Loss modulus at the rate of the snaps, over the slow shear modulus, from which on the rubber
#: needs no help. 8 mm of the introductory example on the coarse mesh without help: with 0.27 and
#: more they are gone through, the energy is balanced to 0.02 %; with 0.1 in ten times the steps and
#: to 1.7 %; of five spectra with less three do not get there.
ENOUGH_LOSS = 0.2


@dataclass(frozen=True, kw_only=True)
class SnapDamping:
    """Damping of each element at level 1.

    Attributes
    ----------
    strength : (ne, 1) float array
        Modulus times relaxation distance ``G (s + s_edge exp(-(r/R)^2))`` [N/mm], with the
        distance r of the element from the nearest leading corner.
    last_resort : bool
        Whether it acts only where no step length has a solution without.
    """

    strength: FloatArray
    last_resort: bool = False

    @classmethod
    def from_case(cls, case: Case, mesh: BlockMesh) -> SnapDamping:
        """Damping of a case; zero where its relaxation distances are."""
        solver = case.solver
        centre = mesh.points[mesh.cells].mean(axis=1)
        r = cKDTree(mesh.points[mesh.leading_corners]).query(centre)[0]
        edge = solver.edge_viscous_distance_mm * np.exp(-((r / solver.edge_radius_mm) ** 2))
        G = case.rubber.model().initial_shear_modulus
        return cls(strength=G * (solver.viscous_distance_mm + edge)[:, None])

    def rate(self, level: float, motion: float) -> FloatArray | None:
        """Stress per strain increment eta/dt, (ne, 1) [N/mm^2], over a motion [mm]; None without.

        Parameters
        ----------
        level : float
            Multiple of the damping [-].
        motion : float
            Distance that the step goes on [mm].
        """
        if level == 0.0 or not self.strength.any():
            return None
        return level / motion * self.strength


def snap_damping(case: Case, mesh: BlockMesh) -> SnapDamping | None:
    """Damping of a case, a last resort where its rubber damps the snaps itself; None without."""
    choice = case.solver.snap_damping
    if choice == "never":
        return None
    own = choice == "auto" and rubber_loss(case) >= ENOUGH_LOSS
    damping = replace(SnapDamping.from_case(case, mesh), last_resort=own)
    return damping if damping.strength.any() else None


def rubber_loss(case: Case) -> float:
    """Loss modulus of the rubber's branches at the rate of the snaps, over the slow modulus [-]."""
    viscoelastic = case.rubber.viscoelastic
    if viscoelastic is None:
        return 0.0
    spectrum = viscoelastic.prony()
    shift = float(spectrum.shift_factor(case.heat.ambient_C))
    loss = spectrum.harmonic_moduli(shift / snap_time(case))[1]
    return float(loss) / spectrum.slow_share


def snap_time(case: Case) -> float:
    """Time in which a shear wave crosses the fold of the leading edge [s]."""
    G, density = case.rubber.material().initial_shear_modulus, case.rubber.thermal.density
    return case.solver.edge_radius_mm / float(np.sqrt(G / density))


def damping_lines(case: Case) -> list[str]:
    """Line for the log of a run whose rubber has branches: whether they damp the snaps."""
    if case.rubber.viscoelastic is None:
        return []
    found = (
        f"its loss modulus is {rubber_loss(case):.3g} slow shear moduli "
        f"at the {1e3 * snap_time(case):.3g} ms of the edge's snaps"
    )
    if case.solver.snap_damping != "auto":
        return [f'the rubber: {found}; snap_damping = "{case.solver.snap_damping}"']
    if rubber_loss(case) >= ENOUGH_LOSS:
        return [f"no artificial damping: the rubber damps the snaps itself, {found}"]
    return [
        f"artificial damping: the rubber does not damp the snaps, {found} (enough: {ENOUGH_LOSS:g})"
    ]
