"""The committed tables of the studies, and the page that is made of them."""

import re

import pandas as pd
import pytest

from fem.sweeps.study import StudyCase
from validation.analysis import with_block
from validation.convergence.onset import SweptRun
from validation.convergence.table import (
    CONVERGENCE,
    FORCES,
    FOUND,
    ONSET,
    PLATEN,
    convergence_table,
    onset_table,
    snaps_table,
)
from validation.convergence.text import (
    convergence_text,
    onset_differences,
    onset_text,
    robustness_text,
    snaps_text,
)
from validation.convergence.write import BLOCK, MADE, PAGE, block
from validation.studies import cases_of

STOPPED = ["A_T_K_mm", "status", "reason"]


def made_up(case: StudyCase, **summary: object) -> SweptRun:
    history = pd.DataFrame({
        "sliding_distance_mm": [0.0, 3.0],
        "friction_force_N_per_mm": [0.0, 3.0],
        "platen_displacement_mm": [0.25, 0.3],
        "viscous_dissipation_mJ_per_mm": [0.0, 0.3],
    })  # fmt: skip
    words = {"status": "ok", "sliding_regime": "steady", "program_version": "0.1.0+0123"}
    return SweptRun(
        study_case=case,
        history=history,
        summary={**dict.fromkeys(FOUND, 1.0 / 3.0), **words, **summary},
    )


def made_up_table(study: str, make, changes=None) -> pd.DataFrame:
    cases = cases_of(study)
    return make([made_up(case, **(changes or {}).get(k, {})) for k, case in enumerate(cases)])


@pytest.mark.parametrize("path", MADE, ids=lambda path: path.name)
def test_the_committed_table_has_every_run_of_its_study_in_order(path):
    expected, found = made_up_table(path.stem, MADE[path]), pd.read_csv(path)
    assert found.columns.tolist() == expected.columns.tolist()
    varied = expected.columns[: expected.columns.get_loc("status")]
    pd.testing.assert_frame_equal(found[varied], expected[varied], check_dtype=False)
    assert found["program_version"].nunique() == 1


def test_the_page_says_what_the_command_makes_of_the_tables():
    page = PAGE.read_text(encoding="utf-8")
    assert with_block(page, BLOCK, block()) == page


def test_every_check_of_the_page_is_a_test():
    page = PAGE.read_text(encoding="utf-8")
    checks = re.findall(r"`(tests/[\w/]+\.py)::(\w+)` \|$", page, flags=re.MULTILINE)
    assert len(checks) == page.count("| `tests/")
    root = PAGE.parents[1]
    found = [f"\ndef {name}(" in (root / path).read_text(encoding="utf-8") for path, name in checks]
    assert all(found)


def test_robustness_counts_what_ends_and_what_is_damped():
    table = pd.DataFrame({
        "compound": ["one", "two", "three"],
        "law": ["huemer", "coulomb", "coulomb"],
        "reason": [None, None, "it folds"],
        "status": ["ok", "ok", "not converged"],
        "mu": [None, 1.2, 0.3],
        "mean_pressure_N_per_mm2": [0.1, 0.5, 0.5],
        "regularisation_share_with_onset": [0.001, 0.034, 0.9],
        "energy_error": [0.001, 0.0004, 0.5],
        "heat_error": [1e-14, 2e-14, 0.5],
        "largest_self_penetration": [0.001, 0.009, 0.5],
    })  # fmt: skip
    text = robustness_text(table)
    assert text.startswith("2 of 3 cases slide to their end: coefficients of 0.3, 1.2, pressures")
    assert "Energy closes to 0.10 %, heat to 2e-14" in text
    assert "at most 0.90 % of an element" in text
    assert "in 1 of them, up to 3.4 % in the others" in text
    assert "1 of them have the highest coefficient, 1 the highest pressure" in text
    assert text.endswith("Not three with coulomb 0.3 at 0.5 N/mm²: it folds.")
    assert robustness_text(table[:1]).endswith("less than 1 % of the work in 1 of them.")


def test_both_distances_of_the_damping_are_scaled_alike():
    cases = cases_of("convergence")
    lone = {"solver.edge_viscous_distance_mm": 0.5}
    case = StudyCase(name="lone", overrides=lone, case=cases[0].case.with_overrides(lone))
    with pytest.raises(ValueError, match=r"block times 1, of its edge times 0\.1"):
        convergence_table([made_up(case)])


def test_differences_are_from_the_default_of_the_mesh_and_between_meshes():
    table = made_up_table("convergence", convergence_table)
    table[["T_max_C", "A_T_K_mm"]] = [45.0, 100.0]
    fine = table["mesh"] == "fine"
    table.loc[fine, "A_T_K_mm"] = 110.0
    table.loc[fine & (table["damping"] == 0.01), ["T_max_C", "A_T_K_mm"]] = [44.5, 99.0]
    table.loc[fine & (table["damping"] == 3.0), "status"] = "not converged"
    text = convergence_text(table)
    assert "| fine: damping / 100 | -0.50 K | -10.0 % | +0.0 % | +0.0 % |" in text
    assert "| default to fine mesh | +0.00 K | +10.0 % |" in text
    assert "| coarse: damping × 3 |" in text
    assert "| fine: damping × 3 |" not in text


