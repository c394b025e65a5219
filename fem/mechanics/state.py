"""Accepted mechanical state of the block."""

from dataclasses import dataclass

from contact.active_set import ContactStatus
from materials.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class MechanicalState:
    """Accepted mechanical state, in the platen's frame.

    Attributes
    ----------
    u : (n, 2) float array
        Nodal displacements [mm].
    velocity : (n, 2) float array
        Absolute nodal velocities [mm/s].
    p : (ne,) float array
        Element pressures dU/dJ, positive in tension [N/mm^2].
    status : ContactStatus
        Status of the contact candidates.
    self_shear : (mb,) float array or None
        Tangential forces of self-contact by boundary node [N/mm]; None where there is none.
    self_normal : (mb,) float array or None
        Normal forces of self-contact on each boundary node, those of nodes that press on its
        segments included [N/mm]; None where there is none.
    rubber : (k, ne, 4) float array or None
        State variables of the rubber at the Gauss points; None of rubber without a memory.
    lost : (ne,) float array or None
        Energy per reference volume that its viscosity has dissipated, mean of each element
        [mJ/mm^3]; None without viscosity.
    """

    u: FloatArray
    velocity: FloatArray
    p: FloatArray
    status: ContactStatus
    self_shear: FloatArray | None = None
    self_normal: FloatArray | None = None
    rubber: FloatArray | None = None
    lost: FloatArray | None = None
