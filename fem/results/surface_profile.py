"""Temperature profile of the bottom surface: highest interior temperature and excess area.

The same two functions serve the simulation and measured profiles, so that both are judged alike.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import FloatArray

#: Share of the bottom's length, at the leading corner, in which a front-edge peak can have its top.
EDGE_ZONE = 0.2
#: Share of the bottom's length, from the leading corner, in which its valley is looked for.
VALLEY_ZONE = 0.4
#: Share of the profile's span by which temperatures must rise or fall to count as peak or valley;
#: smaller wiggles are noise (a pyrometer's 0.5-1 K) or discretisation.
SIGNIFICANT_SHARE = 0.04


class InteriorPeak(NamedTuple):
    """Highest temperatures of the bottom surface.

    Attributes
    ----------
    T_max_C : float
        Highest temperature of the interior, the front-edge peak left out [deg C].
    T_edge_C : float
        Highest temperature of the front edge: of its peak, or of the leading corner if there
        is no such peak [deg C].
    X_of_peak_mm : float
        Reference coordinate of the interior maximum [mm].
    """

    T_max_C: float
    T_edge_C: float
    X_of_peak_mm: float


def interior_peak(X_mm: ArrayLike, T_C: ArrayLike) -> InteriorPeak:
    """Find the highest interior temperature of a bottom-surface profile.

    The paper (section 5.2) takes the peak "in the interior of this surface" and does not consider
    potential peaks at the front edge, without saying where the interior begins. The rule here:

    1. A *valley* is a point of the leading two fifths of the surface that lies more than 4 % of
       the profile's span below the highest point on either side of it, the one towards the front
       being in the leading fifth. That one is the *front-edge peak*.
    2. The interior is everything behind the rearmost valley. There may be several: a corner that
       is folded away from the road stays cold in front of the front-edge peak.
    3. Without a valley, the leading fifth may still rise by more than 4 % of the span above what
       lies behind it (a peak that runs out into a plateau, a profile that rises to the front). The
       interior then ends where the leading fifth begins.
    4. Otherwise there is no front-edge peak, and the interior is the whole surface.

    Parameters
    ----------
    X_mm : (n,) array_like
        Reference coordinate, strictly increasing from the trailing (0) to the leading corner [mm].
    T_C : (n,) array_like
        Temperature [deg C].

    Returns
    -------
    InteriorPeak
    """
    X, T = _profile(X_mm, T_C)
    from_front = (X[-1] - X) / (X[-1] - X[0])
    zone = int(np.argmax(from_front <= EDGE_ZONE))
    significant = SIGNIFICANT_SHARE * float(np.ptp(T))
    valley = _valley(T, from_front, zone, significant)
    if valley is not None:
        last, edge = valley, valley + int(np.argmax(T[valley:]))
    elif _front_rises(T, zone, significant):
        last, edge = max(zone - 1, 0), zone + int(np.argmax(T[zone:]))
    else:
        last = edge = T.size - 1
    peak = int(np.argmax(T[: last + 1]))
    return InteriorPeak(float(T[peak]), float(T[edge]), float(X[peak]))


def excess_area(X_mm: ArrayLike, T_C: ArrayLike, T_0_C: float) -> float:
    """Integrate the temperature rise over the bottom surface (A_T of the paper, section 5.2).

    Parameters
    ----------
    X_mm : (n,) array_like
        Reference coordinate, strictly increasing [mm].
    T_C : (n,) array_like
        Temperature [deg C].
    T_0_C : float
        Temperature before the sliding [deg C].

    Returns
    -------
    float
        Trapezoidal integral of T - T_0 [K mm].
    """
    X, T = _profile(X_mm, T_C)
    return float(np.trapezoid(T - T_0_C, X))


def _valley(T: FloatArray, from_front: FloatArray, zone: int, significant: float) -> int | None:
    """Index of the lowest point of the rearmost valley behind a front-edge peak, or None."""
    behind = np.maximum.accumulate(T)
    ahead = np.maximum.accumulate(T[::-1])[::-1]
    # Where the highest point ahead is not in the leading fifth, it is an interior peak.
    peak_in_zone = ahead == ahead[zone]
    peak_in_zone[zone:] = True
    rises = np.minimum(behind, ahead) - T > significant
    candidates = np.flatnonzero(rises & peak_in_zone & (from_front <= VALLEY_ZONE))
    if not candidates.size:
        return None
    rearmost = np.split(candidates, np.flatnonzero(np.diff(candidates) > 1) + 1)[0]
    return int(rearmost[np.argmin(T[rearmost])])


def _front_rises(T: FloatArray, zone: int, significant: float) -> bool:
    """Whether the leading fifth rises above the lowest point between it and the interior peak."""
    if zone == 0:
        return False
    interior, edge = int(np.argmax(T[:zone])), zone + int(np.argmax(T[zone:]))
    return bool(T[edge] - T[interior : edge + 1].min() > significant)


def _profile(X_mm: ArrayLike, T_C: ArrayLike) -> tuple[FloatArray, FloatArray]:
    X = np.asarray(X_mm, dtype=float)
    T = np.asarray(T_C, dtype=float)
    if X.ndim != 1 or X.shape != T.shape or X.size < 2:
        raise ValueError(
            f"a profile needs two columns of the same length, at least 2 points; found X of "
            f"shape {X.shape} and T of shape {T.shape}"
        )
    if not (np.all(np.isfinite(X)) and np.all(np.isfinite(T))):
        raise ValueError("a profile needs finite coordinates and temperatures; found NaN or inf")
    if not np.all(np.diff(X) > 0.0):
        row = int(np.argmin(np.diff(X) > 0.0)) + 1
        raise ValueError(
            f"X must increase from the trailing to the leading corner; found {X[row]:g} mm after "
            f"{X[row - 1]:g} mm"
        )
    return X, T
