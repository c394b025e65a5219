"""Share of the frictional power that becomes heat at the rubber's surface.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", eqs. (9) and (14).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from materials.checks import require_between, require_finite, require_not_negative

Array = NDArray[np.float64]

# Keeps 0 * infinity out of the law without touching any pressure that a contact can have.
_NO_PRESSURE = 1e-100


@dataclass(frozen=True, kw_only=True)
class HeatPartition:
    """Power law ``kappa = min(cap, prefactor p^exponent)``, eq. (14).

    Parameters
    ----------
    prefactor : float
        Partition at p = 1 N/mm^2 [-].
    exponent : float
        Exponent of the pressure [-].
    cap : float
        Largest partition [-], from 0 to 1: the fitted law exceeds 1 below 0.184 N/mm^2, which
        would create energy.
    """

    prefactor: float = 0.3146
    exponent: float = -0.6833
    cap: float = 1.0

    def __post_init__(self) -> None:
        require_not_negative(prefactor=self.prefactor)
        require_finite(exponent=self.exponent)
        require_between(0.0, 1.0, cap=self.cap)

    def __call__(self, p: ArrayLike) -> Array:
        """Partition kappa [-] at the pressure p [N/mm^2]."""
        return np.minimum(self.uncapped(p), self.cap)

    def uncapped(self, p: ArrayLike) -> Array:
        """Partition of eq. (14) without the cap [-]; huge, not infinite, at zero pressure."""
        return (
            self.prefactor * np.maximum(np.asarray(p, dtype=float), _NO_PRESSURE) ** self.exponent
        )
