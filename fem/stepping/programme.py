"""The phases that a case asks for, in order."""

from dataclasses import replace
from math import ceil
from typing import Any

import numpy as np
from scipy.optimize import brentq

from fem.case import Case, Signal, loading
from fem.stepping.phases import (
    LONGEST_PART,
    SHORTEST_PART,
    Hold,
    LiftOff,
    Phase,
    Press,
    Rest,
    Slide,
    resting_steps,
    sliding_time,
)
from fem.stepping.record import Follow
from materials.units import W_PER_M2_K

#: Longest sliding step over the distance slid. The edge rolls under at a few millimetres; in longer
#: steps the heat of the block's friction on itself would come in one go.
ONSET_SHARE = 0.2
#: Longest time in which a block is lifted off [s], its share of the time in air, and how far it is
#: raised over its height [-].
LIFTING_TIME, LIFTING_SHARE, LIFTING_HEIGHT = 1e-3, 0.1, 0.5
#: First and longest step of lifting off, of all of it. The edge unrolls and the block springs back:
#: in longer steps backward Euler would take more energy than a hundredth of the event's work.
FIRST_LIFT, LONGEST_LIFT = 0.01, 0.03


def programme(case: Case) -> list[Phase]:
    """Phases of a case; of a single slide pressing and sliding (section 4.1 of the paper, Fig. 7).

    A rigid block is pressed and has its speed at once.
    """
    builder = _Builder(case)
    for _ in range(case.loading.repeat):
        for number, phase in enumerate(case.loading.phases, 1):
            builder.add(number, phase)
    return builder.phases


