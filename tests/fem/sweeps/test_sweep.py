"""Sweeps: rows, folders, failures, resuming. Real worker processes are in test_sweep_processes."""

from __future__ import annotations

import csv
import importlib
import json
from dataclasses import replace
from pathlib import Path

import pytest

import treadfem
from fem import simulate
from fem.case.errors import CaseError
from fem.results.result import Result
from fem.sweeps import case as sweep_case
from fem.sweeps import workers as sweep_workers
from fem.sweeps.progress import SweepBar, closing_line, time_left
from fem.sweeps.sweep import SweepProgress, sweep
from fem.sweeps.table import grid_values
from tests.made_up_result import made_up_case, made_up_result
from validation.drawing import draw_missing

VELOCITIES = (7.0, 50.0, 300.0)
BASE = """
[loading]
mean_pressure_N_per_mm2 = 0.25
velocity_mm_per_s = 300.0
distance_mm = 120.0
[output]
figures = false
"""
#: Half a millimetre on few elements: a second.
SHORT_CASE = (
    BASE.replace("120.0", "0.5")
    + """checkpoint_s = 0.0
vtu = false
[block]
mesh = {cells_x = 20, cells_y = 8, smallest_x_mm = 0.5, smallest_y_mm = 0.25}
"""
)
STUDY = 'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [7.0, 50.0, 300.0]\n'


class StubSimulation:
    """Stands in for the simulation; does to each velocity what it is told to."""

    def __init__(self) -> None:
        self.simulated: list[float] = []
        self.faults: dict[float, BaseException] = {}
        self.stops: dict[float, str] = {}

    def __call__(self, case, checkpoint=None, resume=False):
        velocity = case.loading.velocity_mm_per_s
        self.simulated.append(velocity)
        if velocity in self.faults:
            raise self.faults[velocity]
        result = replace(made_up_result(), case=case)
        result.summary.update(T_max_C=20.0 + velocity / 10.0, wall_s=float(len(self.simulated)))
        if velocity in self.stops:
            result.summary.update(status="not converged", reason=self.stops[velocity])
        return result


@pytest.fixture
def simulation(monkeypatch):
    stub = StubSimulation()
    monkeypatch.setattr(sweep_case, "simulate", stub)
    return stub


