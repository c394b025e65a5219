"""Worker processes of this machine: one case at a time each, no port, no file but their results.

A worker is a fresh interpreter that talks to its parent over a pair of connected sockets which no
other process has. It never looks at the caller's program, so that a script without a main guard, a
notebook, standard input or a thread may start one. It leaves as soon as its parent is gone.
"""

import os
import subprocess
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from multiprocessing import Pipe
from multiprocessing.connection import Connection, wait
from queue import SimpleQueue
from threading import Thread
from typing import Any, Generic, TypeVar

from fem.files import listening

T = TypeVar("T")
R = TypeVar("R")

#: How often a task is given to a worker that dies of it.
MOST_TRIES = 3
#: How long to wait for news before saying that time has passed [s].
_LOOK_S = 0.1
#: How long the workers may take to keep what they have got to [s].
_PATIENCE_S = 5.0
_ONE_THREAD = dict.fromkeys(
    ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS"), "1"
)
_PROGRAM = """
import sys
from multiprocessing.connection import Connection
connection = Connection(int(sys.argv[1]))
sys.path[:] = connection.recv()
from fem.sweeps.local_pool import serve
serve(connection)
"""


class WorkersError(OSError):
    """No worker process can be started."""


@dataclass
class _Worker:
    process: subprocess.Popen[bytes]
    connection: Connection
    #: Number of the task it is at.
    task: int | None = None


@dataclass
class LocalPool(Generic[T, R]):
    """Runs a function in worker processes.

    Parameters
    ----------
    function : callable
        Of a module that a fresh interpreter can import; takes a task, returns a result.
    size : int
        Number of processes.
    """

    function: Callable[[T], R]
    size: int
    _workers: list[_Worker] = field(default_factory=list, init=False)

    def run(self, tasks: Sequence[T]) -> Iterator[tuple[T, R | None] | None]:
        """Results as they finish, with None in between as time passes.

        A worker that dies is replaced and its task is tried again; a task of which one worker
        after the other dies has None for its result.

        Raises
        ------
        WorkersError
            If a process cannot be started.
        """
        waiting, tries, left = deque(range(len(tasks))), [0] * len(tasks), len(tasks)
        while left:
            self._give_work(waiting, tasks)
            yield None
            for worker, number in self._with_news():
                result: R | None = None
                try:
                    result = worker.connection.recv()
                    worker.task = None
                except (EOFError, OSError):
                    self._end([worker])
                    tries[number] += 1
                    if tries[number] < MOST_TRIES:
                        waiting.appendleft(number)
                        continue
                left -= 1
                yield tasks[number], result

    def close(self) -> None:
        """Let the workers keep what they have got to, and end."""
        for worker in self._workers:
            worker.process.terminate()
        end = time.monotonic() + _PATIENCE_S
        for worker in self._workers:
            with suppress(subprocess.TimeoutExpired):
                worker.process.wait(max(0.0, end - time.monotonic()))
        self._end(list(self._workers))

    def _give_work(self, waiting: deque[int], tasks: Sequence[T]) -> None:
        while waiting:
            idle = next((worker for worker in self._workers if worker.task is None), None)
            if idle is None:
                if len(self._workers) >= self.size:
                    return
                idle = _started(self.function)
                self._workers.append(idle)
            idle.task = waiting.popleft()
            # A worker that is dead already is found out when it is asked for the result.
            with suppress(OSError):
                idle.connection.send(tasks[idle.task])

    def _with_news(self) -> list[tuple[_Worker, int]]:
        """Workers that have a result, or died, each with the number of its task."""
        busy = [worker for worker in self._workers if worker.task is not None]
        ready = wait([worker.connection for worker in busy], _LOOK_S)
        return [(w, w.task) for w in busy if w.connection in ready and w.task is not None]

    def _end(self, workers: Sequence[_Worker]) -> None:
        for worker in workers:
            self._workers.remove(worker)
            worker.process.kill()
            worker.process.wait()
            worker.connection.close()


@contextmanager
def local_pool(function: Callable[[T], R], size: int) -> Iterator[LocalPool[T, R]]:
    """A pool whose workers end with the block."""
    pool = LocalPool(function, size)
    try:
        yield pool
    finally:
        pool.close()


def _started(function: Callable[[Any], Any]) -> _Worker:
    ours, theirs = Pipe()
    try:
        process = subprocess.Popen(
            [sys.executable, "-c", _PROGRAM, str(theirs.fileno())],
            pass_fds=[theirs.fileno()],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            env=os.environ | _ONE_THREAD,
            # Ctrl-C and the like are for the parent to hear, which then ends its workers.
            process_group=0,
        )
        # Where the program lies, which a script or a notebook may have said in its own way.
        ours.send([os.path.abspath(place) for place in sys.path])
        ours.send(function)
    except OSError as error:
        raise WorkersError(error.errno, f"no worker process: {error.strerror}") from None
    finally:
        theirs.close()
    return _Worker(process, ours)


def serve(connection: Connection) -> None:
    """Work for the parent until it goes away or asks for the end."""
    tasks: SimpleQueue[Any] = SimpleQueue()
    Thread(target=_receive, args=(connection, tasks), daemon=True).start()
    with listening(to_the_end=True), suppress(KeyboardInterrupt):
        function = tasks.get()
        while True:
            connection.send(function(tasks.get()))


def _receive(connection: Connection, tasks: SimpleQueue[Any]) -> None:
    """Hand on what the parent sends; without it the work is for nobody, and the process ends.

    It also ends over what cannot be read here (a function of a module that is not found), so that
    the parent does not wait for ever.
    """
    try:
        while True:
            tasks.put(connection.recv())
    except Exception:
        os._exit(1)
