"""Kelvin-Voigt viscosity that carries the snaps of the leading edge; a regularisation, not physics.

The relaxation time is stated as a sliding distance, so that it acts alike at all velocities. Most
of it sits at the leading corner: there the surface folds in small snaps, which need damping to be
followed with large steps. The bulk has a short relaxation distance, so that the block as a whole
takes up its deformation as it would without. In steady sliding no strain changes and the viscosity
does nothing; its work is audited: `regularisation_share` in the second half of the slide,
`regularisation_share_with_onset` over all of it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fem.case import Case
from fem.mesh import BlockMesh

FloatArray = NDArray[np.float64]


def relaxation_time(case: Case) -> float:
    """Relaxation time of the bulk [s]."""
    return case.solver.viscous_distance_mm / abs(case.loading.velocity_mm_per_s)


def viscosity(case: Case, mesh: BlockMesh) -> FloatArray:
    """Viscosity eta of each element, (ne, 1) [N s/mm^2]; zero if `viscous_distance_mm` is zero.

    ``eta = G (s + s_edge exp(-(r/R)^2)) / v`` with the distance r of the element from the leading
    corner.
    """
    solver = case.solver
    centre = mesh.points[mesh.cells].mean(axis=1)
    r = np.linalg.norm(centre - mesh.points[mesh.bottom[-1]], axis=1)
    edge = solver.edge_viscous_distance_mm * np.exp(-((r / solver.edge_radius_mm) ** 2))
    distance = solver.viscous_distance_mm + edge
    if solver.viscous_distance_mm == 0.0:
        distance = np.zeros_like(distance)
    speed = abs(case.loading.velocity_mm_per_s)
    G = case.rubber.model().initial_shear_modulus
    return np.asarray(G * distance / speed)[:, None]
