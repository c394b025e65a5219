"""What the interface of rubber and road knows, for the laws of friction, heat and conductance."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True, kw_only=True)
class InterfaceState:
    """State of points of the interface, numbers or arrays that broadcast.

    Attributes
    ----------
    p : array_like
        Contact pressure [N/mm^2].
    v : array_like
        Sliding velocity [mm/s].
    T_C, T_road_C : array_like
        Surface temperature of the rubber and of the road below [deg C]; NaN where not known.
    mean_pressure : array_like
        Mean pressure of the contact [N/mm^2]; NaN where not known.
    slip : array_like
        Way slid over the road since touch-down [mm]; NaN where not known.
    T_before_C : array_like
        Surface temperature of the rubber at touch-down [deg C]; NaN where not known.

    Examples
    --------
    >>> from contact import GapConductance, HeatPartition, InterfaceState
    >>> state = InterfaceState(p=[0.1, 5.0], v=300.0, mean_pressure=0.3)
    >>> HeatPartition().at(state).round(3)  # at the mean pressure
    array([0.716, 0.716])
    >>> GapConductance().at(state).round()
    array([  570., 22525.])
    """

    p: ArrayLike
    v: ArrayLike = 0.0
    T_C: ArrayLike = np.nan
    T_road_C: ArrayLike = np.nan
    mean_pressure: ArrayLike = np.nan
    slip: ArrayLike = np.nan
    T_before_C: ArrayLike = np.nan
