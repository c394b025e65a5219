"""Tables of a million rows: each reader stays within 5 s and 1 GB, `compare` within 10 s.

CPU time of a process of its own, because the wall time of a machine that others use contains
their work.
"""

import subprocess
import sys

import numpy as np
import pandas as pd
import pytest

from tests.validation.measured.test_comparison import write_run

ROWS = 1_000_000
RNG = np.random.default_rng(0)
CASE = (
    "from fem.case.case import Case\n"
    "case = Case.from_dict({'loading': {'mean_pressure_N_per_mm2': 0.3, "
    "'velocity_mm_per_s': 300.0, 'distance_mm': 1.0}})\n"
)


def random(low: float, high: float) -> np.ndarray:
    return RNG.uniform(low, high, ROWS)


#: Columns and the reader, by kind.
KINDS = {
    "friction": (
        lambda: {
            "p_N_per_mm2": random(0.1, 0.5), "v_mm_per_s": random(1, 300), "mu": random(0.5, 1)
        },
        "from calibration.friction.data import read_friction as read",
    ),
    "hyperelastic": (
        lambda: {
            "stretch": random(1.2, 2.0), "nominal_stress_N_per_mm2": random(0.3, 1.0),
            "mode": "uniaxial",
        },
        "from calibration.rubber.hyperelastic import select_data as read",
    ),
    "shift factors": (
        lambda: {"T_C": random(-20, 80), "log10_aT": random(-3, 3)},
        "from calibration.data.tables import read_table\n"
        "read = lambda path: read_table(path, ('T_C',)).numbers('log10_aT')",
    ),
    "sweeps": (
        lambda: {
            "T_C": np.repeat(np.arange(10) * 5, ROWS // 10),
            "frequency_Hz": np.tile(np.geomspace(0.1, 100, ROWS // 10), 10),
            "modulus_N_per_mm2": np.tile(np.geomspace(2, 9, ROWS // 10), 10),
        },
        "from calibration.wlf import shift_sweeps as read",
    ),
    "partition": (
        lambda: {
            "mean_pressure_N_per_mm2": np.repeat([0.1, 0.2, 0.3, 0.4], ROWS // 4),
            "v_mm_per_s": 300, "T_max_C": random(30, 50),
        },
        CASE + "from calibration.partition.data import read_partition_data\n"
        "read = lambda path: read_partition_data(path, case)",
    ),
    "conductance": (
        lambda: {
            "time_s": np.arange(ROWS) * 0.01, "heater_power_W": 10,
            "C1_C": 20 + np.arange(ROWS) * 1e-5, "E1_C": 20 + np.arange(ROWS) * 1e-6,
        },
        "from calibration.conductance.fit import read_heating_record\n"
        "from calibration.conductance.heating_rig import HeatingRig\n"
        "read = lambda path: read_heating_record(path, HeatingRig())",
    ),
    "measured tests": (
        lambda: {"T_max_C": random(25, 60), "p_N_per_mm2": random(0.29, 0.31), "T_0_C": 20},
        "from validation.measured.measurements import read_measurements as read",
    ),
}  # fmt: skip


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
    columns, program = KINDS[kind]
    path = tmp_path / "table.csv"
    pd.DataFrame(columns()).to_csv(path, index=False, float_format="%.5f")
    program += f"\nbegin = time.process_time()\nread({str(path)!r})"
    seconds, gigabytes = benchmark.pedantic(measured, (program,), rounds=1)
    print(f"{kind}: {seconds:.1f} s CPU, {gigabytes:.2f} GB")
    assert seconds < 5.0
    assert gigabytes < 1.0


COMPARED = {
    "profiles": ("run,v_mm_per_s,T_0_C,x_mm,T_C", lambda i: f"r{i // 1000},50,20,{i % 1000 / 50}"),
    "tests": ("run,v_mm_per_s,T_0_C,T_max_C", lambda i: f"r{i},50,20"),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", COMPARED)
def test_comparing_a_million_rows_takes_10_s(kind, benchmark, tmp_path):
    write_run(tmp_path / "results" / "runs" / "one")
    path, out = tmp_path / "measured.csv", tmp_path / "out"
    header, row = COMPARED[kind]
    T = np.random.default_rng(0).uniform(25.0, 60.0, ROWS).tolist()
    with path.open("w") as file:
        file.write(f"{header}\n")
        file.writelines(f"{row(i)},{t:.2f}\n" for i, t in enumerate(T))
    words = ["compare", str(path), str(tmp_path / "results"), "-o", str(out)]
    program = (
        "import treadfem\nfrom validation.measured import compare_command\n"
        f"begin = time.process_time()\nassert treadfem.main({words}) == 0"
    )
    seconds, gigabytes = benchmark.pedantic(measured, (program,), rounds=1)
    print(f"compare {kind}: {seconds:.1f} s CPU, {gigabytes:.2f} GB")
    assert seconds < 10.0
    assert gigabytes < 1.2
