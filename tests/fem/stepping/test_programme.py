"""Pressing and sliding phase of a case: force, sweep and time of the steps."""

from itertools import pairwise

import numpy as np
import pytest

from fem import Case
from fem.stepping.programme import programme


def case_of(velocity=300.0, distance=10.0, **solver):
    loading = {
        "mean_pressure_N_per_mm2": 0.25,
        "velocity_mm_per_s": velocity,
        "distance_mm": distance,
    }
    return Case.from_dict({"loading": loading, "solver": solver})


def targets(phase, count=40):
    stops = np.linspace(0.0, phase.end, count + 1)
    return [phase.target(a, b) for a, b in pairwise(stops)]


def test_pressing_raises_the_force_to_pressure_times_length_without_sliding():
    pressing, _ = programme(case_of())
    steps = targets(pressing)
    assert steps[-1].force == pytest.approx(0.25 * 20.0)
    assert (np.diff([step.force for step in steps]) > 0.0).all()
    assert all(step.sweep == 0.0 and step.dt > 0.0 for step in steps)


@pytest.mark.parametrize("velocity", [300.0, -300.0, 7.0])
def test_sliding_sweeps_the_distance_at_constant_force(velocity):
    _, sliding = programme(case_of(velocity))
    steps = targets(sliding)
    assert sliding.end == 10.0
    assert sum(step.sweep for step in steps) == pytest.approx(np.sign(velocity) * 10.0)
    assert all(step.force == pytest.approx(5.0) for step in steps)


@pytest.mark.parametrize("velocity", [300.0, -300.0, 7.0])
def test_the_platen_reaches_its_velocity_after_a_short_acceleration(velocity):
    _, sliding = programme(case_of(velocity))
    speeds = np.array([step.sweep / step.dt for step in targets(sliding)])
    assert abs(speeds[0]) < abs(velocity)
    np.testing.assert_allclose(speeds[10:], velocity, rtol=1e-9)
    assert (np.diff(np.abs(speeds)) > -1e-9 * abs(velocity)).all()


def test_the_time_of_a_slide_does_not_depend_on_its_steps():
    _, sliding = programme(case_of())
    durations = [sum(step.dt for step in targets(sliding, n)) for n in (7, 40, 400)]
    np.testing.assert_allclose(durations, durations[0], rtol=1e-12)
    assert 10.0 / 300.0 < durations[0] < 1.2 * 10.0 / 300.0


def test_steps_scale_scales_all_steps():
    for one, half in zip(programme(case_of()), programme(case_of(steps_scale=0.5)), strict=True):
        assert half.step_initial == pytest.approx(0.5 * one.step_initial)
        assert half.step_max == pytest.approx(0.5 * one.step_max)


def test_step_limits_come_from_the_solver_section():
    _, sliding = programme(case_of(step_mm_initial=0.03, step_mm_max=0.7, step_mm_min=2e-5))
    assert (sliding.step_initial, sliding.step_max, sliding.step_min) == (0.03, 0.7, 2e-5)


def test_steps_of_an_onset_are_resolved_relative_to_the_distance_slid():
    pressing, sliding = programme(case_of(distance=100.0))
    assert sliding.longest(0.0) == sliding.step_initial
    assert sliding.longest(5.0) == pytest.approx(sliding.onset_share * 5.0)
    assert sliding.longest(80.0) == sliding.step_max
    assert pressing.longest(0.5) == pressing.step_max
