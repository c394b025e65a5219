"""Share of the frictional power that becomes heat at the rubber's surface.

The pressure in eq. (14) is the mean contact pressure of the event: the paper found one kappa per
test from its nominal pressure (section 3.4), and ABAQUS takes one number per pair of surfaces for
the heat made by friction. Its text agrees: with the mean pressure the front edge becomes the
hottest place, as it describes, while the several N/mm^2 that press on the edge would turn a tenth
of its friction into heat only. The law at the local pressure is kept for comparison.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", eqs. (9) and (14).
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from contact.interface import InterfaceState
from materials.arrays import BoolArray, FloatArray
from materials.checks import (
    require_between,
    require_finite,
    require_not_negative,
    require_positive,
)

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
    pressure : "mean", "local" or float
        What p is: the mean contact pressure, the same for all points; the pressure of each point;
        or a fixed pressure [N/mm^2].

    Examples
    --------
    >>> [round(float(kappa), 3) for kappa in HeatPartition()([0.1, 0.3])]
    [1.0, 0.716]
    """

    prefactor: float = 0.3146
    exponent: float = -0.6833
    cap: float = 1.0
    pressure: Literal["mean", "local"] | float = "mean"

    def __post_init__(self) -> None:
        require_not_negative(prefactor=self.prefactor)
        require_finite(exponent=self.exponent)
        require_between(0.0, 1.0, cap=self.cap)
        if not isinstance(self.pressure, str):
            require_positive(pressure=self.pressure)
        elif self.pressure not in ("mean", "local"):
            raise ValueError(f'pressure = {self.pressure!r}; expected "mean", "local" or a number')

    def __call__(self, p: ArrayLike) -> FloatArray:
        """Partition kappa [-] at the pressure p [N/mm^2]."""
        return np.minimum(self.uncapped(p), self.cap)

    def at(self, state: InterfaceState) -> FloatArray:
        """Partition kappa [-] at a state of the interface."""
        return self(self.governing(state))

    def capped(self, state: InterfaceState) -> BoolArray:
        """Where the cap holds."""
        return self.uncapped(self.governing(state)) > self.cap

    def governing(self, state: InterfaceState) -> FloatArray:
        """Pressure that enters the law at points of a contact [N/mm^2]."""
        p = np.asarray(state.p, dtype=float)
        if self.pressure == "local":
            return p
        mean = state.mean_pressure if self.pressure == "mean" else float(self.pressure)
        return np.broadcast_to(np.asarray(mean, dtype=float), p.shape)

    def uncapped(self, p: ArrayLike) -> FloatArray:
        """Partition of eq. (14) without the cap [-]; huge, not infinite, at zero pressure."""
        return (
            self.prefactor * np.maximum(np.asarray(p, dtype=float), _NO_PRESSURE) ** self.exponent
        )
