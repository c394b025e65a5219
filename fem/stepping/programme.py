"""What is done to the block over time: pressing, then sliding with a short acceleration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

import numpy as np
from scipy.optimize import brentq

from fem.case.case import Case

#: Longest sliding step over the distance slid. The edge rolls under at a few millimetres; in longer
#: steps the heat of the block's friction on itself would come in one go.
ONSET_SHARE = 0.2
#: Duration of the pressing phase [s].
PRESSING_TIME = 0.05
#: Distance that pressing counts as, where damping is stated by a distance [mm].
PRESSING_MOTION = 1.0
#: Distance of acceleration at the start of sliding [mm].
ACCELERATION_DISTANCE = 0.5


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
    """

    dt: float
    sweep: float
    force: float
    motion: float


@dataclass(frozen=True, kw_only=True)
class Phase:
    """A part of the event, run through along one coordinate from 0 to `end`.

    Attributes
    ----------
    name : str
        For the log.
    end : float
        Last value of the coordinate.
    step_initial, step_max, step_min : float
        Steps of the coordinate.
    target : callable
        ``target(start, stop) -> Target`` of a step between two coordinates.
    slides : bool
        Whether the coordinate is the sliding distance [mm].
    onset_share : float
        Longest step relative to the coordinate reached, beyond the first one: what happens in an
        onset is resolved alike on all its scales.
    """

    name: str
    end: float
    step_initial: float
    step_max: float
    step_min: float
    target: Callable[[float, float], Target]
    slides: bool
    onset_share: float = inf

    def longest(self, at: float) -> float:
        """Longest step from a coordinate on."""
        return min(self.step_max, max(self.step_initial, self.onset_share * at))


def sliding_time(distance: float, speed: float) -> float:
    """Time since the start of sliding [s], smoothly accelerated up to `speed` [mm/s] at first.

    The speed rises as ``3 tau^2 - 2 tau^3``, without a jump of the acceleration: a block of rubber
    would answer one with a jump of the platen's force.

    Parameters
    ----------
    distance : float
        Distance slid [mm].
    speed : float
        Final speed [mm/s].

    Examples
    --------
    >>> sliding_time(2.5, 300.0)
    0.01
    """
    ramp = ACCELERATION_DISTANCE
    if distance >= ramp:
        return (distance + ramp) / speed
    # The distance is the integral of the speed, s/ramp = 2 tau^3 - tau^4.
    tau = brentq(lambda tau: tau**3 * (2.0 - tau) - distance / ramp, 0.0, 1.0, xtol=1e-14)
    return float(tau * 2.0 * ramp / speed)


def programme(case: Case) -> tuple[Phase, Phase]:
    """Pressing and sliding phase of a case (section 4.1 of the paper, Fig. 7)."""
    loading, solver = case.loading, case.solver
    force = loading.mean_pressure_N_per_mm2 * case.block.length_mm
    speed, sense = abs(loading.velocity_mm_per_s), float(np.sign(loading.velocity_mm_per_s))
    scale = solver.steps_scale

    def pressing(start: float, stop: float) -> Target:
        share = stop - start
        return Target(
            dt=PRESSING_TIME * share,
            sweep=0.0,
            force=force * stop,
            motion=PRESSING_MOTION * share,
        )

    def sliding(start: float, stop: float) -> Target:
        dt = sliding_time(stop, speed) - sliding_time(start, speed)
        motion = stop - start
        return Target(dt=dt, sweep=sense * motion, force=force, motion=motion)

    return (
        Phase(
            name="pressing", end=1.0, step_initial=0.25 * scale, step_max=0.25 * scale,
            step_min=1e-4, target=pressing, slides=False,
        ),
        Phase(
            name="sliding", end=loading.distance_mm, step_initial=solver.step_mm_initial * scale,
            step_max=solver.step_mm_max * scale, step_min=solver.step_mm_min, target=sliding,
            slides=True, onset_share=ONSET_SHARE * scale,
        ),
    )  # fmt: skip
