"""What is possible, but unusual: used, and said."""

from __future__ import annotations

from tests.wrong_inputs.cases import LOADING
from tests.wrong_inputs.rows import COMPARE, SHIFTS, WLF, WrongInput, rows, table

_SHIFT_ROWS = [f"{T},{a:.4f}" for T, a in SHIFTS]
#: What is possible, but unusual: used, and said.
UNUSUAL_INPUTS = [
    table(
        "profile half a kelvin from the start temperature",
        COMPARE,
        rows("T_max_C,v_mm_per_s,T_0_C", "35,50,23"),
        "simulations start up to 3 K from the T_0_C of the tests",
    ),
    table(
        "measured pressure in bar",
        COMPARE,
        rows("T_max_C,v_mm_per_s,T_0_C,mean_pressure_N_per_mm2", "35,50,20,0.25", "35,50,20,2.5"),
        "warning: t.csv: row 3, column mean_pressure_N_per_mm2: 2.5 is unusual; it looks like bar",
    ),
    table(
        "start temperature that is not stated",
        COMPARE,
        rows("T_max_C,v_mm_per_s", "35,50"),
        "t.csv: T_0_C not stated in 1 rows: 20 deg C assumed",
    ),
    table(
        "shift factors with semicolons and decimal commas",
        WLF,
        "T_C;log10_aT\n" + "\n".join(_SHIFT_ROWS).replace(",", ";").replace(".", ",") + "\n",
        "t.csv: read with decimal commas",
    ),
    WrongInput(
        kind="case: ambient in Fahrenheit",
        words=("check", "case.toml", "--set", "heat.ambient_C=68"),
        files={"case.toml": LOADING},
        expected=("warning: case.toml: heat.ambient_C: 68 is unusual", "Fahrenheit (20 deg C)"),
    ),
    WrongInput(
        kind="case: velocity in m/s",
        words=("check", "case.toml", "--set", "loading.velocity_mm_per_s=0.3"),
        files={"case.toml": LOADING},
        expected=("loading.velocity_mm_per_s: 0.3 is unusual", "m/s (300 mm/s)"),
    ),
    WrongInput(
        kind="case: distance in metres",
        words=("check", "case.toml", "--set", "loading.distance_mm=0.12"),
        files={"case.toml": LOADING},
        expected=("loading.distance_mm: 0.12 is unusual", "metres (120 mm)"),
    ),
    WrongInput(
        kind="case: pyrometer in metres",
        words=("check", "case.toml", "--set", "pyrometer.spot_mm=0.005"),
        files={"case.toml": LOADING + "[pyrometer]\ngap_mm = 10.0\n"},
        expected=("pyrometer.spot_mm: 0.005 is unusual", "metres (5 mm)"),
    ),
    WrongInput(
        kind="case: pressure in bar",
        words=("check", "case.toml", "--set", "loading.mean_pressure_N_per_mm2=2.5"),
        files={"case.toml": LOADING},
        expected=("loading.mean_pressure_N_per_mm2: 2.5 is unusual", "bar (0.25 N/mm^2)"),
    ),
]
