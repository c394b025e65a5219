"""Figures 2-4 and 9-12 from synthetic tests and made-up runs: labelled, complete, not cut off."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from calibration.conductance.fit import fit_conductance, synthetic_heating_record
from calibration.conductance.heating_rig import HeatingRig
from calibration.synthetic import synthetic_bar_cycles, synthetic_dumbbell_cycles
from fem.sweeps.runs import StudyRun
from tests.validation.checks import assert_labelled, assert_nothing_overlaps
from tests.validation.made_up_run import made_up_run
from validation.drawing.compound_names import COMPOUND_LOOKS
from validation.paper import fig2, fig3, fig4, fig6, fig9, fig10, fig11, fig12
from validation.paper.figures import make_figure
from validation.paper.stress_panels import chosen_cycle, set_table


@pytest.fixture(scope="module")
def compound_runs() -> list[StudyRun]:
    return [made_up_run(rubber__compound=name) for name in COMPOUND_LOOKS]


@pytest.mark.parametrize("number", [2, 3, 4])
def test_figures_without_runs_come_with_their_tables(number, tmp_path):
    path = make_figure(number, tmp_path)
    assert path.is_file()
    assert path.with_suffix(".csv").is_file()
    assert not list(tmp_path.glob(".*"))


@pytest.mark.slow
def test_figure_6_shows_the_rig_and_a_fit_that_finds_the_conductance(tmp_path):
    rig = HeatingRig(ambient_C=20.0)
    record = synthetic_heating_record(rig, noise_K=0.3, every_s=30.0)
    found = fit_conductance(record, rig)
    assert found.values["h_W_per_m2K"] == pytest.approx(1600.0, rel=0.05)
    curves = fig6.fitted_curves(rig, record, found)
    assert list(curves.columns) == ["time_s", *(f"{name}_C" for name in rig.thermocouples)]
    difference = (curves - record[list(curves.columns)]).iloc[:, 1:]
    assert float((difference**2).mean().mean() ** 0.5) == pytest.approx(0.3, rel=0.15)
    figure = fig6.draw(rig, record, curves, found)
    assert_labelled(figure)
    assert_nothing_overlaps(figure)
    assert "not measured" in figure.get_suptitle()


def test_synthetic_data_are_called_so_in_file_and_figure(tmp_path):
    for number in (2, 3):
        make_figure(number, tmp_path)
    assert len(list(tmp_path.glob("fig*synthetic*.csv"))) == 2
    for figure in (
        fig2.draw(synthetic_dumbbell_cycles()),
        fig3.draw({1: synthetic_bar_cycles(1), 2: synthetic_bar_cycles(2)}),
    ):
        assert "not measured" in figure.get_suptitle()


@pytest.mark.parametrize("test", [synthetic_bar_cycles(1), synthetic_bar_cycles(2)])
def test_the_chosen_cycle_is_the_fifth_not_the_path_to_failure(test):
    assert chosen_cycle(test) == 5
    assert test["cycle"].max() == 6


def test_stress_of_the_sets_is_zero_at_rest_and_missing_beyond_a_locking_stretch():
    table = set_table((0.0, 370.0))
    assert np.allclose(table.iloc[0].to_numpy()[1:], 0.0)
    locked = table["van-der-waals-bars-series-1"].isna()
    assert locked.any()
    assert (table["stretch"][locked] > 3.0).all()


def test_figure_4_shows_the_peak_of_the_second_law_and_none_of_the_first():
    table = fig4.friction_table()
    at = table[np.isclose(table["p_N_per_mm2"], table["p_N_per_mm2"].min())]
    v = at["v_mm_per_s"].to_numpy()
    assert v[at["mu_huemer"].argmax()] == pytest.approx(26.5, rel=0.05)
    assert at["mu_exponential"].argmax() == len(v) - 1


def test_figure_9_gives_the_extremes_of_the_elements(compound_runs):
    states = fig9.by_compound(compound_runs)
    assert list(states) == list(COMPOUND_LOOKS)
    table = fig9.extremes_table(states)
    sigma_y = compound_runs[0].result.snapshots[-1].cauchy_stress[:, 1]
    assert table["sigma_y_min_N_per_mm2"].iloc[0] == sigma_y.min()
    assert table["sigma_y_max_N_per_mm2"].iloc[0] == sigma_y.max()


def test_figure_9_contour_runs_along_the_free_boundary(compound_runs):
    state = fig9.by_compound(compound_runs)["yeoh-bars-series-1"]
    contour = fig9.contour(state)
    top = state.points[:, 1].max()
    assert contour[0, 1] == pytest.approx(top)
    assert contour[-1, 1] == pytest.approx(top)
    assert contour[0, 0] < contour[-1, 0]
    assert len(contour) == 48 + 2 * 20 + 1


def test_pictures_from_runs_are_labelled_and_nothing_overlaps(compound_runs):
    laws = ("huemer", "exponential")
    velocity_runs = [
        made_up_run(loading__velocity_mm_per_s=v, friction__law=law)
        for v, law in itertools.product((7.0, 50.0, 300.0), laws)
    ]
    pressure_runs = [
        made_up_run(
            loading__mean_pressure_N_per_mm2=p,
            loading__velocity_mm_per_s=v,
            friction__law=law,
            rubber__compound=name,
        )
        for p, v, law, name in itertools.product(
            (0.1667, 0.25, 0.3333), (7.0, 300.0), laws, list(COMPOUND_LOOKS)[:2]
        )
    ]
    for figure in (
        fig2.draw(synthetic_dumbbell_cycles()),
        fig3.draw({1: synthetic_bar_cycles(1), 2: synthetic_bar_cycles(2)}),
        fig4.draw(fig4.friction_table()),
        fig9.draw(fig9.by_compound(compound_runs)),
        fig10.draw(compound_runs),
        fig11.draw(velocity_runs),
        fig12.draw(fig12.point_table(pressure_runs)),
    ):
        assert_labelled(figure)
        assert_nothing_overlaps(figure)


def test_a_run_that_stopped_says_so_in_its_panel(compound_runs):
    run = compound_runs[0]
    run.result.summary["status"] = "not converged"
    try:
        figure = fig9.draw(fig9.by_compound(compound_runs), fig9.stopped(compound_runs))
    finally:
        run.result.summary["status"] = "ok"
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert [("stopped at 120 mm" in title) for title in titles[:2]] == [True, False]
    assert_nothing_overlaps(figure)


def test_figure_10_has_room_for_the_legend_of_runs_that_stopped(compound_runs):
    for run in compound_runs:
        run.result.summary["status"] = "not converged"
    try:
        assert_nothing_overlaps(fig10.draw(compound_runs))
    finally:
        for run in compound_runs:
            run.result.summary["status"] = "ok"


def test_figure_12_leaves_out_runs_that_stopped():
    runs = [made_up_run(loading__mean_pressure_N_per_mm2=p) for p in (0.2, 0.3)]
    runs[0].result.summary["status"] = "not converged"
    table = fig12.point_table(runs)
    assert table["status"].tolist() == ["not converged", "ok"]
    (line,) = fig12.draw(table).axes[0].lines
    assert len(line.get_xdata()) == 1


def test_figure_12_has_a_point_per_run():
    runs = [made_up_run(loading__mean_pressure_N_per_mm2=p) for p in (0.2, 0.3)]
    table = fig12.point_table(runs)
    assert table["mean_contact_pressure_N_per_mm2"].tolist() == pytest.approx([0.24, 0.36])
    assert set(table["compound"]) == {"yeoh-bars-series-1-load"}
