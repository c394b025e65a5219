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
from numpy.typing import NDArray

Array = NDArray[np.float64]
Branch = Literal["both", "load", "unload"]
BRANCHES = ("load", "unload")

_SAME_LEVEL = 0.02  # strain amplitudes within 2 % of the highest count as the highest level


def label_cycles(
    stretch: Array, *, hysteresis: float = 0.02
) -> tuple[NDArray[np.int64], NDArray[np.str_]]:
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
        "load" where the distance from the undeformed state grows, else "unload".
    """
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


def _turning_points(strain: Array, threshold: float) -> list[int]:
    """Indices where the direction changes by more than the threshold, with both ends."""
    turns, extreme, direction = [0], 0, 0
    for i in range(1, strain.size):
        change = strain[i] - strain[extreme]
        if direction == 0:
            if abs(change) > threshold:
                direction, extreme = int(np.sign(change)), i
        elif change * direction > 0.0:
            extreme = i
        elif abs(change) > threshold:
            turns.append(extreme)
            direction, extreme = -direction, i
    return [*turns, strain.size - 1] if turns[-1] != strain.size - 1 else turns


def last_full_cycle(
    stretch: Array, cycle: NDArray[np.int64], branch: NDArray[np.str_] | None
) -> int | None:
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
    stretch: Array,
    mode: NDArray[np.str_],
    cycle: NDArray[np.int64],
    branch: NDArray[np.str_] | None,
) -> tuple[NDArray[np.bool_], dict[str, int]]:
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
