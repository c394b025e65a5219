"""Time-temperature shift: horizontal shifting of frequency sweeps, and the WLF constants.

References
----------
.. [1] Williams, M. L., Landel, R. F., Ferry, J. D., J. Am. Chem. Soc. 77 (1955) 3701-3707.
.. [2] Ferry, J. D., Viscoelastic Properties of Polymers, 3rd ed. (1980), chapter 11.
"""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.optimize import minimize_scalar

from calibration.fit_core import FitResult, Problem, fit
from calibration.friction import read_temperature
from calibration.provenance import version
from calibration.tables import Table, read_table
from materials.wlf import WLF

Array = NDArray[np.float64]

SWEEP_COLUMNS = ("T_C", "frequency_Hz", "modulus_N_per_mm2")
SHIFT_COLUMNS = ("T_C", "log10_aT")
_LEAST_OVERLAP = 0.2  # decades; a shift that rests on less is reported


@dataclass(frozen=True, kw_only=True)
class MasterCurve:
    """Frequency sweeps shifted to one reference temperature.

    Parameters
    ----------
    shifts : DataFrame
        ``T_C, log10_aT, overlap_decades, overlap_error`` by temperature; the error is the RMS
        difference of log10 modulus where a sweep overlaps those shifted before it.
    curve : DataFrame
        ``T_C, reduced_frequency_Hz, modulus_N_per_mm2``, every point at its reduced frequency.
    T_ref_C : float
    warnings : tuple of str
    """

    shifts: pd.DataFrame
    curve: pd.DataFrame
    T_ref_C: float
    warnings: tuple[str, ...]

    @property
    def overlap_error(self) -> float:
        """RMS overlap error of the whole master curve in decades of modulus."""
        errors = self.shifts["overlap_error"].to_numpy(dtype=float)
        errors = errors[np.isfinite(errors)]
        return float(np.sqrt(np.mean(errors**2))) if errors.size else float("nan")


def shift_sweeps(table: pd.DataFrame | str | Path, T_ref_C: float | None = None) -> MasterCurve:
    """Shift frequency sweeps along the frequency axis onto one master curve.

    Beginning at the sweep closest to the reference temperature, each next one, colder or hotter, is
    moved to where it agrees best with its already shifted neighbour.

    Parameters
    ----------
    table : DataFrame or path of a CSV file
        Columns ``T_C``, ``frequency_Hz``, ``modulus_N_per_mm2`` (storage modulus, or its amount).
    T_ref_C : float, optional
        Temperature of the sweep that stays; default the one in the middle. When it is not one of
        the sweeps, the nearest is taken and reported.
    """
    source = read_table(table, SWEEP_COLUMNS)
    sweeps = _sweeps(source)
    temperatures = np.array(sorted(sweeps))
    wanted = float(np.median(temperatures)) if T_ref_C is None else T_ref_C
    centre = int(np.argmin(np.abs(temperatures - wanted)))
    shifts = np.zeros(temperatures.size)
    decades, errors = np.full(temperatures.size, np.inf), np.full(temperatures.size, np.nan)
    for direction, end in ((1, temperatures.size), (-1, -1)):
        for i in range(centre + direction, end, direction):
            neighbour = temperatures[i - direction]
            step, decades[i], errors[i] = _best_shift(sweeps[neighbour], sweeps[temperatures[i]])
            shifts[i] = shifts[i - direction] + step
    table_of_shifts = pd.DataFrame(
        {
            "T_C": temperatures,
            "log10_aT": shifts,
            "overlap_decades": decades,
            "overlap_error": errors,
        }
    )
    return MasterCurve(
        shifts=table_of_shifts,
        curve=_master(sweeps, temperatures, shifts),
        T_ref_C=float(temperatures[centre]),
        warnings=_shift_warnings(temperatures, decades, T_ref_C, temperatures[centre]),
    )


def _sweeps(source: Table) -> dict[float, tuple[Array, Array]]:
    """log10 frequency and log10 modulus by temperature, in rising frequency."""
    T = read_temperature(source)
    f, E = source.numbers("frequency_Hz"), source.numbers("modulus_N_per_mm2")
    source.require_all("frequency_Hz", f > 0.0, "a frequency above 0 Hz")
    source.require_all("modulus_N_per_mm2", E > 0.0, "a modulus above 0 N/mm^2")
    sweeps = {}
    for temperature in np.unique(T):
        here = np.flatnonzero(temperature == T)
        frequency, first = np.unique(np.log10(f[here]), return_index=True)
        if frequency.size < 3:
            source.refuse_at(
                here[0], "frequency_Hz", f"{frequency.size} frequencies at {temperature:g} deg C",
                "at least 3 per temperature",
            )  # fmt: skip
        sweeps[float(temperature)] = frequency, np.log10(E[here][first])
    if len(sweeps) < 2:
        source.refuse(column="T_C", found="one temperature", expected="two or more sweeps to shift")
    return sweeps


def _best_shift(
    base: tuple[Array, Array], other: tuple[Array, Array]
) -> tuple[float, float, float]:
    """Shift of `other` onto `base` in decades, with the overlap and its RMS difference."""
    curve = PchipInterpolator(*base)
    x, y = other

    def misfit(shift: float) -> tuple[float, float]:
        low, high = max(base[0][0], x[0] + shift), min(base[0][-1], x[-1] + shift)
        if high - low < 0.02 * (x[-1] - x[0]):
            return np.inf, 0.0
        at = np.linspace(low, high, 60)
        difference = curve(at) - PchipInterpolator(x + shift, y)(at)
        return float(np.sqrt(np.mean(difference**2))), float(high - low)

    span = (base[0][-1] - base[0][0]) + (x[-1] - x[0])
    middle = 0.5 * (base[0][0] + base[0][-1] - x[0] - x[-1])
    # Where curves hardly overlap any two of them seem to agree: such shifts are only taken when
    # nothing with a real overlap is nearly as good.
    tried = middle + np.linspace(-0.5, 0.5, 161) * span
    found = [misfit(shift) for shift in tried]
    scale = float(np.ptp(np.concatenate([base[1], y]))) or 1.0
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


