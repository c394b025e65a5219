"""Estimates of steps, time and memory, and the refusal of what would never end or never fit."""

from __future__ import annotations

import pytest

from fem import simulate
from fem.case.case import Case
from fem.case.errors import CaseError
from fem.stepping.cost import estimated_cost, refuse_unaffordable

LOADING = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 120.0}


def case_with(**sections: object) -> Case:
    return Case.from_dict({"loading": LOADING, **sections})


def test_estimate_of_the_introductory_example_is_near_what_it_takes():
    """90 steps and 893 Newton iterations, 16 s on one core."""
    cost = estimated_cost(case_with())
    assert cost.elements == 2880
    assert cost.steps == pytest.approx(95, rel=0.3)
    assert 8.0 < cost.seconds < 32.0
    assert 0.2 < cost.gigabytes < 1.0


def test_steps_of_a_rigid_block_are_those_of_the_heat():
    case = case_with(
        block={"rigid": True, "mesh": "coarse"}, loading={**LOADING, "distance_mm": 5.0}
    )
    assert estimated_cost(case).heat_steps == simulate(case).summary["steps"]


def test_half_the_steps_take_twice_the_time():
    halved = estimated_cost(case_with(solver={"steps_scale": 0.5}))
    assert halved.seconds == pytest.approx(2.0 * estimated_cost(case_with()).seconds, rel=0.02)


@pytest.mark.parametrize(
    "sections, key",
    [
        (
            {"solver": {"heat_step_mm": 1e-7}, "loading": {**LOADING, "distance_mm": 1e3}},
            "solver.heat_step_mm",
        ),
        ({"solver": {"step_mm_max": 1e-7, "step_mm_initial": 1e-7, "step_mm_min": 1e-7}},
         "solver.step_mm_max"),
        ({"solver": {"heat_step_mm": 1e-6, "steps_scale": 0.001}}, "solver.steps_scale"),
        (
            {
                "loading": {**LOADING, "distance_mm": 1e6},
                "block": {
                    "mesh": {
                        "cells_x": 500, "cells_y": 500,
                        "smallest_x_mm": 0.01, "smallest_y_mm": 0.01,
                    }
                },
            },
            "loading.distance_mm",
        ),
    ],
)  # fmt: skip
def test_what_takes_months_is_refused_by_the_key_behind_it(sections, key):
    with pytest.raises(CaseError, match="days on one core, .*within 30 days") as caught:
        refuse_unaffordable(case_with(**sections))
    assert caught.value.key == key


@pytest.mark.parametrize("key", ["block.mesh", "output.snapshots"])
def test_what_does_not_fit_into_the_memory_is_refused(key, monkeypatch):
    monkeypatch.setattr("os.sysconf", lambda name: {"SC_PAGE_SIZE": 4096}.get(name, 65_536))
    mesh = {"cells_x": 200, "cells_y": 200, "smallest_x_mm": 0.01, "smallest_y_mm": 0.01}
    sections = {"block": {"mesh": mesh}} if key == "block.mesh" else {"output": {"snapshots": 9999}}
    sections["solver"] = {"heat_step_mm": 0.01}
    with pytest.raises(CaseError, match="fits into the 0.3 GB of this machine") as caught:
        refuse_unaffordable(case_with(**sections))
    assert caught.value.key == key
