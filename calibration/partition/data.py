"""Measured surface temperatures of sliding blocks, for the identification of the heat partition.

A row is a slide with its highest interior temperature, or a point of a temperature profile.
Rows of the same pressure and velocity belong to one condition, which one simulation stands for.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from calibration.data import Table, read_table
from calibration.partition.loading import loading_keys
from fem.case import Case, CaseError
from fem.results import EDGE_ZONE, interior_peak
from materials.arrays import FloatArray, IndexArray

#: What of a measured profile is compared: every point, or its highest interior temperature.
ProfileUse = Literal["whole", "peak"]

PLATEN, CONTACT = "mean_pressure_N_per_mm2", "p_N_per_mm2"
VELOCITY = "v_mm_per_s"
_SIGMAS = ("sigma_K", "sigma")
_PLACES = ("X_mm", "x_mm")
#: A profile needs that many points to have an interior peak.
FEWEST_POINTS = 5


@dataclass(frozen=True, kw_only=True)
class Condition:
    """Measurements at one pressure and one velocity.

    Attributes
    ----------
    pressure : float
        As the table states it [N/mm^2].
    of_contact : bool
        Whether that is the mean contact pressure; otherwise it is the pressure on the block's top.
    velocity : float
        Sliding velocity [mm/s].
    rows : (n,) int array
        Rows of the table (counted from 0) behind the observations.
    X : (n,) float array or None
        Places of the observations from the trailing corner [mm]; None for highest temperatures.
    observed : (n,) float array
        Temperatures [deg C].
    sigma : (n,) float array or None
        Their standard deviations [K].
    """

    pressure: float
    of_contact: bool
    velocity: float
    rows: IndexArray
    X: FloatArray | None
    observed: FloatArray
    sigma: FloatArray | None

    @property
    def name(self) -> str:
        """For messages."""
        return f"p = {self.pressure:g} N/mm^2, v = {self.velocity:g} mm/s"

    @property
    def weights(self) -> FloatArray:
        """Factors of the residuals (n,) [1/K]; one where no deviation is known."""
        return np.ones(self.observed.size) if self.sigma is None else 1.0 / self.sigma


@dataclass(frozen=True, kw_only=True)
class PartitionData:
    """A checked table of surface temperatures.

    Attributes
    ----------
    table : Table
        Where it came from.
    conditions : tuple of Condition
        In the order of the table.
    quantity : {"T_max_C", "T_C"}
        What the observations are: highest interior temperatures or points of profiles.
    """

    table: Table
    conditions: tuple[Condition, ...]
    quantity: Literal["T_max_C", "T_C"]

    @property
    def has_sigma(self) -> bool:
        """Whether every observation has a standard deviation."""
        return all(condition.sigma is not None for condition in self.conditions)


def read_partition_data(
    source: str | Path | pd.DataFrame, case: Case, *, profile: ProfileUse = "whole"
) -> PartitionData:
    """Read and check surface temperatures measured on sliding blocks.

    Parameters
    ----------
    source : path or DataFrame
        Columns `mean_pressure_N_per_mm2` (on the top of the block) or `p_N_per_mm2` (mean contact
        pressure); `v_mm_per_s`; `T_max_C`, or `T_C` with `X_mm` (or `x_mm`: position on the bottom
        from its trailing corner) and optionally `run`; optionally `sigma_K`. With both pressures
        that on the top counts, since it is what was set.
    case : Case
        The block that slid; its ambient temperature is the one at the start.
    profile : {"whole", "peak"}
        What of a profile is compared. The leading fifth of the bottom is left out either way.

    Raises
    ------
    DataError
        Naming file, row, column, what was found and what was expected.
    """
    table = read_table(source, [VELOCITY])
    pressure = PLATEN if table.has(PLATEN) else CONTACT
    table.require([pressure])
    quantity: Literal["T_max_C", "T_C"] = "T_max_C" if table.has("T_max_C") else "T_C"
    place = next((name for name in _PLACES if table.has(name)), "X_mm")
    table.require(["T_max_C"] if not table.has("T_C") else [quantity])
    if quantity == "T_C":
        table.require([place])
    _check_loading(table, pressure, case)
    T = _temperatures(table, quantity, case)
    deviation = next((name for name in _SIGMAS if table.has(name)), None)
    sigma = None if deviation is None else table.numbers(deviation)
    if deviation is not None and sigma is not None:
        table.require_all(deviation, sigma > 0.0, "a standard deviation above 0 K")
    conditions = tuple(
        Condition(
            pressure=float(p),
            of_contact=pressure == CONTACT,
            velocity=float(v),
            rows=rows,
            X=None,
            observed=T[rows],
            sigma=None if sigma is None else sigma[rows],
        )
        for (p, v), rows in _groups(table, [pressure, VELOCITY])
    )
    if quantity == "T_C":
        conditions = tuple(_with_profile(c, table, place, case, profile) for c in conditions)
        quantity = "T_C" if profile == "whole" else "T_max_C"
    if len({condition.pressure for condition in conditions}) < 2:
        expected = "at least 2 different ones for the power law of eq. (14)"
        table.refuse_at(-1, pressure, "1 pressure", expected)
    return PartitionData(table=table, conditions=conditions, quantity=quantity)


def _check_loading(table: Table, pressure: str, case: Case) -> None:
    """Refuse the first row that no case can be made of."""
    p, v = table.numbers(pressure), table.numbers(VELOCITY)
    for _, rows in _groups(table, [pressure, VELOCITY]):
        first = int(rows[0])
        try:
            case.with_overrides(loading_keys(case, float(p[first]), float(v[first])))
        except CaseError as error:
            column = VELOCITY if "velocity" in error.key else pressure
            table.refuse_at(first, column, error.found, error.expected)


def _temperatures(table: Table, column: str, case: Case) -> FloatArray:
    T, ambient = table.numbers(column), case.heat.ambient_C
    if column == "T_max_C":
        table.require_all(
            column, np.greater(T, ambient), f"more than the case's ambient_C = {ambient:g}"
        )
    return T


def _groups(table: Table, columns: list[str]) -> Iterator[tuple[tuple[float, ...], NDArray]]:
    """Rows with the same values, in the order they first appear."""
    values = pd.DataFrame({name: table.numbers(name) for name in columns})
    for rows in values.groupby(columns, sort=False).indices.values():
        first = np.sort(np.asarray(rows, dtype=np.intp))
        yield tuple(values.iloc[first[0]].tolist()), first


def _with_profile(
    condition: Condition, table: Table, place: str, case: Case, use: ProfileUse
) -> Condition:
    """The condition with its profiles, checked, as points or as highest temperatures."""
    X, length = table.numbers(place), case.block.length_mm
    inside = np.abs(X / length - 0.5) <= 0.501
    table.require_all(place, inside, f"a position on the bottom, 0 to {length:g} mm")
    runs = _runs(table, condition.rows)
    kept: list[IndexArray] = []
    peaks: list[float] = []
    for rows in runs:
        _check_profile(table, place, X, rows)
        T = table.numbers("T_C")[rows]
        peaks.append(interior_peak(X[rows], T).T_max_C)
        kept.append(rows[X[rows] < (1.0 - EDGE_ZONE) * length])
        if not np.any(case.heat.ambient_C < T):
            found = f"at most {np.max(T):g} in {len(T)} rows"
            expected = f"a profile that exceeds the case's ambient_C = {case.heat.ambient_C:g}"
            table.refuse_at(int(rows[0]), "T_C", found, expected)
    if use == "peak":
        return _at_rows(condition, np.array([run[0] for run in runs]), np.array(peaks))
    whole = np.concatenate(kept)
    T = condition.observed[np.searchsorted(condition.rows, whole)]
    return replace(_at_rows(condition, whole, T), X=X[whole])


def _at_rows(condition: Condition, rows: IndexArray, observed: FloatArray) -> Condition:
    """The condition with other observations, which stand in some of its rows."""
    sigma = condition.sigma
    if sigma is not None:
        sigma = sigma[np.searchsorted(condition.rows, rows)]
    return replace(condition, rows=rows, observed=observed, sigma=sigma)


def _runs(table: Table, rows: IndexArray) -> list[IndexArray]:
    if not table.has("run"):
        return [rows]
    names = np.array([str(name).strip() for name in table.frame["run"]])[rows]
    return [rows[names == name] for name in dict.fromkeys(names.tolist())]


def _check_profile(table: Table, place: str, X: FloatArray, rows: IndexArray) -> None:
    if len(rows) < FEWEST_POINTS:
        table.refuse_at(
            int(rows[-1]), place, f"{len(rows)} points of a profile", f"at least {FEWEST_POINTS}"
        )
    back = np.flatnonzero(np.diff(X[rows]) <= 0.0)
    if back.size:
        table.refuse_at(
            int(rows[back[0] + 1]),
            place,
            f"{X[rows[back[0] + 1]]:g}",
            "a position ahead of the row before (a column run tells several profiles apart)",
        )
