"""The rigid block in the time loop: sub-steps, sums and the mirror image; see `test_rigid_run`."""

import numpy as np
import pytest

from fem import Case, simulate
from tests.reference_solutions.conduction_columns import sliding_columns

RUBBER, ASPHALT = (0.284, 1.2070e-9 * 1.45e9), (0.70, 2.0e-9 * 0.92e9)


def slide(velocity=300.0, distance=10.0, pressure=0.15, **solver):
    loading = {
        "mean_pressure_N_per_mm2": pressure,
        "velocity_mm_per_s": velocity,
        "distance_mm": distance,
    }
    block = {"rigid": True, "mesh": "coarse"}
    return simulate(Case.from_dict({"loading": loading, "block": block, "solver": solver}))


def test_columns_agree_with_themselves_on_finer_cells_and_stations():
    """The reference is converged well inside the tolerance it is used with."""
    options = {
        "velocity": 300.0,
        "distance": 60.0,
        "length": 20.0,
        "pressure": 0.3,
        "friction": lambda T: np.full_like(T, 0.9),
        "kappa": 0.7,
        "conductance": 1.6,
        "block": RUBBER,
        "road": ASPHALT,
    }
    one = sliding_columns(**options)
    other = sliding_columns(**options, stations=200, first_cell=0.005, ratio=1.08)
    assert one.T_max_C == pytest.approx(other.T_max_C, abs=0.15)
    assert one.excess_area(20.0, 20.0) == pytest.approx(other.excess_area(20.0, 20.0), rel=4e-3)


def test_sub_steps_of_half_the_length_change_the_temperature_by_little():
    one, other = (slide(distance=40.0, pressure=0.3, heat_step_mm=step) for step in (0.5, 0.25))
    assert len(other.history) == 2 * len(one.history)
    assert np.abs(one.surface["T_C"] - other.surface["T_C"]).max() < 0.2


def test_steps_add_up_and_the_capped_share_is_reported():
    """Below 0.184 N/mm^2 the partition is capped everywhere."""
    result = slide()
    last = result.history.iloc[-1]
    assert last["sliding_distance_mm"] == 10.0
    assert last["time_s"] == pytest.approx(10.0 / 300.0)
    assert last["normal_force_N_per_mm"] == pytest.approx(0.15 * 20.0)
    assert result.summary["capped_heat_share"] == pytest.approx(1.0, rel=1e-12)
    work = last["friction_dissipation_mJ_per_mm"]
    assert last["work_in_mJ_per_mm"] == pytest.approx(work, rel=1e-12)
    assert last["frictional_heat_mJ_per_mm"] == pytest.approx(work, rel=1e-12)


def test_forces_of_the_surface_add_up_to_those_of_the_history():
    result = slide()
    X, shear = result.surface["X_mm"], result.surface["shear_N_per_mm2"]
    friction = result.history["friction_force_N_per_mm"].iloc[-1]
    assert -np.trapezoid(shear, X) == pytest.approx(friction, rel=1e-9)


def test_a_rigid_block_that_slides_to_the_left_is_the_mirror_image():
    ends = [slide(velocity) for velocity in (300.0, -300.0)]
    T = [end.snapshots[-1].temperature for end in ends]
    np.testing.assert_allclose(*T, rtol=0.0, atol=1e-10)


def test_friction_warms_over_the_slip_since_touch_down():
    case = {
        "loading": {
            "mean_pressure_N_per_mm2": 0.3, "velocity_mm_per_s": 300.0, "distance_mm": 4.0,
        },
        "block": {"rigid": True, "mesh": "coarse"},
    }  # fmt: skip
    cases = [Case.from_dict(case | {"friction": {"heating_slip_mm": s}}) for s in (0.0, 1.0)]
    at_once, later = (simulate(case).history for case in cases)
    hot, force = (h["friction_force_N_per_mm"].to_numpy()[1:] for h in (at_once, later))
    cold = cases[0].friction.law_object().coefficient(0.3, 300.0, 20.0) * 0.3 * 20.0
    left = np.exp(-at_once["sliding_distance_mm"].to_numpy()[1:])
    np.testing.assert_allclose((force - hot) / (cold - hot), left, atol=0.05)
