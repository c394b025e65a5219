"""Every script in examples/ runs as it stands, and leaves the picture it promises."""

from __future__ import annotations

import os
import re
import runpy
import subprocess
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples"
LISTED = (EXAMPLES / "README.md").read_text(encoding="utf-8")
#: Scripts and the pictures they leave.
SCRIPTS = dict(
    re.findall(r"^\| `(\w+\.py)` \|.*\| `([\w/]+\.png)` \|$", LISTED, flags=re.MULTILINE)
)

#: Scripts that change the program they run in: a friction law is registered for good.
FOR_GOOD = ("own_friction_law.py",)
ALONE = {**os.environ, "PYTHONPATH": str(ROOT), "MPLBACKEND": "Agg"}


@pytest.fixture(scope="module")
def desk(tmp_path_factory) -> Path:
    return tmp_path_factory.mktemp("desk")


@pytest.fixture
def one_process(monkeypatch):
    """Sweeps in this process: starting others takes longer than their short cases."""
    monkeypatch.setattr("fem.sweeps.workers.cores", lambda: 1)


@pytest.mark.parametrize("script", SCRIPTS)
def test_script_runs_and_leaves_its_picture(script, desk, one_process, monkeypatch, capsys):
    monkeypatch.chdir(desk)
    monkeypatch.setattr(plt, "show", lambda: pytest.fail("a script must not wait for a window"))
    if script == "read_results.py" and not Path("results/first_slide").is_dir():
        runpy.run_path(str(EXAMPLES / "first_slide.py"), run_name="__main__")
    if script in FOR_GOOD:
        run = [sys.executable, str(EXAMPLES / script)]
        said = subprocess.run(run, env=ALONE, check=True, capture_output=True, text=True).stdout
    else:
        runpy.run_path(str(EXAMPLES / script), run_name="__main__")
        said = capsys.readouterr().out
    assert said
    assert plt.get_fignums() == []
    assert plt.imread(desk / SCRIPTS[script]).std() > 0.02


def test_every_file_is_in_the_table():
    files = {path.name for path in EXAMPLES.iterdir() if path.suffix in (".py", ".toml", ".csv")}
    assert files == set(re.findall(r"^\| `([\w.]+)` \|", LISTED, flags=re.MULTILINE))


def test_made_up_data_say_so_in_name_and_first_line():
    for path in EXAMPLES.glob("*.csv"):
        assert path.stem.startswith("synthetic")
        assert path.read_text(encoding="utf-8").startswith("# SYNTHETIC")


@pytest.mark.parametrize("script", SCRIPTS)
def test_script_is_short(script):
    assert len((EXAMPLES / script).read_text(encoding="utf-8").splitlines()) <= 60
