"""Measurements of a sliding block, read from CSV: temperature profiles, or one row per test.

T_max and A_T of a measured profile come from the functions that the simulation uses, so that both
are judged by the same rule.

Files with a column ``x_mm`` hold profiles, a row per point: ``run, x_mm, T_C``, with ``x_mm`` from
the trailing to the leading corner. Others hold a row per test with at least one of ``T_max_C,
A_T_K_mm, friction_coefficient``. Both may say under which conditions: ``p_N_per_mm2`` (mean contact
pressure), ``mean_pressure_N_per_mm2`` (on top of the block), ``v_mm_per_s``, ``compound``, ``law``,
``T_0_C``, the temperature before the sliding, and of several blocks the ``block``, counted from
the trailing one, from whose trailing corner ``x_mm`` counts then.
"""

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from calibration.data import Table, read_table
from contact import FRICTION_LAWS
from fem.results import excess_area, interior_peak
from materials.arrays import FloatArray, IndexArray, IntArray

#: What is compared, with its unit.
QUANTITIES = {"T_max_C": "°C", "A_T_K_mm": "K mm", "friction_coefficient": "-"}
#: Temperature before the sliding where the file does not state it [deg C].
START_C = 20.0

#: `block` of a test of all blocks together.
ALL_BLOCKS = 0
#: Columns of numbers that a test has one value of.
_NUMBERS = (
    *("p_N_per_mm2", "mean_pressure_N_per_mm2", "v_mm_per_s", "T_0_C", "block"),
    *QUANTITIES,
)
#: Those that must be above zero.
_POSITIVE = ("v_mm_per_s", "friction_coefficient", "block")
_WORDS = ("run", "compound", "law")


@dataclass(frozen=True, kw_only=True)
class Profile:
    """A measured temperature profile of the bottom surface.

    Attributes
    ----------
    run : str
        Name of the test.
    X_mm : (n,) array
        Position from the trailing to the leading corner [mm].
    T_C : (n,) array
        Temperature [deg C].
    rows : (n,) int array
        Their rows in the file.
    """

    run: str
    X_mm: FloatArray
    T_C: FloatArray
    rows: IntArray = field(default_factory=lambda: np.empty(0, dtype=np.int64))


@dataclass(frozen=True, kw_only=True)
class Measurements:
    """What a file of measurements holds.

    Attributes
    ----------
    points : DataFrame
        A row per test: `run, compound, law` (empty where not stated), the conditions and
        `QUANTITIES` (NaN where not stated), `row` in the file.
    profiles : list of Profile
        In the order of `points`; empty for a file without profiles.
    file : str
        Name of the file.
    notes, unusual : tuple of str
        How the file was understood, and its numbers outside their usual range.
    """

    points: pd.DataFrame
    profiles: list[Profile]
    file: str
    notes: tuple[str, ...] = ()
    unusual: tuple[str, ...] = ()


def read_measurements(source: str | Path | pd.DataFrame) -> Measurements:
    """Read a file of measurements.

    Raises
    ------
    DataError
        With file, row, column, what was found and what was expected, in one line.
    """
    table = read_table(source, ())
    found = _profiles(table) if table.has("x_mm") else _points(table)
    return replace(found, notes=tuple(table.notes), unusual=tuple(table.unusual))


def _points(table: Table) -> Measurements:
    if not any(table.has(quantity) for quantity in QUANTITIES):
        # `require` says what the columns are; the first quantity stands for all.
        expected = f"x_mm and T_C (profiles), or one of {', '.join(QUANTITIES)}"
        found = f"the columns {', '.join(map(str, table.frame.columns))}"
        table.refuse(found=found, expected=expected)
    points = _conditions(table)
    measured = points[list(QUANTITIES)].notna().to_numpy().any(axis=1)
    if not measured.all():
        index = int(np.argmin(measured))
        column = next(quantity for quantity in QUANTITIES if table.has(quantity))
        table.refuse_at(index, column, "nothing", f"at least one of {', '.join(QUANTITIES)}")
    unnamed = points["run"] == ""
    points.loc[unnamed, "run"] = [f"row {row}" for row in points.loc[unnamed, "row"]]
    return Measurements(points=points, profiles=[], file=table.file)


