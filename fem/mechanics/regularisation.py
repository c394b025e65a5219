"""Damping of the snaps of the leading edge; a regularisation, not physics.

Under high friction the leading edge rolls under in snaps: at a limit point no equilibrium is near,
and the edge jumps to the next one. A step without a solution is solved again with a Kelvin-Voigt
stress ``S = eta (E - E_n)/dt`` that carries the jump; its strength, the *level*, rises with each
failure and fades with each accepted step until nothing of it is left (`fem.stepping.step_control`).
Steps that have a solution see none of it, so that the onset of sliding is the elastic one; those of
the onset that have none are relaxed afterwards (`fem.stepping.relaxation`).

The relaxation time is stated as a sliding distance, so that the damping acts alike at all
velocities; most of it sits at the leading corners, where the surface folds. Too much of it holds an
edge back while the block slides on, which leads to another of its equilibria; too little lets steps
become small. The default weighs both (`make convergence` goes to a hundredth of it). What it
dissipates is audited: `snap_share` in the steps that had no solution without,
`regularisation_share` in those through which it fades.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from fem.case.case import Case
from fem.mesh.block import BlockMesh

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class SnapDamping:
    """Damping of each element at level 1.

    Attributes
    ----------
    strength : (ne, 1) float array
        Modulus times relaxation distance ``G (s + s_edge exp(-(r/R)^2))`` [N/mm], with the
        distance r of the element from the nearest leading corner.
    """

    strength: FloatArray

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
    """Damping of a case; None where it has none or its rubber damps the snaps itself."""
    damping = SnapDamping.from_case(case, mesh)
    return damping if damping.strength.any() else None
