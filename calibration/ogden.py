"""Ogden's energy for incompressible homogeneous tests (fits only, no finite elements).

References
----------
.. [1] Ogden, R. W., Proc. R. Soc. Lond. A 326 (1972) 565-584.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from materials.checks import require_finite

Array = NDArray[np.float64]

#: Exponent t of the transverse stretch lam^-t by mode.
TRANSVERSE = {"uniaxial": 0.5, "equibiaxial": 2.0, "planar": 1.0}


@dataclass(frozen=True, kw_only=True)
class Ogden:
    """Energy ``W = sum_i 2 mu_i/alpha_i^2 (lam1^alpha_i + lam2^alpha_i + lam3^alpha_i - 3)``.

    Parameters
    ----------
    mu : tuple of float
        Moduli [N/mm^2]; their sum is the shear modulus.
    alpha : tuple of float
        Exponents [-], not zero.
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

    @property
    def initial_shear_modulus(self) -> float:
        """Shear modulus of the undeformed state [N/mm^2]."""
        return float(sum(self.mu))

    def nominal_stress(self, stretch: ArrayLike, mode: str = "uniaxial") -> Array:
        """Nominal stress [N/mm^2] at stretches [-] in a homogeneous test of the given mode."""
        if mode not in TRANSVERSE:
            raise ValueError(f"mode is {mode!r}; expected one of {', '.join(TRANSVERSE)}")
        lam, t = np.asarray(stretch, dtype=float), TRANSVERSE[mode]
        P = np.zeros_like(lam)
        for mu, alpha in zip(self.mu, self.alpha, strict=True):
            P = P + 2.0 * mu / alpha * (lam ** (alpha - 1.0) - lam ** (-t * alpha - 1.0))
        return P

    def log_derivatives(self, e1: Array, e2: Array) -> tuple[Array, Array]:
        """Gradient (n, 2) and Hessian (n, 2, 2) of W in the logarithmic stretches e1, e2.

        The third stretch follows from incompressibility, ``e3 = -e1 - e2``.
        """
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
