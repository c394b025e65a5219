"""Simulations of sliding blocks that are kept: a second call with the same case reads its folder.

A folder is named after the case's hash. It counts only when its marker, written last, names the
same case and the same program; so an interrupted calibration goes on with what it has.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem import simulate
from fem.case.case import Case
from fem.files.atomic import remove_remains, write_text
from fem.files.program_version import program_version
from fem.results.checkpoint import CHECKPOINT_FILE, remove_checkpoint
from fem.results.columns import SURFACE
from fem.results.outcome import INTERRUPTED, OK
from fem.results.result import SURFACE_FILE, missing_files, read_summary, read_table
from fem.results.resume import gone_on_with

Array = NDArray[np.float64]
SIMULATIONS_FOLDER = "simulations"
MARKER = "simulation.json"


class SimulationStoppedError(RuntimeError):
    """A simulation that did not get to its end; one line with the case, reason and advice."""


@dataclass(frozen=True, kw_only=True)
class Slide:
    """The bottom surface at the end of a simulated slide.

    Attributes
    ----------
    X, T, pressure : (m,) float array
        Reference coordinate from the trailing corner [mm], temperature [deg C], contact pressure
        [N/mm^2].
    mean_contact_pressure : float
        Mean over the sliding phase [N/mm^2].
    """

    X: Array
    T: Array
    pressure: Array
    mean_contact_pressure: float


@dataclass
class SimulationStore:
    """Runs cases, or reads them when they were run before.

    Parameters
    ----------
    directory : Path
        Folder of the runs.
    progress : callable, optional
        ``progress(label, case)`` gives the callback of a simulation that is about to start.
    simulated : int
        Number of simulations that were made, not read.
    """

    directory: Path
    progress: Callable[[str, Case], Callable[[Any], None] | None] | None = None
    simulated: int = field(default=0, init=False)

    def slide(self, case: Case, label: str) -> Slide:
        """Simulate a case, or read its result.

        Raises
        ------
        SimulationStoppedError
            If it does not reach its end.
        KeyboardInterrupt
            If the user interrupts it.
        """
        folder = self.directory / case.hash()[:16]
        marker = {"case_hash": case.hash(), "version": program_version()}
        if not _finished(folder, marker, case):
            self._simulate(case, label, folder)
            write_text(folder / MARKER, json.dumps(marker, indent=2) + "\n")
        return _read(folder)

    def _simulate(self, case: Case, label: str, folder: Path) -> None:
        (folder / MARKER).unlink(missing_ok=True)
        remove_remains(folder)
        callback = None if self.progress is None else self.progress(label, case)
        checkpoint = folder / CHECKPOINT_FILE
        result = gone_on_with(simulate, case, checkpoint, progress=callback)
        status = result.summary["status"]
        if status == INTERRUPTED:
            raise KeyboardInterrupt
        if status != OK:
            why = "; ".join(str(result.summary.get(key, "")) for key in ("reason", "advice"))
            raise SimulationStoppedError(f"the simulation of {label} is {status}: {why}")
        result.write(folder)
        remove_checkpoint(checkpoint)
        self.simulated += 1


def _finished(folder: Path, marker: dict[str, str], case: Case) -> bool:
    try:
        read_summary(folder)
        same = json.loads((folder / MARKER).read_text(encoding="utf-8")) == marker
    except (OSError, ValueError, RecursionError):
        return False
    return bool(same) and not missing_files(folder, case)


def _read(folder: Path) -> Slide:
    """The slide as it stands in its files, so that a fresh and a kept one are the same number."""
    surface = read_table(folder / SURFACE_FILE, SURFACE)
    return Slide(
        X=surface["X_mm"].to_numpy(dtype=float),
        T=surface["T_C"].to_numpy(dtype=float),
        pressure=surface["pressure_N_per_mm2"].to_numpy(dtype=float),
        mean_contact_pressure=float(read_summary(folder)["mean_contact_pressure_N_per_mm2"]),
    )
