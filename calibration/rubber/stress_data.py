"""The points of a stress-stretch table that a fit is made to, with an account of every row."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pandas as pd

from calibration.data import LeftOut, Table, left_out, read_table
from calibration.rubber.cycles import (
    BRANCHES,
    Branch,
    in_last_full_cycle,
    is_in_order_of_recording,
    label_cycles,
)
from calibration.rubber.stress_checks import STRESS, check_points, check_sign, check_zero
from calibration.rubber.stress_models import Kinematics
from calibration.rubber.stress_zero import Zero, zeroed
from materials import plausible as quantities
from materials.arrays import BoolArray, FloatArray, IntArray, WordArray
from materials.hyperelastic import MODES

Cycle = int | Literal["last-full", "all"] | None

COLUMNS = ("stretch", STRESS, "mode")


@dataclass(frozen=True, kw_only=True)
class StressData:
    """The points a hyperelastic fit is made to, and how they were chosen.

    Parameters
    ----------
    stretch, stress : ndarray, shape (n,)
        Stretch [-] and nominal stress [N/mm^2].
    mode : ndarray of str, shape (n,)
    table : Table
        The rows behind the points.
    selection : dict
        Cycle, branch, window, modes and zero, and what became of all rows, for the parameter file.
    """

    stretch: FloatArray
    stress: FloatArray
    mode: WordArray
    table: Table
    selection: dict[str, Any]

    @property
    def kinematics(self) -> Kinematics:
        return Kinematics.of(self.stretch, self.mode)

    @property
    def window(self) -> dict[str, tuple[float, float]]:
        """Lowest and highest stretch by mode."""
        return {
            str(name): (
                float(self.stretch[self.mode == name].min()),
                float(self.stretch[self.mode == name].max()),
            )
            for name in np.unique(self.mode)
        }

    @property
    def largest_stretch(self) -> float:
        """Largest principal stretch of all tests, that across a compressed one included [-]."""
        across = self.stretch**-self.kinematics.transverse
        return float(max(self.stretch.max(), across.max()))


def select_data(
    table: pd.DataFrame | str | Path,
    *,
    cycle: Cycle = None,
    branch: Branch = "both",
    window: tuple[float, float] | None = None,
    modes: Sequence[str] | None = None,
    zero: Zero = "none",
) -> StressData:
    """Read, check and choose the points of a fit (see `calibration.fit_hyperelastic`)."""
    source, notes = read_stress_table(table, modes[0] if modes and len(modes) == 1 else None)
    stretch, stress, mode = stress_points(source)
    if zero == "none":
        check_zero(source, stretch, stress)
    account = _Account(source)
    if modes is not None:
        account.keep_where(_of_modes(mode, modes), "of another mode")
    chosen, branches, label = _chosen_cycle(source, stretch, mode, cycle, branch)
    account.keep_where(chosen, "of another cycle")
    if zero != "none":
        moved = zeroed(source, stretch, stress, mode, branches, account.keep, zero)
        stretch, stress = moved.stretch, moved.stress
        notes += moved.notes
        account.keep_where(moved.valid, "shorter than the permanent set")
    if branch != "both":
        account.keep_where(_on_path(source, branches, branch), f"not on the {branch} path")
    if window is not None:
        inside = _in_window(source, stretch, account.keep, window)
        account.keep_where(inside, f"outside the window {window[0]:g} to {window[1]:g}")
    data = _used(source, stretch, stress, mode, account.keep)
    selection = {
        "cycle": label,
        "branch": branch,
        "window": list(window) if window is not None else "all",
        "modes": sorted({str(name) for name in data.mode}),
        "zero": zero,
        "rows_used": len(data.table),
        "rows_left_out": [str(entry) for entry in account.out],
        "notes": notes,
    }
    return replace(data, selection=selection)


def stress_points(source: Table) -> tuple[FloatArray, FloatArray, WordArray]:
    """Stretch, nominal stress [N/mm^2] and mode of every row, checked."""
    stretch, mode = source.numbers("stretch", quantities.STRETCH), source.words("mode", MODES)
    stress = source.numbers(STRESS, quantities.STRESS)
    check_points(source, stretch, stress, mode)
    return stretch, stress, mode


def _on_path(source: Table, branches: WordArray | None, branch: Branch) -> BoolArray:
    if branches is None:
        source.refuse(found="no column branch", expected=f"one to choose the {branch} path by")
    return np.asarray(branches == branch)


def _of_modes(mode: WordArray, modes: Sequence[str]) -> BoolArray:
    unknown = [name for name in modes if name not in MODES]
    if unknown:
        raise ValueError(f"modes holds {unknown[0]!r}; expected some of {', '.join(MODES)}")
    return np.isin(mode, list(modes))


def _used(
    source: Table, stretch: FloatArray, stress: FloatArray, mode: WordArray, keep: BoolArray
) -> StressData:
    """The rows that are kept, if they can be fitted to."""
    used, stretch, stress = source.select(keep), stretch[keep], stress[keep]
    if not len(used):
        source.refuse(found="no row that the selection keeps", expected="some data to fit to")
    if not np.any(stress):
        used.refuse_at(0, STRESS, "zero in every row", "stresses in N/mm^2, not all zero")
    check_sign(used, stretch, stress)
    return StressData(stretch=stretch, stress=stress, mode=mode[keep], table=used, selection={})


class _Account:
    """Which rows are still in, and why the others are not."""

    def __init__(self, source: Table) -> None:
        self.rows = source.rows
        self.keep = np.ones(len(source), dtype=bool)
        self.out: list[LeftOut] = []

    def keep_where(self, chosen: BoolArray, reason: str) -> None:
        self.out += left_out(self.rows, self.keep & ~chosen, reason)
        self.keep = self.keep & chosen


def read_stress_table(
    table: pd.DataFrame | str | Path, mode: str | None
) -> tuple[Table, list[str]]:
    """The table with the columns of a fit; strains become stretches, and that is said.

    `mode` is that of tables without a column for it.
    """
    source, notes = read_table(table, (STRESS,)), []
    frame = source.frame
    for column, factor in (("strain", 1.0), ("strain_percent", 0.01)):
        if source.has(column) and not source.has("stretch"):
            frame = frame.assign(stretch=1.0 + factor * source.numbers(column))
            notes.append(f"the stretch is 1 + {column}" + ("" if factor == 1.0 else "/100"))
    if not source.has("mode") and mode is not None:
        frame = frame.assign(mode=mode)
        notes.append(f"no column mode: every row is {mode}, as --mode says")
    if frame is not source.frame:
        frame.attrs = source.frame.attrs
        source = replace(source, frame=frame)
    source.require(COLUMNS)
    return source, notes


def _chosen_cycle(
    source: Table, stretch: FloatArray, mode: WordArray, wanted: Cycle, branch: Branch
) -> tuple[BoolArray, WordArray | None, str]:
    """BoolArray of the chosen cycle, the branches, and a label of the choice."""
    branches = source.words("branch", BRANCHES) if source.has("branch") else None
    everything = np.ones(stretch.size, dtype=bool)
    if source.has("cycle"):
        cycles = source.numbers("cycle")
        source.require_all("cycle", cycles == np.round(cycles), "a whole number")
        number = cycles.astype(np.int64)
        if branches is None:
            _, branches = _labelled(source, stretch, mode, number, strict=branch != "both")
    elif wanted not in (None, "all") or (branch != "both" and branches is None):
        number, branches = _labelled(source, stretch, mode, None, strict=True)
    else:
        return everything, branches, "all"
    if wanted == "all" or (wanted is None and not source.has("cycle")):
        return everything, branches, "all"
    if isinstance(wanted, int):
        if wanted not in number:
            found = f"the cycles {', '.join(map(str, np.unique(number)))}"
            source.refuse(column="cycle", found=found, expected=f"the cycle {wanted}")
        return number == wanted, branches, str(wanted)
    keep, by_mode = in_last_full_cycle(stretch, mode, number, branches)
    if not by_mode and wanted is not None:
        found = "no cycle with both a load and an unload branch"
        source.refuse(column="cycle", found=found, expected="a full cycle, or cycle = all")
    without = [str(name) for name in np.unique(mode) if name not in by_mode]
    keep |= np.isin(mode, without)  # their rows are what there is of these tests
    label = ", ".join(f"{name} {cycle}" for name, cycle in by_mode.items())
    label = f"last full cycle at the highest strain ({label})" if label else ""
    other = f"all of {', '.join(without)}, which has no full cycle" if without else ""
    return keep, branches, "; ".join(filter(None, (label, other)))


def _labelled(
    source: Table,
    stretch: FloatArray,
    mode: WordArray,
    cycles: IntArray | None,
    *,
    strict: bool,
) -> tuple[IntArray, WordArray]:
    """Cycles (where not given) and branches from the course of the stretch, mode by mode."""
    number = np.zeros(stretch.size, dtype=np.int64) if cycles is None else cycles
    found, branches = number.copy(), np.empty(stretch.size, dtype="<U6")
    for name in np.unique(mode):
        for one in np.unique(number[mode == name]):
            here = np.flatnonzero((mode == name) & (number == one))
            if strict and not is_in_order_of_recording(stretch[here]):
                source.refuse_at(
                    int(here[0]),
                    "stretch",
                    f"{name} rows that are in no order of recording",
                    "rows as they were recorded, or a column branch, to tell load from unload",
                )
            label, branches[here] = label_cycles(stretch[here])
            if cycles is None:
                found[here] = label
    return found, branches


def _in_window(
    source: Table, stretch: FloatArray, keep: BoolArray, window: tuple[float, float]
) -> BoolArray:
    low, high = window
    if not 0.0 < low < high:
        raise ValueError(f"window is {low:g} to {high:g}; expected two rising stretches above 0")
    if low >= 1.0:
        compressed = keep & (stretch < 1.0 - 1e-9)
        expected = f"tension only (1 or more), as the window {low:g} to {high:g} asks for"
        source.require_all("stretch", ~compressed, expected)
    return np.asarray((stretch >= low) & (stretch <= high))
