"""Who executes the cases of a sweep: this process, local worker processes, or a cluster."""

from __future__ import annotations

import importlib.util
import logging
import os
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from fem.case_errors import CaseError
from validation.sweeps.sweep_case import FAILED, CaseOutcome, SweepTask, run_task

#: How often a sweep looks for finished cases [s].
_LOOK_S = 0.1
_CONNECT_S = 10.0
_ONE_THREAD = dict.fromkeys(
    ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS"), "1"
)
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
    CaseError
        If the number makes no sense or dask.distributed is missing.
    """
    if wanted is not None and wanted < 1:
        raise CaseError(file="sweep", key="--workers", found=str(wanted), expected="at least 1")
    if has_dask():
        return wanted or cores()
    if scheduler is not None or (wanted or 1) > 1:
        option = "--scheduler" if scheduler is not None else "--workers"
        raise CaseError(
            file="sweep",
            key=option,
            found="no package dask.distributed",
            expected=f"it installed ({INSTALL}), or --workers 1",
        )
    return 1


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
    if scheduler is None and workers == 1:
        yield lambda tasks: map(run_task, tasks)
    else:
        with _client(scheduler, workers) as client:
            yield lambda tasks: _distributed(client, tasks)


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
        reason = "the worker process died each time it ran this case (out of memory?)"
    return CaseOutcome(name=name, summary={"status": FAILED, "reason": reason})


@contextmanager
def _client(scheduler: str | None, workers: int) -> Iterator[Any]:
    from distributed import Client

    # dask reports lost and restarted workers in pages of tracebacks; the table says what matters.
    for name in ("distributed", "tornado.application", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    if scheduler is None:
        with _local_cluster(workers) as cluster, Client(cluster) as client:
            client.register_plugin(_deaf_to_interrupts())
            yield client
        return
    try:
        client = Client(scheduler, timeout=_CONNECT_S)
    except (OSError, ValueError, TypeError) as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        raise CaseError(
            file="sweep",
            key="--scheduler",
            found=f"{scheduler}: {reason}",
            expected="the address of a running dask scheduler, e.g. tcp://10.0.0.1:8786",
        ) from None
    try:
        if not client.scheduler_info()["workers"]:
            print(f"{scheduler} has no workers yet: waiting for the first", file=sys.stderr)
        yield client
    finally:
        client.close(timeout=2.0)


@contextmanager
def _local_cluster(workers: int) -> Iterator[Any]:
    from distributed import LocalCluster

    with tempfile.TemporaryDirectory(prefix="treadfem-", ignore_cleanup_errors=True) as scratch:
        cluster = LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            # dask serves its state over HTTP; any port does, and only for this machine.
            dashboard_address="127.0.0.1:0",
            # Memory is the system's matter.
            memory_limit=0,
            silence_logs=logging.CRITICAL,
            env=_ONE_THREAD,
            local_directory=scratch,
        )
        try:
            yield cluster
        finally:
            cluster.close(timeout=5.0)


def _deaf_to_interrupts() -> Any:
    """Plugin for local workers: Ctrl-C reaches them too, but the sweep is who ends them."""
    from distributed import WorkerPlugin

    class DeafToInterrupts(WorkerPlugin):  # type: ignore[misc, unused-ignore]
        def setup(self, worker: Any) -> None:
            signal.signal(signal.SIGINT, signal.SIG_IGN)

    return DeafToInterrupts()
