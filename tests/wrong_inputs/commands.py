"""Rig files, studies, and commands beside `run` and `calibrate`."""

from __future__ import annotations

import os

from tests.wrong_inputs.cases import LOADING
from tests.wrong_inputs.events import GOOD as EVENT
from tests.wrong_inputs.events import PRESS, SLIDE, event
from tests.wrong_inputs.rows import SWEEP, WrongInput, rig, study

RIGS = [
    rig("ambient in kelvin", "[rig]\nambient_C = 293\n", "which looks like kelvin (19.85 deg C)"),
    rig(
        "density in t/mm^3",
        "[rig.rubber]\nconductivity_W_per_mK = 0.3\ndensity_kg_per_m3 = 1.2e-9\n"
        "specific_heat_kJ_per_kgK = 1.4\n",
        "density_kg_per_m3: found 1.2e-09, which looks like t/mm^3 (1200 kg/m^3)",
    ),
    rig(
        "specific heat in J",
        "[rig.rubber]\nconductivity_W_per_mK = 0.3\ndensity_kg_per_m3 = 1200\n"
        "specific_heat_kJ_per_kgK = 1450\n",
        "which looks like J/(kg K) (1.45 kJ/(kg K))",
    ),
    rig("deep nesting", "[rig]\nx = " + 5000 * "[", "tables nested too deeply"),
    rig("huge integer", "[rig]\nblock_height_mm = " + 5000 * "9", "found text that is not TOML"),
    rig("huge hexadecimal", "[rig]\nblock_height_mm = 0x" + 5000 * "9", "of 6021 digits"),
    rig("no text", b"\xff\xfe\x00", "not UTF-8 text"),
    rig("named pipe", os.mkfifo, "a device or a pipe"),
]

STUDIES = [
    study(
        "kelvin in the grid",
        'base = "case.toml"\n[grid]\n"heat.ambient_C" = [20.0, 293.0]\n',
        "heat.ambient_C: found 293.0, which looks like kelvin (19.85 deg C)",
    ),
    study(
        "negative friction in the grid",
        'base = "case.toml"\n[grid]\n"friction.beta" = [0.4, -0.9]\n',
        "friction.law: found huemer with the coefficient -",
    ),
    study(
        "a month in the grid",
        'base = "case.toml"\n[grid]\n"loading.distance_mm" = [1.0, 1e6]\n'
        '"solver.heat_step_mm" = [1e-5]\n',
        "solver.heat_step_mm",
        "days on one core",
    ),
    *(
        study(f"phase {what}", f'base = "event.toml"\n[grid]\n"loading.{key}" = [{value}]\n', *said)
        for what, key, value, *said in (
            ("that is not there", "phase.7.time_s", 1.0, "phase.7: found 7", "from 0 to 2"),
            ("by name", "phase.slide.time_s", 1.0, "found slide", "a number from 0 to 2"),
            ("in the plural", "phases.1.time_s", 1.0, "loading.phases: found an unknown", "phase"),
            ("with a key of another kind", "phase.0.velocity_mm_per_s", 1.0, "kind, mean_pressure"),
            ("of two lengths", "phase.1.time_s", 1.0, "found both of distance_mm and time_s"),
            ("that is a number", "phase.1", 3, "loading.phase.1: found 3", '"press", "slide"'),
            ("of no slide", "velocity_mm_per_s", 1.0, "none beside [[loading.phase]]"),
        )
    ),
    study("base that is no file", 'base = "nowhere.toml"\n', "nowhere.toml", "no such file"),
    WrongInput(
        kind="study: another base that is no file",
        words=(*SWEEP, "--base", "elsewhere.toml"),
        files={"study.toml": 'base = "case.toml"\n', "case.toml": LOADING},
        expected=("elsewhere.toml", "no such file"),
    ),
]

_PEAKS = "mean_pressure_N_per_mm2,v_mm_per_s,T_max_C\n0.2,300,35\n0.4,300,36\n"
_FASTER = SLIDE.replace("300.0", "600.0")
_RECORD = 'kind = "record"\nfile = "signals.csv"\n'
_SIGNALS = "time_s,velocity_mm_per_s,mean_pressure_N_per_mm2\n0,300,0.2\n1,300,0.2\n"
#: Events that no measured slide can stand for.
EVENTS_OF_SLIDES = [
    WrongInput(
        kind=f"partition: {what}",
        words=("calibrate", "partition", "t.csv", "--case", "event.toml", "-o", "out"),
        files={"event.toml": event(*phases), "t.csv": _PEAKS, "signals.csv": _SIGNALS},
        expected=("event.toml: loading.phase.", *said),
    )
    for what, phases, *said in (
        ("two speeds", (PRESS, SLIDE, _FASTER), "2.velocity", "600.0 after 300.0", "one speed"),
        (
            "two pressures",
            (PRESS, SLIDE, PRESS.replace("0.25", "0.3"), SLIDE),
            "2.mean_pressure",
            "0.3 after 0.25",
            "one pressure",
        ),
        ("a record", (_RECORD,), '0.kind: found "record"', "press and slide"),
    )
]

EXPORTS = [
    WrongInput(
        kind="export: kelvin",
        words=("export", "case.toml", "-o", "out.inp", "--set", "heat.ambient_C=293"),
        files={"case.toml": LOADING},
        expected=("heat.ambient_C", "looks like kelvin"),
    ),
    WrongInput(
        kind="export: rubber with a memory",
        words=("export", "case.toml", "-o", "out.inp"),
        files={"case.toml": "[rubber]\nmullins = {r = 2.0, m_N_per_mm2 = 0.1}\n" + LOADING},
        expected=("rubber.mullins", "rubber that remembers", "an elastic rubber"),
    ),
    WrongInput(
        kind="export: an event",
        words=("export", "event.toml", "-o", "out.inp"),
        files={"event.toml": EVENT},
        expected=("event.toml: loading.phase: found an event of 3 phases", "one slide"),
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
