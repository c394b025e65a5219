"""The phases that a case asks for, in order."""

from __future__ import annotations

from math import ceil

import numpy as np

from fem.case.case import Case
from fem.stepping.phases import LONGEST_PART, SHORTEST_PART, Phase, Press, Slide

#: Longest sliding step over the distance slid. The edge rolls under at a few millimetres; in longer
#: steps the heat of the block's friction on itself would come in one go.
ONSET_SHARE = 0.2
#: Duration of the pressing phase [s].
PRESSING_TIME = 0.05
#: Distance of acceleration at the start of sliding [mm].
ACCELERATION_DISTANCE = 0.5


def programme(case: Case) -> list[Phase]:
    """Phases of a case: pressing and sliding (section 4.1 of the paper, Fig. 7).

    A rigid block is pressed and has its speed at once.
    """
    loading, scale = case.loading, case.solver.steps_scale
    force = loading.mean_pressure_N_per_mm2 * case.block.length_mm
    slide = _slide(case, loading.velocity_mm_per_s, loading.distance_mm, force)
    if case.block.rigid:
        return [slide]
    longest = LONGEST_PART * scale
    return [
        Press(
            time=PRESSING_TIME, force=force,
            step_initial=longest, step_max=longest, step_min=SHORTEST_PART,
        ),
        slide,
    ]  # fmt: skip


def _slide(case: Case, velocity: float, distance: float, force: float) -> Slide:
    """A slide from rest; equal steps of the heat's length for a rigid block."""
    solver, scale = case.solver, case.solver.steps_scale
    speed, sense = abs(velocity), float(np.sign(velocity))
    if case.block.rigid:
        step = distance / max(1, ceil(distance / (solver.heat_step_mm * scale) - 1e-9))
        return Slide(
            end=distance, speed=speed, sense=sense, force=force,
            step_initial=step, step_max=step, step_min=0.0,
        )  # fmt: skip
    return Slide(
        end=distance, speed=speed, sense=sense, force=force,
        acceleration_distance=ACCELERATION_DISTANCE, onset=True, onset_share=ONSET_SHARE * scale,
        step_initial=solver.step_mm_initial * scale, step_max=solver.step_mm_max * scale,
        step_min=solver.step_mm_min,
    )  # fmt: skip
