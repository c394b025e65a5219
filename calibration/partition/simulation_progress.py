"""How a calibration shows its simulations: a bar on a terminal, a line each elsewhere."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from fem.case.case import Case

_BAR = "{desc}: {percentage:3.0f} %|{bar:20}| [{elapsed}<{remaining}]{postfix}"


class SimulationProgress:
    """Numbers the simulations and shows how far the present one is."""

    def __init__(self, *, quiet: bool = False) -> None:
        self.quiet = quiet
        self.count = 0
        self.bar: Any = None

    def __enter__(self) -> SimulationProgress:
        return self

    def __exit__(self, *exc: object) -> None:
        self._close()

    def __call__(self, label: str, case: Case) -> Callable[[Any], None] | None:
        """Announce a simulation; the callback takes its progress."""
        self._close()
        self.count += 1
        text = f"simulation {self.count}, {label}"
        if self.quiet:
            return None
        if not sys.stderr.isatty():
            print(text, flush=True)
            return None
        from tqdm import tqdm

        bar = tqdm(total=case.loading.distance_mm, desc=text, bar_format=_BAR, leave=False)
        self.bar = bar

        def show(state: Any) -> None:
            bar.set_postfix_str(f"T_max {state.T_max_C:.1f} C", refresh=False)
            bar.update(min(abs(state.sliding_distance_mm), bar.total) - bar.n)

        return show

    def _close(self) -> None:
        if self.bar is not None:
            self.bar.close()
            self.bar = None
