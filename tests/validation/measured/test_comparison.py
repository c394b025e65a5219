"""Comparison of measurements with simulations: who belongs to whom, errors, statistics, output."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import treadfem
from calibration.data.errors import DataError
from fem import simulate
from fem.case.case import Case
from fem.case.errors import CaseError
from fem.results.pyrometer import pyrometer_table
from fem.results.result import Result
from fem.sweeps.runs import StudyRun
from tests.made_up_result import made_up_result
from tests.validation.checks import assert_labelled, assert_nothing_overlaps
from tests.validation.made_up_run import made_up_run
from validation.measured.compare_command import write_comparison
from validation.measured.comparison import compare, statistics
from validation.measured.comparison_figures import draw_comparison, draw_profiles
from validation.measured.matching import matched
from validation.measured.measurements import read_measurements
from validation.measured.simulated import _variants, simulated_runs, surface_of
from validation.paper import fig11, fig12

ROOT = Path(__file__).parents[3]
YEOH, VDW = "yeoh-bars-series-1-load", "van-der-waals-bars-series-1"


def simulated(**changes: object) -> dict[str, object]:
    return {
        "case": "c",
        "folder": Path("c"),
        "variant": "one",
        "compound": YEOH,
        "law": "huemer",
        "block": np.nan,
        "p_N_per_mm2": 0.3,
        "mean_pressure_N_per_mm2": 0.25,
        "v_mm_per_s": 50.0,
        "T_0_C": 20.0,
        "length_mm": 20.0,
        "T_max_C": 30.0,
        "A_T_K_mm": 150.0,
        "friction_coefficient": 0.9,
    } | changes


def measured(*rows: dict[str, object]):
    defaults = {"v_mm_per_s": 50.0, "p_N_per_mm2": 0.3}
    return read_measurements(pd.DataFrame([defaults | row for row in rows]))


def point(**changes: object) -> dict[str, object]:
    return dict(measured({"T_max_C": 30.0} | changes).points.iloc[0])


# -- matching --------------------------------------------------------------------------------------


def matching(test, runs):
    """The simulations that belong to one test."""
    return runs.iloc[matched(pd.DataFrame([test]), runs)[1]]


def test_simulation_nearest_in_contact_pressure_is_taken_of_each_variant():
    runs = pd.DataFrame(
        [
            simulated(case=f"{law}{p}", law=law, variant=law, p_N_per_mm2=p)
            for law in ("huemer", "exponential")
            for p in (0.21, 0.28, 0.31, 0.4)
        ]
    )
    assert sorted(matching(point(), runs)["case"]) == ["exponential0.31", "huemer0.31"]
    assert list(matching(point(law="huemer"), runs)["case"]) == ["huemer0.31"]


@pytest.mark.parametrize(
    "changes",
    [
        {"v_mm_per_s": 60.0},
        {"p_N_per_mm2": 0.4},
        {"mean_pressure_N_per_mm2": 0.3},
        {"compound": VDW},
        {"law": "exponential"},
    ],
    ids=str,
)
def test_other_conditions_do_not_match(changes):
    runs = pd.DataFrame([simulated()])
    assert len(matching(point(), runs)) == 1
    assert matching(point(**changes), runs).empty


def test_rises_are_compared_where_the_start_temperatures_differ():
    tests = measured({"T_max_C": 33.0, "T_0_C": 23.0}, {"T_max_C": 36.0, "T_0_C": 23.0})
    found = compare(tests, pd.DataFrame([simulated(T_max_C=30.0, T_0_C=20.0)]))
    assert found.table["error"].tolist() == pytest.approx([0.0, -3.0])
    assert found.table["relative_error"].tolist() == pytest.approx([0.0, -3.0 / 13.0])
    assert found.table["T_0_measured_C"].tolist() == [23.0, 23.0]
    assert "up to 3 K from the T_0_C of the tests" in found.notes[0]
    assert not compare(tests, pd.DataFrame([simulated(T_0_C=23.0)])).notes


def test_of_several_start_temperatures_the_nearest_is_taken():
    runs = pd.DataFrame([simulated(case=f"{T:g}", T_0_C=T) for T in (16.0, 20.0, 25.0)])
    for start, case in ((21.0, "20"), (23.0, "25"), (12.0, "16")):
        assert list(matching(point(T_0_C=start), runs)["case"]) == [case]
    assert matching(point(T_0_C=40.0), runs).empty


@pytest.mark.parametrize("pressures", [(0.3,), (0.29, 0.3, 0.31, 0.5)])
def test_many_tests_match_as_each_does_alone(pressures):
    rng = np.random.default_rng(0)
    runs = pd.DataFrame(
        [
            simulated(case=f"{law}{p}{v}", law=law, variant=law, p_N_per_mm2=p, v_mm_per_s=v)
            for law in ("huemer", "exponential")
            for p in pressures
            for v in (7.0, 50.0)
        ]
    )
    stated = {
        "p_N_per_mm2": rng.choice([0.28, 0.302, 0.4, np.nan], 60),
        "v_mm_per_s": rng.choice([7.0, 50.0, 300.0], 60),
        "law": rng.choice(["", "huemer"], 60),
        "compound": rng.choice(["", YEOH, VDW], 60),
    }
    points = read_measurements(pd.DataFrame({"T_max_C": 30.0, **stated})).points
    tests, found = matched(points, runs)
    for i, own in points.iterrows():
        alone = matching(dict(own), runs)["case"].tolist()
        assert runs["case"].iloc[found[tests == i]].tolist() == alone
        assert len(alone) <= 2 * len(pressures)


def test_test_that_does_not_state_its_velocity_is_refused_if_several_were_simulated():
    runs = pd.DataFrame([simulated(v_mm_per_s=v) for v in (7.0, 50.0)])
    tests = read_measurements(pd.DataFrame([{"T_max_C": 30.0, "p_N_per_mm2": 0.3}]))
    with pytest.raises(DataError, match=r"row 1, column v_mm_per_s.*one of 7, 50"):
        compare(tests, runs)
    assert len(compare(tests, runs.iloc[:1]).table) == 1


def test_tests_without_a_simulation_are_named():
    runs = pd.DataFrame([simulated()])
    tests = measured({"run": "a", "T_max_C": 30.0}, {"run": "b", "T_max_C": 9.0, "v_mm_per_s": 7.0})
    comparison = compare(tests, runs)
    assert comparison.unmatched == ["b"]
    assert set(comparison.table["run"]) == {"a"}


def test_measurements_that_fit_nothing_are_refused_with_what_was_simulated():
    with pytest.raises(DataError, match=rf"expected one of the compounds {YEOH}, v_mm_per_s 50"):
        compare(measured({"T_max_C": 30.0, "v_mm_per_s": 7.0}), pd.DataFrame([simulated()]))


# -- errors and statistics -------------------------------------------------------------------------


def test_errors_are_simulated_minus_measured_and_relative_to_the_measured_rise():
    tests = measured({"T_max_C": 32.5, "A_T_K_mm": 120.0, "friction_coefficient": 1.0})
    table = compare(tests, pd.DataFrame([simulated()])).table.set_index("quantity")
    assert table["error"].to_dict() == pytest.approx(
        {"T_max_C": -2.5, "A_T_K_mm": 30.0, "friction_coefficient": -0.1}
    )
    assert table["relative_error"].to_dict() == pytest.approx(
        {"T_max_C": -2.5 / 12.5, "A_T_K_mm": 0.25, "friction_coefficient": -0.1}
    )


def test_bias_rmse_and_shares_of_known_errors():
    errors = [0.4, -0.5, 0.9, -1.5, 2.0, 3.0]
    tests = measured(*({"T_max_C": 30.0 - error, "A_T_K_mm": 150.0} for error in errors))
    result = compare(tests, pd.DataFrame([simulated()])).statistics.set_index("quantity")
    row = result.loc["T_max_C"]
    assert row["n"] == 6
    assert row["bias"] == pytest.approx(np.mean(errors))
    assert row["rmse"] == pytest.approx(np.sqrt(np.mean(np.square(errors))))
    assert row["largest_error"] == pytest.approx(3.0)
    shares = [row[f"share_within_{limit}_K"] for limit in ("0.5", "1", "2")]
    assert shares == pytest.approx([2 / 6, 3 / 6, 5 / 6])
    assert result.loc["A_T_K_mm", "rmse"] == 0.0
    assert np.isnan(result.loc["A_T_K_mm", "share_within_1_K"])


def test_statistics_are_given_for_each_variant_and_for_all():
    runs = pd.DataFrame([simulated(variant=v, T_max_C=T) for v, T in (("a", 31.0), ("b", 29.0))])
    table = compare(measured({"T_max_C": 30.0}), runs).table
    found = statistics(table).set_index("variant")["bias"]
    assert found.to_dict() == pytest.approx({"a": 1.0, "b": -1.0, "all": 0.0})


# -- from folders to files -------------------------------------------------------------------------


def write_run(folder: Path, **keys: object) -> Result:
    """A made-up run of a case, with T_max and A_T that follow from its surface."""
    result = made_up_result(velocity_mm_per_s=50.0)
    case = Case.from_dict(result.case.to_dict(), overrides=keys | {"output.vtu": False})
    summary = result.summary | {"mean_contact_pressure_N_per_mm2": 0.3}
    history = result.history.to_dict("records")
    made = Result.from_rows(case, result.geometry, history, result.boundary, summary, [])
    made.write(folder)
    return made


@pytest.fixture
def results(tmp_path) -> Path:
    for law in ("huemer", "exponential"):
        write_run(tmp_path / "results" / "runs" / law, **{"friction.law": law})
    return tmp_path / "results"


def test_pyrometer_of_the_simulation_is_compared_where_it_is_asked_for(results, tmp_path, capsys):
    result = write_run(tmp_path / "one", **{"pyrometer.gap_mm": 5.0, "pyrometer.spot_mm": 2.0})
    X = result.surface["X_mm"]
    table = pyrometer_table(X, result.surface["T_C"] - 3.0, result.surface["T_C"], 1.0 + 0.0 * X)
    read = {"T_max_pyrometer_C": 30.0, "A_T_pyrometer_K_mm": 150.0}
    read = replace(result, pyrometer=table, summary=result.summary | read)
    read.write(tmp_path / "one")
    runs = {asked: simulated_runs(tmp_path / "one", pyrometer=asked) for asked in (False, True)}
    assert [runs[asked]["T_max_C"].item() for asked in runs] == [result.summary["T_max_C"], 30.0]
    profiles = [surface_of(runs[asked].iloc[0])["T_C"].to_numpy() for asked in runs]
    np.testing.assert_allclose(profiles[0] - profiles[1], 3.0)

    path = profiles_of(result, tmp_path / "measured.csv", shift=-3.0)
    words = ["compare", str(path), str(tmp_path / "one"), "-o", str(tmp_path / "out")]
    assert treadfem.main([*words, "--pyrometer"]) == 0
    assert "those that the pyrometer" in capsys.readouterr().err
    with pytest.raises(CaseError, match=r"found a run without a pyrometer's reading"):
        simulated_runs(results, pyrometer=True)


@pytest.fixture(scope="module")
def two_blocks(tmp_path_factory):
    """A short run of two blocks, the second of which reaches road that the first has heated."""
    loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 50.0, "distance_mm": 4.0}
    mesh = {"cells_x": 16, "cells_y": 6, "smallest_x_mm": 0.5, "smallest_y_mm": 0.3}
    block = {"mesh": mesh, "blocks": 2, "groove_mm": 3.0, "length_mm": 12.0}
    friction = {"law": "coulomb", "mu": 0.3}
    case = {"block": block, "loading": loading, "friction": friction}
    case["pyrometer"] = {"gap_mm": 5.0, "spot_mm": 2.0}
    folder = tmp_path_factory.mktemp("two")
    result = simulate(Case.from_dict(case))
    result.write(folder)
    return result, folder


def block_profiles(folder: Path, result: Result, path: Path, **columns: object) -> Path:
    """Profile of the second block, counted from its own trailing corner."""
    surface = result.surface[result.surface["X_mm"] >= 15.0]
    table = pd.DataFrame({"run": "b", "x_mm": surface["X_mm"] - 15.0, "T_C": surface["T_C"]})
    table.assign(v_mm_per_s=50, **columns).to_csv(path, index=False)
    return path


def test_a_block_of_several_is_compared_by_its_number(two_blocks, tmp_path):
    result, folder = two_blocks
    path = block_profiles(folder, result, tmp_path / "measured.csv", block=2)
    runs = simulated_runs(folder)
    assert runs["block"].tolist() == [0, 1, 2]
    table = compare(read_measurements(path), runs).table
    assert set(table["block"]) == {2}
    np.testing.assert_allclose(table["error"], 0.0, atol=1e-9)
    totals = pd.DataFrame({"friction_coefficient": [0.3], "v_mm_per_s": 50.0})
    assert set(compare(read_measurements(totals), runs).table["block"]) == {0}


def test_a_pyrometer_reads_each_block_by_itself(two_blocks):
    result, folder = two_blocks
    runs = simulated_runs(folder, pyrometer=True).set_index("block")
    read = result.pyrometer
    for block, begin in ((1, 0.0), (2, 15.0)):
        own = read[read["X_mm"].between(begin, begin + 12.0)]
        assert runs.loc[block, "T_max_C"] <= own["T_pyrometer_C"].max() < own["T_C"].max()
        surface = surface_of(runs.loc[block])
        np.testing.assert_allclose(surface["X_mm"] + begin, own["X_mm"])
        area = np.trapezoid(own["T_pyrometer_C"] - 20.0, own["X_mm"])
        assert runs.loc[block, "A_T_K_mm"] == pytest.approx(area)


def test_profile_beside_several_blocks_says_which(two_blocks, tmp_path):
    result, folder = two_blocks
    path = block_profiles(folder, result, tmp_path / "measured.csv")
    with pytest.raises(DataError, match="column block: found nothing, and several blocks"):
        compare(read_measurements(path), simulated_runs(folder))
    path = block_profiles(folder, result, path, block=3)
    with pytest.raises(DataError, match="block 1, 2 or nothing"):
        compare(read_measurements(path), simulated_runs(folder))


def profiles_of(result: Result, path: Path, shift: float = 0.0) -> Path:
    """The simulated profile as if it had been measured, warmer by a shift."""
    surface = result.surface
    table = pd.DataFrame({"run": "test", "x_mm": surface["X_mm"], "T_C": surface["T_C"] + shift})
    table.assign(p_N_per_mm2=0.3, v_mm_per_s=50).to_csv(path, index=False)
    return path


def test_variants_are_what_differs_between_the_runs(results):
    runs = simulated_runs(results)
    assert set(runs["variant"]) == {"law huemer", "law exponential"}
    assert set(runs["v_mm_per_s"]) == {50.0}
    assert set(runs["compound"]) == {YEOH}


def test_events_of_other_speeds_are_one_variant_and_those_of_other_rests_are_not(tmp_path):
    phases = [
        {"kind": "press", "mean_pressure_N_per_mm2": 0.25},
        {"kind": "slide", "velocity_mm_per_s": 300.0, "distance_mm": 2.0},
        {"kind": "lift", "time_s": 0.1},
    ]
    event = Case.from_dict({"loading": {"phase": phases}})

    def variants(key, values):
        return _variants([event.with_overrides({f"loading.phase.{key}": v}) for v in values])

    assert variants("1.velocity_mm_per_s", (50.0, 300.0)) == ["one variant"] * 2
    assert variants("2.time_s", (0.1, 0.2)) == ["time_s 0.1", "time_s 0.2"]


def test_single_run_can_be_compared_with(results):
    runs = simulated_runs(results / "runs" / "huemer")
    assert list(runs["variant"]) == ["one variant"]


def test_runs_that_do_not_belong_to_the_sweep_and_those_that_stopped_are_left_out(results):
    (results / "summary.csv").write_text("loading.velocity_mm_per_s,case\n50.0,huemer\n")
    assert list(simulated_runs(results)["case"]) == ["huemer"]
    path = results / "runs" / "huemer" / "summary.json"
    path.write_text(path.read_text().replace('"ok"', '"not converged"'))
    with pytest.raises(CaseError, match="no finished run"):
        simulated_runs(results)


@pytest.mark.parametrize("name", ["../../other", "/etc", "", ".."])
def test_name_of_a_case_leads_nowhere_else(name, results):
    (results / "summary.csv").write_text(f"case,status\n{name},ok\n")
    with pytest.raises(CaseError, match=r"summary\.csv: case: found"):
        simulated_runs(results)


def test_text_that_a_spreadsheet_would_run_is_quoted_in_the_tables(results, tmp_path):
    path = tmp_path / "measured.csv"
    path.write_text("run,p_N_per_mm2,v_mm_per_s,T_max_C\n=A1+1,0.3,50,30\n")
    write_comparison(path, results, tmp_path / "out")
    assert "'=A1+1" in (tmp_path / "out" / "comparison.csv").read_text()


def test_simulated_profile_compared_with_itself_has_no_error(results, tmp_path):
    result = write_run(tmp_path / "one")
    path = profiles_of(result, tmp_path / "same.csv")
    surface, summary = result.surface, result.summary
    # The made-up summary is not computed from the made-up surface: put the measured rule's values.
    values = dict(read_measurements(path).points.iloc[0])
    summary.update(T_max_C=values["T_max_C"], A_T_K_mm=values["A_T_K_mm"])
    result.write(tmp_path / "one")
    table = compare(read_measurements(path), simulated_runs(tmp_path / "one")).table
    assert table["error"].to_numpy() == pytest.approx([0.0, 0.0], abs=1e-9)
    assert surface["T_C"].max() > values["T_max_C"], "the made-up surface has a front-edge peak"


def test_command_writes_tables_and_pictures_and_prints_the_statistics(results, tmp_path, capsys):
    result = write_run(tmp_path / "one")
    path = profiles_of(result, tmp_path / "warm.csv", shift=1.5)
    words = ["compare", str(path), str(results), "-o", str(tmp_path / "out")]
    assert treadfem.main(words) == 0
    printed = capsys.readouterr().out
    assert "share_within_2_K" in printed
    assert "nan" not in printed
    assert {file.name for file in (tmp_path / "out").iterdir()} == {
        "comparison.csv",
        "comparison.log",
        "statistics.csv",
        "measured.csv",
        "comparison.png",
        "profiles.png",
    }
    points = pd.read_csv(tmp_path / "out/measured.csv")
    assert points["T_max_C"][0] == pytest.approx(read_measurements(path).points["T_max_C"][0])


@pytest.mark.parametrize("name", ["profiles", "tests"])
def test_synthetic_examples_can_be_compared(name, results, tmp_path, capsys):
    example = ROOT / "examples" / "measurements" / f"synthetic_{name}.csv"
    words = ["compare", str(example), str(results), "-o", str(tmp_path / "out")]
    assert treadfem.main(words) == 0
    # The made-up results have one velocity only.
    assert "without a simulation" in capsys.readouterr().out


@pytest.mark.parametrize(
    "text, words",
    [
        ("run,x_mm,T_C\na,0,20\na,0,21\n", "row 3, column x_mm"),
        ("T_max_C,v_mm_per_s\n30,7\n", "no test that was simulated"),
    ],
)
def test_wrong_measurements_give_one_line_and_write_nothing(text, words, results, tmp_path, capsys):
    path = tmp_path / "measured.csv"
    path.write_text(text)
    out = tmp_path / "out"
    assert treadfem.main(["compare", str(path), str(results), "-o", str(out)]) == 2
    errors = capsys.readouterr().err
    assert words in errors
    assert len(errors.splitlines()) == 1
    assert not out.exists()


def test_folder_without_results_gives_one_line(tmp_path, capsys):
    path = tmp_path / "measured.csv"
    path.write_text("T_max_C\n30\n")
    assert treadfem.main(["compare", str(path), str(tmp_path), "-o", str(tmp_path / "out")]) == 2
    assert "RESULTS_DIR: found no finished run" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


# -- pictures --------------------------------------------------------------------------------------


def test_pictures_of_a_comparison_are_labelled_and_tidy(results, tmp_path):
    path = profiles_of(write_run(tmp_path / "one"), tmp_path / "warm.csv", shift=1.5)
    tests, runs = read_measurements(path), simulated_runs(results)
    for figure in (draw_comparison(compare(tests, runs)), draw_profiles(tests, runs)):
        assert_labelled(figure)
        assert_nothing_overlaps(figure)


def drawn(figure, axes_number: int, colour: str = "#000000") -> list[np.ndarray]:
    """Points of the measured (black, without line) markers of a panel."""
    lines = figure.axes[axes_number].get_lines()
    black = [line for line in lines if line.get_color() == colour and line.get_ls() == "None"]
    return [np.column_stack(line.get_data()) for line in black]


def runs_of(*velocities: float) -> list[StudyRun]:
    return [
        made_up_run(loading__velocity_mm_per_s=v, friction__law=law)
        for v in velocities
        for law in ("huemer", "exponential")
    ]


def test_figure_11_shows_measured_profiles_in_the_panel_of_their_velocity(tmp_path):
    result = write_run(tmp_path / "one")
    tests = read_measurements(profiles_of(result, tmp_path / "measured.csv"))
    figure = fig11.draw(runs_of(7.0, 50.0), tests)
    assert drawn(figure, 0) == []
    (points,) = drawn(figure, 1)
    assert points[:, 1] == pytest.approx(result.surface["T_C"].to_numpy())
    assert "measured" in [text.get_text() for text in figure.legends[0].get_texts()]
    assert_nothing_overlaps(figure)


def test_figure_12_shows_measured_points_in_the_panel_of_their_velocity():
    tests = measured(
        {"T_max_C": 31.0, "A_T_K_mm": 140.0, "compound": YEOH},
        {"T_max_C": 22.0, "v_mm_per_s": 7.0, "p_N_per_mm2": 0.2},
    )
    figure = fig12.draw(fig12.point_table(runs_of(7.0, 50.0)), tests)
    assert drawn(figure, 0)[0] == pytest.approx(np.array([[0.2, 22.0]]))
    assert drawn(figure, 1)[0] == pytest.approx(np.array([[0.3, 31.0]]))
    assert drawn(figure, 3)[0] == pytest.approx(np.array([[0.3, 140.0]]))
    assert "measured (filled)" in [text.get_text() for text in figure.legends[0].get_texts()]
    assert_nothing_overlaps(figure)


@pytest.mark.parametrize(
    "number, file, words",
    [("11", "nowhere.csv", "No such file"), ("7", "measured.csv", "a figure that shows meas")],
)
def test_wrong_measured_option_gives_one_line(number, file, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("measured.csv").write_text("T_max_C,T_0_C\n30,20\n")
    assert treadfem.main(["figure", number, "--measured", file, "-o", "out"]) == 2
    errors = capsys.readouterr().err
    assert words in errors
    assert len(errors.splitlines()) == 1
    assert not Path("out").exists()
