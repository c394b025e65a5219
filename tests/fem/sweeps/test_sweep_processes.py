"""Sweeps with real worker processes, some of which are killed; small simulations."""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest

from tests.machines import ENVIRONMENT

psutil = pytest.importorskip("psutil")

CASE = """
[block]
mesh = {cells_x = 12, cells_y = 5, smallest_x_mm = 0.8, smallest_y_mm = 0.6}
[loading]
mean_pressure_N_per_mm2 = 0.25
velocity_mm_per_s = 300.0
distance_mm = 6.0
[output]
snapshots = 1
figures = false
"""
STUDY = """
base = "case.toml"
[grid]
"loading.velocity_mm_per_s" = [7.0, 50.0, 300.0, -50.0]
[[case]]
[[case]]
"solver.newton_iterations_max" = 1
"solver.step_mm_min" = 0.02
"""
CASES = 8
PATIENCE_S = 120.0


def write_study(folder: Path) -> None:
    (folder / "case.toml").write_text(CASE)
    (folder / "study.toml").write_text(STUDY)


def start(folder: Path, *words: str) -> subprocess.Popen[str]:
    """Start `treadfem sweep study.toml` in a folder."""
    return subprocess.Popen(
        [sys.executable, "-m", "treadfem", "sweep", "study.toml", *words],
        cwd=folder,
        env=ENVIRONMENT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def wait_for(condition: Callable[[], object], sweep: subprocess.Popen[str] | None = None) -> None:
    """Wait until something holds while a sweep is running."""
    end = time.monotonic() + PATIENCE_S
    while not condition():
        if sweep is not None and sweep.poll() is not None:
            pytest.fail(f"the sweep has ended: {sweep.communicate()}")
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.05)


def finished(directory: Path) -> int:
    """Number of rows of a sweep's table."""
    table = directory / "summary.csv"
    return len(table.read_text().splitlines()) - 1 if table.exists() else -1


@contextlib.contextmanager
def program(words: Sequence[str], folder: Path) -> Iterator[subprocess.Popen[bytes]]:
    """Run a program in the background and end it."""
    with subprocess.Popen(
        words,
        cwd=folder,
        env=ENVIRONMENT,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as process:
        try:
            yield process
        finally:
            process.terminate()
            try:
                process.wait(15.0)
            except subprocess.TimeoutExpired:
                process.kill()


@contextlib.contextmanager
def cluster(folder: Path) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    """A dask scheduler and one worker, each a process of its own, on this machine."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address = f"tcp://127.0.0.1:{port}"
    common = ["--host", "127.0.0.1", "--no-dashboard"]
    module = [sys.executable, "-m"]
    scheduler_words = [*module, "distributed.cli.dask_scheduler", "--port", str(port)]
    worker_words = [*module, "distributed.cli.dask_worker", address, "--nthreads", "1"]
    with (
        program([*scheduler_words, *common], folder) as scheduler,
        program([*worker_words, *common], folder),
    ):
        yield address, scheduler


@pytest.fixture(scope="module")
def expected(tmp_path_factory) -> bytes:
    """The table of an uninterrupted sweep in one process."""
    folder = tmp_path_factory.mktemp("serial")
    write_study(folder)
    with start(folder, "-o", "out", "--workers", "1") as sweep:
        _, errors = sweep.communicate(timeout=PATIENCE_S)
    assert sweep.returncode == 3, errors
    assert errors == ""
    table = (folder / "out/summary.csv").read_bytes()
    assert table.count(b",not converged,") == CASES / 2
    assert table.count(b",ok,") == CASES / 2
    return table


@pytest.fixture
def folder(tmp_path) -> Path:
    write_study(tmp_path)
    return tmp_path


def close(sweep: subprocess.Popen[str], folder: Path, expected: bytes) -> None:
    """The sweep ends by itself, says nothing but its last line, and has the expected table."""
    printed, errors = sweep.communicate(timeout=PATIENCE_S)
    assert sweep.returncode == 3, errors
    assert errors == ""
    assert printed.startswith("8 cases: 4 not converged, 4 ok")
    assert (folder / "out/summary.csv").read_bytes() == expected
    assert len(list((folder / "out/runs").iterdir())) == CASES


def test_killed_worker_is_replaced_and_its_case_run_again(folder, expected):
    with start(folder, "-o", "out", "--workers", "2") as sweep:
        wait_for(lambda: finished(folder / "out") >= 1, sweep)
        children = psutil.Process(sweep.pid).children(recursive=True)
        workers = [child for child in children if "local_pool" in " ".join(child.cmdline())]
        assert len(workers) == 2
        workers[0].kill()
        close(sweep, folder, expected)


@pytest.mark.parametrize(
    "number",
    [
        signal.SIGKILL,
        pytest.param(signal.SIGINT, marks=pytest.mark.slow),
        pytest.param(signal.SIGTERM, marks=pytest.mark.slow),
    ],
)
def test_sweep_that_was_ended_from_outside_is_resumed_to_the_same_table(number, folder, expected):
    with start(folder, "-o", "out", "--workers", "2") as sweep:
        wait_for(lambda: finished(folder / "out") >= 2, sweep)
        children = psutil.Process(sweep.pid).children(recursive=True)
        # Ctrl-C reaches the workers as well.
        (os.kill if number != signal.SIGINT else os.killpg)(sweep.pid, number)
        _, errors = sweep.communicate(timeout=PATIENCE_S)
    if number != signal.SIGKILL:
        assert (sweep.returncode, errors) == (130, "treadfem: interrupted\n")
    wait_for(lambda: not any(child.is_running() for child in children))
    assert 2 <= finished(folder / "out") < CASES
    with start(folder, "-o", "out", "--workers", "2", "--resume") as sweep:
        close(sweep, folder, expected)


def test_cluster_that_is_running_already_gives_the_same_table(folder, expected):
    with cluster(folder) as (address, _):
        with start(folder, "-o", "out", "--scheduler", address) as sweep:
            printed, errors = sweep.communicate(timeout=PATIENCE_S)
        assert sweep.returncode == 3, errors
        assert printed.startswith("8 cases")
        assert (folder / "out/summary.csv").read_bytes() == expected


@pytest.mark.slow
def test_scheduler_that_dies_ends_the_sweep_and_resume_goes_on(folder, expected):
    with cluster(folder) as (address, scheduler):
        with start(folder, "-o", "out", "--scheduler", address) as sweep:
            wait_for(lambda: finished(folder / "out") >= 2, sweep)
            scheduler.kill()
            _, errors = sweep.communicate(timeout=PATIENCE_S)
        assert sweep.returncode == 3
        assert "--resume goes on" in errors.splitlines()[-1]
        assert 2 <= finished(folder / "out") < CASES
    with start(folder, "-o", "out", "--resume") as sweep:
        close(sweep, folder, expected)


def test_address_where_nobody_answers_gives_one_line_and_writes_nothing(folder):
    with start(folder, "-o", "out", "--scheduler", "tcp://127.0.0.1") as sweep:
        _, errors = sweep.communicate(timeout=PATIENCE_S)
    assert sweep.returncode == 2
    assert len(errors.splitlines()) == 1
    assert "--scheduler" in errors
    assert not (folder / "out").exists()
