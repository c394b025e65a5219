"""Where a stress-stretch test has its zero: a preload, or the permanent set of worked rubber.

Rubber that has been stretched before comes back to zero stress at a length of its own. Its later
cycles are those of a rubber of that length. With the set stretch ``lam_s`` at zero stress the
stretch is ``lam/lam_s``, and since the work per volume ``P dlam`` stays, the nominal stress is
``P lam_s`` in every mode (the section has shrunk by that).
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from calibration.data import Table
from materials.arrays import BoolArray, FloatArray, IndexArray, WordArray

Zero = Literal["none", "first", "loop"]

_UNDEFORMED = 0.01  # strain below which a first row counts as undeformed
_NEARLY_ZERO = 0.05  # share of the largest stress from which a path is extended to zero


@dataclass(frozen=True, kw_only=True)
class Zeroed:
    """Stretch and stress counted from the new zero.

    Parameters
    ----------
    stretch, stress : ndarray, shape (n,)
    valid : ndarray of bool, shape (n,)
        False where the stretch lies on the other side of the new zero.
    notes : list of str
        What was subtracted or divided by, for each mode.
    """

    stretch: FloatArray
    stress: FloatArray
    valid: BoolArray
    notes: list[str]


def zeroed(
    source: Table,
    stretch: FloatArray,
    stress: FloatArray,
    mode: WordArray,
    branches: WordArray | None,
    used: BoolArray,
    zero: Zero,
) -> Zeroed:
    """Move the zero of every mode; `used` are the rows of the chosen cycle."""
    stretch, stress = stretch.copy(), stress.copy()
    valid, notes = np.ones(stretch.size, dtype=bool), []
    for name in map(str, np.unique(mode[used])):
        here = np.flatnonzero(used & (mode == name))
        if zero == "first":
            first = int(here[0])
            offset = _offset(source, stretch, stress, first)
            stress[mode == name] -= offset
            notes.append(
                f"{name}: the stress of row {source.rows[first]}, {offset:g} N/mm^2, is subtracted"
            )
            continue
        side = float(np.sign(stretch[here[np.argmax(np.abs(stretch[here] - 1.0))]] - 1.0))
        at_zero = _zero_of_the_loop(source, stretch, stress, here, branches, name)
        stretch[mode == name] /= at_zero
        stress[mode == name] *= at_zero
        valid &= ~((mode == name) & ((stretch - 1.0) * side < -1e-9))
        notes.append(
            f"{name}: permanent set {at_zero - 1.0:.4g}; stretches are divided and stresses "
            f"multiplied by {at_zero:.6g}"
        )
    return Zeroed(stretch=stretch, stress=stress, valid=valid, notes=notes)


def _offset(source: Table, stretch: FloatArray, stress: FloatArray, first: int) -> float:
    if abs(stretch[first] - 1.0) > _UNDEFORMED:
        source.refuse_at(
            first,
            "stretch",
            f"{stretch[first]:g} in the first row of its mode",
            "the undeformed state there (1) to read the preload from",
        )
    return float(stress[first])


def _zero_of_the_loop(
    source: Table,
    stretch: FloatArray,
    stress: FloatArray,
    here: IndexArray,
    branches: WordArray | None,
    name: str,
) -> float:
    """Stretch at which the unloading path reaches zero stress."""
    back = here if branches is None else here[branches[here] == "unload"]
    if branches is None or back.size < 2:
        source.refuse(
            column="stretch",
            found=f"no unloading path of the {name} test",
            expected="a loop with load and unload (choose one with --cycle), or --zero first",
        )
    x, y = stretch[back], stress[back] * np.sign(stress[back][np.argmax(np.abs(stress[back]))])
    crossed = np.flatnonzero(y <= 0.0)
    last = int(crossed[0]) if crossed.size else x.size - 1
    if last == 0 or (not crossed.size and y[last] > _NEARLY_ZERO * y.max()):
        source.refuse_at(
            int(back[last]),
            "nominal_stress_N_per_mm2",
            f"{stress[back[last]]:g} where the {name} loop ends",
            "an unloading path that comes down to zero stress",
        )
    i, j = last - 1, last
    if y[i] == y[j]:
        return float(x[j])
    return float(x[j] + y[j] * (x[i] - x[j]) / (y[j] - y[i]))
