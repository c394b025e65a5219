"""Quantities of a run's last state that say where the block is warm."""

from typing import Any

import numpy as np
from scipy.optimize import brentq
from scipy.special import erfc

from fem.results import Result, interior_peak
from materials.arrays import FloatArray
from validation.analysis.ranges import number
from validation.drawing import cell_areas, last_state

_PLACES = 401


def start_temperature(result: Result) -> float:
    """Temperature before the sliding [deg C]."""
    return float(result.case.heat.ambient_C)


def rise(result: Result) -> float:
    """Highest interior temperature above the start [K]."""
    return number(result, "T_max_C") - start_temperature(result)


def pressure_at_peak(result: Result) -> float:
    """Contact pressure at the hottest interior point of the bottom [N/mm^2]."""
    surface = result.surface
    place = interior_peak(surface["X_mm"], surface["T_C"]).X_of_peak_mm
    return float(np.interp(place, surface["X_mm"], surface["pressure_N_per_mm2"]))


def middle_temperature(result: Result) -> float:
    """Temperature in the middle of the bottom [deg C]."""
    surface = result.surface
    middle = 0.5 * (surface["X_mm"].iloc[0] + surface["X_mm"].iloc[-1])
    return float(np.interp(middle, surface["X_mm"], surface["T_C"]))


def column_below_peak(result: Result) -> tuple[FloatArray, FloatArray]:
    """Distance from the bottom [mm] and temperature rise [K] above the hottest interior point."""
    state = last_state(result)
    X, Y = state.geometry.points.T
    place = interior_peak(result.surface["X_mm"], result.surface["T_C"]).X_of_peak_mm
    if state.direction < 0:
        place = X.max() - place
    nodes = np.flatnonzero(np.isclose(X, X[np.argmin(np.abs(X - place))]))
    nodes = nodes[np.argsort(Y[nodes])]
    T = state.snapshot.temperature[nodes] - start_temperature(result)
    return np.asarray(Y[nodes] - Y.min()), np.asarray(T)


def heated_depth(result: Result, share: float = 0.1) -> float:
    """Distance from the bottom at which the rise has fallen to a share of the surface's [mm]."""
    depth, T = column_below_peak(result)
    relative = T / T[0]
    first = int(np.argmax(relative < share))
    if relative[first] >= share:
        return float(depth[-1])
    return float(np.interp(-share, -relative[first - 1 : first + 1], depth[first - 1 : first + 1]))


def surface_gradient(result: Result) -> float:
    """Fall of the temperature with the distance from the bottom, at the surface [K/mm]."""
    depth, T = column_below_peak(result)
    return float((T[0] - T[1]) / (depth[1] - depth[0]))


def cell_rises(result: Result) -> tuple[FloatArray, FloatArray]:
    """Mean temperature rise [K] and undeformed area [mm^2] of each element."""
    state = last_state(result)
    T = state.snapshot.temperature[state.geometry.cells].mean(axis=1)
    area = cell_areas(state.geometry.points[state.geometry.cells])
    return np.asarray(T - start_temperature(result)), area


def places(result: Result) -> FloatArray:
    """Common places along the bottom surface, at which curves are compared [mm]."""
    X = result.surface["X_mm"]
    return np.linspace(float(X.min()), float(X.max()), _PLACES)


def profiles(results: list[Result]) -> FloatArray:
    """Temperatures of bottom surfaces at common places, a row per result [deg C]."""
    X = places(results[0])
    return np.array([np.interp(X, r.surface["X_mm"], r.surface["T_C"]) for r in results])


def mean_difference(one: Result, other: Result) -> float:
    """Difference of the temperatures of two bottom surfaces, mean of its size [K]."""
    a, b = profiles([one, other])
    return float(np.abs(a - b).mean())


def curve_difference(one: Result, other: Result) -> dict[str, Any]:
    """Where two bottom surfaces differ most, and by how much where both are in contact.

    Returns
    -------
    dict
        ``most_K`` at ``X_mm``, ``inside_K`` in the mean where both are in contact, and ``contact``:
        from where to where each is [mm].
    """
    X, (a, b) = places(one), profiles([one, other])
    worst = int(np.argmax(np.abs(a - b)))
    surfaces = [result.surface for result in (one, other)]
    touching = [np.interp(X, s["X_mm"], s["in_contact"].to_numpy(dtype=float)) for s in surfaces]
    contact = [s["X_mm"][s["in_contact"].astype(bool)] for s in surfaces]
    return {
        "most_K": float(abs(a[worst] - b[worst])),
        "X_mm": float(X[worst]),
        "inside_K": float(np.abs(a - b)[np.min(touching, axis=0) > 0.5].mean()),
        "contact": [end for along in contact for end in (along.min(), along.max())],
    }


def half_space_depth(result: Result, share: float = 0.1) -> float:
    """Depth at which the rise is a share of the surface's under constant flux [mm].

    The rise is proportional to ierfc(z/(2 sqrt(alpha t))) (Carslaw and Jaeger, Conduction of Heat
    in Solids, 1959, section 2.9), with ierfc(x) = exp(-x^2)/sqrt(pi) - x erfc(x).
    """
    thermal = result.case.rubber.thermal
    diffusivity = thermal.conductivity / (thermal.density * thermal.specific_heat)
    sliding = result.case.loading
    time = sliding.distance_mm / abs(sliding.velocity_mm_per_s)
    at = brentq(lambda x: np.exp(-(x**2)) - np.sqrt(np.pi) * x * erfc(x) - share, 0.0, 5.0)
    return float(2.0 * np.sqrt(diffusivity * time) * at)
