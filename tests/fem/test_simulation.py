"""The coupled run through `simulate`: balance, mirror image, records, and how a run ends."""

import numpy as np
import pytest

from contact import HeatPartition
from fem import Case, simulate
from fem.results.columns import HISTORY, SUMMARY, SURFACE
from fem.results.result import Result
from fem.stepping.model_parts import mesh_of
from tests.fem.small_blocks import leading_face

COULOMB = {"law": "coulomb", "mu": 0.5, "wlf": False}
HUEMER = {"law": "huemer"}


def case_of(friction=COULOMB, *, velocity=300.0, distance=2.0, **tables):
    loading = {
        "mean_pressure_N_per_mm2": 0.25,
        "velocity_mm_per_s": velocity,
        "distance_mm": distance,
    } | tables.pop("loading", {})
    tables = {"block": {"mesh": "coarse"}, "output": {"snapshots": 2}} | tables
    return Case.from_dict({"loading": loading, "friction": friction, **tables})


@pytest.fixture(scope="module")
def coulomb():
    return simulate(case_of(distance=3.0))


@pytest.fixture(scope="module")
def huemer():
    return simulate(case_of(HUEMER))


@pytest.fixture(params=["coulomb", "huemer"])
def run(request):
    return request.getfixturevalue(request.param)


# ------------------------------------------------------------------------------- balance


def test_a_short_run_finishes_with_all_tables(run):
    assert run.summary["status"] == "ok"
    assert list(run.history.columns[: len(HISTORY)]) == list(HISTORY)
    assert list(run.surface.columns[: len(SURFACE)]) == list(SURFACE)
    assert list(run.summary)[: len(SUMMARY)] == list(SUMMARY)
    assert not run.history.isna().any(axis=None)
    end = run.case.loading.distance_mm
    assert run.history["sliding_distance_mm"].iloc[-1] == end
    assert run.snapshots[-1].sliding_distance_mm == end


def test_energy_is_balanced(run):
    assert run.summary["energy_error"] < 0.01


def test_heat_is_balanced(run):
    assert run.summary["heat_error"] < 1e-9
    last = run.history.iloc[-1]
    found = sum(
        last[f"{name}_mJ_per_mm"] for name in ("heat_in_rubber", "heat_in_road", "radiated")
    )
    assert found == pytest.approx(last["frictional_heat_mJ_per_mm"], rel=1e-9)


def test_the_energy_columns_add_up_to_the_stated_error(run):
    last = run.history.iloc[-1]
    found = (
        last["strain_energy_mJ_per_mm"]
        + last["friction_dissipation_mJ_per_mm"]
        + last["viscous_dissipation_mJ_per_mm"]
        + last["kinetic_energy_mJ_per_mm"]
    )
    work = last["work_in_mJ_per_mm"]
    assert abs(work - found) / work == pytest.approx(run.summary["energy_error"], abs=2e-3)


def test_the_work_is_that_of_the_forces_in_the_history(run):
    """Trapezoids of the friction force over the sweep and of the normal force over the platen."""
    history = run.history
    F_T, F_N = history["friction_force_N_per_mm"], history["normal_force_N_per_mm"]
    s, w = history["sliding_distance_mm"], history["platen_displacement_mm"]
    pressing = 0.5 * F_N.iloc[0] * w.iloc[0]
    work = pressing + np.trapezoid(F_T, s) + np.trapezoid(F_N, w)
    assert history["work_in_mJ_per_mm"].iloc[-1] == pytest.approx(work, rel=0.01)


def test_the_normal_force_is_five_newtons_per_millimetre(run):
    """Of a step in which the leading edge snaps but for the rubber that it accelerates."""
    force = run.history["normal_force_N_per_mm"].iloc[3:]
    assert force.iloc[0] == pytest.approx(5.0, rel=1e-3)
    assert force.median() == pytest.approx(5.0, rel=1e-4)
    assert force.to_numpy() == pytest.approx(5.0, rel=2e-3)


def test_friction_in_steady_slip_is_mu_times_the_normal_force(coulomb):
    steady = coulomb.history[coulomb.history["sticking_nodes"] == 0]
    assert len(steady) > 0
    assert steady["sliding_distance_mm"].min() > 1.0  # the shear of the block comes first
    np.testing.assert_allclose(steady["friction_coefficient"], 0.5, rtol=1e-6)


@pytest.mark.parametrize("friction", [COULOMB, HUEMER | {"memory_mm": 0.0}])
def test_the_shear_of_slipping_nodes_is_mu_p_of_the_law(friction):
    """The coefficient is lagged by a pass; its share of the force is the stated lag error.

    Without memory: with it the coefficient is that of a speed which the surface does not show.
    """
    run = simulate(case_of(friction))
    surface, lag = run.surface, run.history["friction_lag_error"].iloc[-1]
    surface = surface[(surface["status"] == "slip") & (surface["pressure_N_per_mm2"] > 0.0)]
    p, v, T = (surface[c] for c in ("pressure_N_per_mm2", "slip_velocity_mm_per_s", "T_C"))
    mu = run.case.friction.law_object().coefficient(p, v, T)
    shear = np.abs(surface["shear_N_per_mm2"])
    weight = np.gradient(surface["X_mm"])
    difference = np.sum(weight * np.abs(shear - mu * p)) / np.sum(weight * shear)
    assert difference < 1.5 * lag + 0.01
    assert (surface["shear_N_per_mm2"] * v <= 0.0).all()


