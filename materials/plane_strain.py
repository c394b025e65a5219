"""Stress and its tangent from an isochoric energy in plane strain (F33 = 1)."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from materials.hyperelastic import Hyperelastic

Array = NDArray[np.float64]


def invariants(F: ArrayLike) -> tuple[Array, Array]:
    """Invariants ``I1 = F:F + 1`` and ``J = det F`` [-] of deformation gradients (..., 2, 2)."""
    F = np.asarray(F, dtype=float)
    xx, xy, yx, yy = F[..., 0, 0], F[..., 0, 1], F[..., 1, 0], F[..., 1, 1]
    return xx * xx + xy * xy + yx * yx + yy * yy + 1.0, xx * yy - xy * yx


def cofactor(F: ArrayLike) -> Array:
    """Cofactor ``dJ/dF = J F^-T`` of deformation gradients (..., 2, 2)."""
    F = np.asarray(F, dtype=float)
    C = np.empty_like(F)
    C[..., 0, 0], C[..., 1, 1] = F[..., 1, 1], F[..., 0, 0]
    C[..., 0, 1], C[..., 1, 0] = -F[..., 1, 0], -F[..., 0, 1]
    return C


def first_piola_kirchhoff(model: Hyperelastic, F: ArrayLike) -> Array:
    """Isochoric first Piola-Kirchhoff stress ``P = 2 W_1 F + W_J cof F`` [N/mm^2], (..., 2, 2)."""
    F = np.asarray(F, dtype=float)
    W = model.derivatives(*invariants(F))
    return 2.0 * W.W_1[..., None, None] * F + W.W_J[..., None, None] * cofactor(F)


def dP_dF(model: Hyperelastic, F: ArrayLike) -> Array:
    """Tangent of the isochoric stress [N/mm^2].

    Parameters
    ----------
    model : Hyperelastic
    F : array_like, shape (..., 2, 2)
        Deformation gradients [-].

    Returns
    -------
    ndarray, shape (..., 2, 2, 2, 2)
        ``A[i, j, k, l] = dP_ij / dF_kl``.
    """
    F = np.asarray(F, dtype=float)
    W = model.derivatives(*invariants(F))
    D1, DJ = 2.0 * F, cofactor(F)
    mixed = _outer(D1, DJ)
    A = W.W_11[..., None, None, None, None] * _outer(D1, D1)
    A += W.W_1J[..., None, None, None, None] * (mixed + np.einsum("...ijkl->...klij", mixed))
    A += W.W_JJ[..., None, None, None, None] * _outer(DJ, DJ)
    A += 2.0 * W.W_1[..., None, None, None, None] * np.einsum("ik,jl->ijkl", np.eye(2), np.eye(2))
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    A += W.W_J[..., None, None, None, None] * np.einsum("ik,jl->ijkl", turn, turn)
    return A


def cauchy_stress(model: Hyperelastic, F: ArrayLike, pressure: ArrayLike = 0.0) -> Array:
    """Cauchy stress [N/mm^2] of the isochoric energy and a mean stress.

    Parameters
    ----------
    model : Hyperelastic
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
    F = np.asarray(F, dtype=float)
    _, J = invariants(F)
    P = first_piola_kirchhoff(model, F)
    tau = np.einsum("...ij,...kj->...ik", P, F)
    mean = np.asarray(pressure, dtype=float)
    xx, yy, xy = tau[..., 0, 0] / J, tau[..., 1, 1] / J, tau[..., 0, 1] / J
    return np.stack(np.broadcast_arrays(xx + mean, yy + mean, mean - xx - yy, xy), axis=-1)


def _outer(A: Array, B: Array) -> Array:
    return A[..., :, :, None, None] * B[..., None, None, :, :]
