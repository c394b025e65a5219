"""Isochoric strain energies of rubber.

In plane strain (F33 = 1) every energy of the two isochoric invariants is a function of
``I1 = F:F + 1`` and ``J = det F`` alone, because ``I2 = J^2 + I1 - 1``. With
``I1b = J^(-2/3) I1`` and ``I2b = J^(-4/3) I2`` all models here have the form ``W = w(s)`` with one
mixed invariant ``s = c1 I1b + c2 I2b``; a model states its ``c1, c2`` and ``w, w', w''``, and the
chain rule is written once.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", eqs. (1)-(4).
.. [2] Kilian, H.-G., Polymer 22 (1981) 209-217 (van der Waals network).
.. [3] Arruda, E. M., Boyce, M. C., J. Mech. Phys. Solids 41 (1993) 389-412.
"""

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import BoolArray, FloatArray
from materials.checks import require_between, require_finite, require_positive
from materials.hyperelastic_base import (
    MODES,
    EnergyDerivatives,
    Hyperelastic,
    Mode,
    checked_stretch,
)

__all__ = [
    "MODES",
    "ArrudaBoyce",
    "EnergyDerivatives",
    "Hyperelastic",
    "MixedInvariantEnergy",
    "MooneyRivlin",
    "NeoHooke",
    "VanDerWaals",
    "Yeoh",
    "incompressible_kinematics",
]


# Below this value of s - 3 the curvature term of the van der Waals energy contributes less than
# 1e-7 G to dP/dF (its limit at the undeformed state is zero) but would amplify rounding.
_UNDEFORMED = 1e-14