def test_scatter_is_half_the_range_and_leaves_out_what_stopped():
    table = made_up_table("convergence", convergence_table)
    coarse = (table["mesh"] == "coarse") & (table["memory_mm"] == 0.3)
    table.loc[:, "A_T_K_mm"] = 100.0
    table.loc[coarse & (table["steps_scale"] == 0.5), "A_T_K_mm"] = 104.0
    table.loc[coarse & (table["damping"] == 3.0), "A_T_K_mm"] = 50.0
    table.loc[coarse & (table["damping"] == 0.1), STOPPED] = [7.0, "not converged", "folded"]
    text = convergence_text(table)
    assert "100.0 to 104.0 (±2.0 %)" in text
    assert "50.0 to 104.0 (±35.1 %)" in text
    assert "7.0 to" not in text
    assert "26 of 27 runs slide steadily to the end" in text
    assert "coarse mesh, damping / 10, steps × 1, memory 0.3 mm: folded" in text


def test_the_onset_is_compared_with_the_least_damping_in_the_shortest_steps():
    table = made_up_table("onset", onset_table)
    case = slice(0, 3)  # default, short steps, limit, limit in half its steps
    table.loc[case, FORCES[2]] = [1.0, 1.1, 1.2, 1.25]
    table.loc[case, "full_slip_N_per_mm"] = 5.0
    table.loc[case, PLATEN] = [0.26, 0.25, 0.25, 0.25]
    first = onset_differences(table).iloc[0]
    assert first[["default", "short_steps", "limit"]].tolist() == pytest.approx([5.0, 3.0, 1.0])
    assert first["default_at_mm"] == 0.9852
    assert first["default_damping"] == pytest.approx(100 * 0.1 * 0.9852 / 3.0 / 5.0, rel=1e-3)
    assert first["platen"] == pytest.approx(4.0)
    text = onset_text(table)
    assert "Within 2 % of full slip: 9 of 10 with the defaults" in text
    assert "Beyond: introductory example" in text


def test_cases_of_the_onset_are_named_by_what_sets_them_apart():
    names = onset_differences(made_up_table("onset", onset_table))["case"].tolist()
    assert len(set(names)) == len(names) == 10
    assert names[0] == "introductory example"
    assert {"Coulomb, 0.6", "6 mm high", "50 mm/s", "yeoh-bars-series-2"} <= set(names)


def test_large_snaps_are_told_from_small_ones_at_the_limit_of_the_warning():
    table = made_up_table("snaps", snaps_table)
    first = table["compound"] == table["compound"].iloc[0]
    table["snap_share"], table["T_max_C"] = 0.01, 40.0
    high = first & (table["mu"] == 1.2) & (table["mean_pressure_N_per_mm2"] == 0.5)
    table.loc[high, "snap_share"] = [0.05, 0.1, 0.15, 0.2]
    table.loc[high, "T_max_C"] = [38.0, 40.0, 45.0, 39.0]
    table.loc[first & (table["law"] == "huemer"), "T_max_C"] = [40.0, 40.3, 40.1, 41.0]
    table.loc[table.index[-1], ["T_max_C", "status"]] = [90.0, "not converged"]
    text = snaps_text(table)
    case = "yeoh-bars-series-1-load, 0.5 N/mm², coulomb 1.2"
    assert f"| {case} | 5.0 %, 38.0 °C, 0.33 N/mm | 10.0 %, 40.0 °C" in text
    assert "| 20.0 %, 39.0 °C, 0.33 N/mm |" in text
    assert "of 3 % damping moves T_max by up to 0.3 K, shorter steps by up to 0.7 K.\n" in text
    assert "Beyond it damping moves T_max by up to 7.0 K, shorter steps by up to 1.0 K.\n" in text


def test_the_onset_of_the_introductory_example_is_that_of_its_limit():
    """To 2 % of full slip: before the edge rolls under, and on the default mesh at 1.8 mm too."""
    table, full_slip = pd.read_csv(CONVERGENCE), pd.read_csv(ONSET)["full_slip_N_per_mm"].iloc[0]
    for mesh, runs in table[table["steps_scale"] == 1.0].groupby("mesh"):
        limit = runs[runs["damping"] == runs["damping"].min()].iloc[0]
        off = (runs[[*FORCES]] - limit[[*FORCES]]).astype(float).abs() / full_slip
        assert off[[*FORCES[:3]]].to_numpy().max() < 0.02
        if mesh == "default":
            assert off.to_numpy().max() < 0.02
