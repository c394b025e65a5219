"""Volumetric energy ``U(J) = K/2 (J - 1)^2`` of the mean dilatation."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def volumetric_energy(J: ArrayLike, K_bulk: float) -> Array:
    """Energy U per reference volume [N/mm^2] at the volume ratio J [-], bulk modulus [N/mm^2]."""
    return 0.5 * K_bulk * (np.asarray(J, dtype=float) - 1.0) ** 2


def volumetric_stress(J: ArrayLike, K_bulk: float) -> Array:
    """Mean stress ``dU/dJ = K (J - 1)`` [N/mm^2], positive in tension."""
    return K_bulk * (np.asarray(J, dtype=float) - 1.0)


def volumetric_stiffness(J: ArrayLike, K_bulk: float) -> Array:
    """Second derivative ``d2U/dJ2 = K`` [N/mm^2]."""
    return np.full(np.shape(J), float(K_bulk))
