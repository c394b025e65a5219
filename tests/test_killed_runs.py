"""Runs of the command line that are killed (no chance to clean up) and resumed."""

from __future__ import annotations

import json
import random
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import pandas as pd
import pytest

from tests.machines import ENVIRONMENT, TIMES

CASE = """
[block]
mesh = {cells_x = 24, cells_y = 8, smallest_x_mm = 0.4, smallest_y_mm = 0.3}

[loading]
mean_pressure_N_per_mm2 = 0.25
velocity_mm_per_s = 300.0
distance_mm = 30.0

[output]
figures = false
checkpoint_s = 0.0
"""
KILLED = -signal.SIGKILL

# Kills itself instead of the given rename, the first being number 1.
SUICIDE = """
import os, signal, sys
import treadfem
number, seen, replace = int(sys.argv.pop(1)), 0, os.replace

def counting(source, target):
    global seen
    seen += 1
    if seen == number:
        os.kill(os.getpid(), signal.SIGKILL)
    replace(source, target)

os.replace = counting
sys.exit(treadfem.main(sys.argv[1:]))
"""


def words(folder: Path, *more: str) -> list[str]:
    """Arguments of a run of the case beside its folder."""
    return ["run", str(folder.parent / "case.toml"), "-o", str(folder), *more]


def started(folder: Path, *more: str) -> subprocess.Popen[str]:
    """A run in a process of its own."""
    pipe = subprocess.PIPE
    command = [sys.executable, "-m", "treadfem", *words(folder, *more)]
    return subprocess.Popen(command, env=ENVIRONMENT, stdout=pipe, stderr=pipe, text=True)


def finished(folder: Path, *more: str) -> str:
    """Let a run end by itself; what it printed."""
    run = started(folder, *more)
    printed, errors = run.communicate(timeout=300)
    assert run.returncode == 0, errors
    return printed


def assert_nothing_is_torn(folder: Path, reference: Path) -> None:
    """Every file with a final name is complete, and one of a finished run is the right one."""
    for path in folder.glob("[!.]*"):
        if path.suffix == ".npz":
            with zipfile.ZipFile(path) as archive:
                assert archive.testzip() is None
        elif path.suffix == ".json":
            json.loads(path.read_text())
        elif path.suffix == ".vtu" or path.name in ("history.csv", "surface.csv"):
            assert path.read_bytes() == (reference / path.name).read_bytes()


def assert_same_result(folder: Path, reference: Path) -> None:
    one, other = (
        pd.read_csv(run / "summary.csv").drop(columns=TIMES) for run in (folder, reference)
    )
    pd.testing.assert_frame_equal(one, other, check_exact=False, rtol=1e-10, atol=1e-10)
    assert_nothing_is_torn(folder, reference)
    assert {path.name for path in folder.iterdir()} == {path.name for path in reference.iterdir()}


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    """Folder of a run that nobody disturbed, and how long it took with the start of Python."""
    place = tmp_path_factory.mktemp("reference")
    (place / "case.toml").write_text(CASE)
    start = time.monotonic()
    finished(place / "run")
    return place / "run", time.monotonic() - start


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    return tmp_path / "run"


MOMENTS = [*range(2), *(pytest.param(n, marks=pytest.mark.slow) for n in range(2, 20))]


@pytest.mark.parametrize("number", MOMENTS)
def test_a_run_killed_at_a_random_moment_is_resumed_to_the_same_result(number, reference, folder):
    """Killed, resumed, killed again: each time after a random part of an undisturbed run."""
    original, duration = reference
    moment = random.Random(number)
    for more in ([], ["--resume"]):
        run = started(folder, *more)
        try:
            run.wait(timeout=moment.uniform(0.4, 1.0) * duration)
        except subprocess.TimeoutExpired:
            run.kill()
        _, errors = run.communicate(timeout=60)
        assert run.returncode in (KILLED, 0), errors
        assert_nothing_is_torn(folder, original)
    finished(folder, "--resume")
    assert_same_result(folder, original)


