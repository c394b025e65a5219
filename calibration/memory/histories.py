"""Stress histories of homogeneous tests, row by row as they were recorded."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
import pandas as pd
from scipy.interpolate import CubicSpline

from calibration.data import Table, left_out
from calibration.memory.spectrum import log_grid
from calibration.rubber import (
    STRESS,
    StressData,
    check_sign,
    check_zero,
    read_stress_table,
    stress_points,
)
from materials.arrays import BoolArray, FloatArray, IndexArray, WordArray
from materials.homogeneous import branch_histories, reduced_steps
from materials.hyperelastic_base import Mode
from materials.prony import Prony
from materials.wlf import WLF

_LEAST_ROWS = 5
_MOST_ROWS = 20_000  # of all tests; of longer records as many that follow their course
_SHORTEST = 1e-9  # of the longest test; shorter times between rows are the clock's


@dataclass(frozen=True, kw_only=True)
class History:
    """One test.

    Attributes
    ----------
    name, mode : str
    here : (n,) int array
        Its rows in the table, in the order of recording.
    time : (n,) float array or None
        Times [s], not falling; None where the order of the rows is all there is.
    stretch, stress : (n,) float array
        Stretch [-] and nominal stress [N/mm^2].
    T_C : (n,) float array or None
        Temperature [deg C].
    """

    name: str
    mode: Mode
    here: IndexArray
    time: FloatArray | None
    stretch: FloatArray
    stress: FloatArray
    T_C: FloatArray | None


@dataclass(frozen=True, kw_only=True)
class Histories:
    """All tests of a table.

    Attributes
    ----------
    tests : tuple of History
    table : Table
    compared : (n,) bool array
        Rows that a fit is compared with; the others load the rubber only.
    about : dict
        What became of the rows, for the parameter file.
    """

    tests: tuple[History, ...]
    table: Table
    compared: BoolArray
    about: dict[str, Any]

    @property
    def points(self) -> StressData:
        """Points that are compared, as a fit without memory takes them."""
        stretch, stress = np.empty((2, len(self.table)))
        mode = np.empty(len(self.table), dtype="<U16")
        for test in self.tests:
            stretch[test.here], stress[test.here] = test.stretch, test.stress
            mode[test.here] = test.mode
        at = self.compared
        return StressData(
            stretch=stretch[at],
            stress=stress[at],
            mode=mode[at],
            table=self.table.select(at),
            selection=self.about,
        )

    @property
    def time(self) -> FloatArray | None:
        """Times of all rows [s]; None of tests without."""
        if any(test.time is None for test in self.tests):
            return None
        return self.table.numbers("time_s")

    @property
    def names(self) -> WordArray:
        """Name of the test of each row that is compared."""
        names = np.empty(len(self.table), dtype=object)
        for test in self.tests:
            names[test.here] = test.name
        return names[self.compared].astype(str)


def read_histories(
    table: pd.DataFrame | str | Path,
    *,
    timed: bool = True,
    mode: Mode = "uniaxial",
    from_cycle: int | None = None,
) -> Histories:
    """Read the tests of a table.

    Parameters
    ----------
    table : DataFrame or path of a CSV file
        Columns ``stretch`` (or ``strain``, ``strain_percent``) and ``nominal_stress_N_per_mm2`` in
        the order of recording; ``time_s``, needed if `timed`; optional ``test`` (a name for each
        specimen, which begins at rest and virgin), ``mode``, ``T_C`` and ``cycle``.
    mode : str
        Mode of tests without a column for it.
    from_cycle : int, optional
        Rows of earlier cycles load the rubber and are not compared.
    """
    source, notes = read_stress_table(table, mode)
    if timed:
        source.require(("time_s",))
    columns = _columns(source)
    keep = np.ones(len(source), dtype=bool)
    if from_cycle is not None:
        source.require(("cycle",))
        keep = source.numbers("cycle") >= from_cycle
        if not keep.any():
            source.refuse(
                column="cycle", found="no row", expected=f"rows of the cycle {from_cycle} or later"
            )
    tests = tuple(_tests(source, columns))
    followed = np.zeros(len(source), dtype=bool)
    followed[np.concatenate([test.here for test in tests])] = True
    first = np.isin(np.arange(len(source)), [test.here[0] for test in tests])
    check_zero(source, np.where(first, columns["stretch"], np.nan), columns["stress"])
    check_sign(source.select(keep), columns["stretch"][keep], columns["stress"][keep])
    out = left_out(source.rows, ~keep, f"before the cycle {from_cycle}; they load the rubber")
    out += left_out(source.rows, keep & ~followed, "between rows that follow the long record")
    keep &= followed
    about = {
        "tests": [test.name for test in tests],
        "modes": sorted({test.mode for test in tests}),
        "rows_used": int(keep.sum()),
        "rows_left_out": [str(entry) for entry in out],
        "notes": notes,
    }
    return Histories(tests=tests, table=source, compared=keep, about=about)


def _columns(source: Table) -> dict[str, Any]:
    stretch, stress, mode = stress_points(source)
    if not np.any(stress):
        source.refuse_at(0, STRESS, "zero in every row", "stresses in N/mm^2, not all zero")
    names = source.frame["test"].astype(str).str.strip() if source.has("test") else None
    return {
        "stretch": stretch,
        "stress": stress,
        "mode": mode,
        "time": source.numbers("time_s") if source.has("time_s") else None,
        "T_C": source.numbers("T_C") if source.has("T_C") else None,
        "test": np.full(len(source), "") if names is None else names.to_numpy(dtype=str),
    }


def _tests(source: Table, columns: dict[str, Any]) -> list[History]:
    label = list(zip(columns["test"], columns["mode"], strict=True))
    several = len({mode for _, mode in label}) > 1
    found = []
    for test, mode in dict.fromkeys(label):
        here = np.flatnonzero((columns["test"] == test) & (columns["mode"] == mode))
        name = " ".join(filter(None, (test, mode if several or not test else "")))
        time, T_C = columns["time"], columns["T_C"]
        if time is not None:
            _refuse_falling(source, time, here)
        here = here[_following(columns["stretch"][here], columns["stress"][here], len(source))]
        if here.size < _LEAST_ROWS:
            source.refuse_at(
                int(here[-1]),
                "stretch",
                f"{here.size} rows of the test {name}",
                f"at least {_LEAST_ROWS} of each",
            )
        found.append(
            History(
                name=name,
                mode=cast(Mode, str(mode)),
                here=here,
                time=None if time is None else time[here],
                stretch=columns["stretch"][here],
                stress=columns["stress"][here],
                T_C=None if T_C is None else T_C[here],
            )
        )
    return found


def _following(stretch: FloatArray, stress: FloatArray, rows: int) -> IndexArray:
    """Rows that follow the course of a test of a long record: evenly in rows, strain and stress."""
    if rows <= _MOST_ROWS:
        return np.arange(stretch.size)
    travelled = np.linspace(0.0, 1.0, stretch.size)
    for values in (stretch, stress):
        way = np.append(0.0, np.cumsum(np.abs(np.diff(values))))
        travelled = travelled + way / max(way[-1], 1e-300)
    count = max(_LEAST_ROWS, stretch.size * _MOST_ROWS // rows)
    stops = np.linspace(0.0, travelled[-1], count)
    chosen: IndexArray = np.unique(np.searchsorted(travelled, stops).clip(max=stretch.size - 1))
    return chosen


def _refuse_falling(source: Table, time: FloatArray, here: IndexArray) -> None:
    steps = np.diff(time[here])
    if np.any(steps < 0.0):
        i = int(np.flatnonzero(steps < 0.0)[0])
        source.refuse_at(
            int(here[i + 1]),
            "time_s",
            f"{time[here[i + 1]]:g} after {time[here[i]]:g}",
            "times that do not fall (a column test tells several tests apart)",
        )
    if not np.any(steps > 0.0):
        source.refuse_at(int(here[0]), "time_s", "one time", "times that go on")


def time_range(data: Histories) -> tuple[float, float]:
    """Shortest time between rows and longest test [s]."""
    times = [test.time for test in data.tests if test.time is not None]
    steps = np.concatenate([np.diff(time) for time in times])
    longest = float(max(np.ptp(time) for time in times))
    return max(float(steps[steps > 0.0].min()), _SHORTEST * longest), longest


def branch_responses(
    data: Histories, tau_s: tuple[float, float], shift: WLF | None, T_ref_C: float
) -> Callable[[FloatArray], tuple[FloatArray, FloatArray]]:
    """Stress of branches of modulus 1 in the rows that are compared, and its slope by log tau.

    The histories are followed once, on a grid of relaxation times; a cubic spline in their
    logarithm lies between (its error is below 1e-5 of the stress).
    """
    nodes = log_grid(tau_s)
    spectrum = Prony(
        g=tuple(np.ones(nodes.size)), tau_s=tuple(np.exp(nodes)), shift=shift, T_ref_C=T_ref_C
    )
    stress = np.empty((len(data.table), nodes.size))
    for test in data.tests:
        assert test.time is not None
        h = reduced_steps(spectrum, test.time, None if shift is None else test.T_C)
        stress[test.here] = branch_histories(h, test.stretch, test.mode).stress
    curve = CubicSpline(nodes, stress[data.compared].T)
    slope = curve.derivative()
    return lambda log_tau: (curve(log_tau).T, slope(log_tau).T)
