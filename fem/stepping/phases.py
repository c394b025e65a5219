"""What can be done to the block: phases, each run through along one coordinate from 0 to its end.

A phase says what the platen does in a step between two coordinates (its force or its rise, its
motion over the road, the time that takes), how long steps may be, and how far the block has slid.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import floor, inf, log2
from typing import Any, Protocol

from scipy.optimize import brentq

#: Distance that pressing counts as, where damping is stated by a distance [mm].
PRESSING_MOTION = 1.0
#: Parts of pressing and lifting: the longest and the shortest step.
LONGEST_PART, SHORTEST_PART = 0.25, 1e-4
#: Longest step at rest over the time at rest, and the first one [s]: the heat that a contact left
#: in the surface spreads ever more slowly.
RESTING_SHARE, FIRST_REST = 0.15, 1e-4
#: Sub-steps of the heat in a step at rest: backward Euler then errs by half a per cent.
RESTING_PARTS = 4


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
    def on_road(self) -> bool:
        """Whether the block is meant to touch the road."""

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

    def longest(self, at: float) -> float:
        """Longest step from a coordinate on."""

    def target(self, start: float, stop: float) -> Target:
        """What a step between two coordinates does."""

    def slid(self, at: float) -> float:
        """Distance over the road since the start of the phase [mm]."""


@dataclass(frozen=True, kw_only=True)
class Steps:
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

    growth = 1.5
    on_road = True

    def longest(self, at: float) -> float:
        """Longest step from a coordinate on."""
        return self.step_max

    def slid(self, at: float) -> float:
        """Distance over the road since the start of the phase [mm]; none where nothing slides."""
        return 0.0


@dataclass(frozen=True, kw_only=True)
class Press(Steps):
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

    name = "pressing"
    unit = " of the load"
    end = 1.0

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


@dataclass(frozen=True, kw_only=True)
class Slide(Steps):
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

    name = "sliding"
    unit = " mm"

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
class _AtRest(Steps):
    """Nothing moves; the coordinate is time [s], and steps follow the heat.

    Attributes
    ----------
    end : float
        Duration [s].
    """

    end: float

    unit = " s"
    growth = 2.0

    def longest(self, at: float) -> float:
        """Longest step from a time on: the first one times a power of 2.

        Steps of equal length share their matrices of conduction.
        """
        first = self.step_initial
        return first * 2.0 ** floor(log2(max(RESTING_SHARE * at / first, 1.0)))

    def _resting(self, dt: float, **more: Any) -> Target:
        return Target(
            dt=dt,
            sweep=0.0,
            convection=self.convection,
            inertia=False,
            heat_parts=RESTING_PARTS,
            **more,
        )


@dataclass(frozen=True, kw_only=True)
class Hold(_AtRest):
    """The platen stands at a constant force.

    Attributes
    ----------
    force : float
        On the platen [N/mm].
    """

    force: float

    name = "holding"

    def target(self, start: float, stop: float) -> Target:
        """What a step between two times does."""
        dt = stop - start
        return self._resting(dt, force=self.force, motion=PRESSING_MOTION * dt / self.end)


@dataclass(frozen=True, kw_only=True)
class LiftOff(Steps):
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

    name = "lifting"
    unit = " of the rise"
    end = 1.0
    on_road = False

    def target(self, start: float, stop: float) -> Target:
        """What a step between two parts does."""
        share = stop - start
        return Target(
            dt=self.time * share,
            sweep=0.0,
            force=0.0,
            raised=self.rise * share,
            motion=PRESSING_MOTION * share,
            convection=self.convection,
            inertia=False,
        )


@dataclass(frozen=True, kw_only=True)
class Rest(_AtRest):
    """The block hangs in air."""

    name = "in air"
    on_road = False

    def target(self, start: float, stop: float) -> Target:
        """What a step between two times does."""
        return self._resting(stop - start, force=0.0, raised=0.0, motion=PRESSING_MOTION)


def resting_steps(duration: float, scale: float = 1.0) -> dict[str, Any]:
    """Limits of the steps of a rest of a duration [s], for its constructor."""
    first = min(FIRST_REST, 0.1 * duration) * scale
    return {"step_initial": first, "step_max": duration, "step_min": 1e-3 * first}


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
        0.0,
        1.0,
        xtol=1e-14,
    )
    return float(tau * 2.0 * ramp / (speed + start))
