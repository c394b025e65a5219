"""Tables of a million rows: each reader stays within 5 s and 1 GB, `compare` within 10 s.

CPU time of a process of its own, because the wall time of a machine that others use contains
their work.
"""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.validation.measured.test_comparison import write_run

ROWS = 1_000_000
#: Header, rows of random numbers, and the reader, by kind.
KINDS = {
    "friction": (
        "p_N_per_mm2,v_mm_per_s,mu", ("{:.4f}", (0.1, 0.5), (1.0, 300.0), (0.5, 1.0)),
        "from calibration.friction import read_friction as read",
    ),
    "hyperelastic": (
        "stretch,nominal_stress_N_per_mm2,mode", ("{:.4f}", (1.2, 2.0), (0.3, 1.0)),
        "from calibration.hyperelastic import select_data as read",
    ),
    "shift factors": (
        "T_C,log10_aT", ("{:.4f}", (-20.0, 80.0), (-3.0, 3.0)),
        "from calibration.tables import read_table\n"
        "read = lambda path: read_table(path, ('T_C',)).numbers('log10_aT')",
    ),
    "measured tests": (
        "T_max_C,p_N_per_mm2,T_0_C", ("{:.3f}", (25.0, 60.0), (0.29, 0.31), (20.0, 20.0)),
        "from validation.measured.measurements import read_measurements as read",
    ),
}  # fmt: skip


def write_table(path: Path, header: str, form: str, *ranges: tuple[float, float]) -> None:
    rng = np.random.default_rng(0)
    columns = [map(form.format, rng.uniform(low, high, ROWS).tolist()) for low, high in ranges]
    if header.endswith("mode"):
        columns.append(map(str, ROWS * ["uniaxial"]))
    with path.open("w") as file:
        file.write(header + "\n")
        file.writelines(",".join(row) + "\n" for row in zip(*columns, strict=True))


def measured(program: str) -> tuple[float, float]:
    """CPU time [s] and peak memory [GB] of a program, its imports left out of the time."""
    end = (
        "import resource\n"
        "print(time.process_time() - begin, "
        "resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6)"
    )
    words = [sys.executable, "-c", f"import time\n{program}\n{end}"]
    printed = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    seconds, gigabytes = map(float, printed.split()[-2:])
    return seconds, gigabytes


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_reading_a_million_rows_takes_5_s_and_1_GB(kind, benchmark, tmp_path):
    header, (form, *ranges), program = KINDS[kind]
    path = tmp_path / "table.csv"
    write_table(path, header, form, *ranges)
    program += f"\nbegin = time.process_time()\nread({str(path)!r})"
    seconds, gigabytes = benchmark.pedantic(measured, (program,), rounds=1)
    print(f"{kind}: {seconds:.1f} s CPU, {gigabytes:.2f} GB")
    assert seconds < 5.0
    assert gigabytes < 1.0


@pytest.mark.slow
def test_comparing_profiles_of_a_million_points_takes_10_s(benchmark, tmp_path):
    write_run(tmp_path / "results" / "runs" / "one")
    path, out = tmp_path / "profiles.csv", tmp_path / "out"
    T = np.random.default_rng(0).uniform(25.0, 60.0, ROWS).tolist()
    with path.open("w") as file:
        file.write("run,v_mm_per_s,T_0_C,x_mm,T_C\n")
        file.writelines(
            f"r{i // 1000},50,20,{0.02 * (i % 1000):.2f},{t:.2f}\n" for i, t in enumerate(T)
        )
    words = ["compare", str(path), str(tmp_path / "results"), "-o", str(out)]
    program = (
        "import treadfem\nfrom validation.measured import compare_command\n"
        f"begin = time.process_time()\nassert treadfem.main({words}) == 0"
    )
    seconds, gigabytes = benchmark.pedantic(measured, (program,), rounds=1)
    print(f"compare: {seconds:.1f} s CPU, {gigabytes:.2f} GB")
    assert seconds < 10.0
    assert gigabytes < 1.2
