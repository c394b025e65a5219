"""The runs of a study: read where they are finished, simulated side by side where they are not."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from fem.case.case import Case
from fem.case.errors import CaseError
from fem.files.program_version import program_version
from fem.results.result import CASE_FILE, Result, missing_files, read_summary
from validation.sweeps.study import StudyCase, read_study
from validation.sweeps.sweep_case import FAILED, FINAL, SweepTask, forget
from validation.sweeps.sweep_progress import SweepBar, SweepProgress
from validation.sweeps.sweep_workers import executor, number_of_workers


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


def study_runs(study: str | Path, directory: str | Path) -> list[StudyRun]:
    """Finished runs of a study in ``DIR/runs/<case>``; what is missing is simulated there first.

    A sweep leaves its runs in the same place, so that figures find them. Missing runs are made
    side by side, like those of a sweep.

    Raises
    ------
    StudyError
        If a run raised an error; those that finished before it are kept.
    """
    cases = read_study(study)
    runs = Path(directory).absolute() / "runs"
    simulate_missing([(runs / study_case.name, study_case.case) for study_case in cases])
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
        raise CaseError(
            file=str(folder), key="result", found=str(error), expected=expected
        ) from None


def simulate_missing(wanted: Sequence[tuple[Path, Case]]) -> None:
    """Simulate the cases whose folders do not hold their runs, without drawing them.

    Raises
    ------
    StudyError
        If a run raised an error.
    """
    waiting = [
        SweepTask(
            name=folder.name,
            case=case.with_overrides({"output.figures": False}),
            folder=str(folder),
            version=program_version(),
        )
        for folder, case in wanted
        if not holds(folder, case)
    ]
    if not waiting:
        return
    counts: Counter[str] = Counter()
    workers = min(number_of_workers(None, None), len(waiting))
    with executor(workers=workers, scheduler=None) as execute, SweepBar() as bar:
        for task in waiting:
            forget(task, checkpoint=False)
            Path(task.folder).parent.mkdir(parents=True, exist_ok=True)
        for outcome in execute(waiting):
            if outcome is not None:
                counts[outcome.summary["status"]] += 1
                if outcome.summary["status"] == FAILED:
                    raise StudyError(f"{outcome.name}: {outcome.summary['reason']}")
            done = counts.total()
            bar(SweepProgress(cases=len(waiting), done=done, earlier=0, status=dict(counts)))


def holds(folder: Path, case: Case) -> bool:
    """Whether a folder holds the finished run of a case by this program, with fields."""
    try:
        summary = read_summary(folder)
        found = Case.from_toml(folder / CASE_FILE)
        complete = found.output.vtu and not missing_files(folder, found)
    except (CaseError, ValueError):
        # Written by a version with other keys, or damaged: it has to be run again.
        return False
    if summary["status"] not in FINAL or summary.get("program_version") != program_version():
        return False
    return complete and found == case.with_overrides(
        {f"output.{key}": value for key, value in found.to_dict()["output"].items()}
    )


def summary_table(runs: list[StudyRun]) -> pd.DataFrame:
    """One row per run: the grid's columns, then the summary."""
    return pd.DataFrame([run.study_case.overrides | run.result.summary for run in runs])
