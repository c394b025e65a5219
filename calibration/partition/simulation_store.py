"""Simulations of sliding blocks that are kept: a second call with the same case reads its folder.

A folder is named after the case's hash. Those that are missing are simulated side by side; an
interrupted calibration goes on with what it has.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from fem.case import Case
from fem.results import OK, SURFACE, SURFACE_FILE, RunFolder, read_summary, read_table
from fem.sweeps import StudyError, simulate_missing
from materials.arrays import FloatArray

SIMULATIONS_FOLDER = "simulations"


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

    X: FloatArray
    T: FloatArray
    pressure: FloatArray
    mean_contact_pressure: float


@dataclass
class SimulationStore:
    """Runs cases, or reads them when they were run before.

    Parameters
    ----------
    directory : Path
        Folder of the runs.
    workers : int, optional
        How many are simulated at a time; by default one per core.
    say : callable, optional
        Called with a line for each simulation that has to be made; without it there is no bar.
    simulated : int
        Number of simulations that were made, not read.
    """

    directory: Path
    workers: int | None = None
    say: Callable[[str], None] | None = None
    simulated: int = field(default=0, init=False)

    def slides(self, wanted: Sequence[tuple[Case, str]]) -> list[Slide]:
        """Simulate cases, each with its name in words, or read their results.

        Raises
        ------
        SimulationStoppedError
            If one does not reach its end.
        KeyboardInterrupt
            If the user interrupts it.
        """
        folders = [self.directory.absolute() / case.hash()[:16] for case, _ in wanted]
        missing = {
            folder: (case, label)
            for folder, (case, label) in zip(folders, wanted, strict=True)
            if RunFolder(folder, case).finished() is None
        }
        for _, label in missing.values():
            self.simulated += 1
            if self.say is not None:
                self.say(f"simulation {self.simulated}, {label}")
        try:
            simulate_missing(
                {folder: case for folder, (case, _) in missing.items()},
                workers=self.workers,
                quiet=self.say is None,
            )
        except StudyError as error:
            raise SimulationStoppedError(f"simulation {error}") from None
        return [_read(folder, label) for folder, (_, label) in zip(folders, wanted, strict=True)]


def _read(folder: Path, label: str) -> Slide:
    """The slide as it stands in its files, so that a fresh and a kept one are the same number."""
    summary = read_summary(folder)
    if summary["status"] != OK:
        why = "; ".join(str(summary.get(key, "")) for key in ("reason", "advice"))
        raise SimulationStoppedError(f"the simulation of {label} is {summary['status']}: {why}")
    surface = read_table(folder / SURFACE_FILE, SURFACE)
    return Slide(
        X=surface["X_mm"].to_numpy(dtype=float),
        T=surface["T_C"].to_numpy(dtype=float),
        pressure=surface["pressure_N_per_mm2"].to_numpy(dtype=float),
        mean_contact_pressure=float(summary["mean_contact_pressure_N_per_mm2"]),
    )
