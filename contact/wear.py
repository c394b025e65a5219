"""Wear of the rubber's surface by the energy of friction.

References
----------
.. [1] Cenek, P. et al., tyre abrasion on dry road per friction energy (1997), tabulated in
   Meesters, J. and Quik, J., LEON-T deliverable D3.4, RIVM (2023): 1.6e-3 to 9.9e-3 mm^3/J for
   14 car tyres, median 2.15e-3.
.. [2] Persson, B. N. J. and Xu, R., J. Chem. Phys. 162 (2025) 074704: wear in proportion to the
   load, whatever the speed.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import FloatArray
from materials.checks import require_not_negative, require_positive


@dataclass(frozen=True, kw_only=True)
class EnergyWear:
    """Depth that wears off per time, ``k w (w/w_ref)^(n - 1)``, of the friction power ``w``.

    The shape of the block stays as it is: a slide of 0.1 m wears off about 0.1 micrometre.

    Parameters
    ----------
    coefficient : float
        k [mm^3/J]; 0 is no wear. Tyres: see [1]_.
    power_exponent : float
        n [-]; with 1 a given energy wears off the same however fast it comes [2]_.
    reference_power : float
        w_ref, the power at which k holds whatever n is [W/mm^2].

    Examples
    --------
    0.27 N/mm^2 of shear at 300 mm/s, 0.4 s long, and tyre rubber:

    >>> from contact.wear import EnergyWear
    >>> wear = EnergyWear(coefficient=2.15e-3)
    >>> round(float(wear.depth_rate(0.27 * 300.0)) * 0.4 * 1e3, 4)  # micrometre
    0.0697
    """

    coefficient: float = 0.0
    power_exponent: float = 1.0
    reference_power: float = 0.1

    def __post_init__(self) -> None:
        require_not_negative(coefficient=self.coefficient)
        require_positive(power_exponent=self.power_exponent, reference_power=self.reference_power)

    def depth_rate(self, power: ArrayLike) -> FloatArray:
        """Depth per time [mm/s] at the friction power [mJ/(mm^2 s)] of points (broadcast)."""
        w = np.maximum(np.asarray(power, dtype=float), 0.0)
        w_ref = 1e3 * self.reference_power
        return 1e-3 * self.coefficient * w_ref * (w / w_ref) ** self.power_exponent
