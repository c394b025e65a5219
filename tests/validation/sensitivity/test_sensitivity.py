"""Sensitivity: what differs from the base and by how much; nothing that stopped is compared."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from fem.sweeps.runs import StudyRun
from fem.sweeps.study import StudyCase
from tests.validation.checks import assert_nothing_overlaps
from tests.validation.sensitivity.made_up_study import made_up_study
from validation.sensitivity import write
from validation.sensitivity.parameters import NUMERICS, PARAMETERS, PHYSICS
from validation.sensitivity.table import DIFFERENCES, sensitivity_table
from validation.sensitivity.text import sensitivity_text
from validation.sensitivity.tornado import PANELS, by_influence, draw, limit, signed
from validation.studies import cases_of

STOPPED = {"status": "not converged", "reason": "the step became too short", "T_max_C": 31.0}
CHANGES = {
    "height_7.0": {"T_max_C": 49.0, "A_T_K_mm": 440.0, "friction_force_N_per_mm": 4.41},
    "height_10.0": {"T_max_C": 45.0, "A_T_K_mm": 380.0, "friction_force_N_per_mm": 4.46},
    "bulk-ratio_20.0": {"T_max_C": 50.0},
    "mesh_fine": {"T_max_C": 47.9, "A_T_K_mm": 401.0},
    "top_pressure": STOPPED,
}


@pytest.fixture(scope="module")
def table() -> pd.DataFrame:
    return sensitivity_table(made_up_study(CHANGES))


def row(table: pd.DataFrame, parameter: str, to: str) -> pd.Series:
    found = table[(table["parameter"] == parameter) & (table["to"] == to)]
    assert len(found) == 1
    return found.iloc[0]


def test_the_study_changes_one_thing_at_a_time_and_every_change_is_explained():
    cases = cases_of(write.STUDY)
    assert [case.overrides for case in cases].count({}) == 1
    changed = {next(iter(case.overrides)) for case in cases if case.overrides}
    assert changed == set(PARAMETERS)
    assert not any(list(case.overrides)[1:] for case in cases)
    base = next(case for case in cases if not case.overrides).case
    assert all(case.case != base for case in cases if case.overrides)


def test_the_base_is_the_papers_introductory_example():
    base = next(case for case in cases_of(write.STUDY) if not case.overrides).case
    assert (base.loading.velocity_mm_per_s, base.loading.distance_mm) == (300.0, 120.0)
    assert (base.loading.mean_pressure_N_per_mm2, base.friction.law) == (0.25, "huemer")


def test_what_the_solver_only_needs_is_told_from_what_the_paper_leaves_open():
    solver = {key for key in PARAMETERS if key.startswith("solver.")} | {"block.mesh"}
    assert {PARAMETERS[key].group for key in solver - {"solver.self_contact"}} == {NUMERICS}
    assert PARAMETERS["solver.self_contact"].group == PHYSICS
    assert PARAMETERS["rubber.bulk_ratio"].group == PHYSICS


def test_folders_of_the_runs_have_short_names():
    assert max(len(case.name) for case in cases_of(write.STUDY)) <= 40


def test_differences_are_from_the_base_in_kelvin_and_per_cent(table):
    found = row(table, "block.height_mm", "7")
    assert found["from"] == "8"
    assert found["T_max_difference_K"] == pytest.approx(1.0)
    assert found["A_T_difference_percent"] == pytest.approx(10.0)
    assert found["friction_force_difference_percent"] == pytest.approx(-2.0)
    assert table.loc[0, list(DIFFERENCES)].tolist() == [0.0] * len(DIFFERENCES)


def test_a_run_that_stopped_early_stays_with_its_reason_and_is_not_compared(table):
    found = row(table, "loading.top", "pressure")
    assert (found["status"], found["reason"]) == ("not converged", STOPPED["reason"])
    assert found["T_max_C"] == 31.0
    assert all(math.isnan(found[column]) for column in DIFFERENCES)


def test_nothing_is_compared_with_a_base_that_stopped_early():
    table = sensitivity_table(made_up_study({**CHANGES, "base": STOPPED}))
    assert table[list(DIFFERENCES)].isna().all(axis=None)
    assert "nothing can be compared" in sensitivity_text(table)
    assert "did not get to its end" in draw(table).get_suptitle()


@pytest.mark.parametrize("copies", [0, 2])
def test_a_study_has_exactly_one_base(copies):
    base, *others = made_up_study()
    with pytest.raises(ValueError, match=f"{copies} runs without overrides; expected one"):
        sensitivity_table([base] * copies + others)


def test_changes_of_two_keys_at_once_name_both():
    """The study has none; a user's may."""
    runs = made_up_study()
    case = runs[0].study_case.case
    both = {"block.height_mm": 7.5, "friction.T_ref_C": 25.0}
    changed = StudyCase(name="both", case=case.with_overrides(both), overrides=both)
    result = replace(runs[0].result, case=changed.case)
    table = sensitivity_table([*runs, StudyRun(study_case=changed, result=result)])
    found = row(table, "block.height_mm and friction.T_ref_C", "7.5, 25")
    assert found["from"] == "8, 20"