@pytest.mark.parametrize(
    "number", [2, -5, *(pytest.param(n, marks=pytest.mark.slow) for n in (1, 20, -1, -15))]
)
def test_a_run_killed_when_it_is_about_to_name_a_file_is_resumed(number, reference, folder):
    """The checkpoints, then (numbers from the end) the files of the result."""
    original, _ = reference
    steps = json.loads((original / "summary.json").read_text())["steps"]
    files = len([path for path in original.rglob("*") if path.is_file()])
    count = number if number > 0 else steps + files + 1 + number
    command = [sys.executable, "-c", SUICIDE, str(count), *words(folder, "--quiet")]
    run = subprocess.run(command, env=ENVIRONMENT, timeout=300, check=False)
    assert run.returncode == KILLED
    assert_nothing_is_torn(folder, original)
    assert not (folder / "summary.json").exists()
    printed = finished(folder, "--resume")
    expected = "starting from the beginning" if number == 1 else "going on from"
    assert expected in printed
    assert_same_result(folder, original)


def test_a_finished_run_is_not_run_again(reference):
    original, _ = reference
    before = (original / "summary.json").stat().st_mtime_ns
    assert "nothing to do" in finished(original, "--resume")
    assert (original / "summary.json").stat().st_mtime_ns == before


def test_a_finished_run_that_was_killed_before_its_figures_gets_them(tmp_path, monkeypatch):
    import treadfem

    case = tmp_path / "case.toml"
    case.write_text(CASE.replace("false", "true").replace("30.0", "0.3"))
    command = ["run", str(case), "-o", str(tmp_path / "run"), "--quiet"]
    with monkeypatch.context() as killed:
        killed.setattr("validation.drawing.run_figures.save", lambda *_: sys.exit(KILLED))
        with pytest.raises(SystemExit):
            treadfem.main(command)
    (tmp_path / "run" / "checkpoint.npz").unlink()  # runs that take no time have none
    assert not (tmp_path / "run" / "figures").exists()
    assert treadfem.main([*command, "--resume"]) == 0
    pictures = {path.name for path in (tmp_path / "run" / "figures").glob("*.png")}
    assert pictures == {"final_state.png", "history.png", "onset.png", "surface.png"}


def test_an_interrupted_run_is_resumed(reference, folder):
    original, _ = reference
    run = started(folder)
    assert run.stdout is not None
    assert "10 %" in run.stdout.readline()
    run.send_signal(signal.SIGINT)
    _, errors = run.communicate(timeout=120)
    assert run.returncode == 130, errors
    assert errors.endswith("--resume goes on from there\n")
    assert len(errors.splitlines()) == 1
    assert "going on from" in finished(folder, "--resume")
    assert_same_result(folder, original)


@pytest.mark.parametrize(
    ("damage", "blamed"),
    [
        (["--set", "loading.distance_mm=31"], "loading.distance_mm: found 30.0, expected 31.0"),
        ([], "content: found a damaged file"),
    ],
    ids=["foreign", "damaged"],
)
def test_a_checkpoint_that_does_not_fit_gives_code_2_and_one_line(damage, blamed, folder):
    run = started(folder)
    while not (folder / "checkpoint.npz").exists() and run.poll() is None:
        time.sleep(0.01)
    run.kill()
    run.communicate(timeout=60)
    checkpoint = folder / "checkpoint.npz"
    if not damage:
        checkpoint.write_bytes(checkpoint.read_bytes()[:5000])
    before = checkpoint.read_bytes()
    again = started(folder, "--resume", *damage)
    printed, errors = again.communicate(timeout=60)
    assert again.returncode == 2
    assert printed == ""
    assert errors.startswith(f"treadfem: {checkpoint}: {blamed}")
    assert len(errors.splitlines()) == 1
    assert checkpoint.read_bytes() == before
    assert not (folder / "summary.json").exists()
