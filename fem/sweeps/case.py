"""One case of a sweep, from the task to its folder; this is what a worker process executes.

A case is done when its folder holds the finished run, which `RunFolder` says. The file that says so
is written last, so a worker may be killed at any moment. Meanwhile the folder has a checkpoint,
from which another worker or a resumed sweep goes on, to the same result.
"""

import threading
import time
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fem.case import Case
from fem.files import cause, one_line, program_version, write_text
from fem.results import (
    CASE_FILE,
    CHECKPOINT_FILE,
    FIGURES_FOLDER,
    FINAL,
    INTERRUPTED,
    RUN_FILES,
    CheckpointError,
    Result,
    RunFolder,
    output_folder,
    read_summary,
)
from fem.simulation import simulate

RUNS_FOLDER = "runs"
FAILURE_LOG = "failure.log"
#: Status of a case that raised an error or whose worker died.
FAILED = "failed"

# A worker of a foreign cluster may have several threads; matplotlib and the BLAS setting allow one.
_ONE_AT_A_TIME = threading.Lock()
#: How long to wait for another worker that has the folder of a case [s].
_GIVEN_UP_S = 15.0
#: Draws the figures of a run that is written into a folder, if they are not there.
Draw = Callable[[Path], None]


@dataclass(frozen=True, kw_only=True)
class SweepTask:
    """What a worker needs to know.

    Attributes
    ----------
    name : str
        Name of the case.
    case : Case
        The resolved case.
    folder : str
        Absolute path of the run's folder.
    version : str
        `program_version` of whoever asks for the run.
    draw : callable, optional
        Function of a module, which draws the figures of a folder.
    """

    name: str
    case: Case
    folder: str
    version: str = field(default_factory=program_version)
    draw: Draw | None = None

    @property
    def place(self) -> RunFolder:
        """The run's folder."""
        return RunFolder(Path(self.folder), self.case)


@dataclass(frozen=True, kw_only=True)
class CaseOutcome:
    """What a worker returns.

    Attributes
    ----------
    name : str
        Name of the case.
    summary : dict
        The run's summary; only `status` and `reason` where the case failed.
    timing : dict
        `wall_s` and `cpu_s` of the simulation with writing and drawing.
    """

    name: str
    summary: dict[str, Any]
    timing: dict[str, float] = field(default_factory=dict)


def run_task(task: SweepTask) -> CaseOutcome:
    """Simulate a case and write its folder; whatever goes wrong becomes an outcome.

    Raises
    ------
    KeyboardInterrupt
        If the user interrupts a simulation in this process; then nothing is written.
    """
    with _ONE_AT_A_TIME:
        # Of this thread only: a worker also talks to its scheduler meanwhile.
        wall, cpu = time.perf_counter(), time.thread_time()
        try:
            with _own_folder(task):
                # Finished since the sweep began, by a worker that died before it could say so.
                if (earlier := earlier_outcome(task)) is not None:
                    return CaseOutcome(name=task.name, summary=earlier)
                summary = _simulated(task)
                _draw(task)
        except Exception as error:
            return _failure(task, error)
        timing = {"wall_s": time.perf_counter() - wall, "cpu_s": time.thread_time() - cpu}
        return CaseOutcome(name=task.name, summary=summary, timing=timing)


def earlier_outcome(task: SweepTask) -> dict[str, Any] | None:
    """Summary of the finished run of the case by this program, its exports and figures written."""
    summary = task.place.finished()
    if summary is not None:
        task.place.export()
        _draw(task)
    return summary


def _draw(task: SweepTask) -> None:
    if task.draw is not None and task.case.output.figures:
        task.draw(Path(task.folder))


@contextmanager
def _own_folder(task: SweepTask) -> Iterator[None]:
    """Have the folder of a run to oneself, and without what a killed worker left half-written."""
    if program_version() != task.version:
        raise RuntimeError(
            f"the worker runs treadfem {program_version()}, the sweep was started by {task.version}"
        )
    folder = Path(task.folder)
    if not _sees_the_sweep(folder):
        raise RuntimeError(f"the worker does not see {task.folder}: it needs a shared disk")
    # A worker that was given up may need a moment to notice it.
    with output_folder(
        folder,
        files=(*RUN_FILES, CHECKPOINT_FILE),
        folders=[FIGURES_FOLDER],
        patience_s=_GIVEN_UP_S,
    ):
        yield


def _simulated(task: SweepTask) -> dict[str, Any]:
    place = task.place
    place.forget(checkpoint=False)
    result = _gone_on_with(task.case, place.checkpoint)
    if result.summary["status"] == INTERRUPTED:
        raise KeyboardInterrupt
    result.write(place.directory)
    (place.directory / FAILURE_LOG).unlink(missing_ok=True)
    if result.summary["status"] in FINAL:
        place.checkpoint.unlink(missing_ok=True)
    # As it will be read again by a resumed sweep: the two tables have to be the same.
    return read_summary(place.directory)


def _gone_on_with(case: Case, checkpoint: Path) -> Result:
    """Result of a case, from its checkpoint on if there is one that can be used."""
    try:
        return simulate(case, checkpoint=checkpoint, resume=True)
    except CheckpointError:
        checkpoint.unlink()
        return simulate(case, checkpoint=checkpoint)


def _sees_the_sweep(folder: Path) -> bool:
    """Whether the folder of all runs, which was made before runs were asked for, is there."""
    return folder.parent.is_dir()


def _failure(task: SweepTask, error: Exception) -> CaseOutcome:
    known = one_line(error) if isinstance(error, OSError | MemoryError) else ""
    reason = known or " ".join(f"{type(error).__name__}: {error}".split())
    folder = Path(task.folder)
    try:
        if _sees_the_sweep(folder):
            write_text(folder / CASE_FILE, task.case.to_toml())
            write_text(folder / FAILURE_LOG, traceback.format_exc())
    except OSError as unwritable:
        reason += f" (and its folder cannot be written: {cause(unwritable)})"
    return CaseOutcome(name=task.name, summary={"status": FAILED, "reason": reason})
