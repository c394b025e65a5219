"""Invariants and Cauchy stress in plane strain (F33 = 1)."""

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import FloatArray


def invariants(F: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Invariants ``I1 = F:F + 1`` and ``J = det F`` [-] of deformation gradients (..., 2, 2)."""
    F = np.asarray(F, dtype=float)
    xx, xy, yx, yy = F[..., 0, 0], F[..., 0, 1], F[..., 1, 0], F[..., 1, 1]
    return xx * xx + xy * xy + yx * yx + yy * yy + 1.0, xx * yy - xy * yx


def cauchy_stress(P: ArrayLike, F: ArrayLike, pressure: ArrayLike = 0.0) -> FloatArray:
    """Cauchy stress [N/mm^2] of an isochoric first Piola-Kirchhoff stress and a mean stress.

    Parameters
    ----------
    P : array_like, shape (..., 2, 2)
        First Piola-Kirchhoff stress of an isochoric energy [N/mm^2].
    F : array_like, shape (..., 2, 2)
        Deformation gradients [-].
    pressure : array_like, shape (...)
        dU/dJ of the volumetric energy [N/mm^2], positive in tension.

    Returns
    -------
    ndarray, shape (..., 4)
        Components xx, yy, zz, xy.

    Notes
    -----
    An isochoric energy gives a deviatoric stress, hence ``sigma_zz = -(sigma_xx + sigma_yy)``
    before the mean stress is added.
    """
    P, F = np.asarray(P, dtype=float), np.asarray(F, dtype=float)
    _, J = invariants(F)
    tau = np.einsum("...ij,...kj->...ik", P, F)
    mean = np.asarray(pressure, dtype=float)
    xx, yy, xy = tau[..., 0, 0] / J, tau[..., 1, 1] / J, tau[..., 0, 1] / J
    return np.stack(np.broadcast_arrays(xx + mean, yy + mean, mean - xx - yy, xy), axis=-1)
