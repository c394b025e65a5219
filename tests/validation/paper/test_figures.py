"""Figures of the paper and of a run: made from files, complete, nothing cut off."""

from __future__ import annotations

import dataclasses

import numpy as np
import pandas as pd
import pytest

from fem.results.result import Result
from fem.simulation import simulate
from fem.stepping import mesh_of
from fem.sweeps import case as sweep_case
from tests.made_up_result import made_up_case, made_up_result
from tests.validation.checks import assert_labelled, assert_nothing_overlaps
from validation.drawing import draw_missing, run_figures
from validation.paper import fig7, fig8, introductory
from validation.paper.figures import FIGURES, make_figure
from validation.paper.introductory import introductory_case, introductory_run


@pytest.fixture(scope="module")
def result() -> Result:
    return made_up_result()


def test_an_unknown_figure_is_refused_with_the_known_ones(tmp_path):
    with pytest.raises(ValueError, match="figure 99 is not among .*7, 8"):
        make_figure(99, tmp_path / "figures")
    assert not (tmp_path / "figures").exists()


def test_figure_7_is_made_into_a_new_folder_with_its_nodes_beside_it(tmp_path):
    path = make_figure(7, tmp_path / "new" / "figures")
    assert path.read_bytes().startswith(b"\x89PNG")
    nodes = pd.read_csv(path.with_suffix(".csv"))
    assert np.array_equal(nodes[["X_mm", "Y_mm"]], mesh_of(introductory_case()).points)


@pytest.mark.parametrize("velocity", [300.0, -50.0])
def test_figure_7_is_to_scale_and_nothing_overlaps(velocity):
    case = made_up_case(velocity_mm_per_s=velocity)
    figure = fig7.draw(case, mesh_of(case))
    assert_nothing_overlaps(figure)
    assert [axes.get_aspect() for axes in figure.axes] == [1.0, 1.0]


def test_figure_8_is_to_scale_labelled_and_nothing_overlaps(result):
    figure = fig8.draw(result)
    assert_nothing_overlaps(figure)
    assert_labelled(figure)
    fields = figure.axes[:6]
    assert [axes.get_aspect() for axes in fields] == [1.0] * 6


def test_figure_8_uses_the_run_beside_its_folder(tmp_path, monkeypatch, result):
    monkeypatch.setattr(introductory, "introductory_case", made_up_case)
    monkeypatch.setattr(introductory, "simulate_missing", lambda _: pytest.fail("simulated again"))
    result.write(tmp_path / "run")
    path = make_figure(8, tmp_path / "figures")
    assert list(pd.read_csv(path.with_suffix(".csv"))) == list(fig8.SHOWN)


def test_a_run_of_another_case_is_not_mistaken_for_the_introductory_one(tmp_path, monkeypatch):
    calls = []

    def simulate(case, **options):
        calls.append(case)
        return made_up_result()

    monkeypatch.setattr(introductory, "introductory_case", made_up_case)
    monkeypatch.setattr(sweep_case, "simulate", simulate)
    made_up_result(velocity_mm_per_s=50.0).write(tmp_path / "run")
    for _ in range(2):
        found = introductory_run(tmp_path / "figures")
        assert found.case.loading.velocity_mm_per_s == 300.0
    assert len(calls) == 1


def test_every_figure_can_be_asked_for_by_its_number():
    assert {7, 8} <= set(FIGURES)


def test_pictures_of_a_run_are_written_into_its_folder(tmp_path, result):
    result.write(tmp_path)
    paths = run_figures.write_run_figures(tmp_path)
    names = ["final_state.png", "history.png", "onset.png", "surface.png"]
    assert sorted(path.name for path in paths) == names
    assert {path.parent for path in paths} == {tmp_path / "figures"}


def test_pictures_of_a_run_need_no_vtu_files(tmp_path, result):
    case = result.case.with_overrides({"output.vtu": False})
    dataclasses.replace(result, case=case).write(tmp_path)
    assert not list(tmp_path.glob("*.vtu"))
    draw_missing(tmp_path)
    last = tmp_path / "figures" / "final_state.png"
    drawn = last.stat().st_mtime_ns
    draw_missing(tmp_path)
    assert last.stat().st_mtime_ns == drawn


def test_a_run_without_accepted_steps_has_no_pictures(tmp_path, result):
    empty = Result.from_rows(
        result.case, result.geometry, [], result.boundary.iloc[:0], result.summary, []
    )
    empty.write(tmp_path)
    assert run_figures.write_run_figures(tmp_path) == []


def test_a_rigid_block_is_drawn_without_stress(result):
    rigid = dataclasses.replace(result, case=result.case.with_overrides({"block.rigid": True}))
    figure = run_figures.draw_final_state(rigid)
    assert len(figure.axes) == 4
    assert_nothing_overlaps(figure)


@pytest.mark.parametrize("velocity", [300.0, -300.0])
def test_a_simulated_rigid_block_is_written_read_and_drawn(tmp_path, velocity):
    case = made_up_case(velocity_mm_per_s=velocity, distance_mm=5.0)
    case = case.with_overrides({"block.rigid": True, "block.mesh": "coarse"})
    simulated = simulate(case)
    simulated.write(tmp_path)
    again = Result.read(tmp_path)
    pd.testing.assert_frame_equal(again.history, simulated.history)
    assert again.snapshots == simulated.snapshots
    assert again.case == case
    assert len(run_figures.write_run_figures(tmp_path)) == 3


def test_run_pictures_are_labelled_and_nothing_overlaps(result):
    for figure in (
        run_figures.draw_history(result.history),
        run_figures.draw_surface(result.surface, 45.0),
        run_figures.draw_final_state(result),
    ):
        assert_labelled(figure)
        assert_nothing_overlaps(figure)
