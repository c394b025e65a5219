"""Ogden's energy.

In plane strain the principal stretches are ``lam1, lam2, 1``. With ``c = (I1 - 1)/(2 J)``, which is
``cosh 2h`` for ``lam1, lam2 = J^(1/2) exp(+-h)``,

``lam1^alpha + lam2^alpha = 2 J^(alpha/2) cosh(alpha h) = 2 J^(alpha/2) T_nu(c)``, ``nu = alpha/2``

with Chebyshev's function T_nu. It is analytic at c = 1, so equal stretches are a point like any
other: near it the derivatives come from the power series, elsewhere from h and Chebyshev's
equation ``(c^2 - 1) T'' + c T' = nu^2 T``.

References
----------
.. [1] Ogden, R. W., Proc. R. Soc. Lond. A 326 (1972) 565-584.
.. [2] Abramowitz, M., Stegun, I. A., Handbook of Mathematical Functions (1964), 15.1.17, 22.6.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import FloatArray
from materials.checks import require_finite, require_positive
from materials.hyperelastic_base import (
    MODES,
    TRANSVERSE,
    EnergyDerivatives,
    Hyperelastic,
    Mode,
    checked_stretch,
)

#: The series in z = c - 1 is used up to z = 0.1 and nu^2 z = 0.5, where its terms fall by ten each.
_SERIES_END = 0.1
_SERIES_TERMS = 16


@dataclass(frozen=True, kw_only=True)
class Ogden(Hyperelastic):
    """Energy ``W = sum_i 2 mu_i/alpha_i^2 (lam1^alpha_i + lam2^alpha_i + lam3^alpha_i - 3)`` [1]_.

    The stretches are the isochoric ones, ``lam J^(-1/3)``.

    Parameters
    ----------
    mu : tuple of float
        Moduli [N/mm^2]; their sum is the shear modulus and must be positive.
    alpha : tuple of float
        Exponents [-], not zero.

    Examples
    --------
    >>> Ogden(mu=(0.6, 0.1), alpha=(2.0, -2.0)).initial_shear_modulus
    0.7
    """

    mu: tuple[float, ...]
    alpha: tuple[float, ...]

    def __post_init__(self) -> None:
        if len(self.mu) != len(self.alpha) or not self.mu:
            raise ValueError(
                f"mu has {len(self.mu)} and alpha {len(self.alpha)} entries; "
                "expected as many of each, and one at least"
            )
        for i, (mu, alpha) in enumerate(zip(self.mu, self.alpha, strict=True), 1):
            require_finite(**{f"mu{i}": mu, f"alpha{i}": alpha})
            if alpha == 0.0:
                raise ValueError(f"alpha{i} is 0; expected another number")
        require_positive(**{"the sum of mu": float(sum(self.mu))})

    @property
    def initial_shear_modulus(self) -> float:
        return float(sum(self.mu))

    def derivatives(self, I1: ArrayLike, J: ArrayLike) -> EnergyDerivatives:
        """Isochoric energy and its derivatives (see `Hyperelastic.derivatives`)."""
        I1, J = np.asarray(I1, dtype=float), np.asarray(J, dtype=float)
        with np.errstate(all="ignore"):
            terms = [_term(mu, alpha, I1, J) for mu, alpha in zip(self.mu, self.alpha, strict=True)]
            return EnergyDerivatives(*(np.sum(parts, axis=0) for parts in zip(*terms, strict=True)))

    def nominal_stress(self, stretch: ArrayLike, mode: Mode = "uniaxial") -> FloatArray:
        """Nominal stress [N/mm^2] of a homogeneous test (see `Hyperelastic.nominal_stress`)."""
        lam, t = checked_stretch(stretch), _transverse(mode)
        P = np.zeros_like(lam)
        for mu, alpha in zip(self.mu, self.alpha, strict=True):
            P = P + 2.0 * mu / alpha * (lam ** (alpha - 1.0) - lam ** (-t * alpha - 1.0))
        return P

    def strain_energy(self, stretch: ArrayLike, mode: Mode = "uniaxial") -> FloatArray:
        """Energy per volume [N/mm^2] of a homogeneous test (see `Hyperelastic.strain_energy`)."""
        lam, t = checked_stretch(stretch), _transverse(mode)
        W = np.zeros_like(lam)
        for mu, alpha in zip(self.mu, self.alpha, strict=True):
            powers = lam**alpha + lam ** (-t * alpha) + lam ** ((t - 1.0) * alpha)
            W = W + 2.0 * mu / alpha**2 * (powers - 3.0)
        return W

    def log_derivatives(self, e1: FloatArray, e2: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Gradient and Hessian of W in two logarithmic stretches (see `Hyperelastic`)."""
        gradient = np.zeros((e1.size, 2))
        hessian = np.zeros((e1.size, 2, 2))
        for mu, alpha in zip(self.mu, self.alpha, strict=True):
            first, second = np.exp(alpha * e1), np.exp(alpha * e2)
            third = np.exp(-alpha * (e1 + e2))
            slope = 2.0 * mu / alpha
            gradient += slope * np.stack([first - third, second - third], axis=1)
            bend = 2.0 * mu
            hessian[:, 0, 0] += bend * (first + third)
            hessian[:, 1, 1] += bend * (second + third)
            hessian[:, 0, 1] += bend * third
        hessian[:, 1, 0] = hessian[:, 0, 1]
        return gradient, hessian


