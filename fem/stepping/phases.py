"""What can be done to the block: phases, each run through along one coordinate from 0 to its end.

A phase says what the platen does in a step between two coordinates (its force or its rise, its
motion over the road, the time that takes), how long steps may be, and how far the block has slid.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Protocol

from scipy.optimize import brentq

#: Distance that pressing counts as, where damping is stated by a distance [mm].
PRESSING_MOTION = 1.0
#: Parts of pressing and lifting: the longest and the shortest step.
LONGEST_PART, SHORTEST_PART = 0.25, 1e-4
#: Longest step in air over the time in air, and the first one over the time of the contact: the
#: heat that a contact left in the surface spreads ever more slowly. Backward Euler then errs by a
#: fifth of this share on what is left of a contact's temperature.
RESTING_SHARE, FIRST_REST = 0.15, 0.05


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
    """

    dt: float
    sweep: float
    force: float
    motion: float
    raised: float | None = None
    convection: float = 0.0


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
        """Number of the contact with the road, from 1 on; 0 in air."""

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
    contact : int
        Number of the contact with the road; 0 in air.
    convection : float
        Film coefficient of the free surfaces [N/(mm s K)].
    """

    step_initial: float
    step_max: float
    step_min: float
    contact: int = 1
    convection: float = 0.0

    onset = False

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
    velocity : float
        Of the platen [mm/s].
    """

    time: float
    force: float
    force_before: float = 0.0
    velocity: float = 0.0
    name: str = "pressing"
    unit: str = " of the load"
    end: float = 1.0

    def target(self, start: float, stop: float) -> Target:
        """What a step between two parts does."""
        share = stop - start
        motion = self.velocity * self.time * share
        return Target(
            dt=self.time * share,
            sweep=motion,
            force=self.force_before + (self.force - self.force_before) * stop,
            motion=PRESSING_MOTION * share + abs(motion),
            convection=self.convection,
        )

    def slid(self, at: float) -> float:
        """Distance over the road [mm]."""
        return abs(self.velocity) * self.time * at


@dataclass(frozen=True, kw_only=True)
class Slide(_Steps):
    """The platen slides at a constant force; the coordinate is the distance [mm].

    Attributes
    ----------
    end : float
        Sliding distance [mm].
    speed, sense : float
        Final speed [mm/s], and its sign.
    acceleration_distance : float
        Distance over which it starts from rest [mm]; 0 where it has its speed already.
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
        dt = sliding_time(stop, self.speed, ramp) - sliding_time(start, self.speed, ramp)
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
class Change(_Steps):
    """The speed of the platen changes, or stays, at a constant force; the coordinate is time [s].

    Attributes
    ----------
    end : float
        Duration [s].
    before, after : float
        Velocity at both ends [mm/s]; it goes over as ``3 tau^2 - 2 tau^3``.
    force : float
        On the platen [N/mm].
    """

    end: float
    before: float
    after: float
    force: float
    name: str = "sliding"
    unit: str = " s"

    def _position(self, at: float) -> float:
        tau = at / self.end
        return self.before * at + (self.after - self.before) * self.end * tau**3 * (1 - 0.5 * tau)

    def target(self, start: float, stop: float) -> Target:
        """What a step between two times does."""
        sweep = self._position(stop) - self._position(start)
        fastest = max(abs(self.before), abs(self.after))
        motion = fastest * (stop - start) or PRESSING_MOTION * (stop - start) / self.end
        return Target(
            dt=stop - start,
            sweep=sweep,
            force=self.force,
            motion=motion,
            convection=self.convection,
        )

    def slid(self, at: float) -> float:
        """Distance over the road [mm], back and forth."""
        if self.before * self.after >= 0.0:
            return abs(self._position(at))
        share = self.before / (self.before - self.after)
        tau = brentq(lambda tau: tau**2 * (3.0 - 2.0 * tau) - share, 0.0, 1.0, xtol=1e-14)
        turn = tau * self.end
        if at <= turn:
            return abs(self._position(at))
        return abs(self._position(turn)) + abs(self._position(at) - self._position(turn))


@dataclass(frozen=True, kw_only=True)
class LiftOff(_Steps):
    """The platen rises until nothing touches; the coordinate is the part of its rise.

    Attributes
    ----------
    time : float
        Duration [s].
    rise : float
        Of the platen [mm].
    velocity : float
        Of the platen over the road, which the block leaves as it slides [mm/s].
    """

    time: float
    rise: float
    velocity: float = 0.0
    name: str = "lifting"
    unit: str = " of the rise"
    end: float = 1.0

    def target(self, start: float, stop: float) -> Target:
        """What a step between two parts does."""
        share = stop - start
        sweep = self.velocity * self.time * share
        return Target(
            dt=self.time * share,
            sweep=sweep,
            force=0.0,
            raised=self.rise * share,
            motion=PRESSING_MOTION * share + abs(sweep),
            convection=self.convection,
        )

    def slid(self, at: float) -> float:
        """Distance over the road, as long as anything touches it [mm]."""
        return abs(self.velocity) * self.time * at


@dataclass(frozen=True, kw_only=True)
class Rest(_Steps):
    """The block hangs in air; the coordinate is time [s], and steps follow the heat."""

    end: float
    name: str = "in air"
    unit: str = " s"

    def longest(self, at: float) -> float:
        """Longest step from a time on."""
        return max(self.step_initial, RESTING_SHARE * at)

    def target(self, start: float, stop: float) -> Target:
        """What a step between two times does."""
        return Target(
            dt=stop - start,
            sweep=0.0,
            force=0.0,
            raised=0.0,
            motion=PRESSING_MOTION,
            convection=self.convection,
        )

    def slid(self, at: float) -> float:
        """None."""
        return 0.0


def sliding_time(distance: float, speed: float, ramp: float) -> float:
    """Time since the start of sliding [s], smoothly accelerated up to `speed` [mm/s] at first.

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

    Examples
    --------
    >>> sliding_time(2.5, 300.0, 0.5)
    0.01
    """
    if distance >= ramp:
        return (distance + ramp) / speed
    # The distance is the integral of the speed, s/ramp = 2 tau^3 - tau^4.
    tau = brentq(lambda tau: tau**3 * (2.0 - tau) - distance / ramp, 0.0, 1.0, xtol=1e-14)
    return float(tau * 2.0 * ramp / speed)
