"""A simulation in a process of its own: its CPU time by sliding distance, and its peak memory.

Called as ``python -m tests.benchmarks.measured_run``; reads the case as JSON from the standard
input and writes what it measured as JSON to the standard output.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
#: Unit of `ru_maxrss` [byte]: kilobytes, except on macOS.
RSS_UNIT = 1 if sys.platform == "darwin" else 1024


def introductory(distance_mm: float, **block: Any) -> dict[str, Any]:
    """The introductory example with another sliding distance and block."""
    loading = {
        "mean_pressure_N_per_mm2": 0.25,
        "velocity_mm_per_s": 300.0,
        "distance_mm": distance_mm,
    }
    return {"loading": loading, "block": block}


def measured_run(case: dict[str, Any], timeout_s: float | None = None) -> dict[str, Any]:
    """Summary of a case run by another process, with its CPU time and peak memory.

    Parameters
    ----------
    case : dict
        The case as in its file.
    timeout_s : float, optional
        Time after which the run is given up [s].

    Returns
    -------
    dict
        The summary and ``cpu_s`` [s], ``peak_memory_GB``, ``trace``: one row
        ``[sliding distance mm, CPU time s, Newton iterations]`` per accepted step.
    """
    one_thread = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, "-m", "tests.benchmarks.measured_run"],
        input=json.dumps(case), stdout=subprocess.PIPE, text=True, check=True, cwd=ROOT,
        env=os.environ | one_thread, timeout=timeout_s,
    )  # fmt: skip
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def main() -> None:
    """Run the case of the standard input."""
    from fem import Case, simulate
    from fem.stepping import Progress

    trace: list[list[float]] = []

    def keep(progress: Progress) -> None:
        row = [progress.sliding_distance_mm, time.process_time(), progress.newton_iterations]
        trace.append(row)

    case = Case.from_dict(json.load(sys.stdin))
    start = time.process_time()
    summary = simulate(case, progress=keep).summary
    measured = {
        "cpu_s": time.process_time() - start,
        "peak_memory_GB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * RSS_UNIT / 1e9,
        "trace": trace,
    }
    json.dump(summary | measured, sys.stdout)


if __name__ == "__main__":
    main()
