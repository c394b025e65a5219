"""Real processes on small machines: a tiny case, and the command line that runs it."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pandas as pd

ROOT = Path(__file__).parents[1]
ENVIRONMENT = {
    **os.environ,
    "PYTHONPATH": str(ROOT),
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
}
#: About half a second on a dozen elements.
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
checkpoint_s = 0.0
"""
#: Names that begin alike, and one case that takes longer.
STUDY = """
base = "case.toml"
[grid]
"loading.velocity_mm_per_s" = [2.5, 2.25, 50.0]
"""
FRICTION = "p_N_per_mm2,v_mm_per_s,mu\n" + "".join(
    f"{p},{v},{0.6 * p**-0.1 * v**0.05:.5f}\n" for p in (0.05, 0.1, 0.2, 0.4) for v in (3, 30, 300)
)
CALIBRATE = ("calibrate", "friction", "rig.csv", "--no-compare", "--starts", "2")
#: What depends on the machine's mood.
TIMES = ["wall_s", "solver_s"]
PATIENCE_S = 120.0


def write_inputs(folder: Path) -> None:
    """Write the case, the study and the data of a calibration."""
    for name, text in (("case.toml", CASE), ("study.toml", STUDY), ("rig.csv", FRICTION)):
        (folder / name).write_text(text)


def start(folder: Path, *words: str, **options: object) -> subprocess.Popen[str]:
    """Start the command line in a folder, as the leader of a group of its own."""
    settings = {
        "stdout": subprocess.PIPE,
        "stderr": subprocess.PIPE,
        "env": ENVIRONMENT,
        "start_new_session": True,
        **options,
    }
    command = [sys.executable, "-m", "treadfem", *words]
    return subprocess.Popen(command, cwd=folder, text=True, **settings)  # type: ignore[call-overload,no-any-return]


def run(folder: Path, *words: str, **options: object) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of a command."""
    with start(folder, *words, **options) as process:
        printed, errors = process.communicate(timeout=PATIENCE_S)
    return process.returncode, printed or "", without_warnings(errors or "")


def without_warnings(errors: str) -> str:
    """What is complained about, without what so few elements cannot but earn."""
    lines = errors.splitlines(keepends=True)
    return "".join(line for line in lines if not line.startswith("treadfem: warning: "))


def shell(folder: Path, text: str) -> tuple[int, str, str]:
    """The same of a shell command in which T is the command line."""
    program = f'T() {{ {sys.executable} -m treadfem "$@"; }}\n{text}'
    done = subprocess.run(
        ["bash", "-c", program],
        cwd=folder,
        env=ENVIRONMENT,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    return done.returncode, done.stdout, without_warnings(done.stderr)


def wait_for(condition: Callable[[], object], process: subprocess.Popen[str] | None = None) -> None:
    """Wait until something holds, or a process has ended."""
    end = time.monotonic() + PATIENCE_S
    while not condition() and (process is None or process.poll() is None):
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.005)


def is_one_line(errors: str) -> bool:
    """Whether this is a complaint of the program in a single line."""
    return errors.startswith("treadfem: ") and errors.count("\n") == 1 and "Traceback" not in errors


def contents(folder: Path) -> dict[str, object]:
    """Every file below a folder with its content; tables without times, logs without counts."""
    return {
        path.relative_to(folder).as_posix(): _content(path)
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name not in ("timings.csv", "run.log")
    }


def _content(path: Path) -> object:
    if path.name == "summary.json":
        return None  # the same as in summary.csv
    if path.name == "summary.csv":
        return pd.read_csv(path).drop(columns=TIMES, errors="ignore").to_csv()
    return path.read_bytes()
