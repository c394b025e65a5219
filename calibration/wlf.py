"""Fit of the WLF constants to shift factors, measured or found by shifting frequency sweeps.

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

from calibration.data import DataError, LeftOut, Table, left_out, read_table
from calibration.fitting import FitResult, Problem, evenly_spread, fit
from calibration.shifting import MasterCurve, is_sweep_table, shift_sweeps
from fem.files import version_of
from materials.arrays import FloatArray, IntArray
from materials.wlf import WLF

SHIFT_COLUMNS = ("T_C", "log10_aT")
LEAST_R2 = 0.5  # a curve that explains less of the factors is none
_GLASS_TO_POLE_K = 51.6  # d2 at the glass transition, nearly the same for all polymers [1]_
_GLASS_SPAN_K = 0.5  # the transition is no sharper than that
_POLE_DISTANCE_K = 1.0  # the lowest temperature stays that far above the pole


@dataclass(frozen=True, kw_only=True)
class ShiftFactors:
    """Shift factors a fit is made to.

    Parameters
    ----------
    T, log_aT : ndarray, shape (n,)
        Temperature [deg C] and decadic logarithm of the factors [-].
    rows : ndarray of int, shape (n,)
        Their rows in the table; empty for sweeps, whose rows are in the master curve.
    out : tuple of LeftOut
    source : Table or None
        The table behind them.
    master : MasterCurve or None
        Where the factors come from, if from sweeps.
    """

    T: FloatArray
    log_aT: FloatArray
    rows: IntArray
    out: tuple[LeftOut, ...]
    source: Table | None = None
    master: MasterCurve | None = None

    @property
    def file(self) -> str:
        return "table" if self.source is None else self.source.file

    @property
    def origin(self) -> dict[str, Any]:
        """What a result file says of the data (see `Table.origin`)."""
        return {"data_file": self.file} if self.source is None else self.source.origin


def fit_wlf(
    table: pd.DataFrame | str | Path | MasterCurve | ShiftFactors,
    *,
    T_ref_C: float | None = None,
    window: tuple[float, float] | None = None,
    other_sign: bool = False,
    **shifting: Any,
) -> FitResult:
    """Fit d1 and d2 to shift factors.

    Parameters
    ----------
    table : DataFrame, path of a CSV file, MasterCurve, or ShiftFactors
        Columns ``T_C`` and ``log10_aT``, or a_T itself in ``aT``; the factors may refer to any
        temperature, they are rebased. A table of sweeps is shifted first.
    T_ref_C : float, optional
        Reference temperature of the constants [deg C]; default the one where log10 a_T is zero,
        or nearest to it.
    window : tuple of float, optional
        Lowest and highest temperature used [deg C].
    other_sign : bool
        The table holds 1/a_T, which rises with temperature.
    **shifting
        Options of `calibration.shifting.master_curve.shift_sweeps`.

    Raises
    ------
    DataError
        Where the factors rise with temperature, lie on no WLF curve, or leave d1 or d2 at a bound.

    Notes
    -----
    ``log10 a_T = c - d1 (T - T_ref)/(d2 + T - T_ref)``. The offset c takes up that the data may
    refer to another temperature than T_ref (and their scatter there).

    Examples
    --------
    >>> import pandas as pd
    >>> from materials import WLF
    >>> T = [0.0, 20.0, 40.0, 60.0]
    >>> factors = WLF(d1=8.0, d2_K=120.0).log10_shift_factor(T, 20.0)
    >>> table = pd.DataFrame({"T_C": T, "log10_aT": factors})
    >>> round(fit_wlf(table, T_ref_C=20.0).values["d1"], 3)
    8.0
    """
    if not isinstance(table, ShiftFactors):
        options = {"window": window, "other_sign": other_sign, **shifting}
        table = read_shift_factors(table, T_ref_C=T_ref_C, **options)
    data, T, log_aT = table, table.T, table.log_aT
    reference = float(T[np.argmin(np.abs(log_aT))]) if T_ref_C is None else float(T_ref_C)
    _require_factors(data, reference)
    result = _fitted(T - reference, log_aT)
    _refuse_no_curve(data, result)
    wlf = WLF(d1=result.values["d1"], d2_K=result.values["d2_K"])
    metadata: dict[str, Any] = {
        "kind": "wlf",
        "model": "wlf",
        **data.origin,
        "T_ref_C": reference,
        **_about_rows(data),
        "version": version_of(),
    }
    section: dict[str, Any] = {
        "wlf": True,
        "d1": wlf.d1,
        "d2_K": wlf.d2_K,
        "wlf_T_ref_C": reference,
        "window": {"T_C": [float(T.min()), float(T.max())]},
    }
    warnings = (*result.warnings, *_glass_warnings(data, wlf, reference))
    return replace(
        result, model=wlf, metadata=metadata, section={"friction": section}, warnings=warnings
    )


def read_shift_factors(
    table: pd.DataFrame | str | Path | MasterCurve,
    *,
    T_ref_C: float | None = None,
    window: tuple[float, float] | None = None,
    other_sign: bool = False,
    **shifting: Any,
) -> ShiftFactors:
    """Read shift factors, or find them by shifting sweeps (see `fit_wlf`)."""
    source, master, rows = None, None, np.empty(0, dtype=np.int64)
    if isinstance(table, MasterCurve):
        master = table
    else:
        source = read_table(table, ("T_C",))
        if is_sweep_table(source):
            master = shift_sweeps(source, T_ref_C, **shifting)
    if master is not None:
        if other_sign:
            raise ValueError("other_sign is set for sweeps; expected it for shift factors only")
        T, log_aT = (master.shifts[name].to_numpy(dtype=float) for name in SHIFT_COLUMNS)
    else:
        assert source is not None
        T, log_aT, rows = source.numbers("T_C"), _logarithms(source), source.rows
    keep = np.ones(T.size, dtype=bool)
    out: tuple[LeftOut, ...] = ()
    if window is not None:
        low, high = window
        if not low < high:
            raise ValueError(f"window is {low:g} to {high:g}; expected two rising temperatures")
        keep = (low <= T) & (high >= T)
        numbers = rows if rows.size else np.arange(1, T.size + 1)
        out = left_out(numbers, ~keep, f"outside the window {low:g} to {high:g} deg C")
    return ShiftFactors(
        T=T[keep],
        log_aT=-log_aT[keep] if other_sign else log_aT[keep],
        rows=rows[keep] if rows.size else rows,
        out=out,
        source=source,
        master=master,
    )


def _logarithms(source: Table) -> FloatArray:
    if source.has("aT") and not source.has("log10_aT"):
        aT = source.numbers("aT")
        source.require_all("aT", aT > 0.0, "a shift factor above 0")
        return np.log10(aT)
    source.require(SHIFT_COLUMNS)
    return source.numbers("log10_aT")


def _about_rows(data: ShiftFactors) -> dict[str, Any]:
    about = {"rows_left_out": [str(entry) for entry in data.out]}
    if data.master is None:
        return {"rows_used": data.T.size, **about}
    curve = data.master.curve
    frequency = curve["frequency_Hz"]
    return {
        "rows_used": len(curve),
        **about,
        "frequency_window_Hz": [float(frequency.min()), float(frequency.max())],
        "vertical_shift": data.master.vertical,
        "b_T": data.master.shifts["b_T"].tolist(),
        "overlap_error_decades": data.master.overlap_error,
        "notes": list(data.master.notes),
    }


def _require_factors(data: ShiftFactors, reference: float) -> None:
    """Refuse too few temperatures, and factors of the other sign convention."""
    T, log_aT = data.T, data.log_aT
    if np.unique(T).size < 3:
        raise DataError(
            file=data.file,
            column="T_C",
            found=f"{np.unique(T).size} different temperatures",
            expected="at least 3 for d1, d2 and the offset",
        )
    slope = float(np.polyfit(T, log_aT, 1)[0])
    if slope <= 0.0 or data.master is not None:
        return
    try:
        values = _fitted(T - reference, -log_aT).values
        hint = f": d1 = {values['d1']:.2f}, d2 = {values['d2_K']:.2f} K at {reference:g} deg C"
    except ValueError:
        hint = ""
    raise DataError(
        file=data.file,
        column="log10_aT",
        found=f"factors that rise with temperature ({slope:.3g} decades per K)",
        expected="factors that fall; these have the other sign convention, 1/a_T "
        f"(--other-sign{hint})",
    )


def _refuse_no_curve(data: ShiftFactors, result: FitResult) -> None:
    """Refuse what is no WLF curve, so that no parameter file tells otherwise."""
    problem = result.problem
    assert problem is not None
    bounded = [
        f"{name} = {value:.6g} at its bound"
        for name, value, low, high in zip(
            result.names, result.theta, problem.lower, problem.upper, strict=True
        )
        if value <= low * (1.0 + 1e-3) or value >= high / (1.0 + 1e-3)
    ]
    if result.r2 >= LEAST_R2 and not bounded:
        return
    master = data.master
    reasons = [f"R2 = {result.r2:.2g}"] if not result.r2 >= LEAST_R2 else []
    reasons += bounded
    if master is not None:
        reasons += [f"overlap error {master.overlap_error:.2g} decades", *master.warnings]
    raise DataError(
        file=data.file,
        column="T_C",
        found=f"shift factors that no WLF curve follows ({'; '.join(reasons)})",
        expected="factors that fall with temperature along a curved line, above the glass "
        "transition (--window leaves temperatures out)",
    )


def _glass_warnings(data: ShiftFactors, wlf: WLF, reference: float) -> tuple[str, ...]:
    glass = reference - wlf.d2_K + _GLASS_TO_POLE_K
    below = np.unique(data.T[glass - _GLASS_SPAN_K > data.T])
    if not below.size:
        return ()
    listed = ", ".join(f"{value:g}" for value in below)
    return (
        f"{listed} deg C lie below {glass:.4g} deg C, where these constants put the glass "
        f"transition (d2 = {_GLASS_TO_POLE_K:g} K there); WLF does not hold below it",
    )


def _fitted(dT: FloatArray, log_aT: FloatArray) -> FitResult:
    pole = max(float(-dT.min()), 0.0) + _POLE_DISTANCE_K
    problem = replace(
        _wlf_problem(dT, log_aT, pole),
        subset=lambda rows: _wlf_problem(dT[rows], log_aT[rows], pole),
    )
    return fit(problem, _wlf_starts(problem, dT, log_aT))


def _wlf_problem(dT: FloatArray, log_aT: FloatArray, pole: float) -> Problem:
    def predict(theta: FloatArray) -> FloatArray:
        d1, d2, offset = theta
        return np.asarray(offset - d1 * dT / (d2 + dT))

    def jacobian(theta: FloatArray) -> FloatArray:
        d1, d2, _ = theta
        reached = d2 + dT
        return np.stack([-dT / reached, d1 * dT / reached**2, np.ones_like(dT)], axis=1)

    return Problem(
        names=("d1", "d2_K", "offset"),
        predict=predict,
        jacobian=jacobian,
        observed=log_aT,
        lower=np.array([1e-3, pole, -np.inf]),
        upper=np.array([1e4, 1e5, np.inf]),
    )


def _wlf_starts(problem: Problem, dT: FloatArray, log_aT: FloatArray) -> FloatArray:
    """For a given d2 the shift is linear in d1 and the offset."""
    points = []
    few = evenly_spread(dT.size, 2_000)
    dT, log_aT = dT[few], log_aT[few]
    for d2 in problem.lower[1] + np.geomspace(5.0, 2000.0, 12):
        columns = np.stack([-dT / (d2 + dT), np.ones_like(dT)], axis=1)
        d1, offset = np.linalg.lstsq(columns, log_aT, rcond=None)[0]
        points.append([max(d1, 0.1), d2, offset])
    return np.array(points)
