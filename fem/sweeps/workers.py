"""Who executes the cases of a sweep: this process, local worker processes, or a cluster."""

import importlib.util
import logging
import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from fem.case import CaseError
from fem.sweeps.case import FAILED, CaseOutcome, SweepTask, run_task
from fem.sweeps.local_pool import LocalPool, local_pool

#: How often a sweep looks for finished cases [s].
_LOOK_S = 0.1
_CONNECT_S = 10.0
#: A worker died with the outcome still in its memory; the scheduler asks another one.
_RUN_AGAIN = ("lost", "pending")
INSTALL = "pip install 'treadfem[sweep]'"


#: Runs tasks; gives outcomes, and None in between.
Execute = Callable[[Sequence[SweepTask]], Iterator[CaseOutcome | None]]


class SchedulerLostError(RuntimeError):
    """The scheduler of a sweep has gone; what was finished before is kept."""


def has_dask() -> bool:
    """Whether dask.distributed can be imported."""
    return importlib.util.find_spec("distributed") is not None


def cores() -> int:
    """Number of cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def number_of_workers(wanted: int | None, scheduler: str | None) -> int:
    """Number of local worker processes, once it is clear that they can be had.

    Raises
    ------
    TypeError
        If one of them is of another type.
    CaseError
        If the number makes no sense or dask.distributed is missing.
    """
    if wanted is not None and (isinstance(wanted, bool) or not isinstance(wanted, int)):
        raise TypeError(f"workers is {wanted!r}, expected a whole number or None")
    if scheduler is not None and not isinstance(scheduler, str):
        raise TypeError(f"scheduler is {scheduler!r}, expected an address or None")
    if wanted is not None and wanted < 1:
        raise CaseError("sweep", "--workers", str(wanted), "at least 1")
    if scheduler is not None and not has_dask():
        raise CaseError(
            "sweep",
            "--scheduler",
            "no package dask.distributed",
            f"it installed ({INSTALL}), or local workers",
        )
    return wanted or cores()


@contextmanager
def executor(*, workers: int, scheduler: str | None) -> Iterator[Execute]:
    """Give a function that runs tasks and gives their outcomes as they finish.

    Its None means that time has passed.

    Parameters
    ----------
    workers : int
        Number of local processes; a single one is this process.
    scheduler : str or None
        Address of a running dask scheduler, which is used instead.

    Raises
    ------
    CaseError
        If nobody answers at the address.
    SchedulerLostError
        From the function, if the scheduler goes away while the sweep is running.
    """
    if scheduler is not None:
        with _client(scheduler) as client:
            yield lambda tasks: _distributed(client, tasks)
    elif workers == 1:
        yield lambda tasks: map(run_task, tasks)
    else:
        with local_pool(run_task, workers) as pool:
            yield lambda tasks: _local(pool, tasks)


def _local(
    pool: LocalPool[SweepTask, CaseOutcome], tasks: Sequence[SweepTask]
) -> Iterator[CaseOutcome | None]:
    for news in pool.run(tasks):
        if news is None:
            yield None
        else:
            task, outcome = news
            yield _killed(task.name) if outcome is None else outcome


def _killed(name: str) -> CaseOutcome:
    reason = "the worker process died each time it ran this case (out of memory?)"
    return CaseOutcome(name=name, summary={"status": FAILED, "reason": reason})


def _distributed(client: Any, tasks: Sequence[SweepTask]) -> Iterator[CaseOutcome | None]:
    from distributed import as_completed

    # Impure: a case that is asked for has to be run, whatever the scheduler remembers.
    futures = client.map(run_task, list(tasks), pure=False, key=[t.name for t in tasks])
    names = {future.key: task.name for future, task in zip(futures, tasks, strict=True)}
    done = as_completed(futures, raise_errors=False)
    try:
        waiting = len(tasks)
        while waiting:
            for future in done.next_batch(block=False):
                if future.status in _RUN_AGAIN:
                    done.add(future)
                    continue
                waiting -= 1
                yield _outcome(future, names[future.key])
            if client.status not in ("running", "connecting"):
                raise SchedulerLostError("the scheduler does not answer any more")
            yield None
            time.sleep(_LOOK_S)
    finally:
        if client.status == "running":
            client.cancel(futures, force=True)


def _outcome(future: Any, name: str) -> CaseOutcome:
    from distributed import CancelledError

    try:
        error = future.exception()
        if error is None:
            outcome: CaseOutcome = future.result()
            return outcome
    except CancelledError:
        reason = "the scheduler has forgotten the cases of this sweep"
        raise SchedulerLostError(reason) from None
    reason = " ".join(f"{type(error).__name__}: {error}".split())
    if type(error).__name__ == "KilledWorker":
        return _killed(name)
    return CaseOutcome(name=name, summary={"status": FAILED, "reason": reason})


@contextmanager
def _client(scheduler: str) -> Iterator[Any]:
    from distributed import Client

    # dask reports lost and restarted workers in pages of tracebacks; the table says what matters.
    for name in ("distributed", "tornado.application", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        client = Client(scheduler, timeout=_CONNECT_S)
    except (OSError, ValueError, TypeError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise CaseError(
            "sweep",
            "--scheduler",
            f"{scheduler}: {reason}",
            "the address of a running dask scheduler, e.g. tcp://10.0.0.1:8786",
        ) from None
    try:
        if not client.scheduler_info()["workers"]:
            print(f"{scheduler} has no workers yet: waiting for the first", file=sys.stderr)
        yield client
    finally:
        client.close(timeout=2.0)
