"""What wears off the block's surface, step by step; its shape stays as it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact.wear import EnergyWear
from fem.mesh import BlockMesh
from materials.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class Wear:
    """Wear since the start.

    Attributes
    ----------
    energy : (m,) float array
        Friction work of the candidates per undeformed area [mJ/mm^2].
    depth : (m,) float array
        Depth that wore off [mm].
    """

    energy: FloatArray
    depth: FloatArray

    @classmethod
    def none(cls, mesh: BlockMesh) -> Wear:
        """Of a new block."""
        zeros = np.zeros(mesh.candidates.size)
        return cls(energy=zeros, depth=zeros)


def worn(wear: Wear, power: FloatArray, dt: float, law: EnergyWear, length: FloatArray) -> Wear:
    """Wear after one more step.

    Parameters
    ----------
    wear : Wear
        Before the step.
    power : (m,) float array
        Frictional power of the candidates, mean over the step [mJ/s].
    dt : float
        Its length [s].
    law : EnergyWear
        Depth per time by the friction power.
    length : (m,) float array
        Undeformed length of surface of each candidate [mm].
    """
    density = np.maximum(power, 0.0) / length
    return Wear(energy=wear.energy + density * dt, depth=wear.depth + law.depth_rate(density) * dt)
