"""Horizontal and vertical shifting of frequency sweeps onto one master curve.

Time-temperature superposition says ``E'(f, T) = b_T E'(f a_T, T_0)`` and the same for the loss
modulus; the loss factor carries no b_T. Where the modulus is that of a network of chains, near the
rubbery plateau, ``b_T = T rho/(T_0 rho_0)`` with absolute temperatures [1]_: without it a plateau
that rises with temperature makes a_T rise, too.

References
----------
.. [1] Ferry, J. D., Viscoelastic Properties of Polymers, 3rd ed. (1980), chapter 11.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
import pandas as pd
from scipy.interpolate import PchipInterpolator
from scipy.optimize import minimize_scalar

from calibration.data import Table
from calibration.shifting.frequency_sweeps import (
    FREQUENCY,
    LOSS,
    MODULUS,
    TAN_DELTA,
    Sweep,
    SweepData,
    read_sweeps,
)
from materials.arrays import FloatArray
from materials.units import ABSOLUTE_ZERO_C

Vertical = Literal["auto", "temperature", "none"]

_LEAST_OVERLAP = 0.2  # decades; a shift that rests on less is reported
_LARGE_ERROR = 0.02  # decades of modulus (5 %); sweeps that agree worse are no one curve
_GLASSY_MODULUS = 1000.0  # N/mm^2; rubbers reach 1 to 3 GPa as glass, and never as rubber


@dataclass(frozen=True, kw_only=True)
class MasterCurve:
    """Frequency sweeps shifted to one reference temperature.

    Parameters
    ----------
    shifts : DataFrame
        ``T_C, log10_aT, b_T, overlap_decades, overlap_error`` by temperature; the error is the RMS
        difference in decades where a sweep overlaps the one shifted before it.
    curve : DataFrame
        Every row of the table with its sweep's temperature, ``reduced_frequency_Hz`` and the
        quantities as measured and divided by b_T (``reduced_...``).
    T_ref_C : float
    vertical : str
        What was done about the vertical shift, in words.
    notes, warnings : tuple of str
    """

    shifts: pd.DataFrame
    curve: pd.DataFrame
    T_ref_C: float
    vertical: str
    notes: tuple[str, ...]
    warnings: tuple[str, ...]

    @property
    def overlap_error(self) -> float:
        """RMS overlap error of the whole master curve in decades."""
        return _total(self.shifts)


def shift_sweeps(
    table: pd.DataFrame | str | Path | Table | SweepData,
    T_ref_C: float | None = None,
    *,
    vertical: Vertical = "auto",
    expansion_per_K: float = 0.0,
    T_tolerance_K: float | None = None,
) -> MasterCurve:
    """Shift frequency sweeps onto one master curve.

    Beginning at the sweep closest to the reference temperature, each next one, colder or hotter, is
    moved to where it agrees best with its already shifted neighbour, in all its quantities.

    Parameters
    ----------
    table : DataFrame, path of a CSV file, or SweepData
        See `calibration.shifting.frequency_sweeps.read_sweeps`.
    T_ref_C : float, optional
        Temperature of the sweep that stays; default the one in the middle. When it is not one of
        the sweeps, the nearest is taken and reported.
    vertical : {"auto", "temperature", "none"}
        ``b_T = T rho/(T_0 rho_0)``, no vertical shift, or the one of the two with the smaller
        overlap error (data may have been divided by b_T before).
    expansion_per_K : float
        Thermal expansion of the volume [1/K], which gives ``rho/rho_0``; 0 leaves it at 1.
    T_tolerance_K : float, optional
        See `calibration.shifting.frequency_sweeps.read_sweeps`.
    """
    if vertical not in ("auto", "temperature", "none"):
        raise ValueError(f"vertical is {vertical!r}; expected auto, temperature or none")
    data = table if isinstance(table, SweepData) else read_sweeps(table, T_tolerance_K)
    T = data.temperatures
    centre = int(np.argmin(np.abs(T - (float(np.median(T)) if T_ref_C is None else T_ref_C))))
    b_T = vertical_shift(T, float(T[centre]), expansion_per_K)
    if data.quantities == (TAN_DELTA,):
        vertical = "none"  # a ratio of moduli carries none
    shifted = {
        "temperature": _shifted(data, centre, b_T),
        "none": _shifted(data, centre, np.ones_like(b_T)),
    }
    better = min(shifted, key=lambda name: _total(shifted[name]))
    kind = better if vertical == "auto" else vertical
    found = shifted[kind]
    return MasterCurve(
        shifts=found,
        curve=_master(data, found),
        T_ref_C=float(T[centre]),
        vertical=_said(kind, vertical, shifted, expansion_per_K),
        notes=data.notes,
        warnings=(*data.warnings, *_shift_warnings(data, found, T_ref_C, float(T[centre]))),
    )


def vertical_shift(T_C: FloatArray, T_ref_C: float, expansion_per_K: float = 0.0) -> FloatArray:
    """``b_T = T rho/(T_0 rho_0)`` [-] at temperatures T_C (n,) for the reference T_ref_C."""
    density = 1.0 / (1.0 + expansion_per_K * (T_C - T_ref_C))
    return np.asarray((T_C - ABSOLUTE_ZERO_C) / (T_ref_C - ABSOLUTE_ZERO_C) * density)


def _total(shifts: pd.DataFrame) -> float:
    """RMS overlap error of the sweeps that overlap [decades], NaN for none."""
    errors = shifts["overlap_error"].to_numpy(dtype=float)
    errors = errors[np.isfinite(errors)]
    return float(np.sqrt(np.mean(errors**2))) if errors.size else float("nan")


def _said(kind: str, asked: str, shifted: dict[str, pd.DataFrame], expansion_per_K: float) -> str:
    density = (
        f"rho from an expansion of {expansion_per_K:g}/K" if expansion_per_K else "rho = rho_0"
    )
    text = f"b_T = T rho/(T_0 rho_0) with {density}" if kind == "temperature" else "none"
    if asked != "auto":
        return text
    other = "none" if kind == "temperature" else "temperature"
    errors = f"{_total(shifted[kind]):.3g} decades, {_total(shifted[other]):.3g}"
    beside = "without" if kind == "temperature" else "with T/T_0"
    return f"{text} (chosen by the overlap error: {errors} {beside})"


def _shifted(data: SweepData, centre: int, b_T: FloatArray) -> pd.DataFrame:
    """Shift factors by temperature for given vertical shifts."""
    T, count = data.temperatures, len(data.sweeps)
    curves = [
        {q: (y if q == TAN_DELTA else y - np.log10(b)) for q, y in sweep.y.items()}
        for sweep, b in zip(data.sweeps, b_T, strict=True)
    ]
    shifts = np.zeros(count)
    decades, errors = np.full(count, np.inf), np.full(count, np.nan)
    for direction, end in ((1, count), (-1, -1)):
        for i in range(centre + direction, end, direction):
            n = i - direction
            step, decades[i], errors[i] = _best_shift(
                (data.sweeps[n].x, curves[n]), (data.sweeps[i].x, curves[i])
            )
            shifts[i] = shifts[n] + step
    return pd.DataFrame(
        {
            "T_C": T,
            "log10_aT": shifts,
            "b_T": b_T,
            "overlap_decades": decades,
            "overlap_error": errors,
        }
    )


Curves = tuple[FloatArray, dict[str, FloatArray]]


def _best_shift(base: Curves, other: Curves) -> tuple[float, float, float]:
    """Shift of `other` onto `base` in decades, with the overlap and its RMS difference."""
    x0, x = base[0], other[0]
    pairs = [
        (PchipInterpolator(x0, base[1][name]), PchipInterpolator(x, other[1][name]))
        for name in base[1]
    ]

    def misfit(shift: float) -> tuple[float, float]:
        low, high = max(x0[0], x[0] + shift), min(x0[-1], x[-1] + shift)
        if high - low < 0.02 * (x[-1] - x[0]):
            return np.inf, 0.0
        at = np.linspace(low, high, 60)
        squares = [np.mean((curve(at) - moved(at - shift)) ** 2) for curve, moved in pairs]
        return float(np.sqrt(np.mean(squares))), float(high - low)

    span = (x0[-1] - x0[0]) + (x[-1] - x[0])
    middle = 0.5 * (x0[0] + x0[-1] - x[0] - x[-1])
    # Where curves hardly overlap any two of them seem to agree: such shifts are only taken when
    # nothing with a real overlap is nearly as good.
    tried = middle + np.linspace(-0.5, 0.5, 161) * span
    found = [misfit(shift) for shift in tried]
    scale = max(float(np.ptp(np.concatenate([base[1][n], other[1][n]]))) for n in base[1]) or 1.0
    score = [
        error + 0.02 * scale * max(0.0, _LEAST_OVERLAP - overlap) / _LEAST_OVERLAP
        for error, overlap in found
    ]
    i = int(np.argmin(score))
    width = tried[1] - tried[0]
    best = minimize_scalar(
        lambda shift: misfit(shift)[0],
        bounds=(tried[i] - width, tried[i] + width),
        method="bounded",
        options={"xatol": 1e-9},
    )
    shift = float(best.x) if best.fun <= found[i][0] else float(tried[i])
    error, overlap = misfit(shift)
    return shift, overlap, error


def _master(data: SweepData, shifts: pd.DataFrame) -> pd.DataFrame:
    """Every row of the table at its reduced frequency, sweep by sweep."""
    parts = []
    for sweep, log_aT, b in zip(data.sweeps, shifts["log10_aT"], shifts["b_T"], strict=True):
        part = data.points.iloc[np.sort(sweep.here)].rename(columns={"T_C": "measured_T_C"})
        part.insert(1, "T_C", sweep.T_C)
        part["reduced_frequency_Hz"] = part[FREQUENCY] * 10.0**log_aT
        for name in (MODULUS, LOSS):
            if name in part:
                part[f"reduced_{name}"] = part[name] / b
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def _shift_warnings(
    data: SweepData, shifts: pd.DataFrame, wanted: float | None, taken: float
) -> tuple[str, ...]:
    T, log_aT = data.temperatures, shifts["log10_aT"].to_numpy()
    decades, errors = shifts["overlap_decades"].to_numpy(), shifts["overlap_error"].to_numpy()
    found = []
    if wanted is not None and abs(wanted - taken) > 1e-9:
        found.append(f"no sweep at {wanted:g} deg C: the one at {taken:g} deg C is the reference")
    for i in np.flatnonzero(decades < _LEAST_OVERLAP):
        found.append(
            f"the sweep at {T[i]:g} deg C overlaps its neighbour by only {decades[i]:.2f} decades"
        )
    for i in np.flatnonzero(errors > _LARGE_ERROR):
        found.append(
            f"the sweep at {T[i]:g} deg C misses its neighbour by {errors[i]:.2g} decades: the "
            "sweeps are not one curve there"
        )
    for i in np.flatnonzero(np.diff(log_aT) > 0.0):
        found.append(
            f"log10 a_T rises from {log_aT[i]:.4g} at {T[i]:g} deg C to {log_aT[i + 1]:.4g} at "
            f"{T[i + 1]:g} deg C; shift factors fall with temperature"
        )
    glassy = [sweep.T_C for sweep in data.sweeps if _is_glass(sweep)]
    if glassy:
        listed = ", ".join(f"{value:g}" for value in glassy)
        found.append(
            f"the modulus at {listed} deg C exceeds {_GLASSY_MODULUS:g} N/mm^2, that of a glass: "
            "WLF does not hold below the glass transition"
        )
    return tuple(found)


def _is_glass(sweep: Sweep) -> bool:
    modulus = sweep.y.get(MODULUS)
    return modulus is not None and bool(np.median(modulus) > np.log10(_GLASSY_MODULUS))
