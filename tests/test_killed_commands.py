"""Run, sweep and calibrate, ended at random moments and gone on with, byte for byte."""

from __future__ import annotations

import random
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.machines import CASE, contents, is_one_line, run, start, without_warnings, write_inputs

SLIDES = "mean_pressure_N_per_mm2,v_mm_per_s,T_max_C\n0.25,300,23.5\n0.25,50,21.6\n0.4,300,24.5\n"
COMMANDS = {
    "run": (("run", "case.toml"), ("--resume",)),
    "sweep": (("sweep", "study.toml", "--workers", "2"), ("--resume",)),
    # It goes on by itself.
    "calibrate": (
        ("calibrate", "partition", "slides.csv", "--case", "case.toml", "--simulations", "4"),
        (),
    ),
}
SIGNALS = (signal.SIGTERM, signal.SIGKILL)

pytestmark = pytest.mark.slow


def prepare(folder: Path) -> None:
    write_inputs(folder)
    (folder / "case.toml").write_text(CASE.replace("6.0", "12.0"))
    (folder / "slides.csv").write_text(SLIDES)


@pytest.fixture(scope="module", params=COMMANDS)
def undisturbed(request, tmp_path_factory):
    """A command, what it leaves, and how long it takes with the start of Python."""
    folder = tmp_path_factory.mktemp(request.param)
    prepare(folder)
    words, resume = COMMANDS[request.param]
    begin = time.monotonic()
    code, _, errors = run(folder, *words, "-o", "out")
    assert (code, errors) == (0, "")
    return words, resume, contents(folder / "out"), time.monotonic() - begin


@pytest.mark.parametrize("seed", range(20))
def test_command_ended_at_a_random_moment_is_gone_on_with_to_the_same_bytes(
    seed, undisturbed, tmp_path
):
    words, resume, expected, duration = undisturbed
    prepare(tmp_path)
    chance = random.Random(seed)
    for more in ((), resume):
        number = chance.choice(SIGNALS)
        with start(tmp_path, *words, *more, "-o", "out") as process:
            try:
                process.wait(chance.uniform(0.3, 1.0) * duration)
            except subprocess.TimeoutExpired:
                process.send_signal(number)
            errors = without_warnings(process.communicate(timeout=120)[1])
        assert process.returncode in (0, 130, -signal.SIGKILL, -signal.SIGTERM), errors
        assert errors == "" or is_one_line(errors), errors
    code, _, errors = run(tmp_path, *words, *resume, "-o", "out")
    assert (code, errors) == (0, "")
    assert contents(tmp_path / "out") == expected
