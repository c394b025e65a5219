"""Runs of a study: what is finished and of this program is read, the rest is simulated."""

from __future__ import annotations

import pytest

from fem.results import run_folder
from fem.results.run_folder import RunFolder
from fem.sweeps import case as sweep_case
from fem.sweeps import runs as module
from fem.sweeps.runs import StudyError, study_runs
from fem.sweeps.study import read_study
from tests.made_up_result import made_up_result


@pytest.fixture
def simulated(monkeypatch):
    """Velocities of the cases that were simulated, in this process; results are made up."""
    velocities = []

    def fake(case, checkpoint=None, resume=False):
        velocities.append(case.loading.velocity_mm_per_s)
        return made_up_result(velocity_mm_per_s=case.loading.velocity_mm_per_s)

    monkeypatch.setattr(sweep_case, "simulate", fake)
    monkeypatch.setattr(module, "number_of_workers", lambda *_: 1)
    return velocities


TWO = 'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 50.0]'


def test_finished_runs_are_read_and_changed_ones_simulated_again(write_study, tmp_path, simulated):
    path = write_study(TWO)
    for _ in range(2):
        runs = study_runs(read_study(path).cases(), tmp_path / "out")
    assert simulated == [7.0, 50.0]
    assert [run["loading.velocity_mm_per_s"] for run in runs] == [7.0, 50.0]
    case_file = tmp_path / "out" / "runs" / "velocity_mm_per_s_50.0" / "case.toml"
    case_file.write_text(case_file.read_text().replace("height_mm = 8.0", "height_mm = 9.0"))
    study_runs(read_study(path).cases(), tmp_path / "out")
    assert simulated == [7.0, 50.0, 50.0]


def test_runs_of_another_program_are_simulated_again(write_study, tmp_path, simulated, monkeypatch):
    path = write_study(TWO)
    study_runs(read_study(path).cases(), tmp_path / "out")
    monkeypatch.setattr(run_folder, "program_version", lambda: "0.0.9+new")
    study_runs(read_study(path).cases(), tmp_path / "out")
    assert simulated == [7.0, 50.0] * 2


def test_run_that_raises_an_error_is_said_and_the_finished_ones_are_kept(
    write_study, tmp_path, simulated, monkeypatch
):
    def fails_at_50(case, **options):
        if case.loading.velocity_mm_per_s == 50.0:
            raise ValueError("no such thing")
        return made_up_result(velocity_mm_per_s=case.loading.velocity_mm_per_s)

    path = write_study(TWO)
    monkeypatch.setattr(sweep_case, "simulate", fails_at_50)
    with pytest.raises(StudyError, match=r"velocity_mm_per_s_50\.0: .*no such thing"):
        study_runs(read_study(path).cases(), tmp_path / "out")
    first, second = read_study(path).cases()
    runs = tmp_path / "out" / "runs"
    assert RunFolder(runs / first.name, first.case).finished() is not None
    assert RunFolder(runs / second.name, second.case).finished() is None
