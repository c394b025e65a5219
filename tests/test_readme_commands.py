"""Every treadfem command of the README and its pages is run as it stands, in a newcomer's folder.

The folder is filled in the order of the README: what one command writes the next one reads. Cases
are cut short so that each takes seconds; the runs behind claims, sensitivity and figure 11 are made
up (the real ones take minutes; `make report` makes them).
"""

from __future__ import annotations

import re
import shlex
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

import treadfem
from fem.case.case import Case
from fem.results.result import Result
from fem.sweeps import case as sweep_case
from tests.calibration.test_readme_examples import examples as calibrate_examples
from tests.documents import PAGES, ROOT, TEXT
from tests.made_up_result import made_up_result

EXAMPLES = (ROOT / "examples/README.md").read_text(encoding="utf-8")
SHORT = {
    'mesh = "default"': "mesh = {cells_x = 20, cells_y = 8, "
    "smallest_x_mm = 0.5, smallest_y_mm = 0.25}",
    "distance_mm = 120.0": "distance_mm = 1.0",
    "snapshots = 10": "snapshots = 1",
}
SHORT_STUDY = {
    'base = "introductory"': 'base = "my_case.toml"',
    '"loading.distance_mm" = [10.0]': '"loading.distance_mm" = [3.0]',
    '"block.mesh" = ["coarse"]\n': "",
    '"friction.law" = ["huemer", "exponential"]\n': "",
}
SHORT_FILES = {"my_case.toml": SHORT, "my_study.toml": SHORT_STUDY}
#: Files that a command writes, by its first word, where it has no -o.
WRITES = {
    "export": lambda words: words[words.index("-o") + 1] if "-o" in words else "my_case.inp",
    "figure": lambda words: f"results/figures/fig{words[1]}.png",
    "table": lambda words: f"results/figures/table{words[1]}.txt",
    "compare": lambda words: "results/comparison/comparison.csv",
}


def command_lines() -> list[str]:
    """Every indented line that calls treadfem, without its comment."""
    lines = re.findall(r"^    (?:\.venv/bin/)?(treadfem .*)$", TEXT, flags=re.MULTILINE)
    return [line.split("  #")[0].strip() for line in lines]


def words_of(line: str) -> list[str]:
    return shlex.split(line.split(" > ")[0])[1:]


def run_here(line: str) -> int:
    """Run a line with the command line's main function, its output into the file behind ``>``."""
    words = words_of(line)
    if " > " not in line:
        return treadfem.main(words)
    with open(line.split(" > ")[1].strip(), "w", encoding="utf-8") as file:
        return subprocess.run(
            [sys.executable, "-m", "treadfem", *words],
            stdout=file,
            check=False,
            env={"PYTHONPATH": str(ROOT)},
        ).returncode


def shorten(path: Path, replacements: dict[str, str]) -> None:
    text = path.read_text(encoding="utf-8")
    for old, new in replacements.items():
        assert old in text, f"{path.name} has no {old!r} any more"
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")


@pytest.fixture(scope="module")
def desk(tmp_path_factory) -> Path:
    """The newcomer's folder."""
    folder = tmp_path_factory.mktemp("desk")
    (folder / "examples").symlink_to(ROOT / "examples")
    return folder


def made_up(case: Case, **options: object) -> Result:
    """A made-up result of a case; its displacements differ a little from case to case."""
    result = made_up_result()
    factor = 1.0 + 0.1 * int(case.hash()[:4], 16) / 0xFFFF
    snapshots = [replace(s, displacement=factor * s.displacement) for s in result.snapshots]
    return Result.from_rows(
        case,
        result.geometry,
        result.history.to_dict("records"),
        result.boundary,
        result.summary,
        snapshots,
    )


@pytest.fixture
def made_up_runs(monkeypatch):
    monkeypatch.setattr(sweep_case, "simulate", made_up)
    monkeypatch.setattr("fem.sweeps.runs.number_of_workers", lambda *_: 1)


