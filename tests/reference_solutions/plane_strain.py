"""Stress and tangent in plane strain as tensors, from the derivatives of an energy by I1 and J.

The elements write these products out by component; here they stand as in textbooks.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import FloatArray
from materials.hyperelastic import Hyperelastic
from materials.material import EnergyDerivatives, InPlane, MaterialStep
from materials.plane_strain import invariants


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


def step_stress(step: MaterialStep, F: ArrayLike) -> FloatArray:
    """Isochoric stress P [N/mm^2] of a material's step at deformation gradients (..., 2, 2)."""
    response = step.respond(deformation_of(F))
    return stress_of(response.energy, F, response.S)


def step_tangent(step: MaterialStep, F: ArrayLike) -> FloatArray:
    """Consistent tangent of `step_stress` [N/mm^2], (..., 2, 2, 2, 2)."""
    deformation = deformation_of(F)
    response = step.respond(deformation)
    D = step.stiffness(deformation, response, slice(None))
    return stiffness_of(response.energy, F, response.S, D)


def _tensor(components: FloatArray) -> FloatArray:
    """Symmetric tensors (..., 2, 2) of their components 11, 22, 12, shape (3, ...)."""
    return np.moveaxis(components[np.array([[0, 2], [2, 1]])], (0, 1), (-2, -1))


def _outer(A: FloatArray, B: FloatArray) -> FloatArray:
    return A[..., :, :, None, None] * B[..., None, None, :, :]
