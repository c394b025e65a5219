"""Rigid-block cases through `simulate`: the tables, and conduction columns for the temperatures."""

import numpy as np
import pytest

from fem import Case, simulate
from fem.results.columns import HISTORY, SUMMARY, SURFACE
from fem.results.result import Result
from tests.reference_solutions.conduction_columns import sliding_columns


def a_case(velocity=300.0, pressure=0.3, distance=120.0, **tables):
    loading = {
        "mean_pressure_N_per_mm2": pressure,
        "velocity_mm_per_s": velocity,
        "distance_mm": distance,
    }
    block = {"rigid": True, "mesh": "coarse"} | tables.pop("block", {})
    return Case.from_dict({"loading": loading, "block": block, **tables})


@pytest.fixture(scope="module")
def short_run():
    case = a_case(distance=10.0, output={"snapshots": 4})
    return simulate(case)


def columns_of(case):
    """The same event by the independent conduction columns."""
    loading, rubber, road = case.loading, case.rubber.thermal, case.road.thermal
    p, v = loading.mean_pressure_N_per_mm2, abs(loading.velocity_mm_per_s)
    law = case.friction.law_object()
    result = sliding_columns(
        velocity=v,
        distance=loading.distance_mm,
        length=case.block.length_mm,
        pressure=p,
        friction=lambda T: law.coefficient(p, v, T),
        kappa=float(case.heat.partition_object()(p)),
        conductance=1e-3 * float(case.heat.conductance_object().conductance(p, v)),
        block=(rubber.conductivity, rubber.heat_capacity),
        road=(road.conductivity, road.heat_capacity),
        T_0_C=case.heat.ambient_C,
    )
    return result.T_max_C, result.excess_area(case.heat.ambient_C, case.block.length_mm)


@pytest.mark.parametrize("velocity", [7.0, 50.0, 300.0])
@pytest.mark.parametrize("pressure", [0.2, 0.3, 0.4])
def test_a_rigid_case_matches_conduction_columns(velocity, pressure):
    """The case as a user runs it, WLF on; the columns have no radiation, so it is off."""
    case = a_case(velocity, pressure, block={"mesh": "default"}, heat={"emissivity": 0.0})
    summary = simulate(case).summary
    T_max, area = columns_of(case)
    assert summary["T_max_C"] == pytest.approx(T_max, abs=0.5)
    assert summary["A_T_K_mm"] == pytest.approx(area, rel=0.02)


def test_all_tables_are_filled(short_run):
    assert list(short_run.history.columns[: len(HISTORY)]) == list(HISTORY)
    assert list(short_run.surface.columns[: len(SURFACE)]) == list(SURFACE)
    assert list(short_run.summary)[: len(SUMMARY)] == list(SUMMARY)
    assert short_run.summary["status"] == "ok"
    assert not short_run.history.isna().any(axis=None)


def test_the_work_of_the_platen_is_the_integral_of_the_friction_force(short_run):
    history = short_run.history
    length = np.diff(history["sliding_distance_mm"], prepend=0.0)
    work = np.sum(history["friction_force_N_per_mm"] * length)
    assert history["work_in_mJ_per_mm"].iloc[-1] == pytest.approx(work, rel=1e-12)


def test_forces_follow_from_pressure_and_length(short_run):
    last = short_run.history.iloc[-1]
    assert last["normal_force_N_per_mm"] == pytest.approx(0.3 * 20.0, rel=1e-12)
    assert last["contact_length_mm"] == pytest.approx(20.0, rel=1e-12)
    assert last["sliding_distance_mm"] == 10.0
    assert last["time_s"] == pytest.approx(10.0 / 300.0)


def test_the_surface_table_opposes_the_motion_with_mu_p(short_run):
    surface = short_run.surface
    assert (surface["shear_N_per_mm2"] < 0.0).all()
    np.testing.assert_allclose(surface["slip_velocity_mm_per_s"], 300.0, rtol=1e-12)
    ratio = -surface["shear_N_per_mm2"] / surface["pressure_N_per_mm2"]
    mean = np.trapezoid(ratio, surface["X_mm"]) / 20.0
    assert mean == pytest.approx(short_run.history["friction_coefficient"].iloc[-1], rel=1e-3)


def test_heat_balances_to_rounding(short_run):
    assert short_run.summary["heat_error"] < 1e-12
    last = short_run.history.iloc[-1]
    found = (
        last["heat_in_rubber_mJ_per_mm"]
        + last["heat_in_road_mJ_per_mm"]
        + last["radiated_mJ_per_mm"]
    )
    assert found == pytest.approx(last["frictional_heat_mJ_per_mm"], rel=1e-12)


def test_snapshots_are_taken_at_equal_distances_and_at_the_end(short_run):
    at = [snapshot.sliding_distance_mm for snapshot in short_run.snapshots]
    assert at == pytest.approx([2.5, 5.0, 7.5, 10.0])


def test_capped_heat_share_is_one_below_the_cap_pressure():
    capped = simulate(a_case(pressure=0.15, distance=2.0)).summary["capped_heat_share"]
    assert capped == pytest.approx(1.0, rel=1e-12)
    assert simulate(a_case(pressure=0.3, distance=2.0)).summary["capped_heat_share"] == 0.0


def test_a_rigid_run_to_the_left_is_the_mirror_image(short_run):
    left = simulate(a_case(velocity=-300.0, distance=10.0))
    for column in ("T_max_C", "A_T_K_mm", "friction_force_N_per_mm", "time_s"):
        np.testing.assert_allclose(left.history[column], short_run.history[column], rtol=1e-12)
    np.testing.assert_allclose(left.surface["T_C"], short_run.surface["T_C"], rtol=1e-12)
    np.testing.assert_allclose(
        left.surface["shear_N_per_mm2"], -short_run.surface["shear_N_per_mm2"], rtol=1e-12
    )
    np.testing.assert_allclose(left.history["velocity_mm_per_s"], -300.0, rtol=1e-12)


def test_progress_is_reported_after_each_step():
    seen = []
    result = simulate(a_case(distance=3.0), progress=seen.append)
    assert len(seen) == result.summary["steps"]
    assert seen[-1].sliding_distance_mm == 3.0
    assert seen[-1].T_max_C == result.summary["T_max_C"]


@pytest.mark.parametrize("after", [0, 3])
def test_an_interrupted_run_keeps_what_was_accepted(after, tmp_path, monkeypatch):
    if after == 0:
        from fem.stepping.coupled_step import CoupledModel

        def interrupted(*_):
            raise KeyboardInterrupt

        monkeypatch.setattr(CoupledModel, "advance", interrupted)
    seen = []

    def progress(report):
        seen.append(report)
        if len(seen) == after:
            raise KeyboardInterrupt

    result = simulate(a_case(distance=10.0), progress=progress)
    assert result.summary["status"] == "interrupted"
    assert len(result.history) == after
    assert result.snapshots[-1].sliding_distance_mm == pytest.approx(0.5 * after)
    result.write(tmp_path / "run")


def test_a_written_rigid_run_can_be_read_again(short_run, tmp_path):
    short_run.write(tmp_path / "run")
    again = Result.read(tmp_path / "run")
    assert again.summary == short_run.summary
    assert again.case == short_run.case
    np.testing.assert_allclose(again.history["T_max_C"], short_run.history["T_max_C"], rtol=1e-12)
