"""The phase that follows what a rig measured."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np

from fem.case import Signal
from fem.stepping.phases import PRESSING_MOTION, Steps, Target
from materials.arrays import FloatArray

#: Parts of a record that its steps are chosen by, and the least share of a longest step in each.
RECORD_PARTS, LEAST_EFFORT = 400, 0.05


@dataclass(frozen=True, kw_only=True)
class Follow(Steps):
    """The platen follows measured velocity and pressure; the coordinate is time [s].

    A step does the way that was measured in it, under the mean pressure of its second half and of
    as long a time after it: noise averages out, and steps are as long as what happens lets them.

    Attributes
    ----------
    signal : Signal
        What was measured.
    since, end : float
        Start in the signal, and duration [s].
    length : float
        Of the block's top [mm].
    path_max, pressure_max : float
        Way [mm] and change of the pressure [N/mm^2] in a step at most.
    onset_share : float
        Longest way of a step relative to that since the start, beyond the first one.
    """

    signal: Signal
    since: float
    end: float
    length: float
    path_max: float
    path_initial: float
    pressure_max: float
    onset_share: float = inf

    name = "following"
    unit = " s"

    def slid(self, at: float) -> float:
        """Way over the road, back and forth [mm]."""
        path = self.signal.path
        return self.signal.at(path, self.since + at) - self.signal.at(path, self.since)

    def longest(self, at: float) -> float:
        """Longest step from a time on [s]."""
        return float(np.interp(self._effort(at) + 1.0, self._measure[1], self._measure[0])) - at

    def _effort(self, at: float) -> float:
        return float(np.interp(at, *self._measure))

    @cached_property
    def _measure(self) -> tuple[FloatArray, FloatArray]:
        """Times, and how many of the longest steps it takes to come there.

        Of means over parts of the record: what noise does between two rows is no event.
        """
        t = np.linspace(0.0, self.end, RECORD_PARTS + 1)
        path = np.interp(self.since + t, self.signal.t, self.signal.path)
        path = path - path[0]
        impulse = np.interp(self.since + t, self.signal.t, self.signal.impulse)
        p = np.diff(impulse) / np.diff(t)
        change = np.abs(np.diff(p, append=p[-1]))
        middle = 0.5 * (path[1:] + path[:-1])
        longest = np.clip(self.onset_share * middle, self.path_initial, self.path_max)
        parts = np.maximum(np.diff(path) / longest, change / self.pressure_max)
        return t, np.concatenate([[0.0], np.cumsum(np.maximum(parts, LEAST_EFFORT))])

    def target(self, start: float, stop: float) -> Target:
        """What a step between two times does."""
        signal, dt = self.signal, stop - start
        begin, end = self.since + start, self.since + stop
        half = 0.5 * min(dt, signal.duration - end) or 0.5 * dt
        after = min(end + half, self.since + self.end)
        pressure = max(signal.mean(signal.impulse, end - half, after), 0.0)
        motion = signal.at(signal.path, end) - signal.at(signal.path, begin)
        return Target(
            dt=dt,
            sweep=signal.at(signal.position, end) - signal.at(signal.position, begin),
            force=pressure * self.length,
            motion=max(motion, PRESSING_MOTION * dt / self.end),
            convection=self.convection,
        )
