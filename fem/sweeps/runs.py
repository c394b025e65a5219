"""Runs of many cases: read where they are finished, simulated side by side where they are not."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fem.case import Case, CaseError
from fem.results import Result, RunFolder
from fem.sweeps.case import FAILED, RUNS_FOLDER, SweepTask
from fem.sweeps.progress import SweepBar, SweepProgress
from fem.sweeps.study import StudyCase
from fem.sweeps.workers import executor, number_of_workers


@dataclass(frozen=True, kw_only=True)
class StudyRun:
    """A finished run of a study.

    Attributes
    ----------
    study_case : StudyCase
        What was run.
    result : Result
        What came out.
    """

    study_case: StudyCase
    result: Result

    def __getitem__(self, key: str) -> Any:
        """Value of a dotted case key in this run, e.g. ``run["loading.velocity_mm_per_s"]``."""
        value: Any = self.study_case.case.to_dict()
        for part in key.split("."):
            value = value[part]
        return value


class StudyError(RuntimeError):
    """A run of a study could not be made (an error, not a lack of convergence)."""


def study_runs(cases: Sequence[StudyCase], directory: str | Path) -> list[StudyRun]:
    """Finished runs of a study in ``DIR/runs/<case>``; what is missing is simulated there first.

    A sweep leaves its runs in the same place, so that figures find them. Missing runs are made
    side by side, like those of a sweep.

    Raises
    ------
    StudyError
        If a run raised an error; those that finished before it are kept.
    """
    runs = Path(directory).absolute() / RUNS_FOLDER
    simulate_missing({runs / study_case.name: study_case.case for study_case in cases})
    return [StudyRun(study_case=c, result=read_run(runs / c.name)) for c in cases]


def read_run(folder: Path) -> Result:
    """Result of a run that is finished.

    Raises
    ------
    CaseError
        If one of its files is damaged, in one line.
    """
    try:
        return Result.read(folder)
    except CaseError:
        raise
    except ValueError as error:
        expected = "what the run wrote (without summary.json it is run again)"
        raise CaseError(str(folder), "result", str(error), expected) from None


def simulate_missing(
    wanted: Mapping[Path, Case], *, workers: int | None = None, quiet: bool = False
) -> None:
    """Simulate the cases whose folders do not hold their runs, without drawing them.

    Parameters
    ----------
    wanted : mapping
        Absolute folders to what is to be in them.
    workers : int, optional
        Number of local processes; by default one per core. With 1 all is done in this process.
    quiet : bool
        Show no bar on a terminal.

    Raises
    ------
    StudyError
        If a run raised an error.
    """
    waiting = [
        SweepTask(name=folder.name, case=case, folder=str(folder))
        for folder, case in wanted.items()
        if RunFolder(folder, case).finished() is None
    ]
    if not waiting:
        return
    counts: Counter[str] = Counter()
    size = min(number_of_workers(workers, None), len(waiting))
    with executor(workers=size, scheduler=None) as execute, SweepBar() as bar:
        for task in waiting:
            Path(task.folder).parent.mkdir(parents=True, exist_ok=True)
        for outcome in execute(waiting):
            if outcome is not None:
                counts[outcome.summary["status"]] += 1
                if outcome.summary["status"] == FAILED:
                    raise StudyError(f"{outcome.name}: {outcome.summary['reason']}")
            done = counts.total()
            if not quiet:
                bar(SweepProgress(cases=len(waiting), done=done, earlier=0, status=dict(counts)))