def test_a_word_and_a_number_for_one_key_are_two_changes(table):
    for to in ("local", "0.3"):
        assert row(table, "heat.partition.pressure", to)["from"] == "mean"


def test_switches_read_on_and_off(table):
    assert row(table, "friction.wlf", "off")["from"] == "on"


def test_physics_comes_first_then_the_strongest_and_the_values_of_a_parameter_stay_together(table):
    rows = by_influence(table)
    assert len(rows) == len(table) - 1
    assert rows["group"].tolist() == sorted(rows["group"], key=[PHYSICS, NUMERICS].index)
    order = list(dict.fromkeys(rows["parameter"]))
    assert order[:2] == ["block.height_mm", "rubber.bulk_ratio"]
    assert rows["to"].tolist()[:3] == ["5", "7", "10"]
    last_of_physics = rows[rows["group"] == PHYSICS]["parameter"].iloc[-1]
    assert last_of_physics == "loading.top"
    assert rows[rows["group"] == NUMERICS]["parameter"].iloc[0] == "block.mesh"


def test_every_run_is_a_bar_with_its_value_in_every_panel_and_nothing_is_cut_off(table):
    figure = draw(table)
    assert_nothing_overlaps(figure)
    assert "arrow" not in figure.get_supxlabel()
    assert len(figure.axes) == len(PANELS)
    stopped = 1
    for axes, column in zip(figure.axes, PANELS, strict=True):
        widths = [bar.get_width() for bar in axes.patches if bar.get_height() < 1.0]
        assert widths == pytest.approx(by_influence(table)[column].dropna().tolist())
        words = [text.get_text() for text in axes.texts]
        assert len(words) == len(table) - 1
        assert words.count("stopped at 120 mm") == stopped


def test_values_at_the_bars_stay_inside_their_panel(table):
    figure = draw(table)
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    for axes in figure.axes:
        panel = axes.get_window_extent(renderer)
        for text in axes.texts:
            box = text.get_window_extent(renderer)
            assert panel.x0 <= box.x0, text.get_text()
            assert box.x1 <= panel.x1, text.get_text()


def test_a_bar_far_longer_than_all_others_is_cut_but_keeps_its_value():
    values = {"mesh_fine": {"T_max_C": 46.0}, "height_7.0": {"T_max_C": 20.0}}
    figure = draw(sensitivity_table(made_up_study(values)))
    axes = figure.axes[0]
    assert figure.get_supxlabel().startswith("arrow: the bar is longer than shown")
    widths = [bar.get_width() for bar in axes.patches if bar.get_height() < 1.0]
    assert min(widths) == pytest.approx(-2.5)
    assert "−28.0" in [text.get_text() for text in axes.texts]
    assert [line.get_marker() for line in axes.lines].count("<") == 1


def test_bars_of_similar_length_are_not_cut():
    assert limit(np.array([0.0, 1.0, -3.9])) == 3.9
    assert limit(np.array([0.0, 1.0, -4.1])) == 1.25
    assert limit(np.array([0.0, 0.0, 3.0])) == 3.0


@pytest.mark.parametrize(
    ("value", "shown"),
    [(0.004, "0.00"), (-0.004, "0.00"), (-0.25, "−0.25"), (9.994, "+9.99"), (-22.04, "−22.0")],
)
def test_a_change_is_shown_with_its_sign(value, shown):
    assert signed(value) == shown


def test_the_text_says_what_matters_most_what_stopped_and_why_these_ranges(table):
    text = sensitivity_text(table)
    flat = " ".join(text.split())
    assert (
        "T_max is moved most by block height: 8 to 10 mm (−3.00 K); "
        "bulk over shear modulus: 100 to 20 (+2.00 K); "
    ) in flat
    assert "Of the numerics, T_max is moved most by mesh: default to fine (−0.10 K); " in flat
    assert "top pressed by: platen to pressure: not converged at 120 mm" in flat
    assert STOPPED["reason"] in flat
    assert all(key in text for key in PARAMETERS)
    assert max(map(len, text.splitlines())) <= 120


def test_table_picture_and_text_are_written_together(tmp_path, monkeypatch):
    runs = made_up_study(CHANGES)
    monkeypatch.setattr(write, "runs_of", lambda study, directory: runs)
    path = write.write_sensitivity(tmp_path / "figures")
    assert path.name == "sensitivity.txt"
    assert path.with_suffix(".png").read_bytes().startswith(b"\x89PNG")
    again = pd.read_csv(path.with_suffix(".csv"))
    assert len(again) == len(runs)
    assert again["T_max_difference_K"].isna().sum() == 1
    assert sorted(p.name for p in path.parent.iterdir()) == [
        "sensitivity.csv",
        "sensitivity.png",
        "sensitivity.txt",
    ]
