"""One case of a sweep, from the task to its folder; this is what a worker process executes.

A case is done when its folder holds the marker `sweep.json`, which names the case and the program
that made it. The marker is removed before anything is written and written after everything else,
so a worker may be killed at any moment. Meanwhile the folder has a checkpoint, from which another
worker or a resumed sweep goes on, to the same result.
"""

from __future__ import annotations

import json
import threading
import time
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fem import simulate
from fem.case.case import Case
from fem.files.atomic import write_text
from fem.files.machine_faults import cause, one_line
from fem.files.program_version import program_version
from fem.results.checkpoint import CHECKPOINT_FILE, remove_checkpoint
from fem.results.outcome import INTERRUPTED, NOT_CONVERGED, OK
from fem.results.output_folder import output_folder
from fem.results.result import CASE_FILE, FIGURES_FOLDER, RUN_FILES, missing_files, read_summary
from fem.results.resume import gone_on_with

RUNS_FOLDER = "runs"
MARKER = "sweep.json"
FAILURE_LOG = "failure.log"
#: Status of a case that raised an error or whose worker died.
FAILED = "failed"
#: A repetition with the same program would end in the same way.
FINAL = (OK, NOT_CONVERGED)

# A worker of a foreign cluster may have several threads; matplotlib and the BLAS setting allow one.
_ONE_AT_A_TIME = threading.Lock()
#: How long to wait for another worker that has the folder of a case [s].
_GIVEN_UP_S = 15.0


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
    """

    name: str
    case: Case
    folder: str
    version: str


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
        # Finished since the sweep began, by a worker that died before it could say so.
        if (earlier := finished_outcome(task)) is not None:
            return earlier
        # Of this thread only: a worker also talks to its scheduler meanwhile.
        wall, cpu = time.perf_counter(), time.thread_time()
        try:
            with _own_folder(task):
                summary = _simulated(task)
                timing = {"wall_s": time.perf_counter() - wall, "cpu_s": time.thread_time() - cpu}
                _mark(task, timing)
        except Exception as error:
            return _failure(task, error)
        return CaseOutcome(name=task.name, summary=summary, timing=timing)


def finished_outcome(task: SweepTask) -> CaseOutcome | None:
    """Outcome of an earlier run of the same case by the same program, None if there is none."""
    folder = Path(task.folder)
    try:
        marker = json.loads((folder / MARKER).read_text(encoding="utf-8"))
        same = (marker["case_hash"], marker["version"]) == (task.case.hash(), task.version)
        summary = read_summary(folder)
        complete = not missing_files(folder, task.case)
        timing = {str(key): float(value) for key, value in marker["timing"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    if not (same and complete and summary["status"] in FINAL):
        return None
    return CaseOutcome(name=task.name, summary=summary, timing=timing)


def forget(task: SweepTask, *, marker: bool = True, checkpoint: bool = True) -> None:
    """Remove the marker and the checkpoint of an earlier run."""
    if marker:
        (Path(task.folder) / MARKER).unlink(missing_ok=True)
    if checkpoint:
        remove_checkpoint(Path(task.folder) / CHECKPOINT_FILE)


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
    folder = Path(task.folder)
    # Again, since a worker may have died on this case a minute ago.
    forget(task, checkpoint=False)
    result = gone_on_with(simulate, task.case, folder / CHECKPOINT_FILE)
    if result.summary["status"] == INTERRUPTED:
        raise KeyboardInterrupt
    result.write(folder)
    if task.case.output.figures:
        # matplotlib takes a second to load.
        from validation.drawing.run_figures import write_run_figures

        write_run_figures(folder)
    (folder / FAILURE_LOG).unlink(missing_ok=True)
    if result.summary["status"] in FINAL:
        remove_checkpoint(folder / CHECKPOINT_FILE)
    # As it will be read again by a resumed sweep: the two tables have to be the same.
    return read_summary(folder)


def _sees_the_sweep(folder: Path) -> bool:
    """Whether the folder of all runs, which was made before runs were asked for, is there."""
    return folder.parent.is_dir()


def _mark(task: SweepTask, timing: dict[str, float]) -> None:
    marker = {"case_hash": task.case.hash(), "version": task.version, "timing": timing}
    write_text(Path(task.folder) / MARKER, json.dumps(marker, indent=2) + "\n")


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
