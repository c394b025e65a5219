"""Radiation of grey surfaces to surroundings at the ambient temperature."""

import numpy as np

from materials.arrays import BoolArray, FloatArray, IntArray
from materials.units import ABSOLUTE_ZERO_C, STEFAN_BOLTZMANN


def radiated_flux(T_C: FloatArray, ambient_C: float, emissivity: float) -> FloatArray:
    """Net heat flux of a convex grey surface to large surroundings [N/(mm s)].

    Parameters
    ----------
    T_C : float array
        Surface temperature [C].
    ambient_C : float
        Temperature of the surroundings [C].
    emissivity : float
        Emissivity [-].
    """
    T, T_a = T_C - ABSOLUTE_ZERO_C, ambient_C - ABSOLUTE_ZERO_C
    return np.asarray(emissivity * STEFAN_BOLTZMANN * (T**4 - T_a**4))


def radiating_length(positions: FloatArray, edges: IntArray, covered: BoolArray) -> FloatArray:
    """Free surface that each node stands for, (n,) [mm]; nodes in contact do not radiate.

    Parameters
    ----------
    positions : (n, 2) float array
        Deformed nodal positions [mm].
    edges : (m, 2) int array
        Edges of the free boundary.
    covered : (n,) bool array
        Nodes in contact with the road or with the block itself.
    """
    length = np.linalg.norm(positions[edges[:, 1]] - positions[edges[:, 0]], axis=1)
    halves = np.repeat(0.5 * length, 2)
    total = np.bincount(edges.ravel(), weights=halves, minlength=len(positions))
    return np.where(covered, 0.0, total)