#: Commands whose real runs take minutes, and why; here their simulations are made up.
BEHIND_LONG_RUNS = {
    "claims": "the studies of the figures and of claims.toml",
    "sensitivity": "the runs of validation/studies/sensitivity.toml",
    "report": "reads what the long runs of the others made",
    "figure 11": "six runs over the whole distance",
}
#: Commands that another test runs as they stand: by what a line holds, the test and the reason.
COVERED_BY = {
    "treadfem calibrate": (
        "tests/calibration/test_readme_examples.py::test_example_makes_a_parameter_file",
        "each needs measurements of its own kind",
    ),
    "--scheduler": (
        "tests/test_readme_commands.py::"
        "test_scheduler_workers_and_sweep_of_the_readme_work_together",
        "needs a scheduler and workers",
    ),
}


def needs_long_runs(words: list[str]) -> bool:
    return words[0] in BEHIND_LONG_RUNS or " ".join(words[:2]) in BEHIND_LONG_RUNS


def is_covered_elsewhere(line: str) -> bool:
    return any(part in line for part in COVERED_BY)


#: What cuts an example short, by what it is.
SHORTER = {
    "case": " --set loading.distance_mm=1 --set block.mesh=coarse",
    "mesh": " --set loading.distance_mm=1",
    "event": " --set loading.repeat=1 --set loading.phase.1.time_s=5e-4 --set block.mesh=coarse",
}


def example_lines() -> list[str]:
    """Commands of examples/README.md for every example, cut short, on the README's sweep."""
    commands = [" ".join(line.split()) for line in re.findall(r"`(treadfem [^`]*)`", EXAMPLES)]
    kinds = re.findall(r"^\| `(\w+)\.toml` \| (case|event|mesh):", EXAMPLES, flags=re.MULTILINE)
    return [
        line.replace("RESULTS_DIR", "results/my_study")
        for command in commands
        for line in (
            [command.replace("NAME", name) + SHORTER[kind] for name, kind in kinds]
            if "NAME" in command
            else [command]
        )
    ]


LINES = [
    line
    for line in dict.fromkeys([*command_lines(), *example_lines()])
    if not is_covered_elsewhere(line)
]


@pytest.mark.parametrize("line", LINES)
def test_command_does_what_the_readme_says(line, desk, monkeypatch, capsys, request):
    monkeypatch.chdir(desk)
    words = words_of(line)
    if needs_long_runs(words):
        request.getfixturevalue("made_up_runs")
    for promised in map(Path, outputs(words)):
        if promised.is_file():
            promised.unlink()  # an earlier command wrote it
    assert done(line) == 0, capsys.readouterr().err
    for promised in outputs(words):
        assert Path(promised).exists()


def done(line: str) -> int:
    """Run a line, and before it the earlier ones whose files it needs and that are not there.

    In order, there are none; a process that runs only some of the lines makes up for it.
    """
    words = words_of(line)
    for earlier in LINES[: LINES.index(line)]:
        for made in [*outputs(words_of(earlier)), *earlier.split(" > ")[1:]]:
            is_needed = made in words or (words[0] == "sweep" and made in SHORT_FILES)
            if is_needed and made not in outputs(words) and not Path(made).exists():
                assert done(earlier) == 0
    status = run_here(line)
    for made in line.split(" > ")[1:]:
        shorten(Path(made), SHORT_FILES[made])
    return status


def outputs(words: list[str]) -> list[str]:
    if words[0] in WRITES:
        return [WRITES[words[0]](words)]
    return [words[words.index("-o") + 1]] if "-o" in words else []


def test_the_readme_has_every_command():
    known = set(treadfem._parser("calibrate")._subparsers._group_actions[0].choices)
    assert {words_of(line)[0] for line in command_lines()} == known


def test_examples_are_all_listed_and_run():
    files = {
        path.name
        for path in (ROOT / "examples").glob("*.toml")
        if "[loading]" in path.read_text(encoding="utf-8")
    }
    run = {Path(words_of(line)[1]).name for line in example_lines() if " run " in line}
    assert run == files


@pytest.mark.parametrize("part", COVERED_BY)
def test_test_that_covers_a_command_exists_and_has_a_command_to_cover(part):
    path, name = COVERED_BY[part][0].split("::")
    assert f"\ndef {name}(" in (ROOT / path).read_text(encoding="utf-8")
    assert any(part in line for line in command_lines())


