"""Multiplicative Maxwell branches: one time step in closed form.

A branch stores ``G/2 (tr(X Ci^-1) - 3)`` with the isochoric ``X = J^(-2/3) C`` and an internal Ci,
``det Ci = 1``, that follows ``dCi/dt = dev(X Ci^-1) Ci/tau`` [1]_. With ``Y = s Ci`` this is
``dY/dt = s X/tau``, ``s = det(Y)^(1/3)``, ``ds/dt = s tr(X Ci^-1)/(3 tau)``. Over a step of reduced
length ``h = dt/(a_T tau)`` X goes straight from X_n to its new value and s grows exponentially at
its first rate ``beta = tr(X_n Ci_n^-1)/3``, which gives

``Ci = unimodular(A)``, ``A = D + k X``, ``D = e^(-x) Ci_n + k_n X_n``, ``x = beta h``,
``k = (1 - phi)/beta``, ``k_n = (phi - e^(-x))/beta``, ``phi = (1 - e^(-x))/x``.

It is second order in time, exact at small strains along straight paths, and positive definite for
any h; replacing the weights by 1, 0, h gives the first-order update of [1]_.

The stress ``G det(A)^(1/3) A^-1 J^(-2/3)`` (and what keeps it isochoric) is the derivative of
``Phi = 3 G/(2 k) det(D + k X)^(1/3)``, so that the tangent is symmetric, and in plane strain
``det(D + k X)`` is a function of ``q = B:C``, B = adj D of the plane, and J.

References
----------
.. [1] Shutov, A. V., Landgraf, R., Ihlemann, J., Comput. Methods Appl. Mech. Eng. 265 (2013)
   213-225.
"""

from typing import NamedTuple

import numpy as np

from materials.arrays import FloatArray

#: Below this reduced step the strain is taken as straight, not exponential, in `dissipated_share`.
_SHORT = 1e-3