def _profiles(table: Table) -> Measurements:
    table.require(("run", "x_mm", "T_C"))
    for column in ("T_max_C", "A_T_K_mm"):
        if table.has(column):
            found = f"{column} beside a profile"
            table.refuse(column=column, found=found, expected="it to be computed from the profile")
    T = table.numbers("T_C")
    X = table.numbers("x_mm")
    rows = _conditions(table)
    if (rows["run"] == "").any():
        table.refuse_at(int(np.argmax(rows["run"] == "")), "run", "nothing", "the name of the test")
    code, names = pd.factorize(rows["run"])
    order = np.argsort(code, kind="stable")
    runs = np.split(order, np.flatnonzero(np.diff(code[order])) + 1)
    first = np.array([index[0] for index in runs])
    _check_conditions(table, rows, first[code])
    points = rows.iloc[first].reset_index(drop=True)
    profiles = []
    for name, index in zip(names, runs, strict=True):
        _check_profile(table, index, X[index], str(name))
        profiles.append(Profile(run=str(name), X_mm=X[index], T_C=T[index], rows=table.rows[index]))
    values = [evaluated(p, T_0) for p, T_0 in zip(profiles, points["T_0_C"], strict=True)]
    points[list(values[0])] = pd.DataFrame(values)
    return Measurements(points=points, profiles=profiles, file=table.file)


def evaluated(profile: Profile, T_0_C: float = START_C) -> dict[str, float]:
    """T_max and A_T of a profile, by the rules of `fem.results.surface_profile`."""
    return {
        "T_max_C": interior_peak(profile.X_mm, profile.T_C).T_max_C,
        "A_T_K_mm": excess_area(profile.X_mm, profile.T_C, T_0_C),
    }


def _check_profile(table: Table, index: IndexArray, X: FloatArray, run: str) -> None:
    if len(index) < 2:
        table.refuse_at(int(index[0]), "x_mm", f"1 point of run {run}", "at least 2 points")
    falling = np.flatnonzero(np.diff(X) <= 0.0)
    if falling.size:
        at = int(falling[0])
        table.refuse_at(
            int(index[at + 1]),
            "x_mm",
            f"{X[at + 1]:g} after {X[at]:g} in run {run}",
            "x_mm to increase from the trailing to the leading corner",
        )


def _check_conditions(table: Table, rows: pd.DataFrame, first: IndexArray) -> None:
    """Refuse a condition that changes within a run; `first` is the first row of each row's run."""
    for column in rows.columns.drop("row"):
        values = rows[column].to_numpy()
        begin = values[first]
        differs = (values != begin) & ~(pd.isna(values) & pd.isna(begin))
        if differs.any():
            at = int(np.argmax(differs))
            found = f"{values[at]} after {begin[at]} in run {rows['run'].iloc[at]}"
            table.refuse_at(at, column, found, "one value per run")


def _conditions(table: Table) -> pd.DataFrame:
    """Every known column, checked; what the file does not state is empty or NaN."""
    columns: dict[str, object] = {
        name: _words(table.frame[name]) if table.has(name) else "" for name in _WORDS
    }
    frame = pd.DataFrame(columns, index=range(len(table)))
    unknown = ~frame["law"].isin(("", *FRICTION_LAWS)).to_numpy()
    if unknown.any():
        index = int(np.argmax(unknown))
        expected = f"one of {', '.join(FRICTION_LAWS)} or nothing"
        table.refuse_at(index, "law", repr(frame["law"].iloc[index]), expected)
    for name in _NUMBERS:
        frame[name] = _optional_numbers(table, name)
    unstated = int(frame["T_0_C"].isna().sum())
    if unstated:
        table.notes.append(f"T_0_C not stated in {unstated} rows: {START_C:g} deg C assumed")
        frame["T_0_C"] = frame["T_0_C"].fillna(START_C)
    frame["block"] = frame["block"].fillna(ALL_BLOCKS)
    frame["row"] = table.rows
    return frame


def _words(entries: pd.Series) -> NDArray[np.object_]:
    """The entries as words without surrounding spaces; empty where there is none."""
    code, names = pd.factorize(entries.astype(object).fillna(""))
    return np.array([str(name).strip() for name in names], dtype=object)[code]


def _optional_numbers(table: Table, column: str) -> FloatArray:
    """Values of a column, NaN where the entry is empty or there is no such column."""
    values = np.full(len(table), np.nan)
    if table.has(column):
        entries = table.frame[column]
        stated = np.asarray(_words(entries) != "", dtype=bool)
        if stated.any():
            own = table.select(stated)
            numbers = own.numbers(column)
            if column in _POSITIVE:
                own.require_all(column, numbers > 0.0, "a number above 0")
            values[stated] = numbers
    return values