def test_history_columns_are_consistent_with_each_other(run):
    history = run.history[run.history["sliding_distance_mm"] > 0.0]
    np.testing.assert_allclose(
        history["friction_coefficient"],
        history["friction_force_N_per_mm"] / history["normal_force_N_per_mm"],
        rtol=1e-12,
    )
    np.testing.assert_allclose(
        history["mean_contact_pressure_N_per_mm2"] * history["contact_length_mm"],
        history["normal_force_N_per_mm"],
        rtol=1e-12,
    )
    assert (np.diff(history["time_s"]) > 0.0).all()
    assert history["velocity_mm_per_s"].iloc[-1] == pytest.approx(300.0, rel=1e-9)


# --------------------------------------------------------------------------- invariance


@pytest.mark.parametrize("law", ["coulomb", "huemer"])
def test_sliding_to_the_left_is_the_mirror_image(law, request):
    right = request.getfixturevalue(law)
    left = simulate(right.case.with_overrides({"loading.velocity_mm_per_s": -300.0}))
    assert len(left.history) == len(right.history)
    for column in right.history.columns:
        sign = -1.0 if column == "velocity_mm_per_s" else 1.0
        np.testing.assert_allclose(
            left.history[column], sign * right.history[column], rtol=1e-8, atol=1e-8, err_msg=column
        )
    length = right.case.block.length_mm
    for column in ("X_mm", "y_mm", "pressure_N_per_mm2", "T_C"):
        np.testing.assert_allclose(
            left.surface[column], right.surface[column], rtol=0.0, atol=1e-8, err_msg=column
        )
    np.testing.assert_allclose(left.surface["x_mm"], length - right.surface["x_mm"], atol=1e-8)
    for column in ("shear_N_per_mm2", "slip_velocity_mm_per_s"):
        np.testing.assert_allclose(
            left.surface[column], -right.surface[column], rtol=1e-8, atol=1e-8, err_msg=column
        )
    assert (left.surface["status"] == right.surface["status"]).all()
    one, other = left.snapshots[-1], right.snapshots[-1]
    # the meshes are numbered alike, column by column from the trailing side
    np.testing.assert_allclose(
        one.displacement, other.displacement * [-1.0, 1.0], rtol=0.0, atol=1e-8
    )
    np.testing.assert_allclose(one.temperature, other.temperature, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(
        one.cauchy_stress, other.cauchy_stress * [1.0, 1.0, 1.0, -1.0], rtol=0.0, atol=1e-7
    )


def test_the_same_case_gives_the_same_result(coulomb):
    again = simulate(coulomb.case)
    np.testing.assert_array_equal(again.history.to_numpy(), coulomb.history.to_numpy())


# -------------------------------------------------------------------------------- physics


def test_sliding_heats_the_bottom_and_more_so_the_longer_it_lasts(coulomb):
    history = coulomb.history[coulomb.history["sliding_distance_mm"] > 0.0]
    assert (np.diff(history["A_T_K_mm"]) > 0.0).all()
    assert coulomb.summary["T_max_C"] > 20.5


def test_the_leading_side_carries_more_than_the_trailing_one(coulomb):
    """The friction couple presses the leading half down and lifts the trailing edge."""
    surface = coulomb.surface
    front = surface["X_mm"] > 10.0
    dx = np.gradient(surface["X_mm"])
    load = surface["pressure_N_per_mm2"] * dx
    assert load[front].sum() > 1.1 * load[~front].sum()


def test_a_free_top_carries_the_same_load():
    result = simulate(case_of(loading={"top": "pressure"}, distance=1.0))
    assert result.summary["status"] == "ok"
    assert result.history["normal_force_N_per_mm"].iloc[-1] == pytest.approx(5.0, rel=1e-3)


LOW_FRICTION = {"law": "coulomb", "mu": 0.2, "wlf": False}
ALL_HEAT = {"partition": {"prefactor": 1.0, "exponent": 0.0}}


@pytest.fixture(scope="module")
def low_friction():
    """Little deformation, and all friction work made heat: close to a rigid block."""
    return simulate(case_of(LOW_FRICTION, distance=6.0, heat=ALL_HEAT))


def test_all_friction_work_becomes_heat_if_the_partition_says_so(low_friction):
    """Heat and audit count the same work, from the first pressing step on."""
    history = low_friction.history
    np.testing.assert_allclose(
        history["frictional_heat_mJ_per_mm"], history["friction_dissipation_mJ_per_mm"], rtol=1e-9
    )


def test_the_road_takes_the_share_of_heat_it_takes_from_a_rigid_block(low_friction):
    block = {"mesh": "coarse", "rigid": True}
    rigid = simulate(case_of(LOW_FRICTION, distance=6.0, heat=ALL_HEAT, block=block))
    shares = [
        run.history["heat_in_road_mJ_per_mm"].iloc[-1]
        / run.history["frictional_heat_mJ_per_mm"].iloc[-1]
        for run in (low_friction, rigid)
    ]
    assert shares[0] == pytest.approx(shares[1], rel=0.1)


def test_the_kinetic_energy_is_that_of_the_moving_block(low_friction):
    """1207 kg/m^3 x 20 x 8 mm^2 at 300 mm/s, some of it still lagging behind the platen."""
    energy = 0.5 * 1.207e-9 * 20.0 * 8.0 * 300.0**2
    found = low_friction.history["kinetic_energy_mJ_per_mm"].iloc[-1]
    assert found == pytest.approx(energy, rel=0.06)


def test_without_inertia_there_is_no_kinetic_energy():
    result = simulate(case_of(distance=0.2, solver={"inertia": False}))
    assert (result.history["kinetic_energy_mJ_per_mm"] == 0.0).all()


# ------------------------------------------------------------------------- how it ends


def test_progress_is_reported_after_each_accepted_step():
    seen = []
    result = simulate(case_of(distance=0.2), progress=seen.append)
    assert len(seen) == result.summary["steps"]
    assert seen[-1].sliding_distance_mm == 0.2


def test_an_interrupted_run_keeps_what_was_accepted(tmp_path):
    seen = []

    def progress(report):
        seen.append(report)
        if len(seen) == 6:
            raise KeyboardInterrupt

    result = simulate(case_of(), progress=progress)
    assert result.summary["status"] == "interrupted"
    assert len(result.history) == 6
    result.write(tmp_path / "run")
    assert len(Result.read(tmp_path / "run").history) == 6


def test_a_run_that_does_not_converge_says_why_and_keeps_its_steps():
    """Four iterations per step and no small steps are too few for the start of sliding."""
    case = case_of(solver={"newton_iterations_max": 4, "step_mm_min": 1e-2, "tolerance": 1e-10})
    result = simulate(case)
    assert result.summary["status"] == "not converged"
    assert result.summary["reason"]
    assert result.summary["advice"]
    assert result.summary["rejected_steps"] > 0


def test_the_simulation_uses_the_mesh_of_the_case():
    spec = {"cells_x": 24, "cells_y": 10, "smallest_x_mm": 0.4, "smallest_y_mm": 0.2}
    mesh = mesh_of(case_of(block={"mesh": spec}))
    assert len(mesh.cells) == 240
    assert np.diff(mesh.points[mesh.bottom, 0]).min() == pytest.approx(0.4)
    assert np.diff(mesh.points[leading_face(mesh), 1]).min() == pytest.approx(0.2)


@pytest.mark.parametrize("top", ["platen", "pressure"])
def test_a_free_top_balances_as_well_as_a_platen(top):
    """Load and displacement of the top are weighted by length, whatever the grading of the mesh."""
    friction = {"law": "coulomb", "mu": 0.3, "wlf": False}
    solver = {"viscous_distance_mm": 0.0, "edge_viscous_distance_mm": 0.0}
    result = simulate(case_of(friction, loading={"top": top}, solver=solver))
    assert result.summary["status"] == "ok"
    assert result.summary["energy_error"] < 2e-3


# ------------------------------------------------------------------------ heat partition


def _heat_and_work(pressure):
    """Heat made and friction work on the road by step, and the mean pressures before the steps."""
    heat = {"partition": {"pressure": pressure}}
    history = simulate(case_of(LOW_FRICTION, distance=1.0, heat=heat)).history
    made, work = (
        np.diff(history[f"{name}_mJ_per_mm"], prepend=0.0)
        for name in ("frictional_heat", "friction_dissipation")
    )
    before = history["mean_contact_pressure_N_per_mm2"].shift(fill_value=0.25)
    return made, work, before.to_numpy()


def test_the_partition_takes_the_mean_pressure_of_the_last_step_at_every_point():
    made, work, before = _heat_and_work("mean")
    np.testing.assert_allclose(made, HeatPartition()(before) * work, rtol=1e-8)


def test_a_fixed_pressure_gives_one_partition_for_the_whole_run():
    made, work, _ = _heat_and_work(0.3)
    np.testing.assert_allclose(made, float(HeatPartition()(0.3)) * work, rtol=1e-8)


def test_the_local_pressure_makes_less_heat_where_the_edge_is_pressed():
    made, work, before = _heat_and_work("local")
    assert made.sum() < 0.99 * (HeatPartition()(before) * work).sum()