def step_weights(h: FloatArray, beta: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Weights of Ci_n, X_n and X in A (see above) for reduced steps h and growth rates beta."""
    x = beta * h
    old = np.exp(-x)
    from scipy.special import exprel  # loaded with the first step, not with every case

    phi = exprel(-x)
    return old, (phi - old) / beta, (1.0 - phi) / beta


def dissipated_share(
    h: FloatArray, before: FloatArray, cross: FloatArray, after: FloatArray
) -> FloatArray:
    """Integral of ``e:e`` over a step of reduced length h, where e relaxes towards a steady value.

    Parameters
    ----------
    before, cross, after : ndarray
        ``e_n:e_n``, ``e_n:e`` and ``e:e`` at the ends of the step. Times G/2 the result is the
        energy dissipated; with e = dev(X Ci^-1) it is never negative.
    """
    bound = np.sqrt(before * after)
    cross = np.clip(cross, -bound, bound)
    short = h < _SHORT
    length = np.where(short, 1.0, h)
    E = np.exp(-length)
    rho = -np.expm1(-length)
    mean = 0.5 * rho * (1.0 + E)
    late = np.where(short, h / 3.0, (length - 2.0 * rho + mean) / rho**2)
    early = np.where(short, h / 3.0, (E * E * length - 2.0 * E * rho + mean) / rho**2)
    mixed = np.where(short, h / 3.0, (2.0 * mean - 2.0 * E * length) / rho**2)
    return np.maximum(late * after + early * before + mixed * cross, 0.0)


class PlaneDrive(NamedTuple):
    """What the branches bring into a step in plane strain, arrays (branches, ...).

    Attributes
    ----------
    B11, B22, B12 : ndarray
        adj D of the plane [-].
    d : ndarray
        Determinant of D of the plane [-].
    D33 : ndarray
        Component of D across the plane [-].
    k : ndarray
        Weight of the new X [-].
    """

    B11: FloatArray
    B22: FloatArray
    B12: FloatArray
    d: FloatArray
    D33: FloatArray
    k: FloatArray


class BranchDerivatives(NamedTuple):
    """Derivatives of Phi by ``q = B:C`` and J [N/mm^2], arrays (branches, ...)."""

    q: FloatArray
    J: FloatArray
    qq: FloatArray
    qJ: FloatArray
    JJ: FloatArray


def plane_drive(X_n: FloatArray, Ci_n: FloatArray, h: FloatArray) -> PlaneDrive:
    """Drive of a step from the isochoric X_n (3, ...) and Ci_n (3, branches, ...).

    Components 11, 22, 12; h (branches, ...) is the reduced length of the step.
    """
    trace, _ = plane_elastic(X_n, Ci_n)
    old, k_n, k = step_weights(h, trace / 3.0)
    D11, D22, D12 = (old * c + k_n * x for c, x in zip(Ci_n, X_n, strict=True))
    D33 = old / _det(Ci_n) + k_n / _det(X_n)
    return PlaneDrive(D22, D11, -D12, D11 * D22 - D12 * D12, D33, k)


def plane_derivatives(
    drive: PlaneDrive, G: FloatArray, C: tuple[FloatArray, ...], J: FloatArray
) -> BranchDerivatives:
    """Derivatives of Phi at C (components 11, 22, 12) and J; G (branches, 1, ...) [N/mm^2]."""
    B11, B22, B12, d, D33, k = drive
    inverse = 1.0 / J
    j = np.cbrt(inverse) ** 2  # J^(-2/3)
    j_J, area = (-2.0 / 3.0) * j * inverse, (j * J) ** 2
    j_JJ, area_J = (-5.0 / 3.0) * j_J * inverse, (2.0 / 3.0) * area * inverse
    area_JJ = (-1.0 / 3.0) * area_J * inverse
    q = B11 * C[0] + B22 * C[1] + 2.0 * B12 * C[2]
    # determinants of A in the plane, n, and across it, A33; slopes without their factor k
    n, A33 = d + k * (j * q + k * area), D33 + k * j
    n_J, n_JJ = j_J * q + k * area_J, j_JJ * q + k * area_JJ
    inverse = 1.0 / (n * A33)
    det_q = j * A33
    det_J = n_J * A33 + n * j_J
    det_qJ = j_J * (A33 + k * j)
    det_JJ = n_JJ * A33 + 2.0 * k * n_J * j_J + n * j_JJ
    slope = 0.5 * G * np.cbrt(n * A33) * inverse
    bend = (-2.0 / 3.0) * k * inverse
    return BranchDerivatives(
        q=slope * det_q,
        J=slope * det_J,
        qq=slope * bend * det_q * det_q,
        qJ=slope * (det_qJ + bend * det_q * det_J),
        JJ=slope * (det_JJ + bend * det_J * det_J),
    )


def plane_stress(drive: PlaneDrive, d: BranchDerivatives) -> tuple[FloatArray, ...]:
    """Second Piola-Kirchhoff stresses ``2 Phi_q B`` of all branches, 11, 22, 12 [N/mm^2].

    The rest of their stress, ``Phi_J cof F``, goes together with that of the elastic energy.
    """
    return tuple(np.sum(2.0 * d.q * B, axis=0) for B in drive[:3])


def plane_stiffness(
    drive: PlaneDrive, d: BranchDerivatives, C: tuple[FloatArray, ...], J: FloatArray
) -> tuple[FloatArray, ...]:
    """Tangent of `plane_stress` and what q and J have in common, by E11, E22, 2 E12 [N/mm^2].

    Entries 11, 22, 33, 12, 13, 23 of a symmetric matrix. The rest, by J alone, is ``Phi_JJ``.
    """
    B = drive[:3]
    bend = [4.0 * d.qq * component for component in B]
    V = [np.sum(2.0 * d.qJ * component, axis=0) for component in B]
    Y = (C[1] / J, C[0] / J, -C[2] / J)  # dJ/dE, J C^-1
    return tuple(
        np.sum(bend[a] * B[b], axis=0) + V[a] * Y[b] + V[b] * Y[a]
        for a, b in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    )


def plane_internal(drive: PlaneDrive, X: FloatArray) -> FloatArray:
    """Ci (3, branches, ...) at the end of the step, for the isochoric X (3, ...) there."""
    A11, A22, A12 = (
        D + drive.k * x for D, x in zip((drive.B22, drive.B11, -drive.B12), X, strict=True)
    )
    A33 = drive.D33 + drive.k / _det(X)
    scale = 1.0 / np.cbrt((A11 * A22 - A12 * A12) * A33)
    return np.stack([A11 * scale, A22 * scale, A12 * scale])


def plane_elastic(X: FloatArray, Ci: FloatArray) -> tuple[FloatArray, tuple[FloatArray, ...]]:
    """Trace of ``M = X Ci^-1`` and its components 11, 12, 21, 22, 33; each (branches, ...)."""
    c11, c22, c12 = Ci
    d = _det(Ci)
    M = (
        (X[0] * c22 - X[2] * c12) / d,
        (X[2] * c11 - X[0] * c12) / d,
        (X[2] * c22 - X[1] * c12) / d,
        (X[1] * c11 - X[2] * c12) / d,
        d / _det(X),
    )
    return M[0] + M[3] + M[4], M


def plane_dissipated(
    X_n: FloatArray, Ci_n: FloatArray, X: FloatArray, Ci: FloatArray, h: FloatArray
) -> FloatArray:
    """Integral of ``tr[dev(X Ci^-1)^2]`` over a step, (branches, ...); see `dissipated_share`."""
    (t_n, M_n), (t, M) = plane_elastic(X_n, Ci_n), plane_elastic(X, Ci)

    def deviatoric(
        a: tuple[FloatArray, ...], b: tuple[FloatArray, ...], traces: FloatArray
    ) -> FloatArray:
        inner = a[0] * b[0] + a[1] * b[2] + a[2] * b[1] + a[3] * b[3] + a[4] * b[4]
        return np.asarray(inner - traces / 3.0)

    before, after = deviatoric(M_n, M_n, t_n * t_n), deviatoric(M, M, t * t)
    return dissipated_share(
        h, np.maximum(before, 0.0), deviatoric(M_n, M, t_n * t), np.maximum(after, 0.0)
    )


def _det(A: FloatArray) -> FloatArray:
    return np.asarray(A[0] * A[1] - A[2] * A[2])
