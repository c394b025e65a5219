"""Time-temperature shift of Williams, Landel and Ferry.

References
----------
.. [1] Williams, M. L., Landel, R. F., Ferry, J. D., J. Am. Chem. Soc. 77 (1955) 3701-3707.
.. [2] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", eqs. (7)-(8), Table 3.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import FloatArray
from materials.checks import require_positive


@dataclass(frozen=True, kw_only=True)
class WLF:
    """WLF shift ``log10 a_T = -d1 (T - T_ref)/(d2 + T - T_ref)``.

    Parameters
    ----------
    d1 : float
        First constant [-] (decades).
    d2_K : float
        Second constant [K].

    Notes
    -----
    The sign in eq. (8) of [2]_ can be read either way; the physics cannot. States with the same
    reduced velocity ``v a_T(T)`` are equivalent, and a_T falls with temperature, so a *hotter*
    surface acts like a *slower* one: 10 K above the reference multiply the velocity by 0.15.

    Examples
    --------
    >>> round(float(WLF().equivalent_velocity(300.0, 30.0, 20.0)), 1)  # 10 K warmer: as if slower
    44.4
    """

    d1: float = 43.1
    d2_K: float = 509.4

    def __post_init__(self) -> None:
        require_positive(d1=self.d1, d2_K=self.d2_K)

    def log10_shift_factor(self, T_C: ArrayLike, T_ref_C: float) -> FloatArray:
        """Decadic logarithm of the shift factor a_T [-] at T_C with respect to T_ref_C [deg C]."""
        dT, shifted = self._distance(T_C, T_ref_C)
        return -self.d1 * dT / shifted

    def equivalent_velocity(self, v: ArrayLike, T_C: ArrayLike, T_ref_C: float) -> FloatArray:
        """Velocity at T_ref_C that is equivalent to v at T_C, ``v a_T(T)/a_T(T_ref)``.

        Parameters
        ----------
        v : array_like
            Sliding velocity [mm/s].
        T_C, T_ref_C : array_like, float
            Temperature of the surface and reference temperature [deg C].
        """
        return np.asarray(v, dtype=float) * 10.0 ** self.log10_shift_factor(T_C, T_ref_C)

    def rebased(self, T_old_C: float, T_new_C: float) -> "WLF":
        """Constants of the same shift for another reference temperature.

        ``d2' = d2 + T_new - T_old`` and ``d1' = d1 d2/d2'`` (d1 d2 is invariant).
        """
        d2 = self.d2_K + T_new_C - T_old_C
        if d2 <= 0.0:
            raise ValueError(
                f"reference temperature {T_new_C:g} C lies at or below the pole "
                f"{T_old_C - self.d2_K:g} C of the WLF shift; expected a higher one"
            )
        return WLF(d1=self.d1 * self.d2_K / d2, d2_K=d2)

    def _distance(self, T_C: ArrayLike, T_ref_C: float) -> tuple[FloatArray, FloatArray]:
        dT = np.asarray(T_C, dtype=float) - T_ref_C
        shifted = self.d2_K + dT
        if np.any(shifted <= 0.0):
            raise ValueError(
                f"temperature {np.min(dT) + T_ref_C:g} C lies at or below the pole "
                f"{T_ref_C - self.d2_K:g} C of the WLF shift; expected a higher one"
            )
        return dT, shifted
