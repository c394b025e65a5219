"""The command line: exit codes, one-line errors, nothing written on bad input, what is printed."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import treadfem
from fem.case.case import Case
from fem.case.reading import parse_override
from fem.sweeps.runs import StudyError
from tests.wrong_inputs import LOADING

ROOT = Path(__file__).parents[1]


def contents(folder: Path) -> dict[str, bytes | None]:
    """Every file and folder below `folder` with its content."""
    return {
        str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None
        for path in folder.rglob("*")
    }


def command(*words: str | Path) -> int:
    """Run the command line as the console script does."""
    try:
        return treadfem.main([str(word) for word in words])
    except SystemExit as stop:
        return int(stop.code or 0)


@pytest.fixture
def case_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "case.toml"
    path.write_text(LOADING + "[output]\nfigures = false\n")
    return path


class StubSimulation:
    """Stands in for the simulation: reports two steps and ends as it is told to."""

    def __init__(self, status: str = "ok", **summary: object) -> None:
        self.summary = {"status": status, "T_max_C": 41.25, "steps": 2, **summary}
        self.cases: list[Case] = []

    def simulate(self, case, *, progress=None, **_):
        self.cases.append(case)
        for share in (0.5, 1.0):
            if progress is not None:
                distance = share * case.loading.distance_mm
                progress(SimpleNamespace(sliding_distance_mm=distance, T_max_C=30.0))
        return self

    def write(self, directory):
        directory = Path(directory)
        directory.mkdir(parents=True, exist_ok=True)
        (directory / "summary.json").write_text(json.dumps(self.summary))


@pytest.fixture
def stub(monkeypatch):
    """Replace the simulation; returns a function that sets the stub in place."""

    def install(simulation):
        monkeypatch.setattr("fem.simulate", simulation.simulate)
        return simulation

    return install


# -- bad input -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["simulate"],
        ["run"],
        ["run", "case.toml", "--fast"],
        ["template", "mesh"],
        ["check", "case.toml", "--set"],
    ],
    ids=" ".join,
)
def test_wrong_usage_gives_one_line(words, case_file, capsys):
    assert command(*words) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert len(printed.err.splitlines()) == 1


def test_output_folder_that_is_a_file_is_refused_before_the_simulation(case_file, capsys, stub):
    simulation = stub(StubSimulation())
    Path("taken").write_text("mine")
    assert command("run", case_file, "-o", "taken/out") == 2
    assert "taken: a file, expected a writable folder" in capsys.readouterr().err
    assert simulation.cases == []
    assert Path("taken").read_text() == "mine"


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write everywhere")
def test_output_folder_without_permission_is_refused(case_file, capsys, stub):
    stub(StubSimulation())
    Path("locked").mkdir(mode=0o500)
    assert command("run", case_file, "-o", "locked/out") == 2
    assert "without permission" in capsys.readouterr().err


def test_pardiso_without_its_package_is_refused(case_file, capsys, monkeypatch):
    monkeypatch.setattr("fem.case.sections.find_spec", lambda name: None)
    assert command("check", case_file, "--set", "solver.linear_solver=pardiso") == 2
    assert "solver.linear_solver" in capsys.readouterr().err


# -- run -------------------------------------------------------------------------------------------


def test_run_writes_the_result_and_prints_a_summary(case_file, capsys, stub):
    stub(StubSimulation())
    assert command("run", case_file, "-o", "out/deep") == 0
    printed = capsys.readouterr()
    assert json.loads(Path("out/deep/summary.json").read_text())["status"] == "ok"
    assert "T_max_C" in printed.out
    assert "41.25" in printed.out
    assert "results in out/deep" in printed.out
    assert printed.err == ""


def test_run_goes_to_a_folder_named_like_the_case_by_default(case_file, stub):
    stub(StubSimulation())
    assert command("run", case_file, "--quiet") == 0
    assert Path("results/case/summary.json").exists()


def test_progress_is_printed_in_lines_when_there_is_no_terminal(case_file, capsys, stub):
    stub(StubSimulation())
    command("run", case_file, "-o", "out")
    lines = capsys.readouterr().out.splitlines()
    assert [line.split("%")[0].strip() for line in lines if "%" in line] == ["50", "100"]


def test_quiet_run_prints_nothing(case_file, capsys, stub):
    stub(StubSimulation())
    assert command("run", case_file, "-o", "out", "--quiet") == 0
    assert capsys.readouterr() == ("", "")


def test_overrides_reach_the_simulation(case_file, stub):
    simulation = stub(StubSimulation())
    command("run", case_file, "--quiet", "--set", "loading.velocity_mm_per_s=-50")
    assert simulation.cases[0].loading.velocity_mm_per_s == -50.0


def test_no_convergence_gives_code_3_and_keeps_what_was_accepted(case_file, capsys, stub):
    stub(StubSimulation("not converged", reason="step below its minimum", advice="refine"))
    assert command("run", case_file, "-o", "out") == 3
    assert capsys.readouterr().err == "treadfem: not converged: step below its minimum; refine\n"
    assert Path("out/summary.json").exists()


@pytest.mark.parametrize("words, code", [([], 0), (["--strict"], 4), (["--quiet"], 0)])
def test_warnings_of_a_run_are_printed_and_end_a_strict_one_with_code_4(
    words, code, case_file, capsys, stub
):
    stub(StubSimulation(warnings=["energy_error = 0.05 is above 0.01"]))
    assert command("run", case_file, "-o", "out", *words) == code
    assert capsys.readouterr().err == "treadfem: warning: energy_error = 0.05 is above 0.01\n"
    assert Path("out/summary.json").exists()


def test_strict_run_without_a_warning_ends_with_code_0(case_file, stub):
    stub(StubSimulation())
    assert command("run", case_file, "-o", "out", "--strict") == 0


def test_interrupted_simulation_gives_code_130_and_keeps_what_was_accepted(case_file, stub):
    stub(StubSimulation("interrupted"))
    assert command("run", case_file, "-o", "out", "--quiet") == 130
    assert Path("out/summary.json").exists()


def test_interrupt_before_anything_was_accepted_gives_code_130(case_file, capsys, stub):
    class Interrupted(StubSimulation):
        def simulate(self, case, *, progress=None, **_):
            raise KeyboardInterrupt

    stub(Interrupted())
    assert command("run", case_file, "-o", "out") == 130
    assert capsys.readouterr().err == "treadfem: interrupted\n"
    assert not Path("out").exists()


TINY = [
    "block.mesh={cells_x = 12, cells_y = 5, smallest_x_mm = 0.8, smallest_y_mm = 0.6}",
    "loading.distance_mm=0.3",
    "output.snapshots=1",
    "output.figures=true",
]


def settings(*texts: str) -> list[str]:
    """Words of overrides."""
    return [word for text in texts for word in ("--set", text)]


def test_tiny_real_case_leaves_every_file(case_file, capsys):
    assert command("run", case_file, "-o", "out", *settings(*TINY)) == 0
    found = {path.name for path in Path("out").rglob("*")}
    tables = {"case.toml", "run.log", "history.csv", "surface.csv", "summary.json", "summary.csv"}
    pictures = {"history.png", "surface.png", "final_state.png"}
    assert tables | pictures | {"block.pvd", "road.pvd"} <= found
    assert json.loads(Path("out/summary.json").read_text())["status"] == "ok"
    assert Case.from_toml("out/case.toml") == Case.from_toml(
        case_file, dict(parse_override(text) for text in TINY)
    )


def test_real_case_that_cannot_converge_gives_code_3_with_reason_and_advice(case_file, capsys):
    hopeless = ["solver.newton_iterations_max=1", "solver.step_mm_min=0.02"]
    assert (
        command("run", case_file, "-o", "out", "--accept-unusual", *settings(*TINY, *hopeless)) == 3
    )
    assert len(capsys.readouterr().err.splitlines()) == 1
    summary = json.loads(Path("out/summary.json").read_text())
    assert summary["status"] == "not converged"
    assert summary["reason"]
    assert summary["advice"]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signal_stops_a_real_run_and_keeps_what_was_accepted(number, case_file):
    words = [sys.executable, "-m", "treadfem", "run", str(case_file), "-o", str(Path("out"))]
    far = ["loading.distance_mm=400.0", "output.figures=false"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    pipe = subprocess.PIPE
    with subprocess.Popen(
        [*words, *settings(*TINY, *far)], env=environment, stdout=pipe, stderr=pipe, text=True
    ) as run:
        assert run.stdout is not None
        assert "10 %" in run.stdout.readline()
        run.send_signal(number)
        _, errors = run.communicate(timeout=120)
    assert run.returncode == 130, errors
    assert len(errors.splitlines()) == 1
    assert json.loads(Path("out/summary.json").read_text())["status"] == "interrupted"
    assert len(Path("out/history.csv").read_text().splitlines()) > 1


# -- check, template -------------------------------------------------------------------------------


def test_check_prints_the_resolved_case_and_writes_nothing(case_file, tmp_path, capsys):
    before = contents(tmp_path)
    assert command("check", case_file, "--set", "block.mesh=coarse") == 0
    resolved = tmp_path / "resolved.toml"
    assert contents(tmp_path) == before
    resolved.write_text(capsys.readouterr().out)
    assert Case.from_toml(resolved) == Case.from_toml(case_file, {"block.mesh": "coarse"})


@pytest.mark.parametrize("words", [["template"], ["template", "case"]], ids=" ".join)
def test_template_passes_the_check(words, tmp_path, capsys):
    assert command(*words) == 0
    path = tmp_path / "template.toml"
    path.write_text(capsys.readouterr().out)
    assert command("check", path) == 0


@pytest.mark.parametrize(
    "example",
    [
        path
        for path in sorted((ROOT / "examples").glob("*.toml"))
        if "[loading]" in path.read_text()
    ],
    ids=lambda path: path.stem,
)
def test_every_example_of_a_case_passes_the_check(example, capsys):
    assert command("check", example) == 0


def test_fitted_rubber_goes_straight_into_a_run(case_file, capsys):
    data = ROOT / "calibration" / "datasets" / "treloar1944.csv"
    fit = ["--model", "mooney-rivlin", "--window", "1", "2", "--starts", "1", "--no-compare"]
    assert command("calibrate", "hyperelastic", data, *fit, "-o", "fit", "--quiet") == 0
    fitted = settings("rubber.parameters=fit/parameters.toml", *TINY, "output.figures=false")
    assert command("run", case_file, "-o", "out", *fitted, "--quiet") == 0
    assert Case.from_toml("out/case.toml").rubber.model_name == "mooney-rivlin"


@pytest.mark.parametrize(
    "words",
    [["calibrate"], ["calibrate", "rubber"], ["calibrate", "friction", "missing.csv"]],
    ids=" ".join,
)
def test_wrong_calibration_gives_one_line_and_writes_nothing(words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert command(*words) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert contents(tmp_path) == {}


def test_help_lists_every_command(capsys):
    assert command("--help") == 0
    shown = capsys.readouterr().out
    for name in (
        *("run", "sweep", "compare", "check", "template", "calibrate", "figure", "table"),
        *("claims", "sensitivity", "report", "export"),
    ):
        assert re.search(rf"^    {name}\b", shown, flags=re.MULTILINE)


@pytest.mark.parametrize("what", ["figure", "table"])
def test_unknown_number_is_refused(what, capsys, tmp_path):
    assert command(what, "1000", "-o", tmp_path / "out") == 2
    printed = capsys.readouterr()
    assert "1000" in printed.err
    assert len(printed.err.splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_table_is_printed_and_written(tmp_path, capsys):
    assert command("table", "3", "-o", tmp_path / "out") == 0
    assert "asphalt" in capsys.readouterr().out
    assert (tmp_path / "out" / "table3.csv").exists()


def test_figure_is_written(tmp_path, capsys):
    assert command("figure", "7", "-o", tmp_path / "out") == 0
    assert capsys.readouterr().out == f"{tmp_path / 'out' / 'fig7.png'}\n"
    assert (tmp_path / "out" / "fig7.png").exists()


def test_figure_that_is_up_to_date_is_left_alone_unless_asked_for_again(tmp_path, capsys):
    words = ("figure", "7", "-o", tmp_path)
    assert command(*words) == 0
    before = (tmp_path / "fig7.png").stat().st_mtime_ns
    assert command(*words) == 0
    assert "(up to date)" in capsys.readouterr().out.splitlines()[-1]
    assert (tmp_path / "fig7.png").stat().st_mtime_ns == before
    assert command(*words, "--again") == 0
    assert (tmp_path / "fig7.png").stat().st_mtime_ns > before


@pytest.mark.parametrize(
    "words, part",
    [
        (("figure", "7", "-o", "taken"), "taken: -o"),
        (("claims", "-o", "taken"), "taken: -o"),
        (("sensitivity", "-o", "taken"), "taken: -o"),
        (("report", "--figures", "nowhere"), "nowhere: --figures: found no such folder"),
        (("report", "--figures", ".", "-o", "."), ".: -o: found a folder, expected a file"),
    ],
    ids=" ".join,
)
def test_wrong_folder_gives_one_line_and_writes_nothing(words, part, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("taken").write_text("a file")
    assert command(*words) == 2
    error = capsys.readouterr().err
    assert part in error
    assert error.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


def test_run_that_fails_behind_a_figure_is_said_in_one_line(tmp_path, monkeypatch, capsys):
    def fails(number, directory, measured=None):
        raise StudyError("v_7: ValueError: no such thing")

    monkeypatch.setattr("validation.paper.make_figure", fails)
    assert command("figure", "11", "-o", tmp_path) == 3
    assert capsys.readouterr().err == "treadfem: fig11: v_7: ValueError: no such thing\n"


def test_module_runs_as_a_program():
    words = [sys.executable, "-m", "treadfem", "check", "examples/introductory.toml"]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    assert "yeoh-bars-series-1-load" in done.stdout


def test_reader_that_stops_reading_is_no_error():
    words = f"{sys.executable} -m treadfem template | true"
    done = subprocess.run(
        words, cwd=ROOT, capture_output=True, text=True, timeout=120, check=False, shell=True
    )
    assert done.stderr == ""
