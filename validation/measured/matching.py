"""Which simulations belong to which measured tests: the same conditions, nearest in pressure."""

import numpy as np
import pandas as pd

from materials.arrays import BoolArray, IndexArray

#: Measured conditions and how far a simulation may be from them [-]. The mean contact pressure is a
#: result, which varies with friction; the others are inputs.
TOLERANCES = {"p_N_per_mm2": 0.15, "mean_pressure_N_per_mm2": 0.02, "v_mm_per_s": 0.02}
#: How far the start temperatures may be apart [K]: within it rises are compared, beyond it rubber
#: and friction are others.
START_TOLERANCE_K = 5.0
_PRESSURE = "p_N_per_mm2"
_WORDS = ("compound", "law")
#: Tests that are matched at a time.
_BATCH = 20_000


def matched(points: pd.DataFrame, runs: pd.DataFrame) -> tuple[IndexArray, IndexArray]:
    """Positions of the tests (k,) and of their simulations (k,), test by test.

    Of each variant it is the simulation nearest in contact pressure. What a test does not state
    (empty or NaN) excludes nothing, but of several blocks it is a test of all together.
    """
    tests, found = [np.empty(0, dtype=np.intp)], [np.empty(0, dtype=np.intp)]
    for first in range(0, len(points), _BATCH):
        test, run = np.nonzero(_fitting(points.iloc[first : first + _BATCH], runs))
        tests.append(first + test)
        found.append(run)
    return np.concatenate(tests), np.concatenate(found)


def _fitting(points: pd.DataFrame, runs: pd.DataFrame) -> BoolArray:
    """Whether a simulation (column) belongs to a test (row)."""
    fits = np.ones((len(points), len(runs)), dtype=bool)
    for name in _WORDS:
        stated, numbers = points[name], {word: i for i, word in enumerate(set(runs[name]))}
        code = stated.map(numbers).fillna(-1).to_numpy(dtype=int)[:, None]
        own = runs[name].map(numbers).to_numpy(dtype=int)
        fits &= (code == own) | (stated == "").to_numpy()[:, None]
    for name, tolerance in TOLERANCES.items():
        value = points[name].to_numpy(dtype=float)[:, None]
        distance = np.abs(runs[name].to_numpy(dtype=float) / value - 1.0)
        fits &= (distance <= tolerance) | np.isnan(value)
    block = runs["block"].to_numpy(dtype=float)
    fits &= (points["block"].to_numpy(dtype=float)[:, None] == block) | np.isnan(block)
    start = points["T_0_C"].to_numpy(dtype=float)[:, None]
    apart = np.abs(runs["T_0_C"].to_numpy(dtype=float) - start)
    fits &= apart <= START_TOLERANCE_K
    for columns in runs.reset_index().groupby("variant").indices.values():
        nearest = np.where(fits[:, columns], apart[:, columns], np.inf).min(axis=1)
        fits[:, columns] &= apart[:, columns] <= nearest[:, None]
    return _nearest_in_pressure(fits, points, runs)


def _nearest_in_pressure(fits: BoolArray, points: pd.DataFrame, runs: pd.DataFrame) -> BoolArray:
    """For tests with a pressure the one simulation of each variant and velocity that is nearest."""
    pressure = points[_PRESSURE].to_numpy(dtype=float)[:, None]
    with_pressure = np.isfinite(pressure[:, 0])
    groups = runs.reset_index().groupby(["variant", "v_mm_per_s", "block"], dropna=False)
    for columns in groups.indices.values():
        if len(columns) < 2:
            continue
        own = fits[:, columns]
        distance = np.abs(runs[_PRESSURE].to_numpy(dtype=float)[columns] - pressure)
        nearest = np.where(own, distance, np.inf).argmin(axis=1)
        only = np.zeros_like(own)
        only[np.arange(len(own)), nearest] = own.any(axis=1)
        fits[:, columns] = np.where(with_pressure[:, None], only, own)
    return fits
