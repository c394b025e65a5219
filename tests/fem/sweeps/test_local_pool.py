"""Worker processes: from wherever they are started, whatever becomes of them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import types
from pathlib import Path

import pytest

from fem.sweeps.local_pool import MOST_TRIES, WorkersError, local_pool
from tests.machines import ENVIRONMENT, ROOT, write_inputs

SCRIPT = """
from fem.sweeps.sweep import sweep
state = sweep("study.toml", "out", workers=2)
print(state.status)
"""
THREAD = """
import threading
import treadfem
words = ["sweep", "study.toml", "-o", "out", "--workers", "2"]
thread = threading.Thread(target=lambda: print(treadfem.main(words)))
thread.start()
thread.join()
"""


def doubled(number: int) -> int:
    return 2 * number


def deadly(task: tuple[str, int]) -> int:
    """Kill the process for odd numbers; count the tries in a file."""
    path, number = task
    with open(path, "a") as file:
        file.write(f"{number}\n")
    if number % 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def test_results_come_with_their_tasks():
    with local_pool(doubled, 2) as pool:
        news = [n for n in pool.run([1, 2, 3]) if n is not None]
    assert sorted(news) == [(1, 2), (2, 4), (3, 6)]


def test_function_that_no_worker_finds_is_not_waited_for(monkeypatch):
    here_only = types.ModuleType("here_only")
    monkeypatch.setitem(sys.modules, "here_only", here_only)
    monkeypatch.setattr(doubled, "__module__", "here_only")
    here_only.doubled = doubled
    with local_pool(doubled, 1) as pool:
        assert [n for n in pool.run([1]) if n is not None] == [(1, None)]


def test_worker_that_is_killed_costs_its_task_only(tmp_path):
    tasks = [(str(tmp_path / "tries"), number) for number in range(4)]
    with local_pool(deadly, 2) as pool:
        found = {task[1]: result for task, result in filter(None, pool.run(tasks))}
    assert found == {0: 0, 1: None, 2: 2, 3: None}
    tries = (tmp_path / "tries").read_text().split()
    assert sorted(tries) == sorted(["0", "2", *["1", "3"] * MOST_TRIES])


def test_machine_that_starts_no_process_is_said(monkeypatch):
    monkeypatch.setattr(sys, "executable", "/nowhere/python")
    with local_pool(doubled, 2) as pool, pytest.raises(WorkersError, match="no worker process"):
        list(pool.run([1]))


@pytest.fixture
def folder(tmp_path):
    write_inputs(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    "way",
    [
        "standard input",
        *(pytest.param(way, marks=pytest.mark.slow) for way in ("script", "thread", "console")),
    ],
)
def test_sweep_runs_from_a_script_without_a_main_guard_from_standard_input_and_a_thread(
    way, folder
):
    (folder / "script.py").write_text(THREAD if way == "thread" else SCRIPT)
    words = {"standard input": ["-"], "console": ["-i"]}.get(way, ["script.py"])
    done = subprocess.run(
        [sys.executable, *words],
        cwd=folder, env=ENVIRONMENT, input=SCRIPT, capture_output=True, text=True, timeout=120,
        check=False,
    )  # fmt: skip
    assert "Traceback" not in done.stderr
    assert ("3 cases: 3 ok" if way == "thread" else "{'ok': 3}") in done.stdout
    assert (folder / "out" / "summary.csv").read_text().count(",ok,") == 3


def test_worker_listens_to_no_port(folder):
    psutil = pytest.importorskip("psutil")
    command = [sys.executable, "-m", "treadfem", "sweep", "study.toml", "-o", "out"]
    with subprocess.Popen(
        [*command, "--workers", "2"], cwd=folder, env=ENVIRONMENT, stdout=subprocess.DEVNULL
    ) as sweep:
        seen = 0
        while sweep.poll() is None:
            try:
                family = [psutil.Process(sweep.pid), *psutil.Process(sweep.pid).children()]
                seen = max(seen, len(family))
                ports = [c for process in family for c in process.net_connections("inet")]
            except psutil.NoSuchProcess:
                continue
            assert ports == []
    assert sweep.returncode == 0
    assert seen == 3


def test_sources_stay_free_of_dask_where_no_scheduler_is_asked_for():
    words = "import sys, fem.sweeps.sweep; print('distributed' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", words], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "False"


def test_path_of_the_program_reaches_the_workers(tmp_path, monkeypatch):
    """A notebook may have put its modules on the path by hand."""
    (tmp_path / "own_module.py").write_text("def tripled(n):\n    return 3 * n\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    import own_module  # type: ignore[import-not-found]

    with local_pool(own_module.tripled, 1) as pool:
        assert [n for n in pool.run([2]) if n is not None] == [(2, 6)]
    assert Path(own_module.__file__).parent == tmp_path
