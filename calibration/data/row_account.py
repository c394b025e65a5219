"""What became of every row of a table: used, or left out for a reason that is said."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby

from materials.arrays import BoolArray, IntArray

_MOST_RANGES = 8  # ranges of rows that are spelt out; the rest is counted


@dataclass(frozen=True, kw_only=True)
class LeftOut:
    """Rows that a fit does not use, and why.

    Parameters
    ----------
    rows : tuple of int
        Row numbers as a user would find them.
    reason : str
    """

    rows: tuple[int, ...]
    reason: str

    def __str__(self) -> str:
        count = len(self.rows)
        return f"{count} row{'' if count == 1 else 's'} ({spelt(self.rows)}): {self.reason}"


def left_out(rows: IntArray, out: BoolArray, reason: str) -> tuple[LeftOut, ...]:
    """An entry for the rows where `out` is true; none when it is false everywhere."""
    chosen = tuple(int(row) for row in rows[out])
    return (LeftOut(rows=chosen, reason=reason),) if chosen else ()


def spelt(rows: Iterable[int]) -> str:
    """Row numbers as ranges, e.g. ``2-5, 9``."""
    ordered = sorted(rows)
    ranges = []
    for _, run in groupby(enumerate(ordered), key=lambda pair: pair[1] - pair[0]):
        numbers = [number for _, number in run]
        first, last = numbers[0], numbers[-1]
        ranges.append(f"{first}" if first == last else f"{first}-{last}")
    more = len(ranges) - _MOST_RANGES
    return ", ".join(ranges[:_MOST_RANGES]) + (f" and {more} ranges more" if more > 0 else "")
