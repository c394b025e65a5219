"""Case files with one fault each, and what the error must name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

LOADING = """[loading]
mean_pressure_N_per_mm2 = 0.25
velocity_mm_per_s = 300.0
distance_mm = 120.0
"""


@dataclass(frozen=True, kw_only=True)
class WrongCase:
    """A fault: the file's content (or how to make it), and key, found, expected of the error.

    `blames` is the file named in the message where that is not the case file.
    """

    name: str
    content: str | bytes | Callable[[Path], None]
    key: str
    found: str
    expected: str
    overrides: tuple[str, ...] = ()
    beside: dict[str, str] = field(default_factory=dict)
    blames: str = "case.toml"

    def write(self, folder: Path) -> Path:
        """Write the case (and the files beside it) into `folder`."""
        path = folder / "case.toml"
        for name, text in self.beside.items():
            (folder / name).write_text(text)
        if callable(self.content):
            self.content(path)
        elif isinstance(self.content, bytes):
            path.write_bytes(self.content)
        else:
            path.write_text(self.content)
        return path


def loading(**changes: str) -> str:
    values = {
        "mean_pressure_N_per_mm2": "0.25",
        "velocity_mm_per_s": "300.0",
        "distance_mm": "120.0",
    }
    return "[loading]\n" + "".join(f"{k} = {v}\n" for k, v in {**values, **changes}.items())


def _missing(path: Path) -> None:
    assert not path.exists()


def wrong(
    name: str, text: str, key: str, found: str, expected: str, beside: dict[str, str] | None = None
) -> WrongCase:
    return WrongCase(
        name=name,
        content=text + "\n" + LOADING,
        key=key,
        found=found,
        expected=expected,
        beside=beside or {},
    )


def override(name: str, text: str, key: str, found: str, expected: str) -> WrongCase:
    return WrongCase(
        name=name, content=LOADING, key=key, found=found, expected=expected, overrides=(text,)
    )


def whole(name: str, content: str | bytes, key: str, found: str, expected: str) -> WrongCase:
    return WrongCase(name=name, content=content, key=key, found=found, expected=expected)


_NO_FILE = WrongCase(
    name="missing file", content=_missing, key="file", found="no such file", expected="a readable"
)
_DIRECTORY = WrongCase(
    name="directory", content=Path.mkdir, key="file", found="a directory", expected="a readable"
)

FILES = [
    _NO_FILE,
    _DIRECTORY,
    whole("not toml", "this is no case\n", "syntax", "line 1", "TOML"),
    whole("unclosed text", "[rubber]\ncompound = 'yeoh\n", "syntax", "end of document", "TOML"),
    whole("key twice", "[block]\nrigid = true\nrigid = true\n", "syntax", "overwrite", "TOML"),
    whole("binary", bytes(range(256)), "file", "not UTF-8", "a TOML file"),
    whole("nul bytes", b"\0\0\0\0", "syntax", "line 1", "TOML"),
    whole("empty", "", "loading", "nothing", "no default"),
    whole("xml", "<case>\n</case>\n", "syntax", "line 1", "TOML"),
]

KEYS = [
    wrong("unknown section", "[blok]\nlength_mm = 20.0", "blok", "unknown", "[block]"),
    wrong("unknown key", "[block]\nlenght_mm = 20.0", "block.lenght_mm", "unknown", "length_mm"),
    wrong("without unit", "[block]\nlength = 20.0", "block.length", "unknown", "length_mm"),
    wrong(
        "key of another section",
        "[rubber]\nemissivity = 0.9",
        "rubber.emissivity",
        "unknown",
        "emissivity in [heat]",
    ),
    wrong(
        "unknown key in a nested table",
        "[heat]\npartition = {capp = 1.0}",
        "heat.partition.capp",
        "unknown",
        "cap",
    ),
    wrong("nothing near", "[output]\nzzz = 1", "output.zzz", "unknown", "snapshots, vtu"),
    whole(
        "missing loading key",
        "[loading]\nmean_pressure_N_per_mm2 = 0.25\ndistance_mm = 1.0\n",
        "loading.velocity_mm_per_s",
        "nothing",
        "no default",
    ),
    whole("section is a number", "block = 3\n" + LOADING, "block", "3", "a table"),
    wrong("section is an array", "[[block]]\nrigid = true", "block", "an array", "a table"),
]

TYPES = [
    whole("text", loading(distance_mm='"far"'), "loading.distance_mm", '"far"', "a number"),
    whole("number in quotes", loading(distance_mm='"9"'), "loading.distance_mm", '"9"', "number"),
    whole("truth value", loading(distance_mm="true"), "loading.distance_mm", "true", "number"),
    whole(
        "date", loading(distance_mm="2024-01-01"), "loading.distance_mm", "2024-01-01", "a number"
    ),
    whole("array", loading(distance_mm="[1, 2]"), "loading.distance_mm", "an array", "a number"),
    wrong("number for truth value", "[block]\nrigid = 1", "block.rigid", "1", "true or false"),
    wrong(
        "fraction for count",
        "[solver]\nfriction_passes = 1.5",
        "solver.friction_passes",
        "1.5",
        "a whole number",
    ),
    wrong("number for name", "[rubber]\ncompound = 3", "rubber.compound", "3", "a text"),
    wrong("array for mesh", "[block]\nmesh = [80, 40]", "block.mesh", "an array", '"coarse"'),
]

VALUES = [
    wrong("negative length", "[block]\nlength_mm = -20.0", "block.length_mm", "-20.0", "than 0"),
    wrong("zero height", "[block]\nheight_mm = 0", "block.height_mm", "0", "greater than 0"),
    whole("nan", loading(velocity_mm_per_s="nan"), "loading.velocity_mm_per_s", "nan", "finite"),
    whole("inf", loading(distance_mm="inf"), "loading.distance_mm", "inf", "finite"),
    whole(
        "minus inf", loading(velocity_mm_per_s="-inf"), "loading.velocity_mm_per_s", "-inf", "fin"
    ),
    whole("zero distance", loading(distance_mm="0.0"), "loading.distance_mm", "0.0", "than 0"),
    whole(
        "zero velocity",
        loading(velocity_mm_per_s="0"),
        "loading.velocity_mm_per_s",
        "0",
        "other than zero",
    ),
    whole(
        "too fast",
        loading(velocity_mm_per_s="3e8"),
        "loading.velocity_mm_per_s",
        "300000000.0",
        "from 1e-06 to 100000",
    ),
    whole(
        "pressure in pascal",
        loading(mean_pressure_N_per_mm2="250000"),
        "loading.mean_pressure_N_per_mm2",
        "250000",
        "from 1e-06 to 20",
    ),
    wrong("mesh name", '[block]\nmesh = "fin"', "block.mesh", '"fin"', '"fine"'),
    wrong(
        "huge mesh",
        "[block]\nmesh = {cells_x = 100000, cells_y = 100000, smallest_x_mm = 1e-4, "
        "smallest_y_mm = 1e-5}",
        "block.mesh.cells_x",
        "10000000000 elements",
        "at most 250000",
    ),
    wrong(
        "cells that do not fit",
        "[block]\nmesh = {cells_x = 40, cells_y = 20, smallest_x_mm = 5.0, smallest_y_mm = 0.1}",
        "block.mesh.smallest_x_mm",
        "5.0",
        "at most 0.5",
    ),
    wrong("emissivity", "[heat]\nemissivity = 1.5", "heat.emissivity", "1.5", "at most 1"),
    wrong("below absolute zero", "[heat]\nambient_C = -300", "heat.ambient_C", "-300", "-273.15"),
    wrong(
        "beyond the WLF pole",
        "[heat]\nambient_C = -80\n[friction]\nd2_K = 51.6",
        "heat.ambient_C",
        "-80",
        "above -31.6",
    ),
    wrong(
        "steps in the wrong order",
        "[solver]\nstep_mm_min = 2.0",
        "solver.step_mm_min",
        "2.0",
        "at most 0.02",
    ),
]


def value(name: str, section: str, entry: str, *parts: str) -> WrongCase:
    """A number that cannot be meant: `parts` are what is found and what is expected of it."""
    key = f"{section}.{entry.split(' =')[0]}"
    return wrong(name, f"[{section}]\n{entry}", key, *parts)


RUBBER = [
    wrong(
        "unknown compound",
        '[rubber]\ncompound = "yeoh-bars-series-3"',
        "rubber.compound",
        '"yeoh-bars-series-3"',
        '"yeoh-bars-series-',
    ),
    wrong(
        "unknown model",
        '[rubber]\nmodel = "yeo"\nC10_N_per_mm2 = 1.0',
        "rubber.model",
        "yeo",
        "yeoh",
    ),
    wrong(
        "compound and model",
        '[rubber]\ncompound = "yeoh-bars-series-1"\nmodel = "yeoh"\nC10_N_per_mm2 = 0.3',
        "rubber.compound",
        '"yeoh-bars-series-1" and model "yeoh"',
        "either",
    ),
    wrong(
        "missing constant",
        '[rubber]\nmodel = "mooney-rivlin"\nC10_N_per_mm2 = 0.3',
        "rubber.C01_N_per_mm2",
        "nothing",
        "a number",
    ),
    wrong(
        "constant of another model",
        '[rubber]\nmodel = "neo-hooke"\nG_N_per_mm2 = 0.6\nC10_N_per_mm2 = 0.3',
        "rubber.C10_N_per_mm2",
        "0.3",
        "G_N_per_mm2",
    ),
    wrong(
        "constant without model",
        "[rubber]\nC10_N_per_mm2 = 0.3",
        "rubber.C10_N_per_mm2",
        "0.3",
        "a model",
    ),
    wrong(
        "locking stretch below one",
        '[rubber]\nmodel = "van-der-waals"\nG_N_per_mm2 = 0.6\nlambda_m = 0.9\na = 0.7',
        "rubber.lambda_m",
        "0.9",
        "1.7321",
    ),
    wrong(
        "negative stiffness",
        '[rubber]\nmodel = "mooney-rivlin"\nC10_N_per_mm2 = 0.3\nC01_N_per_mm2 = -0.4',
        "rubber.model",
        "C10 + C01",
        "above zero",
    ),
    wrong("bulk ratio", "[rubber]\nbulk_ratio = 0.5", "rubber.bulk_ratio", "0.5", "0.666667"),
]

FRICTION = [
    wrong("unknown law", '[friction]\nlaw = "hümer"', "friction.law", "hümer", '"huemer"'),
    wrong("coulomb without mu", '[friction]\nlaw = "coulomb"', "friction.mu", "nothing", "mu"),
    wrong(
        "negative mu", '[friction]\nlaw = "coulomb"\nmu = -0.5', "friction.mu", "-0.5", "at least 0"
    ),
    wrong("parameter of another law", "[friction]\nmu = 0.9", "friction.mu", "0.9", "alpha"),
    wrong("law with a pole", "[friction]\na = -1.0", "friction.law", "a = -1", "a + b s"),
]

REFERENCES = [
    wrong(
        "missing parameter file",
        '[rubber]\nparameters = "fit.toml"',
        "rubber.parameters",
        "no such file",
        "a readable",
    ),
    wrong(
        "reference is a folder", '[heat]\nparameters = "."', "heat.parameters", "a dir", "a read"
    ),
    wrong(
        "reference is a number", "[friction]\nparameters = 7", "friction.parameters", "7", "name of"
    ),
    wrong(
        "parameter file without the table",
        '[rubber]\nparameters = "fit.toml"',
        "rubber.parameters",
        "without a table [rubber]",
        "a parameter file",
        {"fit.toml": "[friction]\nlaw = 'huemer'\n"},
    ),
    WrongCase(
        name="parameter file not toml",
        content='[rubber]\nparameters = "fit.toml"\n' + LOADING,
        key="syntax",
        found="line 1",
        expected="TOML",
        beside={"fit.toml": "=\n"},
        blames="fit.toml",
    ),
    WrongCase(
        name="wrong value in the parameter file",
        content='[rubber]\nparameters = "fit.toml"\n' + LOADING,
        key="rubber.C10_N_per_mm2",
        found='"soft"',
        expected="a number",
        beside={
            "fit.toml": "[rubber]\nmodel = 'yeoh'\nC10_N_per_mm2 = 'soft'\nC20_N_per_mm2 = 0.0\n"
            "C30_N_per_mm2 = 0.0\n"
        },
        blames="fit.toml",
    ),
    WrongCase(
        name="unknown key in the parameter file",
        content='[heat]\nparameters = "fit.toml"\n' + LOADING,
        key="heat.emisivity",
        found="unknown",
        expected="emissivity",
        beside={"fit.toml": "[heat]\nemisivity = 0.9\n"},
        blames="fit.toml",
    ),
]

OVERRIDES = [
    override("override to nan", "block.length_mm=nan", "block.length_mm", "nan", "finite"),
    override("override unknown", "block.lengt_mm=3", "block.lengt_mm", "unknown", "length_mm"),
    override("override of wrong type", "block.rigid=yes", "block.rigid", '"yes"', "true or false"),
    override("override inside a number", "block.length_mm.x=3", "block.length_mm", "a t", "number"),
]

#: Faults of `--set` itself; there the option takes the place of the file.
SET_SYNTAX = [
    override(
        "override without value", "block.length_mm", "block.length_mm", "block.length_mm", "value"
    ),
    override("override without section", "length_mm=3", "length_mm", "length_mm=3", "section.key"),
    override("override not toml", "block.mesh={", "block.mesh", '"{"', "a TOML value"),
    override(
        "override of 5000 digits",
        "block.length_mm=" + 5000 * "9",
        "block.length_mm",
        "999...",
        "a TOML",
    ),
    override(
        "override that is no text", "block.length_mm=\udcff3", "override", "length_mm", "printable"
    ),
    override("override of two values", "block.mesh=1 2", "block.mesh", '"1 2"', "a TOML value"),
]

WRONG_CASES = FILES + KEYS + TYPES + VALUES + RUBBER + FRICTION + REFERENCES + OVERRIDES
