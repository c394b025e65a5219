"""Everything a command refuses: a row per kind, with the command, its files and the line expected.

Case files are in `tests.wrong_cases`; here they become rows as well, next to tables of
measurements, rig and study files. `tests/test_wrong_inputs.py` runs each row once.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tests.wrong_cases import LOADING, SET_SYNTAX, WRONG_CASES, WrongCase

Content = str | bytes | Callable[[Path], object]


@dataclass(frozen=True, kw_only=True)
class WrongInput:
    """A kind of wrong input.

    Attributes
    ----------
    kind : str
        What is wrong.
    words : tuple of str
        The command; ``{results}`` stands for a folder of two finished runs.
    files : mapping
        Content by name, or what makes the file.
    expected : tuple of str
        Parts of the one line on standard error.
    """

    kind: str
    words: tuple[str, ...]
    files: Mapping[str, Content] = field(default_factory=dict)
    expected: tuple[str, ...]

    def write(self, folder: Path) -> None:
        """Write the files into `folder`."""
        for name, content in self.files.items():
            path = folder / name
            if callable(content):
                content(path)
            elif isinstance(content, bytes):
                path.write_bytes(content)
            else:
                path.write_text(content)


def _of_case(wrong: WrongCase) -> WrongInput:
    file = "--set" if wrong in SET_SYNTAX else wrong.blames
    overrides = [word for text in wrong.overrides for word in ("--set", text)]
    return WrongInput(
        kind=f"case: {wrong.name}",
        words=("run", "case.toml", "-o", "out", *overrides),
        files={"case.toml": wrong.content, **wrong.beside},
        expected=(file, wrong.key, wrong.found, wrong.expected),
    )


STRETCHES = "stretch,nominal_stress_N_per_mm2,mode\n"
SLIDES = "p_N_per_mm2,v_mm_per_s,mu\n"
GOOD_SLIDES = "".join(f"{p},{v},0.9\n" for p in (0.1, 0.3, 0.5) for v in (1, 30, 300))
#: Commands that read a table, without its name.
HYPERELASTIC = ("calibrate", "hyperelastic", "t.csv", "--model", "neo-hooke", "-o", "out")
FRICTION = ("calibrate", "friction", "t.csv", "-o", "out")
WLF = ("calibrate", "wlf", "t.csv", "-o", "out")
PARTITION = ("calibrate", "partition", "t.csv", "--case", "case.toml", "-o", "out")
CONDUCTANCE = ("calibrate", "conductance", "t.csv", "-o", "out")
RIG = (*CONDUCTANCE, "--rig", "rig.toml")
COMPARE = ("compare", "t.csv", "{results}", "-o", "out")
FIGURE = ("figure", "11", "--measured", "t.csv", "-o", "out")
SWEEP = ("sweep", "study.toml", "-o", "out", "--workers", "1")
HEATING = "time_s,heater_power_W,C1_C,E1_C\n0,10,20,20\n10,10,21,20\n20,10,22,20\n"


def _table(kind: str, words: tuple[str, ...], content: Content, *expected: str) -> WrongInput:
    files = {"t.csv": content, "case.toml": LOADING}
    return WrongInput(kind=kind, words=words, files=files, expected=("t.csv", *expected))


def _rig(kind: str, content: Content, *expected: str) -> WrongInput:
    files = {"t.csv": HEATING, "rig.toml": content}
    return WrongInput(kind=f"rig: {kind}", words=RIG, files=files, expected=("rig.toml", *expected))


def _study(kind: str, content: str, *expected: str) -> WrongInput:
    files = {"study.toml": content, "case.toml": LOADING}
    return WrongInput(kind=f"study: {kind}", words=SWEEP, files=files, expected=expected)


def _rows(header: str, *rows: str) -> str:
    return "\n".join([header.strip(), *rows, ""])


#: Shift factors of the universal WLF curve.
_SHIFTS = [(T, -8.86 * (T - 20) / (101.6 + T - 20)) for T in (-20, 0, 20, 40, 60)]


def _pulled(stretch: float) -> float:
    """Nominal stress of a neo-Hookean rubber of 2 N/mm^2."""
    return 2.0 * (stretch - stretch**-2)


_SWEEP_COLUMNS = "T_C,frequency_Hz,modulus_N_per_mm2"
_PROFILE = "run,x_mm,T_C,v_mm_per_s,T_0_C"

UNITS = [
    _table(
        "shift factors in kelvin",
        WLF,
        _rows("T_C,log10_aT", *(f"{T + 273.15:.2f},{a:.4f}" for T, a in _SHIFTS)),
        "row 2, column T_C: found 253.15, which looks like kelvin (-20 deg C)",
        "from -200 to 250 deg C",
    ),
    _table(
        "friction at temperatures in kelvin",
        (*FRICTION, "--wlf", "given"),
        _rows("p_N_per_mm2,v_mm_per_s,mu,T_C", *(f"0.{i},30,0.9,293.15" for i in range(1, 6))),
        "row 2, column T_C: found 293.15, which looks like kelvin (20 deg C)",
    ),
    _table(
        "temperatures in Fahrenheit",
        (*FRICTION, "--wlf", "fit"),
        _rows(
            "p_N_per_mm2,v_mm_per_s,mu,T_C", *(f"0.3,30,0.9,{T}" for T in (68, 140, 212, 280, 284))
        ),
        "row 5, column T_C: found 280, which looks like Fahrenheit (137.8 deg C)",
    ),
    _table(
        "pressures in kPa",
        FRICTION,
        _rows(SLIDES, *(f"{p},{v},0.9" for p in (100, 300) for v in (1, 30, 300))),
        "row 2, column p_N_per_mm2: found 100, which looks like kPa (0.1 N/mm^2)",
    ),
    _table(
        "pressures in Pa",
        FRICTION,
        _rows(SLIDES, *(f"{p}e5,{v},0.9" for p in (1, 3) for v in (1, 30, 300))),
        "found 1e5, which looks like Pa (0.1 N/mm^2)",
    ),
    _table(
        "pressures in psi",
        FRICTION,
        _rows(SLIDES, *(f"{p},{v},0.9" for p in (29, 58) for v in (1, 30, 300))),
        "found 29, which looks like kPa (0.029 N/mm^2)",
    ),
    _table(
        "friction in per cent",
        FRICTION,
        SLIDES + GOOD_SLIDES + "0.3,50,92\n",
        "row 11, column mu: found 92, which looks like per cent (0.92)",
    ),
    _table(
        "speed in micrometres per second",
        FRICTION,
        SLIDES + GOOD_SLIDES + "0.3,3e5,0.9\n",
        "row 11, column v_mm_per_s: found 3e5, expected a sliding speed from 1e-06 to 100000",
    ),
    _table(
        "modulus in Pa",
        WLF,
        _rows(_SWEEP_COLUMNS, *(f"{T},{f},{2e6 * f}" for T in (0, 20) for f in (1, 10, 100))),
        "column modulus_N_per_mm2: found 2000000.0, which looks like Pa (2 N/mm^2)",
    ),
    _table(
        "stress in kPa",
        HYPERELASTIC,
        _rows(STRETCHES, *(f"{s},{150 * _pulled(s):.4g},uniaxial" for s in (1.1, 1.5, 2.0, 3.0))),
        "column nominal_stress_N_per_mm2",
        "looks like kPa (0.3 N/mm^2)",
        "a shear modulus of rubber from 0.001 to 200 N/mm^2",
    ),
    _table(
        "stress in Pa",
        HYPERELASTIC,
        _rows(STRETCHES, *(f"{s},{150e3 * _pulled(s):.4g},uniaxial" for s in (1.1, 1.5, 2.0, 3.0))),
        "looks like Pa",
    ),
    _table(
        "strain in per cent below 20",
        HYPERELASTIC,
        _rows(STRETCHES, *(f"{e},{_pulled(1 + e / 100):.4g},uniaxial" for e in (2, 4, 6, 9, 11))),
        "row 2, column stretch: found 2",
        "strain in per cent",
    ),
    _table(
        "strain in per cent",
        HYPERELASTIC,
        _rows(STRETCHES, *(f"{e},{0.02 * e:.4g},uniaxial" for e in (10, 50, 100))),
        "row 3, column stretch: found 50, which looks like strain in per cent (1.5)",
    ),
    _table(
        "strain as a fraction",
        HYPERELASTIC,
        _rows(STRETCHES, *(f"{e},{2 * e:.4g},uniaxial" for e in (0.1, 0.2, 0.5))),
        "row 2, column stretch",
        "these look like strains",
    ),
    _table(
        "amounts of compression",
        HYPERELASTIC,
        _rows(STRETCHES, *(f"{e},{-2 * e:.4g},uniaxial" for e in (0.1, 0.2, 0.3, 0.4))),
        "row 2, column stretch",
        "looks like 1 - stretch",
    ),
    _table(
        "compression with positive stress",
        HYPERELASTIC,
        _rows(STRETCHES, *(f"{s},{1 - s:.4g},uniaxial" for s in (0.9, 0.8, 0.7))),
        "row 2, column stretch: found 0.9 with the tensile stress 0.1",
    ),
    _table(
        "tension with negative stress",
        HYPERELASTIC,
        _rows(STRETCHES, *(f"{s},{1 - s:.4g},uniaxial" for s in (1.1, 1.2, 1.5))),
        "column nominal_stress_N_per_mm2: found -0.1",
        "a positive stress",
    ),
    _table(
        "peaks in kelvin",
        PARTITION,
        _rows("mean_pressure_N_per_mm2,v_mm_per_s,T_max_C", "0.2,300,308", "0.4,300,309"),
        "row 2, column T_max_C: found 308, which looks like kelvin (34.85 deg C)",
    ),
    _table(
        "thermocouples in kelvin",
        CONDUCTANCE,
        HEATING.replace(",20", ",293.15"),
        "row 2, column C1_C: found 293.15, which looks like kelvin (20 deg C)",
    ),
    _table(
        "measured in kelvin",
        COMPARE,
        _rows("T_max_C,v_mm_per_s,T_0_C", "309,50,20"),
        "row 2, column T_max_C: found 309, which looks like kelvin (35.85 deg C)",
    ),
    _table(
        "start temperature in kelvin",
        COMPARE,
        _rows("T_max_C,v_mm_per_s,T_0_C", "35,50,293"),
        "row 2, column T_0_C: found 293, which looks like kelvin (19.85 deg C)",
    ),
    _table(
        "measured pressure in kPa",
        COMPARE,
        _rows("T_max_C,p_N_per_mm2,T_0_C", "35,300,20"),
        "row 2, column p_N_per_mm2: found 300, which looks like kPa (0.3 N/mm^2)",
    ),
    _table(
        "measured friction in per cent",
        COMPARE,
        _rows("friction_coefficient,T_0_C", "95,20"),
        "column friction_coefficient: found 95, which looks like per cent (0.95)",
    ),
    _table(
        "profile in metres",
        COMPARE,
        _rows(_PROFILE, *(f"a,{x / 1e3},{30 + x},50,20" for x in (0.1, 5, 10, 20))),
        "column x_mm: found 0.02 in a profile from 0.0001 to 0.02 (looks like metres)",
        "0 to 20 mm",
    ),
    _table(
        "profile beyond the block",
        COMPARE,
        _rows(_PROFILE, *(f"a,{x},30,50,20" for x in (0, 10, 20, 30))),
        "row 5, column x_mm: found 30 in a profile from 0 to 30",
    ),
    _table(
        "a test that started warmer than any simulation",
        COMPARE,
        _rows("T_max_C,v_mm_per_s,T_0_C", "55.5,50,40"),
        "found no test that was simulated",
        "T_0_C 20 (within 5 K)",
    ),
    _table(
        "profiles in kelvin to draw",
        FIGURE,
        _rows(_PROFILE, "a,0,293,50,20", "a,10,310,50,20"),
        "row 2, column T_C: found 293, which looks like kelvin",
    ),
]

READING = [
    _table("Excel workbook", FRICTION, b"PK\x03\x04rest", "found an Excel workbook or zip archive"),
    _table("old Excel workbook", WLF, b"\xd0\xcf\x11\xe0rest", "found an old Excel workbook"),
    _table("gzip archive", COMPARE, b"\x1f\x8brest", "found a gzip archive", "a CSV file"),
    _table("PDF", HYPERELASTIC, b"%PDF-1.4", "found a PDF"),
    _table("bytes that are no text", COMPARE, bytes(range(256)), "found bytes that are no text"),
    _table("named pipe", COMPARE, os.mkfifo, "found a device or a pipe"),
    _table("directory", FRICTION, Path.mkdir, "found Is a directory"),
    _table("no such file", COMPARE, lambda path: None, "found No such file"),
    _table("empty file", COMPARE, "", "found no header line"),
    _table("spaces only", WLF, " \n\t\n", "found no header line"),
    _table("header only", COMPARE, "T_max_C\n", "found no rows of data"),
    _table(
        "long cell",
        COMPARE,
        'T_max_C,run\n30,"' + 140_000 * "a" + '"\n',
        "row 2: found a cell of more than 131072 characters",
    ),
    _table(
        "open quote",
        FRICTION,
        SLIDES + '0.3,30,"0.9\n0.4,30,0.9\n',
        "row 2: found a quote that is never closed",
    ),
    _table("stray quote", FRICTION, SLIDES + '0.3,30,"0"9\n', "row 2", "quotes in pairs"),
    _table("short row", WLF, "T_C,aT\n20\n", "row 2: found 1 comma-separated entries, expected 2"),
    _table(
        "decimal commas between commas",
        FRICTION,
        SLIDES + "0,3,30,0,9\n",
        "row 2: found 5 comma-separated entries",
        "decimal commas need ;",
    ),
    _table(
        "decimal commas and points",
        FRICTION,
        SLIDES.replace(",", ";") + "0,3;30;0.9\n",
        "row 2, column p_N_per_mm2: found '0,3', expected decimal points or decimal commas",
    ),
    _table(
        "thousands or decimals",
        WLF,
        "T_C;aT\n20;1\n30;1,250\n",
        "row 3, column aT: found '1,250'",
        "comma of thousands",
    ),
    _table("name twice", COMPARE, "T_max_C,T_max_C\n30,30\n", "row 1", "the name twice"),
    _table(
        "unit in the header that is another",
        FRICTION,
        "p_N_per_mm2,v [m/s],mu\n0.3,0.3,0.9\n",
        "row 1, column v_mm_per_s: found the columns p_N_per_mm2, v [m/s], mu",
    ),
    _table("text", COMPARE, "T_max_C\nwarm\n", "row 2, column T_max_C: found 'warm'"),
    _table("overflow", COMPARE, "T_max_C\n1e400\n", "row 2, column T_max_C: found '1e400'"),
    _table(
        "huge text in the wrong place",
        COMPARE,
        "T_max_C\n" + 100_000 * "9" + "\n",
        "row 2, column T_max_C: found '9999",
        "...",
    ),
]

RIGS = [
    _rig("ambient in kelvin", "[rig]\nambient_C = 293\n", "which looks like kelvin (19.85 deg C)"),
    _rig(
        "density in t/mm^3",
        "[rig.rubber]\nconductivity_W_per_mK = 0.3\ndensity_kg_per_m3 = 1.2e-9\n"
        "specific_heat_kJ_per_kgK = 1.4\n",
        "density_kg_per_m3: found 1.2e-09, which looks like t/mm^3 (1200 kg/m^3)",
    ),
    _rig(
        "specific heat in J",
        "[rig.rubber]\nconductivity_W_per_mK = 0.3\ndensity_kg_per_m3 = 1200\n"
        "specific_heat_kJ_per_kgK = 1450\n",
        "which looks like J/(kg K) (1.45 kJ/(kg K))",
    ),
    _rig("deep nesting", "[rig]\nx = " + 5000 * "[", "tables nested too deeply"),
    _rig("huge integer", "[rig]\nblock_height_mm = " + 5000 * "9", "found text that is not TOML"),
    _rig("huge hexadecimal", "[rig]\nblock_height_mm = 0x" + 5000 * "9", "of 6021 digits"),
    _rig("no text", b"\xff\xfe\x00", "not UTF-8 text"),
    _rig("named pipe", os.mkfifo, "a device or a pipe"),
]

STUDIES = [
    _study(
        "kelvin in the grid",
        'base = "case.toml"\n[grid]\n"heat.ambient_C" = [20.0, 293.0]\n',
        "heat.ambient_C: found 293.0, which looks like kelvin (19.85 deg C)",
    ),
    _study(
        "negative friction in the grid",
        'base = "case.toml"\n[grid]\n"friction.beta" = [0.4, -0.9]\n',
        "friction.law: found huemer with the coefficient -",
    ),
    _study(
        "a month in the grid",
        'base = "case.toml"\n[grid]\n"loading.distance_mm" = [1.0, 1e6]\n'
        '"solver.heat_step_mm" = [1e-5]\n',
        "solver.heat_step_mm",
        "days on one core",
    ),
    _study("base that is no file", 'base = "nowhere.toml"\n', "nowhere.toml", "no such file"),
]

EXPORTS = [
    WrongInput(
        kind="export: kelvin",
        words=("export", "case.toml", "-o", "out.inp", "--set", "heat.ambient_C=293"),
        files={"case.toml": LOADING},
        expected=("heat.ambient_C", "looks like kelvin"),
    ),
    WrongInput(
        kind="check: device",
        words=("check", "/dev/zero"),
        expected=("/dev/zero", "a device or a pipe"),
    ),
    WrongInput(
        kind="check: hours of heat steps",
        words=("check", "case.toml", "--set", "solver.heat_step_mm=1e-7"),
        files={"case.toml": LOADING.replace("120.0", "1000.0")},
        expected=("solver.heat_step_mm", "days on one core", "within 30 days"),
    ),
]

WRONG_INPUTS = [
    *map(_of_case, [*WRONG_CASES, *SET_SYNTAX]),
    *(UNITS + READING + RIGS + STUDIES + EXPORTS),
]

_SHIFT_ROWS = [f"{T},{a:.4f}" for T, a in _SHIFTS]
#: What is possible, but unusual: used, and said.
UNUSUAL_INPUTS = [
    _table(
        "profile half a kelvin from the start temperature",
        COMPARE,
        _rows("T_max_C,v_mm_per_s,T_0_C", "35,50,23"),
        "simulations start up to 3 K from the T_0_C of the tests",
    ),
    _table(
        "measured pressure in bar",
        COMPARE,
        _rows("T_max_C,v_mm_per_s,T_0_C,mean_pressure_N_per_mm2", "35,50,20,0.25", "35,50,20,2.5"),
        "warning: t.csv: row 3, column mean_pressure_N_per_mm2: 2.5 is unusual; it looks like bar",
    ),
    _table(
        "start temperature that is not stated",
        COMPARE,
        _rows("T_max_C,v_mm_per_s", "35,50"),
        "t.csv: T_0_C not stated in 1 rows: 20 deg C assumed",
    ),
    _table(
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
        kind="case: pressure in bar",
        words=("check", "case.toml", "--set", "loading.mean_pressure_N_per_mm2=2.5"),
        files={"case.toml": LOADING},
        expected=("loading.mean_pressure_N_per_mm2: 2.5 is unusual", "bar (0.25 N/mm^2)"),
    ),
]
