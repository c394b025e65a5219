"""Sweeps: all cases of a study, in parallel, one row per case, resumable after any interruption."""

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from fem.case import Case, CaseError
from fem.results import SUMMARY_CSV, output_folder
from fem.stepping import duration, estimated_cost, refuse_unaffordable
from fem.sweeps.case import RUNS_FOLDER, CaseOutcome, Draw, SweepTask, earlier_outcome
from fem.sweeps.progress import SweepProgress
from fem.sweeps.study import Study, StudyCase, read_study
from fem.sweeps.table import TIMINGS_CSV, SweepTable
from fem.sweeps.workers import executor, number_of_workers

#: A study with more cases is not begun without being asked for.
MANY_CASES = 1000
#: How many cases are looked at for an estimate.
_SAMPLE = 20
#: Rough size of `fields.npz` and of the VTU files [bytes].
_FIELD_BYTES_PER_CELL_AND_SNAPSHOT = 200.0
_VTU_BYTES_PER_CELL_AND_SNAPSHOT = 700.0


@dataclass(frozen=True, kw_only=True)
class _Execution:
    """Where and how the cases of a sweep are run."""

    directory: Path
    workers: int
    scheduler: str | None
    resume: bool
    progress: Callable[[SweepProgress], None] | None
    draw: Draw | None


def sweep(
    study: str | Path,
    directory: str | Path,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    resume: bool = False,
    bases: Mapping[str, Path] | None = None,
    base: str | Path | None = None,
    draw: Draw | None = None,
    progress: Callable[[SweepProgress], None] | None = None,
    confirm: Callable[[str], bool] | None = None,
    warn: Callable[[str], None] | None = None,
) -> SweepProgress:
    """Run all cases of a study file.

    Parameters
    ----------
    study : str or Path
        Study file, see `fem.sweeps.study`.
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
    bases : mapping, optional
        Case files that the study may name by a word.
    base : str or Path, optional
        Another base case for the study's grid.
    draw : callable, optional
        Function of a module that draws the figures of a run's folder which are not there yet; it
        is called for cases with ``output.figures``.
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
    read = read_study(study, bases, base)
    if read.number > MANY_CASES:
        size = size_of_study(read, workers)
        if confirm is None or not confirm(size):
            expected = f"at most {MANY_CASES} cases, or --yes"
            raise CaseError(str(study), "grid", size, expected)
    cases = read.cases()
    for case in cases:
        refuse_unaffordable(case.case)
    for sentence in dict.fromkeys(said for case in cases for said in case.case.warnings):
        if warn is not None:
            warn(sentence)
    with output_folder(
        directory, files=(SUMMARY_CSV, TIMINGS_CSV), folders=[RUNS_FOLDER]
    ) as folder:
        how = _Execution(
            directory=folder.absolute(),
            workers=workers,
            scheduler=scheduler,
            resume=resume,
            progress=progress,
            draw=draw,
        )
        return _sweep(cases, how)


def _sweep(cases: list[StudyCase], how: _Execution) -> SweepProgress:
    """Run the cases of a study in a folder that nobody else uses."""
    runs = how.directory / RUNS_FOLDER
    tasks = {
        case.name: SweepTask(
            name=case.name, case=case.case, folder=str(runs / case.name), draw=how.draw
        )
        for case in cases
    }
    table = SweepTable(how.directory, cases)
    waiting = _take_finished(tasks, table, resume=how.resume)
    earlier = len(table.rows)

    def report() -> SweepProgress:
        state = SweepProgress(
            cases=len(tasks),
            done=len(table.rows),
            earlier=earlier,
            status=dict(Counter(row["status"] for row in table.rows.values())),
            warned=sum(bool(row.get("warnings")) for row in table.rows.values()),
        )
        if how.progress is not None:
            how.progress(state)
        return state

    workers = max(1, min(how.workers, len(waiting)))
    with executor(workers=workers, scheduler=how.scheduler) as execute:
        for task in waiting:
            task.place.forget(checkpoint=not how.resume)
        runs.mkdir(exist_ok=True)
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
    times, waiting = table.earlier_times() if resume else {}, []
    for task in tasks.values():
        summary = earlier_outcome(task) if resume else None
        if summary is None:
            waiting.append(task)
        else:
            timing = times.get(task.name, {})
            table.add(task, CaseOutcome(name=task.name, summary=summary, timing=timing))
    return waiting


def size_of_study(study: Study, workers: int) -> str:
    """Say how many cases a study has, and roughly how long they take and how much they leave.

    Some cases stand for all of them.
    """
    some = study.some_cases(_SAMPLE)
    seconds = sum(estimated_cost(case).seconds for case in some) / len(some)
    space = sum(map(_bytes, some)) / len(some)
    took = duration(study.number * seconds / workers)
    gigabytes = study.number * space / 1e9
    return f"{study.number} cases: about {took} with {workers} workers, {gigabytes:.3g} GB"


def _bytes(case: Case) -> float:
    """Rough size of what a run leaves."""
    vtu = _VTU_BYTES_PER_CELL_AND_SNAPSHOT if case.output.vtu else 0.0
    per_cell = _FIELD_BYTES_PER_CELL_AND_SNAPSHOT + vtu
    return per_cell * estimated_cost(case).elements * case.output.snapshots
