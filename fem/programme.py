"""What is done to the block over time: pressing, then sliding with a short acceleration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fem.case import Case
from fem.regularisation import relaxation_time

#: Duration of the pressing phase [s] without viscosity, and with it in relaxation times.
PRESSING_TIME = 0.05
PRESSING_RELAXATIONS = 3.0
#: Distance of constant acceleration at the start of sliding [mm].
ACCELERATION_DISTANCE = 0.5


@dataclass(frozen=True, kw_only=True)
class Target:
    """End of a step: its length [s], platen motion [mm, signed] and platen force [N/mm]."""

    dt: float
    sweep: float
    force: float


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
    """

    name: str
    end: float
    step_initial: float
    step_max: float
    step_min: float
    target: Callable[[float, float], Target]
    slides: bool


def sliding_time(distance: float, speed: float) -> float:
    """Time since the start of sliding [s], constant acceleration up to `speed` [mm/s] at first.

    Parameters
    ----------
    distance : float
        Distance slid [mm].
    speed : float
        Final speed [mm/s].
    """
    ramp = ACCELERATION_DISTANCE
    if distance < ramp:
        return float(2.0 * np.sqrt(ramp * distance) / speed)
    return (distance + ramp) / speed


def programme(case: Case) -> tuple[Phase, Phase]:
    """Pressing and sliding phase of a case (section 4.1 of the paper, Fig. 7)."""
    loading, solver = case.loading, case.solver
    force = loading.mean_pressure_N_per_mm2 * case.block.length_mm
    speed, sense = abs(loading.velocity_mm_per_s), float(np.sign(loading.velocity_mm_per_s))
    scale = solver.steps_scale
    pressing_time = max(PRESSING_TIME, PRESSING_RELAXATIONS * relaxation_time(case))

    def pressing(start: float, stop: float) -> Target:
        return Target(dt=pressing_time * (stop - start), sweep=0.0, force=force * stop)

    def sliding(start: float, stop: float) -> Target:
        dt = sliding_time(stop, speed) - sliding_time(start, speed)
        return Target(dt=dt, sweep=sense * (stop - start), force=force)

    return (
        Phase(
            name="pressing", end=1.0, step_initial=0.25 * scale, step_max=0.25 * scale,
            step_min=1e-4, target=pressing, slides=False,
        ),
        Phase(
            name="sliding", end=loading.distance_mm, step_initial=solver.step_mm_initial * scale,
            step_max=solver.step_mm_max * scale, step_min=solver.step_mm_min, target=sliding,
            slides=True,
        ),
    )  # fmt: skip
