"""Rubber that remembers, with one fault each."""

from __future__ import annotations

from tests.wrong_inputs.cases import WrongCase, wrong

_SPECTRUM = "g = [0.5, 0.2], tau_s = [1e-3, 1e-2]"


def viscoelastic(name: str, table: str, key: str, found: str, expected: str) -> WrongCase:
    text = f"[rubber]\nviscoelastic = {{{table}}}"
    return wrong(f"viscoelastic: {name}", text, f"rubber.viscoelastic{key}", found, expected)


def mullins(name: str, table: str, key: str, found: str, expected: str) -> WrongCase:
    text = f"[rubber]\nmullins = {{{table}}}"
    return wrong(f"mullins: {name}", text, f"rubber.mullins{key}", found, expected)


MEMORY = [
    viscoelastic("no branches", "", ".g", "nothing", "no default"),
    viscoelastic("no times", "g = [0.5]", ".tau_s", "nothing", "no default"),
    viscoelastic("unequal", "g = [0.5], tau_s = [1.0, 2.0]", ".g", "1 and tau_s 2", "as many"),
    viscoelastic("empty", "g = [], tau_s = []", ".g", "0 values", "at least 1"),
    viscoelastic("negative modulus", "g = [-0.5], tau_s = [1.0]", ".g.0", "-0.5", "at least"),
    viscoelastic("zero time", "g = [0.5], tau_s = [0.0]", ".tau_s.0", "0.0", "at least"),
    viscoelastic("endless time", "g = [0.5], tau_s = [1e20]", ".tau_s.0", "1e+20", "at most"),
    viscoelastic("text", 'g = ["a"], tau_s = [1.0]', ".g.0", 'text "a"', "a number"),
    viscoelastic("nan", "g = [nan], tau_s = [1.0]", ".g.0", "nan", "finite"),
    viscoelastic("one number", "g = 0.5, tau_s = [1.0]", ".g", "0.5", "an array of numbers"),
    viscoelastic("other moduli", f'{_SPECTRUM}, moduli = "short"', ".moduli", "short", "long-term"),
    viscoelastic("nothing left", 'g = [0.6, 0.5], tau_s = [1.0, 2.0], moduli = "instantaneous"',
                 ".g", "1.1", "less than 1"),
    viscoelastic("heats a number", f"{_SPECTRUM}, heats = 1", ".heats", "1", "true or false"),
    viscoelastic("half a shift", f"{_SPECTRUM}, C1 = 7.0", ".C2_K", "nothing", "C1 is given"),
    viscoelastic("the other half", f"{_SPECTRUM}, C2_K = 90.0", ".C1", "nothing", "C2_K is given"),
    viscoelastic("negative shift", f"{_SPECTRUM}, C1 = -7.0, C2_K = 90.0", ".C1", "-7", "greater"),
    viscoelastic("kelvin", f"{_SPECTRUM}, T_ref_C = 293.15", ".T_ref_C", "kelvin", "250"),
    viscoelastic("unknown", f"{_SPECTRUM}, tau = [1.0]", ".tau", "unknown key", "tau_s"),
    viscoelastic("too many", f"g = {[0.1] * 41}, tau_s = {[1.0] * 41}", ".g", "41", "at most 40"),
    wrong("viscoelastic: at its pole",
          f"[rubber]\nviscoelastic = {{{_SPECTRUM}, C1 = 7.0, C2_K = 50.0, T_ref_C = 90.0}}",
          "heat.ambient_C", "20.0", "above 40"),
    wrong("viscoelastic: no table", "[rubber]\nviscoelastic = [0.5]", "rubber.viscoelastic",
          "an array", "a table of keys"),
    mullins("no numbers", "", ".r", "nothing", "no default"),
    mullins("no energy", "r = 2.0", ".m_N_per_mm2", "nothing", "no default"),
    mullins("r below 1", "r = 0.5, m_N_per_mm2 = 0.3", ".r", "0.5", "at least 1"),
    mullins("zero energy", "r = 2.0, m_N_per_mm2 = 0.0", ".m_N_per_mm2", "0.0", "at least"),
    mullins("negative beta", "r = 2.0, m_N_per_mm2 = 0.3, beta = -0.1", ".beta", "-0.1", "least"),
    mullins("heats a word", 'r = 2.0, m_N_per_mm2 = 0.3, heats = "no"', ".heats", "no", "true or"),
    mullins("without unit", "r = 2.0, m = 0.3", ".m", "unknown key", "m_N_per_mm2"),
    wrong("mullins: no table", "[rubber]\nmullins = 2.0", "rubber.mullins", "2.0", "a table"),
    wrong("damping by another name", '[solver]\nsnap_damping = "off"', "solver.snap_damping",
          "off", "auto"),
]  # fmt: skip
