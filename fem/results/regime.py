"""How the block slides: steadily, or sticking and slipping in turn.

A coefficient of friction that falls with the speed makes steady sliding of a block unstable: its
rubber and its mass swing, and nothing but losses damps that [1]_. The coefficient's memory
(`ThermalFriction.memory_mm`) restores what a law measured at constant speed leaves out, and with it
the steady slide. Without it, or with a law that falls steeply, the other regime is told here.

References
----------
.. [1] Ruina, A., J. Geophys. Res. 88 (1983) 10359-10370.
"""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

STEADY, STICK_SLIP, ONSET = "steady", "stick-slip", "onset"

#: Mean slip velocity over the platen's from which the block slides in full, and below which it has
#: been caught again. The snaps of an edge that rolls under change it by less than half.
SLIDING, CAUGHT = 0.9, 0.5
#: Returns to full sliding from which on one speaks of a regime; the start is not one.
CYCLES = 3


@dataclass(frozen=True, kw_only=True)
class SlidingRegime:
    """Regime of a slide: its name, and how often the block was caught and slid again."""

    name: str
    cycles: int = 0

    @property
    def warnings(self) -> list[str]:
        """What a reader of the results has to know of it."""
        if self.name != STICK_SLIP:
            return []
        return [
            f"the block stick-slips ({self.cycles} times caught and sliding again): means over the "
            "slide are not those of steady sliding; a larger [friction] memory_mm steadies it "
            "where the law allows"
        ]


def stick_slip_cycles(ratio: ArrayLike) -> int:
    """How often the block is caught and slides again.

    Parameters
    ----------
    ratio : (n,) array_like
        Mean slip velocity over the velocity of the platen, by accepted step [-].

    Examples
    --------
    >>> stick_slip_cycles([0.0, 0.4, 1.0, 0.8, 1.0, 1.0])
    0
    >>> stick_slip_cycles([0.0, 1.4, 0.1, 2.0, 0.0, 1.2])
    2
    """
    ratio = np.asarray(ratio, dtype=float)
    marks = np.where(ratio >= SLIDING, 1, np.where(ratio < CAUGHT, -1, 0))
    marks = marks[marks != 0]
    returns = int(np.sum((marks[1:] == 1) & (marks[:-1] == -1)))
    started_caught = bool(marks.size and marks[0] == -1)
    return max(returns - int(started_caught), 0)


def sliding_regime(history: pd.DataFrame) -> SlidingRegime:
    """Regime of a run from its history."""
    slide = history[history["velocity_mm_per_s"] != 0.0] if len(history) else history
    if slide.empty:
        return SlidingRegime(name=ONSET)
    ratio = slide["mean_slip_velocity_mm_per_s"].abs() / slide["velocity_mm_per_s"].abs()
    # A block is caught at the beginning of every contact, and where it turns round.
    places = [np.sign(slide["velocity_mm_per_s"])]
    if "contact" in slide:
        places.append(slide["contact"])
    cycles = max(stick_slip_cycles(part) for _, part in ratio.groupby(places))
    if cycles >= CYCLES:
        return SlidingRegime(name=STICK_SLIP, cycles=cycles)
    return SlidingRegime(name=STEADY if (ratio >= SLIDING).any() else ONSET, cycles=cycles)
