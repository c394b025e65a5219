"""Measured velocity and pressure of a rig over time, which a phase of kind "record" follows."""

import hashlib
import warnings
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

import numpy as np

from materials.arrays import BoolArray, FloatArray

TIME, VELOCITY, PRESSURE = COLUMNS = ("time_s", "velocity_mm_per_s", "mean_pressure_N_per_mm2")
#: Shares of the largest pressure from which a block in air touches, and below which one on the road
#: is lifted; of means over a part of the record, so that noise around zero is no contact.
TOUCHES, LIFTED = 0.03, 0.01
_PARTS = 5000
#: A gap is a time between two rows of more than this many times the median.
_GAP = 20.0
#: Largest speed and pressure [mm/s], [N/mm^2].
_LARGEST = {VELOCITY: 1e5, PRESSURE: 1e3}
_LARGEST_FILE = 500_000_000


@dataclass(frozen=True, eq=False)
class Signal:
    """Velocity and pressure over time, linear between rows.

    Attributes
    ----------
    t : (n,) float array
        Times from 0 on [s].
    v, p : (n,) float arrays
        Velocity [mm/s] and mean pressure [N/mm^2].
    """

    t: FloatArray
    v: FloatArray
    p: FloatArray

    @property
    def duration(self) -> float:
        """From the first to the last row [s]."""
        return float(self.t[-1])

    @cached_property
    def path(self) -> FloatArray:
        """Way of the platen up to each row, back and forth [mm]."""
        return _integral(self.t, np.abs(self.v))

    @cached_property
    def position(self) -> FloatArray:
        """Displacement of the platen at each row [mm]."""
        return _integral(self.t, self.v)

    @cached_property
    def impulse(self) -> FloatArray:
        """Integral of the pressure up to each row [N s/mm^2]."""
        return _integral(self.t, self.p)

    def mean(self, integral: FloatArray, start: float, stop: float) -> float:
        """Mean of what has that integral between two times."""
        change = self.at(integral, stop) - self.at(integral, start)
        return change / (stop - start)

    def at(self, values: FloatArray, time: float) -> float:
        """Values of the rows at a time."""
        return float(np.interp(time, self.t, values))

    def contacts(self) -> list[tuple[float, float, bool]]:
        """Start and end of each stretch on the road and in air, and whether it is on the road."""
        on = self._on_road()
        changes = np.flatnonzero(np.diff(on)) + 1
        ends = [0.0, *self.t[changes].tolist(), self.duration]
        kinds = on[np.concatenate([[0], changes])].tolist()
        stretches = zip(ends[:-1], ends[1:], kinds, strict=True)
        return [(start, end, kind) for start, end, kind in stretches if end > start]

    def _on_road(self) -> BoolArray:
        """Whether the block is on the road at each row."""
        rows = max(len(self.p) // _PARTS, 1)
        share = uniform_mean(self.p, rows) / uniform_mean(self.p, rows).max()
        told = np.where(share > TOUCHES, 1, np.where(share < LIFTED, -1, 0))
        # Between the two shares it is where it was; at the start, in air.
        last = np.maximum.accumulate(np.where(told != 0, np.arange(told.size), -1))
        return np.where(last >= 0, told[last] == 1, False)


def uniform_mean(values: FloatArray, rows: int) -> FloatArray:
    """Moving mean over so many rows before and after each, fewer at the ends."""
    sums = np.concatenate([[0.0], np.cumsum(values)])
    n = values.size
    first = np.maximum(np.arange(n) - rows + 1, 0)
    end = np.minimum(np.arange(n) + rows, n)
    return np.asarray((sums[end] - sums[first]) / (end - first))


def _integral(t: FloatArray, values: FloatArray) -> FloatArray:
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(t)
    return np.concatenate([[0.0], np.cumsum(steps)])


def digest(path: str) -> str:
    """SHA-256 of a file; raises `ValueError` where it cannot be read."""
    try:
        if Path(path).stat().st_size > _LARGEST_FILE:
            raise ValueError("a file of more than 500 MB; expected a table of signals")
        return hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError as error:
        reason = "no such file" if isinstance(error, FileNotFoundError) else error.strerror
        raise ValueError(f"{path}: {reason}; expected a readable CSV file") from None


@lru_cache(maxsize=4)
def read_signal(path: str, sha256: str) -> Signal:
    """Read a table of signals.

    Parameters
    ----------
    path : str
        A CSV file with the columns time_s, velocity_mm_per_s, mean_pressure_N_per_mm2.
    sha256 : str
        Its digest, by which what was read before is known.

    Raises
    ------
    ValueError
        ``<what is wrong>; expected <what>``, in one line.
    """
    try:
        with Path(path).open(encoding="utf-8-sig") as file:
            names = [name.strip() for name in file.readline().split(",")]
            missing = [name for name in COLUMNS if name not in names]
            if missing:
                raise ValueError(f"{path} without {missing[0]}; expected {', '.join(COLUMNS)}")
            used = [names.index(name) for name in COLUMNS]
            with warnings.catch_warnings(action="ignore"):  # of no rows, which is said below
                rows = np.loadtxt(file, delimiter=",", usecols=used, ndmin=2, comments=None)
    except UnicodeDecodeError:
        raise ValueError(f"{path}: not UTF-8 text; expected a CSV file") from None
    except (ValueError, IndexError) as error:
        if "; expected " in str(error):
            raise
        raise ValueError(f"{path}: {error}; expected a number in every row") from None
    return _checked(path, rows)


def _checked(path: str, rows: FloatArray) -> Signal:
    if len(rows) < 2:
        raise ValueError(f"{path}: {len(rows)} rows; expected at least 2")
    wrong = np.argwhere(~np.isfinite(rows))
    if wrong.size:
        row, column = wrong[0]
        raise ValueError(
            f"{path}: {rows[row, column]} as {COLUMNS[column]} in row {row + 1}; "
            "expected a finite number"
        )
    t, v, p = rows.T
    steps = np.diff(t)
    if t[0] < 0.0:
        raise ValueError(f"{path}: time_s {t[0]:g} in row 1; expected times of 0 or more")
    if (steps <= 0.0).any():
        row = int(np.argmax(steps <= 0.0)) + 1
        found = f"time_s {t[row]:g} in row {row + 1} after {t[row - 1]:g}"
        raise ValueError(f"{path}: {found}; expected times that increase")
    if len(t) > 10 and steps.max() > _GAP * np.median(steps):
        row = int(np.argmax(steps)) + 1
        found = f"no row from {t[row - 1]:g} to {t[row]:g} s (row {row + 1})"
        raise ValueError(f"{path}: {found}; expected no gap of {_GAP:g} usual steps")
    _check_sizes(path, v, p)
    return Signal(t=t - t[0], v=v, p=p)


def _check_sizes(path: str, v: FloatArray, p: FloatArray) -> None:
    for name, values in ((VELOCITY, v), (PRESSURE, p)):
        row = int(np.argmax(np.abs(values)))
        if abs(values[row]) > _LARGEST[name]:
            found = f"{name} {values[row]:g} in row {row + 1}"
            raise ValueError(f"{path}: {found}; expected at most {_LARGEST[name]:g}")
    if not p.max() > 0.0:
        raise ValueError(f"{path}: no pressure above 0; expected a block on the road")
    lowest = int(np.argmin(p))
    if p[lowest] < -0.1 * p.max():
        found = f"{PRESSURE} {p[lowest]:g} in row {lowest + 1}"
        raise ValueError(f"{path}: {found}; expected 0 in air, but for noise")
    if not v.any():
        raise ValueError(f"{path}: {VELOCITY} is 0 throughout; expected a block that slides")