@pytest.fixture
def study(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(BASE)
    path = tmp_path / "study.toml"
    path.write_text(STUDY)
    return path


def rows(directory: str | Path = "out") -> list[dict[str, str]]:
    with open(Path(directory) / "summary.csv", newline="") as file:
        return list(csv.DictReader(file))


def run(study: Path, **options: object) -> SweepProgress:
    return sweep(study, "out", workers=1, **options)


# -- table and folders -----------------------------------------------------------------------------


def test_every_case_is_a_row_with_the_columns_of_the_grid_first(study, simulation):
    study.write_text(STUDY + '"friction.law" = ["huemer", "exponential"]\n')
    assert run(study).all_ok
    table = rows()
    assert list(table[0])[:2] == ["loading.velocity_mm_per_s", "friction.law"]
    assert [(row["loading.velocity_mm_per_s"], row["friction.law"]) for row in table] == [
        (str(v), law) for v in VELOCITIES for law in ("huemer", "exponential")
    ]
    assert {row["status"] for row in table} == {"ok"}
    assert float(table[-1]["T_max_C"]) == 50.0


def test_every_case_has_the_folder_of_a_normal_run(study, simulation):
    study.write_text(STUDY.replace("[7.0, 50.0, 300.0]", "[300.0]"))
    (study.parent / "case.toml").write_text(BASE.replace("false", "true"))
    run(study, draw=draw_missing)
    folder = Path("out/runs") / rows()[0]["case"]
    tables = {"case.toml", "run.log", "history.csv", "surface.csv", "summary.json", "summary.csv"}
    assert tables | {"block.pvd", "road.pvd", "figures"} <= {p.name for p in folder.iterdir()}
    assert (folder / "figures" / "final_state.png").exists()


def test_times_stand_in_a_table_of_their_own(study, simulation):
    run(study)
    assert not {"wall_s", "solver_s"} & set(rows()[0])
    with open("out/timings.csv", newline="") as file:
        times = list(csv.DictReader(file))
    assert [row["case"] for row in times] == [row["case"] for row in rows()]
    assert all(float(row["wall_s"]) >= float(row["cpu_s"]) * 0.5 > 0.0 for row in times)


def test_extra_cases_show_the_value_of_every_grid_column(study, simulation):
    study.write_text(
        'base = "case.toml"\n[[case]]\n"block.height_mm" = 7.0\n[[case]]\n'
        '"rubber.bulk_ratio" = 20.0\n'
    )
    run(study)
    first, second = rows()
    assert (first["block.height_mm"], first["rubber.bulk_ratio"]) == ("7.0", "100.0")
    assert (second["block.height_mm"], second["rubber.bulk_ratio"]) == ("8.0", "20.0")


def test_table_in_the_grid_is_one_entry_of_the_row(study, simulation):
    mesh = {"cells_x": 12, "cells_y": 5, "smallest_x_mm": 0.8, "smallest_y_mm": 0.6}
    text = ", ".join(f"{key} = {value}" for key, value in mesh.items())
    study.write_text(f'base = "case.toml"\n[grid]\n"block.mesh" = ["coarse", {{{text}}}]\n')
    run(study)
    first, second = rows()
    assert first["block.mesh"] == "coarse"
    assert json.loads(second["block.mesh"]) == mesh


def test_key_without_a_value_in_a_case_is_empty():
    from fem.sweeps.study import StudyCase

    case = StudyCase(name="a", overrides={}, case=made_up_case())
    assert grid_values(case, ["friction.mu", "loading.distance_mm"]) == {
        "friction.mu": None,
        "loading.distance_mm": 120.0,
    }


EVENT = """
[block]
rigid = true
mesh = "coarse"
[output]
figures = false
vtu = false
[loading]
[[loading.phase]]
kind = "press"
mean_pressure_N_per_mm2 = 0.25
time_s = 1e-3
[[loading.phase]]
kind = "slide"
velocity_mm_per_s = 300.0
distance_mm = 2.0
[[loading.phase]]
kind = "slide"
velocity_mm_per_s = 100.0
distance_mm = 1.0
[[loading.phase]]
kind = "lift"
time_s = 0.01
"""


def test_phases_of_an_event_are_varied_by_their_number(tmp_path, monkeypatch):
    """A column for each key of a phase, filled also where only another case sets it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(EVENT)
    keys = [f"loading.phase.{number}.velocity_mm_per_s" for number in (1, 2)]
    (tmp_path / "study.toml").write_text(
        f'base = "case.toml"\n[grid]\n"{keys[0]}" = [300.0, 600.0]\n"loading.repeat" = [1, 2]\n'
        f'[[case]]\n"{keys[1]}" = 50.0\n[[case]]\n"friction.law" = "exponential"\n'
    )
    sweep("study.toml", "out", workers=1)
    table = rows()
    assert [row["status"] for row in table] == ["ok"] * 8
    found = {(row[keys[0]], row["loading.repeat"], row[keys[1]]) for row in table}
    assert len(found) == 8
    assert {row[keys[1]] for row in table} == {"50.0", "100.0"}
    assert "1.velocity_mm_per_s_600.0__repeat_2__2.velocity_mm_per_s_50.0" in {
        row["case"] for row in table
    }
    contacts = [len(Result.read(Path("out/runs") / row["case"]).contacts) for row in table]
    assert contacts == [int(row["loading.repeat"]) for row in table]
    before = {row["case"]: row["T_max_C"] for row in table}
    state = sweep("study.toml", "out", workers=1, resume=True)
    assert state.all_ok
    assert {row["case"]: row["T_max_C"] for row in rows()} == before


def test_rows_appear_as_cases_finish(study, simulation):
    seen = []
    run(study, progress=lambda state: seen.append((state.done, len(rows()))))
    assert sorted(set(seen)) == [(0, 0), (1, 1), (2, 2), (3, 3)]


# -- failures --------------------------------------------------------------------------------------


def test_template_of_a_study_runs_as_it_is(tmp_path, monkeypatch, simulation, capsys):
    monkeypatch.chdir(tmp_path)
    # Pictures take most of the time; test_every_case_has_the_folder_of_a_normal_run draws them.
    monkeypatch.setattr("validation.drawing.run_figures.write_run_figures", lambda *_: [])
    assert treadfem.main(["template", "study"]) == 0
    Path("study.toml").write_text(capsys.readouterr().out)
    assert treadfem.main(["sweep", "study.toml", "-o", "out", "--workers", "1"]) == 0
    assert rows()[0]["case"].startswith("v_50.0__law_huemer")
    assert len(rows()) == 4


def test_case_that_raises_is_a_row_and_does_not_stop_the_others(study, simulation, capsys):
    simulation.faults[50.0] = ValueError("no\nway")
    assert treadfem.main(["sweep", str(study), "-o", "out", "--workers", "1"]) == 3
    assert [row["status"] for row in rows()] == ["ok", "failed", "ok"]
    assert rows()[1]["reason"] == "ValueError: no way"
    assert rows()[1]["T_max_C"] == ""
    folder = Path("out/runs") / rows()[1]["case"]
    assert "in _simulated" in (folder / "failure.log").read_text()
    assert "1 failed, 2 ok" in capsys.readouterr().out


def test_case_that_does_not_converge_is_a_row_with_its_reason(study, simulation):
    simulation.stops[7.0] = "step below its minimum"
    state = run(study)
    assert state.status == {"not converged": 1, "ok": 2}
    assert not state.all_ok
    assert rows()[0]["reason"] == "step below its minimum"


def test_worker_that_runs_another_program_is_a_failure(study, simulation, monkeypatch):
    monkeypatch.setattr(sweep_case, "program_version", lambda: "0.0.9+old")
    run(study)
    assert {row["status"] for row in rows()} == {"failed"}
    assert "0.0.9+old" in rows()[0]["reason"]
    assert simulation.simulated == []


def test_worker_that_does_not_see_the_disk_is_a_failure_and_writes_nothing(tmp_path, simulation):
    task = sweep_case.SweepTask(
        name="a",
        case=made_up_case(),
        folder=str(tmp_path / "elsewhere" / "runs" / "a"),
    )
    outcome = sweep_case.run_task(task)
    assert outcome.summary["status"] == "failed"
    assert "shared disk" in outcome.summary["reason"]
    assert list(tmp_path.iterdir()) == []


# -- resuming --------------------------------------------------------------------------------------


def test_resume_runs_only_what_is_missing_and_gives_the_same_table(study, simulation):
    run(study)
    whole = Path("out/summary.csv").read_bytes()
    (Path("out/runs") / rows()[1]["case"] / "summary.json").unlink()
    Path("out/summary.csv").unlink()
    simulation.simulated.clear()
    state = run(study, resume=True)
    assert simulation.simulated == [50.0]
    assert (state.earlier, state.done) == (2, 3)
    assert Path("out/summary.csv").read_bytes() == whole


def test_interrupted_sweep_keeps_what_is_finished_and_goes_on_from_there(study, simulation, capsys):
    run(study)
    whole = Path("out/summary.csv").read_bytes()
    simulation.faults[50.0] = KeyboardInterrupt()
    assert treadfem.main(["sweep", str(study), "-o", "out", "--workers", "1"]) == 130
    assert capsys.readouterr().err == "treadfem: interrupted\n"
    assert [row["loading.velocity_mm_per_s"] for row in rows()] == ["7.0"]
    simulation.faults.clear()
    simulation.simulated.clear()
    assert treadfem.main(["sweep", str(study), "-o", "out", "--workers", "1", "--resume"]) == 0
    assert simulation.simulated == [50.0, 300.0]
    assert Path("out/summary.csv").read_bytes() == whole


def test_simulation_that_reports_an_interrupt_ends_the_sweep(study, simulation, monkeypatch):
    def interrupted(case, **options):
        result = simulation(case, **options)
        result.summary["status"] = "interrupted"
        return result

    monkeypatch.setattr(sweep_case, "simulate", interrupted)
    with pytest.raises(KeyboardInterrupt):
        run(study)
    assert rows() == []
    assert simulation.simulated == [7.0]


def test_without_resume_everything_is_run_again(study, simulation):
    run(study)
    simulation.simulated.clear()
    run(study)
    assert simulation.simulated == list(VELOCITIES)


def test_resume_repeats_failures_but_not_what_cannot_converge(study, simulation):
    simulation.faults[7.0] = MemoryError()
    simulation.stops[50.0] = "locked"
    run(study)
    simulation.simulated.clear()
    simulation.faults.clear()
    run(study, resume=True)
    assert simulation.simulated == [7.0]
    assert [row["status"] for row in rows()] == ["ok", "not converged", "ok"]
    assert not list(Path("out/runs").glob("*/failure.log"))


def test_resume_repeats_changed_cases_and_the_work_of_another_program(
    study, simulation, monkeypatch
):
    run(study)
    simulation.simulated.clear()
    (study.parent / "case.toml").write_text(BASE.replace("120.0", "60.0"))
    run(study, resume=True)
    assert simulation.simulated == list(VELOCITIES)
    simulation.simulated.clear()
    monkeypatch.setattr("fem.results.run_folder.program_version", lambda: "9.9+new")
    run(study, resume=True)
    assert simulation.simulated == list(VELOCITIES)


def test_leftovers_of_killed_workers_are_removed(study, simulation):
    run(study)
    name = rows()[0]["case"]
    (Path("out/runs") / name / "summary.json").unlink()
    left = [Path(f"out/{place}/.unfinished-abc") for place in (".", "runs", f"runs/{name}")]
    other = Path("out/runs/.mine")
    for folder in (*left, other):
        folder.mkdir()
    run(study, resume=True)
    assert not any(folder.exists() for folder in left)
    assert other.exists()


# -- bad input -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words, parts",
    [
        (["--workers", "0"], ["--workers", "found 0", "at least 1"]),
        (["--workers", "two"], ["--workers", "'two'"]),
        (["--workers", "2", "--scheduler", "tcp://a:1"], ["not allowed with"]),
        (["--resume", "now"], ["now"]),
    ],
)
def test_wrong_options_give_one_line_and_write_nothing(words, parts, study, capsys):
    try:
        code = treadfem.main(["sweep", str(study), "-o", "out", *words])
    except SystemExit as stop:
        code = stop.code
    printed = capsys.readouterr()
    assert code == 2
    assert len(printed.err.splitlines()) == 1
    assert all(part in printed.err for part in parts)
    assert not Path("out").exists()


def test_wrong_study_gives_one_line_and_writes_nothing(study, capsys):
    study.write_text(STUDY.replace("velocity_mm", "velocity_cm"))
    assert treadfem.main(["sweep", str(study), "-o", "out"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert not Path("out").exists()


def test_missing_dask_is_said_with_the_command_that_installs_it(study, monkeypatch):
    monkeypatch.setattr(sweep_workers, "has_dask", lambda: False)
    with pytest.raises(CaseError, match=r"pip install 'treadfem\[sweep\]'") as error:
        sweep(study, "out", scheduler="tcp://127.0.0.1:1")
    assert "\n" not in str(error.value)
    assert not Path("out").exists()


@pytest.mark.parametrize(
    "options", [{"workers": "2"}, {"workers": True}, {"workers": 1.0}, {"scheduler": 8786}], ids=str
)
def test_wrong_types_are_named(options, study):
    with pytest.raises(TypeError, match=next(iter(options))):
        sweep(study, "out", **options)
    assert not Path("out").exists()


def large(study):
    values = ", ".join(f"{value}.0" for value in range(1, 1002))
    study.write_text(f'base = "case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [{values}]\n')


def test_large_study_is_refused_with_its_size_unless_asked_for(study, simulation, capsys):
    large(study)
    assert treadfem.main(["sweep", str(study), "-o", "out", "--workers", "1"]) == 2
    errors = capsys.readouterr().err
    assert "found 1001 cases: about" in errors
    assert "--yes" in errors
    assert len(errors.splitlines()) == 1
    assert simulation.simulated == []
    assert not Path("out").exists()


@pytest.mark.parametrize("answer", [True, False])
def test_large_study_is_begun_when_it_is_confirmed(answer, study, monkeypatch):
    large(study)
    asked = []

    def confirm(size):
        asked.append(size)
        return answer

    begun = []
    monkeypatch.setattr(
        importlib.import_module("fem.sweeps.sweep"), "_sweep", lambda cases, *_: begun.append(cases)
    )
    if answer:
        sweep(study, "out", confirm=confirm)
        assert len(begun[0]) == 1001
    else:
        with pytest.raises(CaseError, match="1001 cases"):
            sweep(study, "out", confirm=confirm)
        assert begun == []
    assert len(asked) == 1


@pytest.mark.parametrize("words, code", [([], 0), (["--strict"], 4)])
def test_strict_sweep_with_a_warning_ends_with_code_4(words, code, study, simulation, monkeypatch):
    def warned(case, **options):
        result = simulation(case, **options)
        result.summary["warnings"] = ["energy_error = 0.05 is above 0.01"]
        return result

    monkeypatch.setattr(sweep_case, "simulate", warned)
    assert treadfem.main(["sweep", str(study), "-o", "out", "--workers", "1", *words]) == code


@pytest.mark.parametrize("damage", ["5", "null", "[]", '{"status": 3}'])
def test_damaged_summary_or_missing_table_means_not_done(damage, study, simulation):
    run(study)
    simulation.simulated.clear()
    folders = [Path("out/runs") / row["case"] for row in rows()]
    (folders[0] / "summary.json").write_text(damage)
    (folders[2] / "history.csv").unlink()
    run(study, resume=True)
    assert simulation.simulated == [7.0, 300.0]


def test_text_that_a_spreadsheet_would_run_is_quoted(study, simulation):
    simulation.stops[7.0] = "=HYPERLINK(1)"
    simulation.faults[50.0] = ValueError("plain")
    run(study)
    assert [row["reason"] for row in rows()] == ["'=HYPERLINK(1)", "ValueError: plain", ""]


# -- progress --------------------------------------------------------------------------------------


def state(done: int, earlier: int = 0, **status: int) -> SweepProgress:
    return SweepProgress(cases=36, done=done, earlier=earlier, status=status)


@pytest.mark.parametrize(
    "progress, words",
    [
        (state(0), "time left unknown"),
        (state(12, 12), "time left unknown"),
        (state(6), "08:20 left"),
        (state(24, 23), "20:00 left"),
        (state(1), "58:20 left"),
        (state(36), "done"),
    ],
)
def test_time_left_follows_from_the_cases_of_this_sweep(progress, words):
    assert time_left(progress, 100.0) == words


def test_bar_on_a_terminal_shows_cases_time_left_and_failures(capsys, monkeypatch):
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    with SweepBar() as bar:
        bar(state(0))
        bar(state(2, ok=1, failed=1))
    shown = capsys.readouterr().err
    assert "2/36 cases" in shown
    assert "left" in shown
    assert "1 not ok" in shown


def test_pipe_gets_one_line(study, simulation, capsys):
    assert treadfem.main(["sweep", str(study), "-o", "out", "--workers", "1"]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert printed.out == f"3 cases: 3 ok; table in {Path('out/summary.csv')}\n"


def test_closing_line_tells_what_was_finished_earlier():
    assert "(12 finished earlier)" in closing_line(state(36, 12, ok=36), Path("out"))


# -- checkpoints of the cases ----------------------------------------------------------------------


def test_case_of_a_resumed_sweep_goes_on_from_its_checkpoint(tmp_path, monkeypatch):
    """Stopped after some steps, the case ends with the row of an uninterrupted sweep."""
    (tmp_path / "case.toml").write_text(SHORT_CASE)
    path = tmp_path / "study.toml"
    path.write_text('base = "case.toml"')
    sweep(path, tmp_path / "whole", workers=1)

    steps = []

    def stopped(case, *, checkpoint, resume):
        def stop(progress):
            steps.append(progress.sliding_distance_mm)
            if len(steps) == 7:
                raise KeyboardInterrupt

        return simulate(case, checkpoint=checkpoint, resume=resume, progress=stop)

    monkeypatch.setattr(sweep_case, "simulate", stopped)
    with pytest.raises(KeyboardInterrupt):
        sweep(path, tmp_path / "out", workers=1)
    kept = tmp_path / "out" / "runs" / "base" / "checkpoint.npz"
    assert kept.is_file()

    monkeypatch.setattr(sweep_case, "simulate", simulate)
    sweep(path, tmp_path / "out", workers=1, resume=True)
    log = (kept.parent / "run.log").read_text()
    assert "resumed after 7 steps" in log
    assert not kept.exists()
    tables = [tmp_path / folder / "summary.csv" for folder in ("whole", "out")]
    assert tables[0].read_bytes() == tables[1].read_bytes()


def test_sweep_that_is_not_resumed_starts_its_cases_anew(study, simulation):
    run(study)
    kept = Path("out/runs") / rows()[0]["case"] / "checkpoint.npz"
    kept.write_bytes(b"of an earlier sweep")
    run(study)
    assert not kept.exists()


def test_damaged_checkpoint_of_a_case_means_from_the_beginning(tmp_path):
    (tmp_path / "case.toml").write_text(SHORT_CASE)
    path = tmp_path / "study.toml"
    path.write_text('base = "case.toml"')
    kept = tmp_path / "out" / "runs" / "base" / "checkpoint.npz"
    kept.parent.mkdir(parents=True)
    kept.write_bytes(b"half a file")
    assert sweep(path, tmp_path / "out", workers=1, resume=True).all_ok
    assert not kept.exists()
