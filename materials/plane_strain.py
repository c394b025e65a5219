"""Stress and its tangent from an isochoric energy in plane strain (F33 = 1)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import FloatArray
from materials.hyperelastic import Hyperelastic
from materials.material import EnergyDerivatives, InPlane


def invariants(F: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Invariants ``I1 = F:F + 1`` and ``J = det F`` [-] of deformation gradients (..., 2, 2)."""
    F = np.asarray(F, dtype=float)
    xx, xy, yx, yy = F[..., 0, 0], F[..., 0, 1], F[..., 1, 0], F[..., 1, 1]
    return xx * xx + xy * xy + yx * yx + yy * yy + 1.0, xx * yy - xy * yx


def cofactor(F: ArrayLike) -> FloatArray:
    """Cofactor ``dJ/dF = J F^-T`` of deformation gradients (..., 2, 2)."""
    F = np.asarray(F, dtype=float)
    C = np.empty_like(F)
    C[..., 0, 0], C[..., 1, 1] = F[..., 1, 1], F[..., 0, 0]
    C[..., 0, 1], C[..., 1, 0] = -F[..., 1, 0], -F[..., 0, 1]
    return C


class PlaneDeformation(NamedTuple):
    """Deformation as a material sees it (`materials.material.Deformation`)."""

    C: InPlane
    I1: FloatArray
    J: FloatArray


def deformation_of(F: ArrayLike) -> PlaneDeformation:
    """``C = F^T F``, I1 and J of deformation gradients (..., 2, 2)."""
    F = np.asarray(F, dtype=float)
    C = np.einsum("...ki,...kj->...ij", F, F)
    return PlaneDeformation(InPlane(C[..., 0, 0], C[..., 1, 1], C[..., 0, 1]), *invariants(F))


def first_piola_kirchhoff(model: Hyperelastic, F: ArrayLike) -> FloatArray:
    """Isochoric first Piola-Kirchhoff stress ``P = 2 W_1 F + W_J cof F`` [N/mm^2], (..., 2, 2)."""
    return stress_of(model.derivatives(*invariants(F)), F)


def dP_dF(model: Hyperelastic, F: ArrayLike) -> FloatArray:
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
    return stiffness_of(model.derivatives(*invariants(F)), F)


def stress_of(W: EnergyDerivatives, F: ArrayLike, S: ArrayLike | None = None) -> FloatArray:
    """``P = F (2 W_1 I + S) + W_J cof F`` [N/mm^2], (..., 2, 2).

    `S` (3, ...), components 11, 22, 12, are second Piola-Kirchhoff stresses besides.
    """
    F = np.asarray(F, dtype=float)
    P = 2.0 * W.W_1[..., None, None] * F + W.W_J[..., None, None] * cofactor(F)
    return P if S is None else P + F @ _tensor(np.asarray(S))


def stiffness_of(
    W: EnergyDerivatives, F: ArrayLike, S: ArrayLike | None = None, D: ArrayLike | None = None
) -> FloatArray:
    """Tangent dP/dF of `stress_of`, (..., 2, 2, 2, 2).

    `D` (6, ...) is the symmetric tangent of S by the strains E11, E22, 2 E12: entries 11, 22, 33,
    12, 13, 23.
    """
    F = np.asarray(F, dtype=float)
    D1, DJ = 2.0 * F, cofactor(F)
    mixed = _outer(D1, DJ)
    A = W.W_11[..., None, None, None, None] * _outer(D1, D1)
    A += W.W_1J[..., None, None, None, None] * (mixed + np.einsum("...ijkl->...klij", mixed))
    A += W.W_JJ[..., None, None, None, None] * _outer(DJ, DJ)
    A += 2.0 * W.W_1[..., None, None, None, None] * np.einsum("ik,jl->ijkl", np.eye(2), np.eye(2))
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    A += W.W_J[..., None, None, None, None] * np.einsum("ik,jl->ijkl", turn, turn)
    if S is not None:
        A += np.einsum("ik,...jl->...ijkl", np.eye(2), _tensor(np.asarray(S)))
    if D is not None:
        D11, D22, D33, D12, D13, D23 = np.asarray(D)
        rows = np.stack([[D11, D12, D13], [D12, D22, D23], [D13, D23, D33]])
        moduli = _tensor(np.stack([_tensor(row) for row in rows]))  # the symmetric D_mjnl
        A += np.einsum("...im,...mjnl,...kn->...ijkl", F, moduli, F)
    return A


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


def _tensor(components: FloatArray) -> FloatArray:
    """Symmetric tensors (..., 2, 2) of their components 11, 22, 12, shape (3, ...)."""
    return np.moveaxis(components[np.array([[0, 2], [2, 1]])], (0, 1), (-2, -1))


def _outer(A: FloatArray, B: FloatArray) -> FloatArray:
    return A[..., :, :, None, None] * B[..., None, None, :, :]
