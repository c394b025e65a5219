"""The onset in a few numbers: interpolated forces, the pressed platen, the force of full slip."""

import numpy as np
import pandas as pd
import pytest

from fem.case.case import Case
from validation.convergence.onset import (
    damping_force_at,
    force_at,
    full_slip,
    pressed_platen,
    swept_runs,
)

#: Two rows of pressing, then three steps.
HISTORY = pd.DataFrame({
    "sliding_distance_mm": [0.0, 0.0, 0.1, 0.3, 1.0],
    "friction_force_N_per_mm": [-9.0, 0.0, 0.2, 0.6, 1.3],
    "platen_displacement_mm": [0.1, 0.25, 0.26, 0.27, 0.3],
    "viscous_dissipation_mJ_per_mm": [0.3, 0.5, 0.5, 0.7, 0.7],
})  # fmt: skip
LOADING = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": -300.0, "distance_mm": 3.0}


def test_forces_are_linear_between_the_steps_and_begin_at_the_pressed_block():
    found = force_at(HISTORY, np.array([0.05, 0.1, 0.2, 1.0]))
    assert found == pytest.approx([0.1, 0.2, 0.4, 1.3])


def test_the_damping_takes_what_it_dissipates_per_motion_and_nothing_of_the_pressing():
    found = damping_force_at(HISTORY, np.array([0.05, 0.1, 0.2, 0.3, 1.0]))
    assert found == pytest.approx([0.0, 0.0, 0.5, 1.0, 0.0])


def test_beyond_the_end_of_a_run_there_is_no_force():
    assert np.isnan(force_at(HISTORY, np.array([1.01]))).all()


def test_the_platen_is_that_of_the_pressed_block_before_it_moves():
    assert pressed_platen(HISTORY) == 0.25


def test_full_slip_is_the_coefficient_times_the_load_whatever_the_direction():
    friction = {"law": "coulomb", "mu": 0.6}
    case = Case.from_dict({"loading": LOADING, "friction": friction})
    assert full_slip(case) == pytest.approx(0.6 * 0.25 * 20.0)
    law = Case.from_dict({"loading": LOADING}).friction.law_object()
    expected = float(law.coefficient(0.25, 300.0, 20.0)) * 0.25 * 20.0
    assert full_slip(Case.from_dict({"loading": LOADING})) == pytest.approx(expected)


def test_a_run_that_is_missing_is_named(tmp_path):
    with pytest.raises(ValueError, match="distance_3.0"):
        swept_runs("onset", tmp_path)