def _transverse(mode: str) -> float:
    """Exponent t of the transverse stretch lam^-t; the third is lam^(t-1)."""
    if mode not in TRANSVERSE:
        raise ValueError(f"mode is {mode!r}; expected one of {', '.join(MODES)}")
    return TRANSVERSE[mode]


def _term(mu: float, alpha: float, I1: FloatArray, J: FloatArray) -> EnergyDerivatives:
    """One term ``k (2 A T(c) + B - 3)``, ``A = J^(alpha/6)``, ``B = J^(-alpha/3)``."""
    inverse = 1.0 / J
    c_1 = 0.5 * inverse
    c = (I1 - 1.0) * c_1
    T, T_c, T_cc = chebyshev(0.5 * alpha, c)
    c_J = -c * inverse
    a, b = alpha / 6.0, -alpha / 3.0
    k = 2.0 * mu / alpha**2
    A, B = 2.0 * k * J**a, k * J**b
    A_J, B_J = a * A * inverse, b * B * inverse
    return EnergyDerivatives(
        W=A * T + B - 3.0 * k,
        W_1=A * T_c * c_1,
        W_J=A_J * T + A * T_c * c_J + B_J,
        W_11=A * T_cc * c_1**2,
        W_1J=(A_J * T_c + A * T_cc * c_J - A * T_c * inverse) * c_1,
        W_JJ=(a - 1.0) * inverse * A_J * T
        + 2.0 * A_J * T_c * c_J
        + A * (T_cc * c_J**2 - 2.0 * T_c * c_J * inverse)
        + (b - 1.0) * inverse * B_J,
    )


def chebyshev(nu: float, c: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    """``T_nu(c) = cosh(nu arcosh c)`` with its first and second derivative, for c >= 1 [2]_.

    Rounding may put c below 1 by its last digit; the function is smooth there.
    """
    c = np.asarray(c, dtype=float)
    z = c - 1.0
    near = z < min(_SERIES_END, 0.5 / max(nu * nu, 1e-300))
    T, T_c, T_cc = _series(nu, np.where(near, z, 0.0))
    if np.all(near):
        return T, T_c, T_cc
    away = np.where(near, 2.0, c)
    two_h = np.arccosh(away)
    far = np.cosh(nu * two_h)
    far_c = nu * np.sinh(nu * two_h) / np.sinh(two_h)
    far_cc = (nu * nu * far - away * far_c) / (away * away - 1.0)
    return np.where(near, T, far), np.where(near, T_c, far_c), np.where(near, T_cc, far_cc)


def _series(nu: float, z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Power series of T_nu about c = 1 and its derivatives, by Horner's scheme."""
    weights = [1.0]
    for k in range(_SERIES_TERMS):
        weights.append(weights[-1] * (nu * nu - k * k) / ((2.0 * k + 1.0) * (k + 1.0)))
    T, T_c, T_cc = np.zeros_like(z), np.zeros_like(z), np.zeros_like(z)
    for k in range(_SERIES_TERMS, -1, -1):
        T = T * z + weights[k]
        if k >= 1:
            T_c = T_c * z + k * weights[k]
        if k >= 2:
            T_cc = T_cc * z + k * (k - 1) * weights[k]
    return T, T_c, T_cc
