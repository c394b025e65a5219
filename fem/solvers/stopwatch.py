"""Adds up the time spent in some of the work."""

import time
from dataclasses import dataclass, field
from types import TracebackType


@dataclass
class Stopwatch:
    """Runs inside each ``with`` block; what an exception ends counts too.

    Attributes
    ----------
    seconds : float
        Time so far [s].
    """

    seconds: float = field(default=0.0, init=False)
    _started: float = field(default=0.0, init=False, repr=False)

    def __enter__(self) -> None:
        self._started = time.perf_counter()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.seconds += time.perf_counter() - self._started
