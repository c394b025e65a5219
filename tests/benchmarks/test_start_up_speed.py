"""How long a command takes to begin, as a ratio to an interpreter that does nothing.

CPU time of processes of their own: the wall time of a machine that others use contains their work.
"""

import os
import subprocess
import sys

import pytest

from tests.benchmarks.measured_run import ROOT


def cpu_s(*words: str) -> float:
    """CPU time of an interpreter with these words [s]."""
    before = os.times()
    subprocess.run([sys.executable, *words], check=True, cwd=ROOT, stdout=subprocess.DEVNULL)
    after = os.times()
    return after.children_user + after.children_system - before[2] - before[3]


@pytest.mark.parametrize(
    ("words", "largest_ratio"),
    [(["--help"], 10.0), (["check", "examples/introductory.toml"], 25.0)],
    ids=["help", "check"],
)
def test_commands_begin_at_once(words, largest_ratio, benchmark):
    def ratio() -> float:
        return cpu_s("treadfem.py", *words) / cpu_s("-c", "pass")

    ratios = []
    benchmark.pedantic(lambda: ratios.append(ratio()), rounds=7, warmup_rounds=1)
    benchmark.extra_info["ratio"] = sorted(ratios)[len(ratios) // 2]
    assert benchmark.extra_info["ratio"] < largest_ratio
