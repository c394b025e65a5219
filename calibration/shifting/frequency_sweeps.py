"""Frequency sweeps at several temperatures, as a rheometer or a DMA writes them."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from calibration.data import Table, read_table
from materials.arrays import FloatArray, IndexArray

#: Quantities of a sweep; the first two carry the vertical shift, a ratio does not.
MODULUS, LOSS, TAN_DELTA = "modulus_N_per_mm2", "loss_modulus_N_per_mm2", "tan_delta"
QUANTITIES = (MODULUS, LOSS, TAN_DELTA)
FREQUENCY, OMEGA = "frequency_Hz", "omega_rad_per_s"

DEFAULT_TOLERANCE_K = 1.0
_LEAST_FREQUENCIES = 3
_DISAGREEMENT = 0.05  # decades between two values at one frequency, or two columns, worth a word


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """One sweep, its values the geometric means where a frequency occurs more than once.

    Parameters
    ----------
    T_C : float
        Mean temperature of its rows [deg C].
    x : ndarray, shape (n,)
        log10 of the frequency [Hz], rising.
    y : dict of ndarray, shape (n,)
        log10 of each quantity.
    here : ndarray of int
        Its rows in the table.
    """

    T_C: float
    x: FloatArray
    y: Mapping[str, FloatArray]
    here: IndexArray


@dataclass(frozen=True, kw_only=True)
class SweepData:
    """All sweeps of a table in rising temperature, and what was noticed while reading.

    Parameters
    ----------
    sweeps : tuple of Sweep
    points : DataFrame
        Every row of the table: ``row, T_C`` (as measured), ``frequency_Hz`` and the quantities.
    quantities : tuple of str
        Those that are shifted.
    notes, warnings : tuple of str
    """

    sweeps: tuple[Sweep, ...]
    points: pd.DataFrame
    quantities: tuple[str, ...]
    notes: tuple[str, ...]
    warnings: tuple[str, ...]

    @property
    def temperatures(self) -> FloatArray:
        return np.array([sweep.T_C for sweep in self.sweeps])


def is_sweep_table(source: Table) -> bool:
    """Whether a table holds sweeps rather than shift factors."""
    return any(source.has(column) for column in (FREQUENCY, OMEGA, *QUANTITIES))


def read_sweeps(
    table: pd.DataFrame | str | Path | Table, T_tolerance_K: float | None = None
) -> SweepData:
    """Read sweeps: a frequency, and one or more of storage modulus, loss modulus and tan delta.

    Parameters
    ----------
    table : DataFrame, path of a CSV file, or Table
        Columns ``T_C``, ``frequency_Hz`` or ``omega_rad_per_s``, and at least one of
        ``modulus_N_per_mm2``, ``loss_modulus_N_per_mm2``, ``tan_delta``.
    T_tolerance_K : float, optional
        Rows within that of each other belong to one sweep [K]. Default: every temperature is a
        sweep of its own where each holds one, else 1 K.
    """
    source = table if isinstance(table, Table) else read_table(table, ("T_C",))
    T, f = source.numbers("T_C"), _frequency(source)
    present = tuple(name for name in QUANTITIES if source.has(name))
    if not present:
        source.require((MODULUS,))
    values = {name: source.numbers(name) for name in present}
    if TAN_DELTA in values:
        source.require_all(TAN_DELTA, values[TAN_DELTA] > 0.0, "a number above 0")
    warnings = _consistency(source, values)
    quantities = tuple(q for q in present if not (q == TAN_DELTA and len(present) == 3))
    logs = {name: np.log10(values[name]) for name in quantities}
    groups, notes = _groups(source, T, f, T_tolerance_K)
    sweeps = []
    for here in groups:
        sweep, noticed = _sweep(source, T, np.log10(f), logs, here)
        sweeps.append(sweep)
        warnings += noticed
    if len(sweeps) < 2:
        source.refuse(column="T_C", found="one temperature", expected="two or more sweeps to shift")
    points = pd.DataFrame({"row": source.rows, "T_C": T, FREQUENCY: f, **values})
    return SweepData(
        sweeps=tuple(sweeps),
        points=points,
        quantities=quantities,
        notes=notes,
        warnings=tuple(warnings),
    )


def _frequency(source: Table) -> FloatArray:
    if not source.has(OMEGA):
        source.require((FREQUENCY,))
        return source.numbers(FREQUENCY)
    f = source.numbers(OMEGA) / (2.0 * np.pi)
    if source.has(FREQUENCY):
        same = np.abs(source.numbers(FREQUENCY) - f) <= 0.01 * f
        source.require_all(FREQUENCY, same, f"{OMEGA}/(2 pi) to 1 %, or one of the two columns")
    return f


def _consistency(source: Table, values: Mapping[str, FloatArray]) -> list[str]:
    if len(values) < 3:
        return []
    off = np.abs(np.log10(values[LOSS] / (values[MODULUS] * values[TAN_DELTA])))
    worst = int(np.argmax(off))
    if off[worst] <= _DISAGREEMENT:
        return []
    ratio = values[LOSS][worst] / values[MODULUS][worst]
    return [
        f"tan_delta is not loss over storage modulus: row {source.rows[worst]} has "
        f"{values[TAN_DELTA][worst]:g} beside {ratio:.4g}; the moduli are used"
    ]


def _groups(
    source: Table, T: FloatArray, f: FloatArray, tolerance: float | None
) -> tuple[list[IndexArray], tuple[str, ...]]:
    """Rows of each sweep in rising temperature."""
    order = np.argsort(T, kind="stable")
    if tolerance is None:
        groups = np.split(order, np.flatnonzero(np.diff(T[order]) > 0.0) + 1)
        if all(np.unique(f[here]).size >= _LEAST_FREQUENCIES for here in groups):
            return groups, ()
        tolerance = DEFAULT_TOLERANCE_K
    groups = np.split(order, np.flatnonzero(np.diff(T[order]) > tolerance) + 1)
    notes = []
    for here in groups:
        low, high = float(T[here].min()), float(T[here].max())
        if high - low > 2.0 * tolerance:
            source.refuse(
                column="T_C",
                found=f"temperatures that go on from {low:g} to {high:g} deg C without a gap of "
                f"{tolerance:g} K",
                expected="sweeps at set temperatures, or a smaller --T-tolerance",
            )
        if high > low:
            notes.append(f"{T[here].mean():.4g} ({low:g} to {high:g})")
    if not notes:
        return groups, ()
    text = f"rows within {tolerance:g} K are one sweep, its temperature their mean: "
    return groups, (text + ", ".join(notes) + " deg C",)


def _sweep(
    source: Table,
    T: FloatArray,
    log_f: FloatArray,
    logs: Mapping[str, FloatArray],
    here: IndexArray,
) -> tuple[Sweep, list[str]]:
    temperature = float(T[here].mean())
    # frequencies that a generator meant to be equal differ by rounding
    key = np.round(log_f[here], 4)
    places, inverse, counts = np.unique(key, return_inverse=True, return_counts=True)
    if places.size < _LEAST_FREQUENCIES:
        source.refuse_at(
            int(here[0]),
            FREQUENCY if source.has(FREQUENCY) else OMEGA,
            f"{places.size} frequencies at {temperature:g} deg C",
            f"at least {_LEAST_FREQUENCIES} per temperature",
        )
    mean = {q: np.bincount(inverse, values[here]) / counts for q, values in logs.items()}
    sweep = Sweep(T_C=temperature, x=np.bincount(inverse, log_f[here]) / counts, y=mean, here=here)
    if np.all(counts == 1):
        return sweep, []
    apart = max(2.0 * float(np.abs(logs[q][here] - mean[q][inverse]).max()) for q in logs)
    if apart <= _DISAGREEMENT:
        return sweep, []
    rows = source.rows[here]
    return sweep, [
        f"several sweeps at {temperature:g} deg C (rows {rows.min()} to {rows.max()}) differ by up "
        f"to {apart:.2g} decades at one frequency; their geometric mean is used"
    ]


def one_sweep(source: Table) -> tuple[pd.DataFrame, float | None]:
    """Points of a table at one temperature (``row, frequency_Hz`` and the quantities) and that."""
    f = _frequency(source)
    values = {name: source.numbers(name) for name in QUANTITIES if source.has(name)}
    if np.unique(f).size < _LEAST_FREQUENCIES:
        source.refuse_at(
            0,
            FREQUENCY if source.has(FREQUENCY) else OMEGA,
            f"{np.unique(f).size} frequencies",
            f"at least {_LEAST_FREQUENCIES}",
        )
    T = float(source.numbers("T_C")[0]) if source.has("T_C") else None
    return pd.DataFrame({"row": source.rows, FREQUENCY: f, **values}), T
