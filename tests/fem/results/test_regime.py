"""Steady sliding and stick-slip, as histories and as short runs of a rubber block."""

import numpy as np
import pandas as pd
import pytest

from fem import Case, simulate
from fem.results.regime import (
    CAUGHT,
    CYCLES,
    ONSET,
    SLIDING,
    STEADY,
    STICK_SLIP,
    sliding_regime,
    stick_slip_cycles,
)

#: Ratios of the mean slip velocity to the platen's, between which nothing is counted.
BETWEEN = 0.5 * (SLIDING + CAUGHT)


@pytest.mark.parametrize(
    ("ratio", "cycles"),
    [
        ([], 0),
        ([0.0, 0.1, 0.4], 0),
        ([1.0, 1.0, 1.0], 0),
        ([0.0, BETWEEN, 1.0, 1.0], 0),
        ([1.0, BETWEEN, 1.0, BETWEEN, 1.0], 0),
        ([1.0, 0.0, BETWEEN, 0.0, 1.0], 1),
        ([0.0, 1.0, 0.0, 1.0, 0.0], 1),
        ([0.0, *[1.0, 0.0] * 5], 4),
    ],
)
def test_a_cycle_is_being_caught_and_sliding_in_full_again(ratio, cycles):
    assert stick_slip_cycles(ratio) == cycles


def history(ratio, velocity=300.0):
    """History with a row of pressing before the slide."""
    ratio = np.concatenate([[0.0], ratio])
    return pd.DataFrame({
        "sliding_distance_mm": np.arange(len(ratio), dtype=float),
        "velocity_mm_per_s": np.full(len(ratio), velocity),
        "mean_slip_velocity_mm_per_s": ratio * abs(velocity),
    })  # fmt: skip


@pytest.mark.parametrize("velocity", [300.0, -300.0])
@pytest.mark.parametrize(
    ("ratio", "name"),
    [
        ([], ONSET),
        ([0.0, 0.5, 0.8], ONSET),
        ([0.0, 0.5, 1.0], STEADY),
        ([0.0, 1.0, *[0.0, 1.0] * (CYCLES - 1)], STEADY),
        ([0.0, 1.0, *[0.0, 1.0] * CYCLES], STICK_SLIP),
    ],
)
def test_regime_follows_from_full_sliding_and_returns_to_it(ratio, name, velocity):
    assert sliding_regime(history(ratio, velocity)).name == name


def slide(**friction):
    """Summary and log of a slide in steps short enough for the vibrations of the block."""
    case = Case.from_dict({
        "block": {"mesh": {
            "cells_x": 10, "cells_y": 4, "smallest_x_mm": 2.0, "smallest_y_mm": 2.0,
        }},
        "friction": friction,
        "loading": {
            "mean_pressure_N_per_mm2": 0.1, "velocity_mm_per_s": 300.0, "distance_mm": 3.0,
        },
        "solver": {"step_mm_max": 0.02},
        "output": {"snapshots": 1, "vtu": False},
    })  # fmt: skip
    result = simulate(case)
    assert result.summary["status"] == "ok"
    return result.summary, result.log


def test_a_coefficient_that_falls_with_speed_at_once_makes_the_block_stick_slip_and_says_so():
    summary, log = slide(memory_mm=0.0)
    assert summary["sliding_regime"] == STICK_SLIP
    (warning,) = (line for line in summary["warnings"] if "stick-slips" in line)
    assert any(warning in line for line in log)


@pytest.mark.parametrize(
    "friction",
    [{}, {"law": "coulomb", "mu": 0.9, "memory_mm": 0.0}],
    ids=["default memory", "constant coefficient without memory"],
)
def test_the_same_block_slides_steadily(friction):
    summary, _ = slide(**friction)
    assert summary["sliding_regime"] == STEADY
    assert not any("stick-slip" in line for line in summary["warnings"])