class _Builder:
    """Phases one after another, each from where the last one ends."""

    def __init__(self, case: Case) -> None:
        self.case, self.scale, self.rigid = case, case.solver.steps_scale, case.block.rigid
        self.film = W_PER_M2_K * case.heat.convection_W_per_m2K
        self.phases: list[Phase] = []
        self.pressure = self.velocity = 0.0
        self.number, self.contact, self.in_air = 0, 0, False

    @property
    def force(self) -> float:
        """Force on the platen [N/mm]."""
        return self.pressure * self.case.block.pressed_length_mm

    def add(self, number: int, phase: loading.PhaseKind) -> None:
        """Append a phase of the case."""
        self.number = number
        if isinstance(phase, loading.Press):
            self._press(phase)
        elif isinstance(phase, loading.Lift):
            self._lift(phase.time_s, phase.convection_W_per_m2K)
        elif isinstance(phase, loading.Record):
            for start, end, on_road in phase.signal.contacts():
                if on_road:
                    self._follow(phase.signal, start, end)
                else:
                    self._air(end - start)
        elif phase.velocity_mm_per_s == 0.0:
            self._hold(phase.duration)
        else:
            self._slide(phase)

    def _common(self) -> dict[str, Any]:
        return {
            "number": self.number,
            "contact": self.contact,
            "pressure": self.pressure,
            "convection": self.film,
        }

    def _press(self, phase: loading.Press) -> None:
        before, comes_down = self.force, self.in_air
        self.contact += comes_down or not self.contact
        self.pressure, self.velocity, self.in_air = phase.mean_pressure_N_per_mm2, 0.0, False
        if self.rigid:
            if self.case.loading.phase:
                self._hold(phase.time_s, touches_down=comes_down)
            return
        longest = LONGEST_PART * self.scale
        self.phases.append(
            Press(
                time=phase.time_s,
                force=self.force,
                force_before=before,
                touches_down=comes_down,
                step_initial=longest,
                step_max=longest,
                step_min=SHORTEST_PART,
                **self._common(),
            )
        )

    def _slide(self, phase: loading.Slide) -> None:
        speed, sense = abs(phase.velocity_mm_per_s), float(np.sign(phase.velocity_mm_per_s))
        # A block that turns round stops first.
        start = max(sense * self.velocity, 0.0)
        ramp = 0.0 if self.rigid else phase.acceleration_distance_mm
        distance = _distance(phase, speed, start, ramp)
        self.velocity = phase.velocity_mm_per_s
        last = self.phases[-1] if self.phases else None
        if isinstance(last, Slide) and start == speed:
            # The same slide goes on.
            self.phases[-1] = replace(last, end=last.end + distance)
            return
        self.phases.append(
            Slide(
                end=distance,
                speed=speed,
                sense=sense,
                force=self.force,
                start=start,
                acceleration_distance=ramp,
                **self._steps(distance),
                **self._common(),
            )
        )

    def _steps(self, distance: float) -> dict[str, Any]:
        """Steps of a slide; of a rigid block equal ones of the heat's length."""
        solver, scale = self.case.solver, self.scale
        if self.rigid:
            step = distance / max(1, ceil(distance / (solver.heat_step_mm * scale) - 1e-9))
            return {"step_initial": step, "step_max": step, "step_min": 0.0}
        return {
            "step_initial": solver.step_mm_initial * scale,
            "step_max": solver.step_mm_max * scale,
            "step_min": solver.step_mm_min,
            "onset_share": ONSET_SHARE * scale,
        }

    def _hold(self, duration: float, *, touches_down: bool = False) -> None:
        self.velocity = 0.0
        self.phases.append(
            Hold(
                end=duration,
                force=self.force,
                touches_down=touches_down,
                **resting_steps(duration, self.scale),
                **self._common(),
            )
        )

    def _follow(self, signal: Signal, start: float, end: float) -> None:
        """Follow what was measured on the road."""
        solver, scale, comes_down = self.case.solver, self.scale, self.in_air
        self.contact += comes_down or not self.contact
        self.in_air, self.pressure = False, signal.at(signal.p, end)
        self.velocity = signal.at(signal.v, end)
        path = solver.heat_step_mm if self.rigid else solver.step_mm_max
        first = path if self.rigid else solver.step_mm_initial
        duration = end - start
        follow = Follow(
            signal=signal,
            since=start,
            end=duration,
            length=self.case.block.pressed_length_mm,
            path_max=scale * path,
            path_initial=scale * first,
            onset_share=scale * ONSET_SHARE,
            pressure_max=scale * LONGEST_PART * float(signal.p.max()),
            touches_down=comes_down,
            step_initial=duration,
            step_max=duration,
            step_min=1e-7 * duration,
            **self._common(),
        )
        self.phases.append(replace(follow, step_initial=follow.longest(0.0)))

    def _air(self, time: float) -> None:
        """In air after a contact; before the first one the block only waits."""
        if self.contact:
            self._lift(time, None)

    def _lift(self, time_s: float, convection: float | None) -> None:
        self.pressure, self.velocity, self.in_air = 0.0, 0.0, True
        common, rest = self._common(), time_s
        if convection is not None:
            common["convection"] = W_PER_M2_K * convection
        if not self.rigid:
            time = min(LIFTING_TIME, LIFTING_SHARE * rest)
            self.phases.append(
                LiftOff(
                    time=time,
                    rise=LIFTING_HEIGHT * self.case.block.height_mm,
                    step_initial=FIRST_LIFT * self.scale,
                    step_max=LONGEST_LIFT * self.scale,
                    step_min=SHORTEST_PART,
                    **common,
                )
            )
            rest -= time
        self.phases.append(Rest(end=rest, **resting_steps(rest, self.scale), **common))


def _distance(phase: loading.Slide, speed: float, start: float, ramp: float) -> float:
    """Distance of a slide [mm]; one that lasts a given time gets as far as its speed lets it."""
    if phase.distance_mm is not None:
        return phase.distance_mm
    duration = phase.duration
    whole = speed * duration - (speed - start) / (speed + start) * ramp
    if whole >= ramp:
        return whole
    return float(
        brentq(lambda s: sliding_time(s, speed, ramp, start) - duration, 0.0, ramp, xtol=1e-14)
    )
