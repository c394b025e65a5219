"""How a run shows how far it is, and hears that it is asked to end."""

from __future__ import annotations

import sys
from typing import Any

from fem.case import Case
from fem.files import requested

_BAR = "{percentage:3.0f} %|{bar}| {n:.1f}/{total:g} mm [{elapsed}<{remaining}]{postfix}"


class RunProgress:
    """Shows how far the simulation is: a bar on a terminal, a line per tenth elsewhere."""

    def __init__(self, case: Case, *, quiet: bool) -> None:
        self.distance = case.loading.distance_mm
        self.quiet = quiet
        self.tenths = 0
        self.bar: Any = None

    def __enter__(self) -> RunProgress:
        if not self.quiet and sys.stderr.isatty():
            from tqdm import tqdm

            self.bar = tqdm(total=self.distance, unit="mm", bar_format=_BAR, leave=False)
        return self

    def __exit__(self, *exc: object) -> None:
        if self.bar is not None:
            self.bar.close()

    def __call__(self, state: Any) -> None:
        done = min(abs(state.sliding_distance_mm), self.distance)
        if self.bar is not None:
            self.bar.set_postfix_str(f"T_max {state.T_max_C:.1f} C", refresh=False)
            self.bar.update(done - self.bar.n)
        elif not self.quiet and int(10.0 * done / self.distance + 1e-9) > self.tenths:
            self.tenths = int(10.0 * done / self.distance + 1e-9)
            print(f"{10 * self.tenths:4d} %  {done:8.2f} mm  T_max {state.T_max_C:6.2f} C")
            sys.stdout.flush()
        if requested():
            raise KeyboardInterrupt
