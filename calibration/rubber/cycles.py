"""Choice of the load cycle that a fit is made to.

The paper's rule: the last full cycle (loading and unloading) at the highest strain level, where the
softening by damage has mostly run out; for comparison, only its loading path. The stretch to
failure that ends a test has no unloading, so it never counts as a full cycle.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", section 2.2.
"""

from itertools import pairwise
from typing import Literal

import numpy as np

from materials.arrays import BoolArray, FloatArray, IntArray, WordArray

Branch = Literal["both", "load", "unload"]
BRANCHES = ("load", "unload")

_TOO_FEW_TO_TELL = 6  # rows
_SAME_LEVEL = 0.02  # strain amplitudes within 2 % of the highest count as the highest level


def label_cycles(stretch: FloatArray, *, hysteresis: float = 0.02) -> tuple[IntArray, WordArray]:
    """Number the cycles of a recorded test and name their branches.

    Parameters
    ----------
    stretch : ndarray, shape (n,)
        Stretch in the order of recording [-].
    hysteresis : float
        Share of the whole range of stretch that a reversal must exceed, so that noise makes none.

    Returns
    -------
    cycle : ndarray of int, shape (n,)
        1, 2, ...; a cycle begins where loading begins.
    branch : ndarray of str, shape (n,)
        "load" where the distance from the undeformed state grows, else "unload". A record that
        only rises or only falls and passes the undeformed state holds no return: a table sorted
        from compression to tension, all of it loading.
    """
    if _passes_through(stretch):
        return np.ones(stretch.size, dtype=np.int64), np.full(stretch.size, "load", dtype="<U6")
    strain = np.abs(stretch - 1.0)
    turns = _turning_points(strain, hysteresis * float(np.ptp(strain)))
    branch = np.empty(stretch.size, dtype="<U6")
    cycle = np.empty(stretch.size, dtype=np.int64)
    number = 0
    for first, last in pairwise(turns):
        rising = strain[last] > strain[first]
        number += int(rising or number == 0)
        branch[first : last + 1] = "load" if rising else "unload"
        cycle[first : last + 1] = number
    return cycle, branch


def is_in_order_of_recording(stretch: FloatArray) -> bool:
    """Whether the stretch runs up and down as in a test, rather than from row to row at random.

    Nor are tables sorted by the stretch recorded, in which a loop has two rows at every stretch.
    """
    if stretch.size < _TOO_FEW_TO_TELL:
        return True
    steps = np.diff(stretch)
    if np.all(steps >= 0.0) or np.all(steps <= 0.0):
        return bool(np.count_nonzero(steps == 0.0) < 0.25 * steps.size)
    turns = _turning_points(stretch, 0.02 * float(np.ptp(stretch)))
    return len(turns) - 2 <= stretch.size / 3.0


def _passes_through(stretch: FloatArray) -> bool:
    """Whether the stretch goes from compression to tension (or back) without a turn."""
    steps = np.diff(stretch)
    one_way = bool(np.all(steps >= 0.0) or np.all(steps <= 0.0))
    return one_way and bool(stretch.min() < 1.0 < stretch.max())


def _turning_points(values: FloatArray, threshold: float) -> list[int]:
    """Indices where the direction changes by more than the threshold, with both ends."""
    turns, extreme, direction = [0], 0, 0
    strain = values.tolist()  # plain numbers: this loop is the slow part of a million rows
    for i in range(1, len(strain)):
        change = strain[i] - strain[extreme]
        if direction == 0:
            if abs(change) > threshold:
                direction, extreme = (1 if change > 0.0 else -1), i
        elif change * direction > 0.0:
            extreme = i
        elif abs(change) > threshold:
            turns.append(extreme)
            direction, extreme = -direction, i
    return [*turns, len(strain) - 1] if turns[-1] != len(strain) - 1 else turns


def last_full_cycle(stretch: FloatArray, cycle: IntArray, branch: WordArray | None) -> int | None:
    """Number of the last full cycle at the highest strain level.

    Parameters
    ----------
    stretch : ndarray, shape (n,)
        Stretch [-].
    cycle : ndarray of int, shape (n,)
    branch : ndarray of str, shape (n,), optional
        "load" or "unload"; without it every cycle counts as full.

    Returns
    -------
    int or None
        None when no cycle is full.
    """
    numbers = np.unique(cycle)
    if branch is not None:
        numbers = np.array(
            [n for n in numbers if set(BRANCHES) <= set(branch[cycle == n])], dtype=np.int64
        )
    if not numbers.size:
        return None
    level = np.array([np.abs(np.log(stretch[cycle == n])).max() for n in numbers])
    return int(numbers[level >= (1.0 - _SAME_LEVEL) * level.max()].max())


def in_last_full_cycle(
    stretch: FloatArray,
    mode: WordArray,
    cycle: IntArray,
    branch: WordArray | None,
) -> tuple[BoolArray, dict[str, int]]:
    """Mask of the rows in the last full cycle of each mode, and its number by mode."""
    keep = np.zeros(stretch.size, dtype=bool)
    chosen = {}
    for name in np.unique(mode):
        here = np.flatnonzero(mode == name)
        part = None if branch is None else branch[here]
        number = last_full_cycle(stretch[here], cycle[here], part)
        if number is not None:
            chosen[str(name)] = number
            keep[here[cycle[here] == number]] = True
    return keep, chosen
