"""Several blocks on one platen: each like one alone, results per block that add up, mirrored."""

import json
from itertools import pairwise

import numpy as np
import pytest

from fem import Case, simulate
from tests.reference_solutions.conduction_columns import Contacts

SPEC = {"cells_x": 24, "cells_y": 10, "smallest_x_mm": 0.3, "smallest_y_mm": 0.15}
ADDED = ("normal_force_N_per_mm", "friction_force_N_per_mm", "contact_length_mm", "A_T_K_mm")


def slide(velocity=300.0, distance=3.0, **block):
    loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": velocity}
    return simulate(
        Case.from_dict(
            {
                "loading": loading | {"distance_mm": distance},
                "block": {"mesh": SPEC} | block,
                "friction": {"law": "coulomb", "mu": 0.3, "wlf": False},
                "output": {"snapshots": 1},
            }
        )
    )


@pytest.fixture(scope="module")
def two():
    return slide(blocks=2, groove_mm=12.0)


def test_two_blocks_apart_are_twice_one(two):
    """Before the second reaches road that the first has heated: 12 mm behind, after 3 mm."""
    one, both = slide(), two
    assert both.summary["friction_force_N_per_mm"] == pytest.approx(
        2.0 * one.summary["friction_force_N_per_mm"], rel=1e-3
    )
    np.testing.assert_allclose(
        both.history["platen_displacement_mm"].iloc[-1],
        one.history["platen_displacement_mm"].iloc[-1],
        rtol=1e-6,
    )
    for block in both.summary["blocks"]:
        assert block["T_max_C"] == pytest.approx(one.summary["T_max_C"], abs=0.1)
        assert block["friction_force_N_per_mm"] == pytest.approx(
            one.summary["friction_force_N_per_mm"], rel=1e-3
        )


def test_columns_of_the_blocks_add_up(two):
    history = two.history
    for name in ADDED:
        parts = history[f"block_1_{name}"] + history[f"block_2_{name}"]
        np.testing.assert_allclose(parts, history[name], rtol=1e-12, atol=1e-12)
    hottest = history[["block_1_T_max_C", "block_2_T_max_C"]].max(axis=1)
    np.testing.assert_array_equal(hottest, history["T_max_C"])
    assert set(two.boundary["block"]) == {1, 2}


def test_files_hold_the_blocks(two, tmp_path):
    two.write(tmp_path)
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert [block["block"] for block in summary["blocks"]] == [1, 2]
    header = (tmp_path / "summary.csv").read_text().splitlines()[0]
    assert "block_2_friction_force_N_per_mm" in header.split(",")
    assert "blocks" not in header.split(",")


def test_one_block_has_no_columns_of_blocks():
    one = slide(distance=0.2)
    assert "blocks" not in one.summary
    assert not [name for name in one.history if name.startswith("block_")]


@pytest.fixture(scope="module")
def rigid_in_a_row():
    """Two rigid blocks in a row, so that nothing but the road differs, and their columns."""
    case = Case.from_dict(
        {
            "loading": {
                "mean_pressure_N_per_mm2": 0.3,
                "velocity_mm_per_s": 300.0,
                "distance_mm": 120.0,
            },
            "block": {"blocks": 2, "groove_mm": 5.0, "rigid": True},
            "friction": {"law": "coulomb", "mu": 0.9, "wlf": False},
            "heat": {"emissivity": 0.0},
            "output": {"snapshots": 1},
        }
    )
    rubber, road = case.rubber.thermal, case.road.thermal
    columns = Contacts(
        velocity=300.0,
        distance=120.0,
        length=20.0,
        pressure=0.3,
        friction=lambda T: 0.9,
        kappa=float(case.heat.partition_object()(0.3)),
        conductance=1e-3 * float(case.heat.conductance_object().conductance(0.3, 300.0)),
        block=(rubber.conductivity, rubber.heat_capacity),
        road=(road.conductivity, road.heat_capacity),
        blocks=2,
        groove=5.0,
    ).contact()
    return simulate(case).summary["blocks"], columns.T_C.reshape(2, -1)


def test_a_block_on_heated_road_is_hotter_by_what_columns_give(rigid_in_a_row):
    """One-dimensional columns of both blocks over the same columns of road; within 5 %."""
    (behind, ahead), T = rigid_in_a_row
    hotter = T.max(axis=1)[1] - T.max(axis=1)[0]
    assert hotter > 1.0
    assert behind["T_max_C"] - ahead["T_max_C"] == pytest.approx(hotter, rel=0.05)
    more = 20.0 * (T[1].mean() - T[0].mean())
    assert behind["A_T_K_mm"] - ahead["A_T_K_mm"] == pytest.approx(more, rel=0.05)


def test_the_mirror_image_of_a_siped_slide_is_the_same():
    sipes = [{"position_mm": 8.0, "depth_mm": 5.0, "width_mm": 0.6, "angle_deg": 10.0}]
    outline = {"sipes": sipes, "chamfer_leading_mm": 1.0}
    right, left = slide(distance=0.6, **outline), slide(velocity=-300.0, distance=0.6, **outline)
    for name in ("friction_force_N_per_mm", "T_max_C", "contact_length_mm", "A_T_K_mm"):
        np.testing.assert_allclose(left.history[name], right.history[name], rtol=1e-8)
    names = ["block", "chain", "status"]
    assert (left.boundary[names] == right.boundary[names]).all(axis=None)


def test_shear_stiffness_falls_with_each_sipe():
    """Force over motion while the road still holds; more walls give more way to bend."""
    places = [[], [10.0], [7.0, 13.0], [5.0, 10.0, 15.0]]
    forces = []
    for at in places:
        sipes = [{"position_mm": x, "depth_mm": 6.0, "width_mm": 0.6} for x in at]
        history = slide(distance=0.1, sipes=sipes).history
        forces.append(float(history["friction_force_N_per_mm"].iloc[-1]))
    assert all(less < more / 1.05 for more, less in pairwise(forces)), forces


@pytest.mark.slow
def test_the_walls_of_a_narrow_sipe_close_under_shear_and_stiffen_the_block():
    """Against the same sipe ten times as wide; both walls carry the same force."""
    sipes = {
        width: [{"position_mm": 10.0, "depth_mm": 6.0, "width_mm": width, "base": "flat"}]
        for width in (0.1, 1.0)
    }
    narrow, wide = (slide(distance=1.0, sipes=sipes[width]) for width in (0.1, 1.0))
    name = "self_contact_pressure_N_per_mm2"
    on_walls = narrow.boundary[narrow.boundary["chain"].str.startswith("sipe")]
    rear, front = (
        float(np.sum(on_walls[on_walls["chain"] == f"sipe 1 {side}"][name] > 0.01))
        for side in ("rear", "front")
    )
    assert rear > 1
    assert front > 1
    assert not wide.boundary[name].any()
    forces = [run.history["friction_force_N_per_mm"].iloc[-1] for run in (narrow, wide)]
    assert forces[0] > 1.02 * forces[1]
    assert narrow.history["self_contact_penetration"].max() < 0.01