def _master(
    sweeps: dict[float, tuple[Array, Array]], temperatures: Array, shifts: Array
) -> pd.DataFrame:
    parts = [
        pd.DataFrame(
            {
                "T_C": T,
                "reduced_frequency_Hz": 10.0 ** (sweeps[T][0] + shift),
                "modulus_N_per_mm2": 10.0 ** sweeps[T][1],
            }
        )
        for T, shift in zip(temperatures, shifts, strict=True)
    ]
    return pd.concat(parts, ignore_index=True)


def _shift_warnings(
    temperatures: Array, decades: Array, wanted: float | None, taken: float
) -> tuple[str, ...]:
    found = []
    if wanted is not None and abs(wanted - taken) > 1e-9:
        found.append(f"no sweep at {wanted:g} deg C: the one at {taken:g} deg C is the reference")
    for i in np.flatnonzero(decades < _LEAST_OVERLAP):
        found.append(
            f"the sweep at {temperatures[i]:g} deg C overlaps its neighbour by only "
            f"{decades[i]:.2f} decades"
        )
    return tuple(found)


def fit_wlf(
    table: pd.DataFrame | str | Path | MasterCurve, *, T_ref_C: float | None = None
) -> FitResult:
    """Fit d1 and d2 to shift factors.

    Parameters
    ----------
    table : DataFrame, path of a CSV file, or MasterCurve
        Columns ``T_C`` and ``log10_aT``, or a_T itself in ``aT``; the factors may refer to any
        temperature, they are rebased. A table of sweeps (``frequency_Hz``,
        ``modulus_N_per_mm2``) is shifted first.
    T_ref_C : float, optional
        Reference temperature of the constants [deg C]; default the one where log10 a_T is zero,
        or nearest to it.

    Notes
    -----
    ``log10 a_T = c - d1 (T - T_ref)/(d2 + T - T_ref)``. The offset c takes up that the data may
    refer to another temperature than T_ref (and their scatter there).
    """
    source, T, log_aT = _shift_factors(table, T_ref_C)
    reference = float(T[np.argmin(np.abs(log_aT))]) if T_ref_C is None else float(T_ref_C)
    dT = T - reference
    if np.unique(dT).size < 3:
        source.refuse(
            column="T_C",
            found=f"{np.unique(dT).size} different temperatures",
            expected="at least 3 for d1, d2 and the offset",
        )
    problem = _wlf_problem(dT, log_aT)
    result = fit(problem, _wlf_starts(problem, dT, log_aT))
    wlf = WLF(d1=result.values["d1"], d2_K=result.values["d2_K"])
    metadata: dict[str, Any] = {
        "kind": "wlf",
        "model": "wlf",
        **source.origin,
        "temperature_window_C": [float(T.min()), float(T.max())],
        "T_ref_C": reference,
        "T_C": T.tolist(),
        "version": version(),
    }
    section = {"wlf": True, "d1": wlf.d1, "d2_K": wlf.d2_K, "T_ref_C": reference}
    return replace(result, model=wlf, metadata=metadata, section={"friction": section})


def _shift_factors(
    table: pd.DataFrame | str | Path | MasterCurve, T_ref_C: float | None
) -> tuple[Table, Array, Array]:
    if isinstance(table, MasterCurve):
        source = read_table(table.shifts[["T_C", "log10_aT"]], SHIFT_COLUMNS)
    else:
        source = read_table(table, ("T_C",))
        if source.has("frequency_Hz"):
            master = shift_sweeps(table, T_ref_C)
            inner = read_table(master.shifts[["T_C", "log10_aT"]], SHIFT_COLUMNS)
            source = replace(inner, file=source.file, sha256=source.sha256)
    T = read_temperature(source)
    if source.has("aT") and not source.has("log10_aT"):
        aT = source.numbers("aT")
        source.require_all("aT", aT > 0.0, "a shift factor above 0")
        return source, T, np.log10(aT)
    source.require(SHIFT_COLUMNS)
    return source, T, source.numbers("log10_aT")


def _wlf_problem(dT: Array, log_aT: Array) -> Problem:
    def predict(theta: Array) -> Array:
        d1, d2, offset = theta
        return np.asarray(offset - d1 * dT / (d2 + dT))

    def jacobian(theta: Array) -> Array:
        d1, d2, _ = theta
        reached = d2 + dT
        return np.stack([-dT / reached, d1 * dT / reached**2, np.ones_like(dT)], axis=1)

    pole = max(float(-dT.min()), 0.0) + 1.0  # keeps every temperature 1 K above the pole
    return Problem(
        names=("d1", "d2_K", "offset"),
        predict=predict,
        jacobian=jacobian,
        observed=log_aT,
        lower=np.array([1e-3, pole, -np.inf]),
        upper=np.array([1e4, 1e5, np.inf]),
    )


def _wlf_starts(problem: Problem, dT: Array, log_aT: Array) -> Array:
    """For a given d2 the shift is linear in d1 and the offset."""
    points = []
    for d2 in problem.lower[1] + np.geomspace(5.0, 2000.0, 12):
        columns = np.stack([-dT / (d2 + dT), np.ones_like(dT)], axis=1)
        d1, offset = np.linalg.lstsq(columns, log_aT, rcond=None)[0]
        points.append([max(d1, 0.1), d2, offset])
    return np.array(points)
