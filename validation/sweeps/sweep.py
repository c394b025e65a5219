"""Sweeps: all cases of a study, in parallel, one row per case, resumable after any interruption."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path

from fem.case.errors import CaseError
from fem.files.program_version import program_version
from fem.results.output_folder import output_folder
from fem.results.result import SUMMARY_CSV
from fem.stepping.cost import refuse_unaffordable
from validation.sweeps.size import MANY_CASES, size_of_study
from validation.sweeps.study import StudyCase, number_of_cases, read_study
from validation.sweeps.sweep_case import RUNS_FOLDER, SweepTask, finished_outcome, forget
from validation.sweeps.sweep_progress import SweepProgress
from validation.sweeps.sweep_table import TIMINGS_CSV, SweepTable
from validation.sweeps.sweep_workers import executor, number_of_workers


def sweep(
    study: str | Path,
    directory: str | Path,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    resume: bool = False,
    progress: Callable[[SweepProgress], None] | None = None,
    confirm: Callable[[str], bool] | None = None,
    warn: Callable[[str], None] | None = None,
) -> SweepProgress:
    """Run all cases of a study file.

    Parameters
    ----------
    study : str or Path
        Study file, see `validation.sweeps.study`.
    directory : str or Path
        Folder for `summary.csv`, `timings.csv` and `runs/<case>/`. Workers on other machines have
        to see it under the same path.
    workers : int, optional
        Number of local processes, one thread each; by default one per core. With 1
        the cases run one after the other in this process.
    scheduler : str, optional
        Address of a running dask scheduler, used instead of local processes.
    resume : bool
        Keep cases that the same program has finished; otherwise all are run.
    progress : callable, optional
        Called with a `SweepProgress` when a case has finished, and some times a second.
    confirm : callable, optional
        Asked before a study of more than a thousand cases, with its size in words; without it (or
        if it says no) such a study is not begun.
    warn : callable, optional
        Called before anything runs with each sentence about unusual numbers of the cases.

    Returns
    -------
    SweepProgress
        The final counts.

    Raises
    ------
    CaseError
        If the study, the number of workers or the address is wrong, or the study too large;
        nothing is written then.
    TypeError
        If an argument is of another type.
    SchedulerLostError
        If the scheduler went away; what was finished is in the table.
    """
    workers = number_of_workers(workers, scheduler)
    if number_of_cases(study) > MANY_CASES:
        size = size_of_study(study, workers)
        if confirm is None or not confirm(size):
            expected = f"at most {MANY_CASES} cases, or --yes"
            raise CaseError(file=str(study), key="grid", found=size, expected=expected)
    cases = read_study(study)
    for case in cases:
        refuse_unaffordable(case.case)
    for sentence in dict.fromkeys(said for case in cases for said in case.case.warnings):
        if warn is not None:
            warn(sentence)
    with output_folder(
        directory, files=(SUMMARY_CSV, TIMINGS_CSV), folders=[RUNS_FOLDER]
    ) as folder:
        return _sweep(cases, folder.absolute(), workers, scheduler, resume, progress)


def _sweep(
    cases: list[StudyCase],
    directory: Path,
    workers: int,
    scheduler: str | None,
    resume: bool,
    progress: Callable[[SweepProgress], None] | None,
) -> SweepProgress:
    """Run the cases of a study in a folder that nobody else uses."""
    tasks = {
        case.name: SweepTask(
            name=case.name,
            case=case.case,
            folder=str(directory / RUNS_FOLDER / case.name),
            version=program_version(),
        )
        for case in cases
    }
    table = SweepTable(directory, cases)
    waiting = _take_finished(tasks, table, resume=resume)
    earlier = len(table.rows)

    def report() -> SweepProgress:
        state = SweepProgress(
            cases=len(tasks),
            done=len(table.rows),
            earlier=earlier,
            status=dict(Counter(row["status"] for row in table.rows.values())),
            warned=sum(bool(row.get("warnings")) for row in table.rows.values()),
        )
        if progress is not None:
            progress(state)
        return state

    with executor(workers=max(1, min(workers, len(waiting))), scheduler=scheduler) as execute:
        for task in tasks.values():
            forget(task, marker=task.name not in table.rows, checkpoint=not resume)
        (directory / RUNS_FOLDER).mkdir(exist_ok=True)
        table.write()
        report()
        for outcome in execute(waiting):
            if outcome is not None:
                table.add(tasks[outcome.name], outcome)
                table.write()
            report()
    return report()


def _take_finished(
    tasks: dict[str, SweepTask], table: SweepTable, *, resume: bool
) -> list[SweepTask]:
    """Put cases that are done already into the table and return the others."""
    waiting = []
    for task in tasks.values():
        outcome = finished_outcome(task) if resume else None
        if outcome is None:
            waiting.append(task)
        else:
            table.add(task, outcome)
    return waiting
