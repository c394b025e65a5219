"""Limits of the trust figures: what is beyond them is said, what is not stays quiet."""

import pytest

from contact.friction import ThermalFriction
from fem import Case, simulate
from fem.results.result import Result
from fem.results.trust import LIMITS, judged, warnings_of

AT_ITS_LIMITS = {limit.key: limit.largest for limit in LIMITS}


def test_figures_at_their_limits_give_no_warning():
    assert warnings_of(AT_ITS_LIMITS) == []


@pytest.mark.parametrize("limit", LIMITS, ids=lambda limit: limit.key)
def test_each_figure_beyond_its_limit_gives_one_line_that_names_key_value_and_limit(limit):
    (line,) = warnings_of({**AT_ITS_LIMITS, limit.key: 1.23456 * limit.largest})
    for part in (limit.key, f"{1.23456 * limit.largest:.3g}", f"{limit.largest:g}", limit.meaning):
        assert part in line
    assert "\n" not in line


@pytest.mark.parametrize("value", [None, float("nan")])
def test_what_could_not_be_computed_gives_no_warning(value):
    assert warnings_of({"energy_error": value}) == []


def test_warnings_from_elsewhere_stay_and_come_first():
    summary = judged({"energy_error": 0.5, "warnings": ["outside the fitted window"]})
    assert len(summary["warnings"]) == 2
    assert summary["warnings"][0] == "outside the fitted window"


def case_of(**tables):
    loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 0.5}
    spec = {"cells_x": 12, "cells_y": 6, "smallest_x_mm": 1.6, "smallest_y_mm": 1.3}
    base = {"block": {"mesh": spec}, "output": {"snapshots": 1, "vtu": False}}
    return Case.from_dict({"loading": loading, **base, **tables})


#: Settings that spoil a run, and the figure that must say so.
SPOILT = {
    "a block of one cell": (
        {"block": {"mesh": {"cells_x": 1, "cells_y": 1, "smallest_x_mm": 20, "smallest_y_mm": 8}}},
        "heat_layer_error",
    ),
    "heat steps longer than the contact of a road point": (
        {
            "block": {"rigid": True, "mesh": "coarse"},
            "solver": {"heat_step_mm": 60.0},
            "loading": {
                "mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 120.0,
            },
        },
        "road_layer_error",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("tables", "key"), SPOILT.values(), ids=SPOILT)
def test_a_spoilt_run_says_so_in_summary_log_and_both_files(tables, key, tmp_path):
    result = simulate(case_of(**tables))
    lines = [line for line in result.summary["warnings"] if line.startswith(key)]
    assert len(lines) == 1
    assert f"warning: {lines[0]}" in result.log
    result.write(tmp_path)
    assert lines[0] in (tmp_path / "summary.csv").read_text(encoding="utf-8")
    assert lines[0] in (tmp_path / "run.log").read_text(encoding="utf-8")


@pytest.mark.parametrize("rigid", [False, True])
def test_friction_that_drives_the_block_is_an_error_of_the_energy(rigid, monkeypatch):
    """The case file refuses such laws; the balance must not depend on that."""
    at = ThermalFriction.at
    monkeypatch.setattr(ThermalFriction, "at", lambda *given: -at(*given))
    mesh = "coarse" if rigid else case_of().block.mesh.model_dump()
    result = simulate(case_of(block={"rigid": rigid, "mesh": mesh}))
    summary = result.summary
    assert result.history["friction_dissipation_mJ_per_mm"].iloc[-1] < 0.0
    assert summary["energy_error"] > 0.1
    assert any(line.startswith("energy_error") for line in summary["warnings"])


def test_warnings_are_read_again_as_a_list(tmp_path):
    result = simulate(case_of(output={"snapshots": 1}))
    result.write(tmp_path)
    assert Result.read(tmp_path).summary["warnings"] == result.summary["warnings"] != []


def test_a_resolved_rigid_slide_is_free_of_warnings():
    loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 60.0}
    result = simulate(case_of(loading=loading, block={"rigid": True, "mesh": "coarse"}))
    assert result.summary["warnings"] == []
