"""What can be done to the block: phases, each run through along one coordinate from 0 to its end.

A phase says what the platen does in a step between two coordinates (its force or its rise, its
motion over the road, the time that takes), how long steps may be, and how far the block has slid.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import floor, inf, log2
from typing import Protocol

import numpy as np
from scipy.optimize import brentq

from fem.case.signals import Signal
from materials.arrays import FloatArray

#: Distance that pressing counts as, where damping is stated by a distance [mm].
PRESSING_MOTION = 1.0
#: Parts of pressing and lifting: the longest and the shortest step.
LONGEST_PART, SHORTEST_PART = 0.25, 1e-4
#: Longest step at rest over the time at rest, and the first one [s]: the heat that a contact left
#: in the surface spreads ever more slowly.
RESTING_SHARE, FIRST_REST = 0.15, 1e-4
#: Sub-steps of the heat in a step at rest: backward Euler then errs by half a per cent.
RESTING_PARTS = 4


#: Parts of a record that its steps are chosen by, and the least share of a longest step in each.
RECORD_PARTS, LEAST_EFFORT = 400, 0.05


@dataclass(frozen=True, kw_only=True)
class Target:
    """End of a step.

    Attributes
    ----------
    dt : float
        Its length [s].
    sweep : float
        Motion of the platen over the road, signed [mm].
    force : float
        Force on the platen per depth [N/mm].
    motion : float
        Distance that the step goes on, for damping stated by a distance [mm].
    raised : float or None
        Rise of the platen in place of the force [mm].
    convection : float
        Film coefficient of the free surfaces [N/(mm s K)].
    inertia : bool
        Whether the block's inertia counts.
    heat_parts : int
        Sub-steps of the heat at least.
    """

    dt: float
    sweep: float
    force: float
    motion: float
    raised: float | None = None
    convection: float = 0.0
    inertia: bool = True
    heat_parts: int = 1


class Phase(Protocol):
    """What the time loop asks of a phase."""

    @property
    def name(self) -> str:
        """For tables and log."""

    @property
    def unit(self) -> str:
        """Unit of the coordinate, for the log."""

    @property
    def contact(self) -> int:
        """Number of the contact with the road, or of the last one, from 1 on."""

    @property
    def number(self) -> int:
        """Number of the phase in the case, from 1 on."""

    @property
    def pressure(self) -> float:
        """Mean pressure on the top at its end [N/mm^2]."""

    @property
    def touches_down(self) -> bool:
        """Whether it begins with a block that comes down from the air."""

    @property
    def end(self) -> float:
        """Last value of the coordinate."""

    @property
    def step_initial(self) -> float:
        """First step."""

    @property
    def step_max(self) -> float:
        """Longest step."""

    @property
    def step_min(self) -> float:
        """Step that is too short to go on with."""

    @property
    def growth(self) -> float:
        """Factor of steps after an easy one."""

    @property
    def onset(self) -> bool:
        """Whether sliding begins in it, so that its first damped steps are relaxed."""

    def longest(self, at: float) -> float:
        """Longest step from a coordinate on."""

    def target(self, start: float, stop: float) -> Target:
        """What a step between two coordinates does."""

    def slid(self, at: float) -> float:
        """Distance over the road since the start of the phase [mm]."""


@dataclass(frozen=True, kw_only=True)
class _Steps:
    """What all phases have.

    Attributes
    ----------
    step_initial, step_max, step_min : float
        Steps of the coordinate.
    number, contact : int
        Number of the phase in the case, and of its contact with the road.
    pressure : float
        Mean pressure on the top at its end [N/mm^2].
    touches_down : bool
        Whether it begins with a block that comes down from the air.
    convection : float
        Film coefficient of the free surfaces [N/(mm s K)].
    """

    step_initial: float
    step_max: float
    step_min: float
    number: int = 1
    contact: int = 1
    pressure: float = 0.0
    touches_down: bool = False
    convection: float = 0.0

    onset = False
    growth = 1.5

    def longest(self, at: float) -> float:
        """Longest step from a coordinate on."""
        return self.step_max


@dataclass(frozen=True, kw_only=True)
class Press(_Steps):
    """The force changes in proportion to time; the coordinate is the part of the change.

    Attributes
    ----------
    time : float
        Duration [s].
    force_before, force : float
        Force at its start and at its end [N/mm].
    """

    time: float
    force: float
    force_before: float = 0.0
    name: str = "pressing"
    unit: str = " of the load"
    end: float = 1.0

    def target(self, start: float, stop: float) -> Target:
        """What a step between two parts does."""
        share = stop - start
        return Target(
            dt=self.time * share,
            sweep=0.0,
            force=self.force_before + (self.force - self.force_before) * stop,
            motion=PRESSING_MOTION * share,
            convection=self.convection,
        )

    def slid(self, at: float) -> float:
        """None."""
        return 0.0


@dataclass(frozen=True, kw_only=True)
class Slide(_Steps):
    """The platen slides at a constant force; the coordinate is the distance [mm].

    Attributes
    ----------
    end : float
        Sliding distance [mm].
    speed, sense : float
        Final speed [mm/s], and its sign.
    start : float
        Speed at its start [mm/s].
    acceleration_distance : float
        Distance over which the speed changes [mm]; 0: at once.
    force : float
        On the platen [N/mm].
    onset_share : float
        Longest step relative to the distance slid, beyond the first one: what happens in an onset
        is resolved alike on all its scales.
    """

    end: float
    speed: float
    sense: float
    force: float
    start: float = 0.0
    acceleration_distance: float = 0.0
    onset_share: float = inf
    onset: bool = False
    name: str = "sliding"
    unit: str = " mm"

    def longest(self, at: float) -> float:
        """Longest step from a distance on."""
        return min(self.step_max, max(self.step_initial, self.onset_share * at))

    def target(self, start: float, stop: float) -> Target:
        """What a step between two distances does."""
        ramp, motion = self.acceleration_distance, stop - start
        since = sliding_time(start, self.speed, ramp, self.start)
        dt = sliding_time(stop, self.speed, ramp, self.start) - since
        return Target(
            dt=dt,
            sweep=self.sense * motion,
            force=self.force,
            motion=motion,
            convection=self.convection,
        )

    def slid(self, at: float) -> float:
        """Distance over the road [mm]."""
        return at


@dataclass(frozen=True, kw_only=True)
class Hold(_Steps):
    """The platen stands at a constant force; the coordinate is time [s], and steps follow the heat.

    Attributes
    ----------
    end : float
        Duration [s].
    force : float
        On the platen [N/mm].
    """

    end: float
    force: float
    name: str = "holding"
    unit: str = " s"
    growth = 2.0

    def longest(self, at: float) -> float:
        """Longest step from a time on."""
        return at_rest(self.step_initial, at)

    def target(self, start: float, stop: float) -> Target:
        """What a step between two times does."""
        dt = stop - start
        return Target(
            dt=dt, sweep=0.0, force=self.force, motion=PRESSING_MOTION * dt / self.end,
            convection=self.convection, inertia=False, heat_parts=RESTING_PARTS,
        )  # fmt: skip

    def slid(self, at: float) -> float:
        """None."""
        return 0.0


@dataclass(frozen=True, kw_only=True)
class Follow(_Steps):
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
    name: str = "following"
    unit: str = " s"

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


@dataclass(frozen=True, kw_only=True)
class LiftOff(_Steps):
    """The platen rises until nothing touches; the coordinate is the part of its rise.

    Attributes
    ----------
    time : float
        Duration [s].
    rise : float
        Of the platen [mm].
    """

    time: float
    rise: float
    name: str = "lifting"
    unit: str = " of the rise"
    end: float = 1.0

    def target(self, start: float, stop: float) -> Target:
        """What a step between two parts does."""
        share = stop - start
        return Target(
            dt=self.time * share, sweep=0.0, force=0.0, raised=self.rise * share,
            motion=PRESSING_MOTION * share, convection=self.convection, inertia=False,
        )  # fmt: skip

    def slid(self, at: float) -> float:
        """None."""
        return 0.0


@dataclass(frozen=True, kw_only=True)
class Rest(_Steps):
    """The block hangs in air; the coordinate is time [s], and steps follow the heat."""

    end: float
    name: str = "in air"
    unit: str = " s"
    growth = 2.0

    def longest(self, at: float) -> float:
        """Longest step from a time on."""
        return at_rest(self.step_initial, at)

    def target(self, start: float, stop: float) -> Target:
        """What a step between two times does."""
        return Target(
            dt=stop - start,
            sweep=0.0,
            force=0.0,
            raised=0.0,
            motion=PRESSING_MOTION,
            convection=self.convection,
            inertia=False,
            heat_parts=RESTING_PARTS,
        )

    def slid(self, at: float) -> float:
        """None."""
        return 0.0


def at_rest(first: float, at: float) -> float:
    """Longest step from a time at rest on [s]: the first one times a power of 2.

    Steps of equal length share their matrices of conduction.
    """
    return first * 2.0 ** max(floor(log2(max(RESTING_SHARE * at / first, 1.0))), 0)


def sliding_time(distance: float, speed: float, ramp: float, start: float = 0.0) -> float:
    """Time since the start of a slide [s], smoothly accelerated up to `speed` [mm/s] at first.

    The speed rises as ``3 tau^2 - 2 tau^3``, without a jump of the acceleration: a block of rubber
    would answer one with a jump of the platen's force.

    Parameters
    ----------
    distance : float
        Distance slid [mm].
    speed : float
        Final speed [mm/s].
    ramp : float
        Distance of acceleration [mm].
    start : float
        Speed at the start [mm/s].

    Examples
    --------
    >>> sliding_time(2.5, 300.0, 0.5)
    0.01
    """
    change = (speed - start) / (speed + start)
    if distance >= ramp:
        return (distance + change * ramp) / speed
    # The distance is the integral of the speed; from rest s/ramp = 2 tau^3 - tau^4.
    tau = brentq(
        lambda tau: change * tau**3 * (2.0 - tau) + (1.0 - change) * tau - distance / ramp,
        0.0, 1.0, xtol=1e-14,
    )  # fmt: skip
    return float(tau * 2.0 * ramp / (speed + start))
