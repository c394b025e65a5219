"""Softening of rubber by its largest load so far (Mullins effect), as a pseudo-elastic law.

References
----------
.. [1] Ogden, R. W., Roxburgh, D. G., Proc. R. Soc. Lond. A 455 (1999) 2861-2877; with the term
   ``beta W_max`` the three-parameter form in use in finite-element programs.
.. [2] Lake, G. J., Thomas, A. G., Proc. R. Soc. Lond. A 300 (1967) 108-119.
"""

from dataclasses import dataclass

import numpy as np

from materials.arrays import FloatArray
from materials.checks import require_finite, require_not_negative, require_positive
from materials.hyperelastic_base import EnergyDerivatives

_ROOT_PI = float(np.sqrt(np.pi))


@dataclass(frozen=True, kw_only=True)
class OgdenRoxburgh:
    """Softening of the elastic isochoric stress by a factor eta [1]_.

    ``eta = 1 - erf[(W_max - W)/(m + beta W_max)]/r``, where W is the energy of the elastic law and
    W_max its largest value so far.

    The free energy is what unloading gives back (`recoverable`), so that growing W_max dissipates
    ``-d(recoverable)/dW_max`` (`consumed`). All of it is heat: a chain that breaks or lets go of a
    filler particle was stretched bond by bond and loses the energy of all its bonds, of which the
    one that stays broken keeps only one in a hundred [2]_.

    Parameters
    ----------
    r : float
        Largest softening, ``eta >= 1 - 1/r`` [-], at least 1.
    m : float
        Energy below the maximum over which the softening acts [N/mm^2].
    beta : float
        Share of the maximum that is added to it [-].

    Examples
    --------
    >>> eta, slope = OgdenRoxburgh(r=2.0, m=0.3, beta=0.1).factor(np.array([1.0, 0.0]), 1.0)
    >>> float(eta[0]), round(float(eta[1]), 4)
    (1.0, 0.5002)
    """

    r: float
    m: float
    beta: float = 0.0

    def __post_init__(self) -> None:
        require_finite(r=self.r)
        if self.r < 1.0:
            raise ValueError(f"r is {self.r:g}; expected a number from 1 on")
        require_positive(m=self.m)
        require_not_negative(beta=self.beta)

    def factor(self, W: FloatArray, W_max: FloatArray) -> tuple[FloatArray, FloatArray]:
        """eta and its derivative by W at fixed W_max; 1 and 0 where W is the maximum.

        Parameters
        ----------
        W, W_max : ndarray
            Energy and its largest value before [N/mm^2].
        """
        width = self.m + self.beta * W_max
        z = np.maximum(W_max - W, 0.0) / width
        slope = np.where(W_max > W, 2.0 / (_ROOT_PI * self.r * width) * np.exp(-z * z), 0.0)
        return 1.0 - _erf(z) / self.r, slope

    def softened(self, energy: EnergyDerivatives, W_max: FloatArray) -> EnergyDerivatives:
        """Derivatives of the softened energy, whose stress is eta times the elastic one.

        ``W`` of the result is the energy that unloading gives back (`recoverable`).
        """
        eta, slope = self.factor(energy.W, W_max)
        return EnergyDerivatives(
            W=self.recoverable(energy.W, np.maximum(energy.W, W_max)),
            W_1=eta * energy.W_1,
            W_J=eta * energy.W_J,
            W_11=eta * energy.W_11 + slope * energy.W_1 * energy.W_1,
            W_1J=eta * energy.W_1J + slope * energy.W_1 * energy.W_J,
            W_JJ=eta * energy.W_JJ + slope * energy.W_J * energy.W_J,
        )

    def recoverable(self, W: FloatArray, W_max: FloatArray) -> FloatArray:
        """Energy that unloading from W gives back, the integral of eta from 0 to W [N/mm^2]."""
        width = self.m + self.beta * W_max
        lost = _erf_integral(W_max / width) - _erf_integral((W_max - W) / width)
        return W - width / self.r * lost

    def consumed(self, W_max: FloatArray) -> FloatArray:
        """Energy that damage has consumed once W_max was reached [N/mm^2]; grows with it."""
        return W_max - self.recoverable(W_max, W_max)


def _erf_integral(z: FloatArray) -> FloatArray:
    """Integral of the error function from 0 to z, plus ``pi^(-1/2)``."""
    return np.asarray(z * _erf(z) + np.exp(-z * z) / _ROOT_PI)


def _erf(z: FloatArray) -> FloatArray:
    from scipy.special import erf  # loaded with the first step, not with every case

    return np.asarray(erf(z))