@dataclass(frozen=True, kw_only=True)
class MixedInvariantEnergy(Hyperelastic):
    """Base of the isochoric energies ``W = w(s)``, ``s = c1 I1b + c2 I2b``."""

    @property
    @abstractmethod
    def mixture(self) -> tuple[float, float]:
        """Weights ``(c1, c2)`` of the two isochoric invariants in the mixed invariant s [-]."""

    @abstractmethod
    def energy(self, s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Energy ``w(s)`` [N/mm^2] with its first and second derivative with respect to s."""

    def derivatives(self, I1: ArrayLike, J: ArrayLike) -> EnergyDerivatives:
        """Isochoric energy and its derivatives (see `Hyperelastic.derivatives`).

        Notes
        -----
        s is linear in I1, so ``s_11 = 0`` and four products suffice. This is the inner loop of
        the Newton assembly: only one cube root and one division per point.
        """
        I1, J = np.asarray(I1, dtype=float), np.asarray(J, dtype=float)
        with np.errstate(all="ignore"):
            s, s_1, s_J, s_1J, s_JJ = self._mixed_invariant(I1, J)
            W, w1, w2 = self.energy(s)
            bend = w2 * s_1
            return EnergyDerivatives(
                W=W,
                W_1=w1 * s_1,
                W_J=w1 * s_J,
                W_11=bend * s_1,
                W_1J=bend * s_J + w1 * s_1J,
                W_JJ=w2 * (s_J * s_J) + w1 * s_JJ,
            )

    def _mixed_invariant(self, I1: FloatArray, J: FloatArray) -> tuple[FloatArray, ...]:
        """s and its derivatives ``s_1, s_J, s_1J, s_JJ`` (s_11 is zero)."""
        c1, c2 = self.mixture
        inverse = 1.0 / J
        cube = np.cbrt(inverse)
        s_1 = c1 * (cube * cube)
        s = s_1 * I1
        slope = inverse * (-2.0 / 3.0)
        s_1J = s_1 * slope
        s_J = s * slope
        s_JJ = s_J * inverse * (-5.0 / 3.0)
        if c2 == 0.0:
            return s, s_1, s_J, s_1J, s_JJ
        # I2b = (I1 - 1) J^(-4/3) + J^(2/3)
        fourth = c2 * (cube * inverse)
        part = fourth * (I1 - 1.0)
        s_1 = s_1 + fourth
        s = s + part + fourth * (J * J)
        s_1J = s_1J + 2.0 * slope * fourth
        part_J = 2.0 * slope * part
        s_J = s_J + part_J + (2.0 / 3.0) * J * fourth
        s_JJ = s_JJ - (7.0 / 3.0) * inverse * part_J - (2.0 / 9.0) * fourth
        return s, s_1, s_J, s_1J, s_JJ

    def nominal_stress(self, stretch: ArrayLike, mode: Mode = "uniaxial") -> FloatArray:
        """Nominal stress [N/mm^2] of a homogeneous test (see `Hyperelastic.nominal_stress`)."""
        I1b, I2b, k1, k2 = incompressible_kinematics(checked_stretch(stretch), mode)
        c1, c2 = self.mixture
        with np.errstate(all="ignore"):
            _, slope, _ = self.energy(c1 * I1b + c2 * I2b)
        return slope * (c1 * k1 + c2 * k2)

    def strain_energy(self, stretch: ArrayLike, mode: Mode = "uniaxial") -> FloatArray:
        """Energy per volume [N/mm^2] of a homogeneous test (see `Hyperelastic.strain_energy`)."""
        I1b, I2b, _, _ = incompressible_kinematics(checked_stretch(stretch), mode)
        c1, c2 = self.mixture
        with np.errstate(all="ignore"):
            return self.energy(c1 * I1b + c2 * I2b)[0]

    def log_derivatives(self, e1: FloatArray, e2: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Gradient and Hessian of W in two logarithmic stretches (see `Hyperelastic`)."""
        c1, c2 = self.mixture
        e = np.stack([e1, e2, -e1 - e2])
        squares, inverse = np.exp(2.0 * e), np.exp(-2.0 * e)
        s = c1 * squares.sum(axis=0) + c2 * inverse.sum(axis=0)
        slopes = 2.0 * (c1 * squares - c2 * inverse)
        bends = 4.0 * (c1 * squares + c2 * inverse)
        with np.errstate(all="ignore"):
            _, w1, w2 = self.energy(s)
        s_i = np.stack([slopes[0] - slopes[2], slopes[1] - slopes[2]], axis=1)
        s_ij = np.empty((e1.size, 2, 2))
        s_ij[:, 0, 0], s_ij[:, 1, 1] = bends[0] + bends[2], bends[1] + bends[2]
        s_ij[:, 0, 1] = s_ij[:, 1, 0] = bends[2]
        w1, w2 = np.broadcast_to(w1, s.shape), np.broadcast_to(w2, s.shape)
        gradient = w1[:, None] * s_i
        hessian = w2[:, None, None] * s_i[:, :, None] * s_i[:, None, :] + w1[:, None, None] * s_ij
        return gradient, hessian


def incompressible_kinematics(
    lam: FloatArray, mode: str
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Invariants and stress factors of the homogeneous incompressible tests.

    Parameters
    ----------
    lam : ndarray
        Stretch in the loading direction [-].
    mode : {"uniaxial", "equibiaxial", "planar"}

    Returns
    -------
    I1b, I2b, k1, k2 : ndarray
        Invariants and the factors in ``P = k1 dW/dI1b + k2 dW/dI2b``.
    """
    if mode == "uniaxial":
        k1 = 2.0 * (lam - 1.0 / lam**2)
        return lam**2 + 2.0 / lam, 2.0 * lam + 1.0 / lam**2, k1, k1 / lam
    if mode == "equibiaxial":
        k1 = 2.0 * (lam - 1.0 / lam**5)
        return 2.0 * lam**2 + 1.0 / lam**4, lam**4 + 2.0 / lam**2, k1, k1 * lam**2
    if mode == "planar":
        k1 = 2.0 * (lam - 1.0 / lam**3)
        I1b = lam**2 + 1.0 + 1.0 / lam**2
        return I1b, I1b, k1, k1
    raise ValueError(f"mode is {mode!r}; expected one of {', '.join(MODES)}")


@dataclass(frozen=True, kw_only=True)
class NeoHooke(MixedInvariantEnergy):
    """Neo-Hookean energy ``W = G/2 (I1b - 3)``.

    Parameters
    ----------
    G : float
        Shear modulus [N/mm^2].

    Examples
    --------
    >>> NeoHooke(G=0.8).initial_shear_modulus
    0.8
    """

    G: float

    def __post_init__(self) -> None:
        require_positive(G=self.G)

    @property
    def mixture(self) -> tuple[float, float]:
        return 1.0, 0.0

    @property
    def initial_shear_modulus(self) -> float:
        return self.G

    def energy(self, s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        half = np.full_like(s, 0.5 * self.G)
        return half * (s - 3.0), half, np.zeros_like(s)


@dataclass(frozen=True, kw_only=True)
class MooneyRivlin(MixedInvariantEnergy):
    """Mooney-Rivlin energy ``W = C10 (I1b - 3) + C01 (I2b - 3)``, eq. (1).

    Parameters
    ----------
    C10, C01 : float
        Constants [N/mm^2]; their sum is half the shear modulus and must be positive.

    Examples
    --------
    >>> round(MooneyRivlin(C10=0.4, C01=0.1).initial_shear_modulus, 9)
    1.0
    """

    C10: float
    C01: float

    def __post_init__(self) -> None:
        require_finite(C10=self.C10, C01=self.C01)
        require_positive(**{"C10 + C01": self.C10 + self.C01})

    @property
    def mixture(self) -> tuple[float, float]:
        return self.C10, self.C01

    @property
    def initial_shear_modulus(self) -> float:
        return 2.0 * (self.C10 + self.C01)

    def energy(self, s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        return s - 3.0 * (self.C10 + self.C01), np.ones_like(s), np.zeros_like(s)


@dataclass(frozen=True, kw_only=True)
class Yeoh(MixedInvariantEnergy):
    """Yeoh energy ``W = C10 x + C20 x^2 + C30 x^3`` with ``x = I1b - 3``, eq. (2).

    Parameters
    ----------
    C10, C20, C30 : float
        Constants [N/mm^2]; C10 is half the shear modulus and must be positive.

    Notes
    -----
    A negative C30 (Table 1, "bars, series 1, load") lets the energy lose ellipticity at large I1b.

    Examples
    --------
    >>> model = Yeoh(C10=0.38, C20=0.02, C30=0.001)
    >>> round(float(model.nominal_stress(1.5, "uniaxial")), 4)
    0.8536
    """

    C10: float
    C20: float = 0.0
    C30: float = 0.0

    def __post_init__(self) -> None:
        require_positive(C10=self.C10)
        require_finite(C20=self.C20, C30=self.C30)

    @property
    def mixture(self) -> tuple[float, float]:
        return 1.0, 0.0

    @property
    def initial_shear_modulus(self) -> float:
        return 2.0 * self.C10

    def energy(self, s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        x = s - 3.0
        cubic = self.C30 * x
        W = x * (self.C10 + x * (self.C20 + cubic))
        slope = self.C10 + x * (2.0 * self.C20 + 3.0 * cubic)
        return W, slope, 2.0 * self.C20 + 6.0 * cubic


@dataclass(frozen=True, kw_only=True)
class VanDerWaals(MixedInvariantEnergy):
    """Van der Waals energy of a real network, eqs. (3)-(4) [2]_.

    ``W = G { -(lambda_m^2 - 3) [ln(1 - eta) + eta] - (2 a/3) ((s - 3)/2)^(3/2) }`` with
    ``s = (1 - beta) I1b + beta I2b`` and ``eta = sqrt((s - 3)/(lambda_m^2 - 3))``.

    Parameters
    ----------
    G : float
        Initial shear modulus [N/mm^2].
    lambda_m : float
        Locking stretch [-], above sqrt(3).
    a : float
        Global interaction parameter [-].
    beta : float
        Weight of the second invariant [-], from 0 to 1.

    Notes
    -----
    w'' is singular like (s - 3)^(-1/2) at the undeformed state, while its factors in dP/dF vanish
    like s - 3. The product tends to zero, so w'' is set to zero there. Beyond eta = 1 the energy
    does not exist and the values are NaN (see `admissible`).

    Examples
    --------
    >>> model = VanDerWaals(G=0.6, lambda_m=4.95, a=0.68)
    >>> round(float(model.nominal_stress(2.0, "planar")), 4)
    0.8515
    """

    G: float
    lambda_m: float
    a: float
    beta: float = 0.0

    def __post_init__(self) -> None:
        require_positive(G=self.G)
        require_finite(lambda_m=self.lambda_m, a=self.a)
        if self.lambda_m <= 0.0 or self.lambda_m**2 <= 3.0:
            raise ValueError(
                f"lambda_m is {self.lambda_m:g}; expected a locking stretch above sqrt(3) = 1.732"
            )
        require_between(0.0, 1.0, beta=self.beta)

    @property
    def mixture(self) -> tuple[float, float]:
        return 1.0 - self.beta, self.beta

    @property
    def initial_shear_modulus(self) -> float:
        return self.G

    def _below_locking(self, I1: FloatArray, J: FloatArray) -> BoolArray:
        return self._mixed_invariant(I1, J)[0] < self.lambda_m**2

    def energy(self, s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        G, limit = self.G, self.lambda_m**2 - 3.0
        x = np.maximum(s - 3.0, 0.0)
        root = np.sqrt(x)
        eta = root * limit**-0.5
        gap = np.where(eta < 1.0, 1.0 - eta, np.nan)
        inverse = 1.0 / gap
        attraction = self.a * 2.0**-1.5
        W = -G * (limit * (np.log(gap) + eta) + (2.0 / 3.0) * attraction * (x * root))
        w1 = G * (0.5 * inverse - attraction * root)
        curved = x > _UNDEFORMED
        bend = inverse * inverse * (0.5 * limit**-0.5) - attraction
        w2 = np.where(curved, 0.5 * G * bend / np.where(curved, root, 1.0), 0.0)
        return W, w1, w2


# Coefficients of the five-term expansion of the inverse Langevin function, as in [3].
_ARRUDA_BOYCE = (1 / 2, 1 / 20, 11 / 1050, 19 / 7000, 519 / 673750)


@dataclass(frozen=True, kw_only=True)
class ArrudaBoyce(MixedInvariantEnergy):
    """Eight-chain energy in its five-term expansion [3]_.

    ``W = C1 sum_i c_i lambda_m^(2 - 2 i) (I1b^i - 3^i)``

    Parameters
    ----------
    C1 : float
        Rubbery modulus [N/mm^2].
    lambda_m : float
        Limiting chain stretch [-], above 1.

    Examples
    --------
    >>> round(ArrudaBoyce(C1=0.25, lambda_m=3.0).initial_shear_modulus, 4)
    0.2686
    """

    C1: float
    lambda_m: float

    def __post_init__(self) -> None:
        require_positive(C1=self.C1)
        require_finite(lambda_m=self.lambda_m)
        if self.lambda_m <= 1.0:
            raise ValueError(f"lambda_m is {self.lambda_m:g}; expected a stretch above 1")

    @property
    def mixture(self) -> tuple[float, float]:
        return 1.0, 0.0

    @property
    def initial_shear_modulus(self) -> float:
        return float(2.0 * self.energy(np.array(3.0))[1])

    def energy(self, s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        q = self.lambda_m**-2
        weights = [self.C1 * c * q**i for i, c in enumerate(_ARRUDA_BOYCE)]
        W = np.zeros_like(s)
        w1 = np.zeros_like(s)
        w2 = np.zeros_like(s)
        for i in range(len(weights), 0, -1):  # Horner's scheme
            weight = weights[i - 1]
            W = W * s + weight
            w1 = w1 * s + i * weight
            if i > 1:
                w2 = w2 * s + i * (i - 1) * weight
        return W * s - sum(w * 3.0**i for i, w in enumerate(weights, 1)), w1, w2
