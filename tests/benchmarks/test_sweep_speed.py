"""Parallel efficiency of a sweep on two cores, in one run.

Efficiency is the CPU time that the cases need one after the other in one process, over the time of
both workers from the first case's start to the last one's end. The wall time of a machine that
others use contains their work: then nothing is asserted. Two things can still be told, and are
printed: the share of the time in which the workers were inside a case, and how much more CPU time
the cases took side by side.
"""

from __future__ import annotations

import os
import time
from pathlib import Path

import pandas as pd
import psutil
import pytest

from fem.sweeps.sweep import sweep

pytest.importorskip("distributed", reason="dask.distributed is not installed (extra sweep)")

#: Cases of half a second, so that what a sweep adds to each would show; and 60 of them, so that the
#: last one, which one worker runs alone, is a small part.
CASE = """
[block]
mesh = {cells_x = 24, cells_y = 8, smallest_x_mm = 0.4, smallest_y_mm = 0.2}
[loading]
mean_pressure_N_per_mm2 = 0.25
velocity_mm_per_s = 300.0
distance_mm = 30.0
[output]
figures = false
"""
STUDY = """
base = "case.toml"
[grid]
"loading.mean_pressure_N_per_mm2" = [0.2, 0.21, 0.22, 0.23, 0.24, 0.25, 0.26, 0.27, 0.28, 0.29]
"loading.velocity_mm_per_s" = [50.0, 100.0, 300.0]
"friction.law" = ["huemer", "exponential"]
"""
WORKERS = 2
#: Share of the cores that others may use before the wall time says nothing about the sweep.
BUSY_SHARE = 0.08


@pytest.mark.slow
@pytest.mark.skipif((os.cpu_count() or 1) < WORKERS, reason="needs two cores")
def test_two_workers_keep_two_cores_busy(tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    study = tmp_path / "study.toml"
    study.write_text(STUDY)
    busy = float(psutil.cpu_percent(interval=2.0)) / 100.0

    cpu_before, begin = machine_cpu_s(), time.perf_counter()
    assert sweep(study, tmp_path / "two", workers=WORKERS).all_ok
    whole = time.perf_counter() - begin
    machine = machine_cpu_s() - cpu_before
    assert sweep(study, tmp_path / "one", workers=1).all_ok

    parallel, alone = times(tmp_path / "two"), times(tmp_path / "one")
    running = parallel["end"].max() - parallel["start"].min()
    cpu, cpu_alone = parallel["cpu_s"].sum(), alone["cpu_s"].sum()
    occupied = parallel["wall_s"].sum() / (WORKERS * running)
    others = (machine - cpu) / (WORKERS * whole)
    print(
        f"\n{len(parallel)} cases, {WORKERS} workers: {whole:.1f} s, {running:.1f} s of them from "
        f"the first case to the last\nCPU of the cases: {cpu:.1f} s in parallel, {cpu_alone:.1f} s "
        f"one after the other\nefficiency, CPU alone over wall: "
        f"{cpu_alone / (WORKERS * running):.1%} (whole command {cpu_alone / (WORKERS * whole):.1%})"
        f"\nworkers were inside a case {occupied:.1%} of the time; times the CPU ratio: "
        f"{occupied * cpu_alone / cpu:.1%}\nthe machine was busy to {busy:.0%} before; "
        f"{others:.0%} of it went to other things meanwhile (start-up included)"
    )
    if busy > BUSY_SHARE:
        pytest.skip(f"others use {busy:.0%} of this machine: the wall time is theirs too")
    assert cpu_alone / (WORKERS * running) > 0.85


def times(directory: Path) -> pd.DataFrame:
    """CPU and wall time of each case, and when it ended (its marker is written) [s]."""
    table = pd.read_csv(directory / "timings.csv")
    table["end"] = [
        (directory / "runs" / case / "summary.json").stat().st_mtime for case in table["case"]
    ]
    return table.assign(start=table["end"] - table["wall_s"])


def machine_cpu_s() -> float:
    """Time that the cores of this machine have spent on anything [s]."""
    times = psutil.cpu_times()
    return float(times.user + times.system)
