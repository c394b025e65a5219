"""Table of the free boundary: where it lies, how it touches the road, how warm it is."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fem.mesh import BlockMesh
from materials.arrays import FloatArray

#: What the names of the chains on the road begin with.
BOTTOM = "bottom"
#: Words for the kinds of `contact.active_set`: OPEN, STICK, SLIP.
STATUS = np.array(["open", "stick", "slip"])


@dataclass(frozen=True, kw_only=True)
class BoundaryContact:
    """Contact of the free boundary nodes with the road, arrays (m,) in the order of the candidates.

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

    The chains of a plain block are the trailing face from the platen down, the bottom with both
    corners, and the leading face up to the platen; `s_mm` is the undeformed length along each.

    Parameters
    ----------
    mesh : BlockMesh
        Reference mesh.
    u : (n, 2) float array
        Nodal displacements [mm].
    T_C : (n,) float array
        Nodal temperatures [deg C].
    contact : BoundaryContact
        Of the candidates of the mesh.
    """
    nodes, chains = mesh.candidates, mesh.chains
    counts = [chain.nodes.size for chain in chains]
    x = mesh.points[nodes] + u[nodes]
    return pd.DataFrame(
        {
            "block": np.repeat([chain.block for chain in chains], counts),
            "chain": np.repeat([chain.name for chain in chains], counts),
            "s_mm": np.concatenate([chain.s for chain in chains]),
            "X_mm": mesh.from_trailing(nodes),
            "Y_mm": mesh.points[nodes, 1],
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
    """The bottoms of the boundary, from the trailing to the leading corner."""
    bottom = boundary[boundary["chain"].str.startswith(BOTTOM)].reset_index(drop=True)
    return bottom.drop(columns=["block", "chain", "s_mm", "Y_mm"]).assign(
        in_contact=bottom["status"] != STATUS[0]
    )
