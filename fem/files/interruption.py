"""Requests to end: Ctrl-C, a request to terminate, a terminal that hangs up.

All of them mean the same: stop, and keep what there is. `listening` makes each of them raise
`KeyboardInterrupt` where the program stands. Where that would lose something, `gently` lets them be
noted only, and `at_step_ends` says where in there a second one may raise.

Without `listening` (a script, a notebook) nothing is changed; Python then raises as it always does.
"""

import math
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType

SIGNALS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)
#: Those that follow a request within that time are the same impatience, not another request [s].
_ONE_REQUEST_S = 1.0
#: After which one that came during an import comes again [s].
_IMPORT_S = 0.02


@dataclass
class _Requests:
    """How many requests came, how many the present code tolerates, and when one acted."""

    count: int = 0
    tolerated: float = 0.0
    acted: float = -math.inf

    def heard(self, number: int, frame: FrameType | None) -> None:
        """Take a request; with more than are tolerated, raise.

        One that comes while a module is imported comes again a little later: half a module raises
        what it likes, and Python may end with another code than the program's.
        """
        if _imports(frame):
            again = threading.Timer(_IMPORT_S, signal.raise_signal, [number])
            again.daemon = True
            again.start()
            return
        self.count += 1
        now = time.monotonic()
        if self.count > self.tolerated and now - self.acted > _ONE_REQUEST_S:
            self.acted = now
            raise KeyboardInterrupt


def _imports(frame: FrameType | None) -> bool:
    """Whether the program stands in an import."""
    while frame is not None:
        if frame.f_code.co_filename == "<frozen importlib._bootstrap>":
            return True
        frame = frame.f_back
    return False


_requests = _Requests()


@contextmanager
def listening(*, to_the_end: bool = False) -> Iterator[None]:
    """Let every request raise `KeyboardInterrupt`.

    A signal that is ignored (a program in the background, `nohup`) stays ignored. In a thread
    other than the main one, which never gets a signal, this does nothing.

    Parameters
    ----------
    to_the_end : bool
        The program ends with the block: no request is taken any more after it.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in SIGNALS}
    outer = (_requests.count, _requests.tolerated, _requests.acted)
    _requests.count, _requests.tolerated, _requests.acted = 0, 0.0, -math.inf
    try:
        for number, handler in before.items():
            if handler is not signal.SIG_IGN:
                signal.signal(number, _requests.heard)
        yield
    finally:
        for number, handler in before.items():
            # None: set by something that is not Python, which has to set it again.
            again = signal.SIG_DFL if handler is None else handler
            signal.signal(number, signal.SIG_IGN if to_the_end else again)
        _requests.count, _requests.tolerated, _requests.acted = outer


@contextmanager
def gently() -> Iterator[None]:
    """Let requests be noted only; `requested` tells whether there was one."""
    with _tolerating(math.inf):
        yield


@contextmanager
def deferring() -> Iterator[None]:
    """Let a request wait for the end of the block, where it acts as it would have before."""
    count = _requests.count
    with _tolerating(math.inf):
        yield
    if count < _requests.count > _requests.tolerated:
        _requests.acted = time.monotonic()
        raise KeyboardInterrupt


@contextmanager
def at_step_ends() -> Iterator[None]:
    """Within `gently`: the first request is still only noted, a second one raises."""
    with _tolerating(1.0 if _requests.tolerated > 0.0 else 0.0):
        yield


@contextmanager
def _tolerating(number: float) -> Iterator[None]:
    # In another thread there is nobody to tolerate, and the main one has its own mind.
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before, _requests.tolerated = _requests.tolerated, number
    try:
        yield
    finally:
        _requests.tolerated = before


def requested() -> bool:
    """Whether there was a request since `listening` began."""
    return _requests.count > 0