def test_every_calibrate_command_is_an_example_of_its_own_test():
    shown = [words_of(line)[1:] for line in command_lines() if words_of(line)[0] == "calibrate"]
    assert shown == calibrate_examples(*PAGES)


# -- on a cluster ----------------------------------------------------------------------------------

CASE = """
[block]
mesh = {cells_x = 12, cells_y = 5, smallest_x_mm = 0.8, smallest_y_mm = 0.6}
[loading]
mean_pressure_N_per_mm2 = 0.25
velocity_mm_per_s = 300.0
distance_mm = 0.5
[output]
figures = false
"""
STUDY = 'base = "my_case.toml"\n[grid]\n"loading.velocity_mm_per_s" = [50.0, 300.0]\n'


@pytest.fixture
def shared(tmp_path) -> Path:
    (tmp_path / "my_case.toml").write_text(CASE)
    (tmp_path / "my_study.toml").write_text(STUDY)
    return tmp_path


def free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return int(listener.getsockname()[1])


@contextmanager
def started(words: list[str], folder: Path) -> Iterator[None]:
    """A program of the README in the background."""
    environment = {"PYTHONPATH": str(ROOT), "PATH": str(Path(sys.executable).parent)}
    process = subprocess.Popen(
        [sys.executable, "-m", "distributed.cli.dask_" + words[1], *words[2:]],
        cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        yield
    finally:
        process.terminate()
        process.wait(30)


@pytest.mark.slow
def test_scheduler_workers_and_sweep_of_the_readme_work_together(shared, monkeypatch):
    pytest.importorskip("distributed", reason="dask.distributed is not installed (extra sweep)")
    port = free_port()
    dask = re.findall(r"^    (dask .*)$", TEXT, flags=re.MULTILINE)
    (sweep_line,) = [line for line in command_lines() if "--scheduler" in line]
    changes = {"8786": str(port), "//host": "//127.0.0.1", "/shared/": f"{shared}/",
               "--nworkers 16": "--nworkers 2"}  # fmt: skip

    def here(line: str) -> str:
        for old, new in changes.items():
            line = line.replace(old, new)
        return line

    scheduler, worker = (shlex.split(here(line)) for line in dask)
    monkeypatch.chdir(shared)
    with started([*scheduler, "--no-dashboard"], shared):
        wait_for_port(port)
        with started([*worker, "--no-dashboard", "--local-directory", str(shared)], shared):
            assert run_here(here(sweep_line)) == 0
    assert (shared / "my_study" / "summary.csv").is_file()


def wait_for_port(port: int) -> None:
    for _ in range(300):
        with socket.socket() as probe:
            if probe.connect_ex(("127.0.0.1", port)) == 0:
                return
        time.sleep(0.1)
    pytest.fail("the scheduler did not start")


STAND_IN = '''
from distributed import LocalCluster


class SLURMCluster(LocalCluster):
    """Takes what the real one takes, and starts two workers here."""

    def __init__(self, queue, cores, processes, memory, walltime):
        super().__init__(n_workers=0, threads_per_worker=1, dashboard_address=None)

    def scale(self, jobs):
        super().scale(2)
'''


@pytest.mark.slow
def test_slurm_script_of_the_readme_runs_a_sweep(shared):
    """With a stand-in for the batch system; everything else as it stands in the README."""
    pytest.importorskip("distributed", reason="dask.distributed is not installed (extra sweep)")
    (script,) = re.findall(r"```py\n(.*?)```", TEXT, flags=re.DOTALL)
    (shared / "dask_jobqueue.py").write_text(STAND_IN)
    (shared / "job.py").write_text(script.replace("/shared/", f"{shared}/"))
    subprocess.run(
        [sys.executable, "job.py"], cwd=shared, check=True, timeout=300,
        env={"PYTHONPATH": f"{ROOT}:{shared}"},
    )  # fmt: skip
    assert (shared / "my_study" / "summary.csv").read_text().count("ok") == 2
