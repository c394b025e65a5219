"""Table of the free boundary: where it lies, how it touches the road, how warm it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fem.mesh.block import BlockMesh

FloatArray = NDArray[np.float64]

TRAILING_FACE, BOTTOM, LEADING_FACE = "trailing face", "bottom", "leading face"
#: Words for the kinds of `contact.active_set`: OPEN, STICK, SLIP.
STATUS = np.array(["open", "stick", "slip"])


@dataclass(frozen=True, kw_only=True)
class BoundaryContact:
    """Contact of the free boundary nodes with the road, arrays (m,) in the mesh's order.

    Attributes
    ----------
    kind : int array
        0 open, 1 stick, 2 slip, as in `contact.active_set`.
    pressure, shear : float arrays
        Normal and tangential force on the block per contact length [N/mm^2].
    slip_velocity : float array
        Velocity over the road, signed [mm/s].
    """

    kind: NDArray[np.integer]
    pressure: FloatArray
    shear: FloatArray
    slip_velocity: FloatArray


def boundary_table(
    mesh: BlockMesh, u: FloatArray, T_C: FloatArray, contact: BoundaryContact
) -> pd.DataFrame:
    """A row per free boundary node, chain by chain; columns of `fem.results.columns.BOUNDARY`.

    The chains are the trailing face from the platen down, the bottom with both corners, and the
    leading face up to the platen; `s_mm` is the undeformed length along each.

    Parameters
    ----------
    mesh : BlockMesh
        Reference mesh.
    u : (n, 2) float array
        Nodal displacements [mm].
    T_C : (n,) float array
        Nodal temperatures [deg C].
    contact : BoundaryContact
        Of the nodes of `mesh.boundary` without its ends, which the platen holds.
    """
    nodes = mesh.boundary[1:-1]
    faces, corners = len(mesh.rear) - 2, len(mesh.bottom)
    chain = np.repeat([TRAILING_FACE, BOTTOM, LEADING_FACE], [faces, corners, faces])
    X, Y = np.abs(mesh.points[nodes, 0] - mesh.points[mesh.bottom[0], 0]), mesh.points[nodes, 1]
    along = {TRAILING_FACE: mesh.height - Y, BOTTOM: X, LEADING_FACE: Y}
    x = mesh.points[nodes] + u[nodes]
    return pd.DataFrame(
        {
            "block": 1,
            "chain": chain,
            "s_mm": np.select([chain == name for name in along], list(along.values())),
            "X_mm": X,
            "Y_mm": Y,
            "x_mm": x[:, 0],
            "y_mm": x[:, 1],
            "status": STATUS[contact.kind],
            "pressure_N_per_mm2": contact.pressure,
            "shear_N_per_mm2": contact.shear,
            "slip_velocity_mm_per_s": contact.slip_velocity,
            "T_C": T_C[nodes],
        }
    )


def surface_table(boundary: pd.DataFrame) -> pd.DataFrame:
    """The bottom of the boundary, from the trailing to the leading corner."""
    bottom = boundary[boundary["chain"] == BOTTOM].reset_index(drop=True)
    return bottom.drop(columns=["block", "chain", "s_mm", "Y_mm"]).assign(
        in_contact=bottom["status"] != STATUS[0]
    )
