"""A row of the table of wrong inputs, and the commands, files and cells they are made of."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tests.wrong_inputs.cases import LOADING, SET_SYNTAX, WrongCase
from tests.wrong_inputs.events import GOOD as EVENT

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


def of_case(wrong: WrongCase) -> WrongInput:
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


def table(kind: str, words: tuple[str, ...], content: Content, *expected: str) -> WrongInput:
    files = {"t.csv": content, "case.toml": LOADING}
    return WrongInput(kind=kind, words=words, files=files, expected=("t.csv", *expected))


def rig(kind: str, content: Content, *expected: str) -> WrongInput:
    files = {"t.csv": HEATING, "rig.toml": content}
    return WrongInput(kind=f"rig: {kind}", words=RIG, files=files, expected=("rig.toml", *expected))


def study(kind: str, content: str, *expected: str) -> WrongInput:
    files = {"study.toml": content, "case.toml": LOADING, "event.toml": EVENT}
    return WrongInput(kind=f"study: {kind}", words=SWEEP, files=files, expected=expected)


def rows(header: str, *rows: str) -> str:
    return "\n".join([header.strip(), *rows, ""])


#: Shift factors of the universal WLF curve.
SHIFTS = [(T, -8.86 * (T - 20) / (101.6 + T - 20)) for T in (-20, 0, 20, 40, 60)]


def pulled(stretch: float) -> float:
    """Nominal stress of a neo-Hookean rubber of 2 N/mm^2."""
    return 2.0 * (stretch - stretch**-2)


SWEEP_COLUMNS = "T_C,frequency_Hz,modulus_N_per_mm2"
PROFILE = "run,x_mm,T_C,v_mm_per_s,T_0_C"
