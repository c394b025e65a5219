"""How a sweep shows how far it is: a bar with the time left on a terminal, nothing in a pipe."""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fem.results import OK, SUMMARY_CSV

_BAR = "{n_fmt}/{total_fmt} cases |{bar}| {elapsed}{postfix}"
_REDRAW_S = 1.0


@dataclass(frozen=True, kw_only=True)
class SweepProgress:
    """How far a sweep is.

    Attributes
    ----------
    cases : int
        Cases of the study.
    done : int
        Cases that have finished, the ones an earlier sweep had finished among them.
    earlier : int
        Cases that an earlier sweep had finished.
    status : dict
        Number of finished cases by status.
    warned : int
        Number of finished cases whose results come with a warning.
    """

    cases: int
    done: int
    earlier: int
    status: dict[str, int]
    warned: int = 0

    @property
    def all_ok(self) -> bool:
        """Whether every case has finished as it should."""
        return self.status.get(OK, 0) == self.cases


class SweepBar:
    """Bar of finished cases; time left is judged by the cases this sweep has finished itself."""

    def __init__(self) -> None:
        self.bar: Any = None
        self.begin = self.drawn = time.monotonic()

    def __enter__(self) -> SweepBar:
        return self

    def __exit__(self, *exc: object) -> None:
        if self.bar is not None:
            self.bar.close()

    def __call__(self, state: SweepProgress) -> None:
        """Show the state; between finished cases once a second, so that the clock runs."""
        if not sys.stderr.isatty():
            return
        if self.bar is None:
            from tqdm import tqdm

            self.bar = tqdm(total=state.cases, bar_format=_BAR, leave=False)
        now = time.monotonic()
        if state.done == self.bar.n and now - self.drawn < _REDRAW_S:
            return
        self.drawn = now
        self.bar.n = state.done
        self.bar.set_postfix_str(self._words(state, now - self.begin), refresh=True)

    @staticmethod
    def _words(state: SweepProgress, elapsed_s: float) -> str:
        bad = state.done - state.status.get(OK, 0)
        words = [time_left(state, elapsed_s)]
        return ", ".join(words + [f"{bad} not ok"] * (bad > 0))


def time_left(state: SweepProgress, elapsed_s: float) -> str:
    """Words for the time the rest will take, e.g. ``12:30 left``."""
    own = state.done - state.earlier
    if state.done == state.cases:
        return "done"
    if own == 0:
        return "time left unknown"
    seconds = round(elapsed_s / own * (state.cases - state.done))
    hours, minutes = seconds // 3600, seconds // 60 % 60
    clock = f"{hours}:{minutes:02d}" if hours else f"{minutes:02d}"
    return f"{clock}:{seconds % 60:02d} left"


def closing_line(state: SweepProgress, directory: Path) -> str:
    """Say in one line what came out."""
    counts = ", ".join(f"{number} {status}" for status, number in sorted(state.status.items()))
    earlier = f" ({state.earlier} finished earlier)" if state.earlier else ""
    warned = f", {state.warned} with warnings" if state.warned else ""
    return f"{state.cases} cases: {counts}{warned}{earlier}; table in {directory / SUMMARY_CSV}"
