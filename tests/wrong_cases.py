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


def _loading(**changes: str) -> str:
    values = {
        "mean_pressure_N_per_mm2": "0.25",
        "velocity_mm_per_s": "300.0",
        "distance_mm": "120.0",
    }
    return "[loading]\n" + "".join(f"{k} = {v}\n" for k, v in {**values, **changes}.items())


def _missing(path: Path) -> None:
    assert not path.exists()


def _wrong(
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


def _override(name: str, text: str, key: str, found: str, expected: str) -> WrongCase:
    return WrongCase(
        name=name, content=LOADING, key=key, found=found, expected=expected, overrides=(text,)
    )


def _whole(name: str, content: str | bytes, key: str, found: str, expected: str) -> WrongCase:
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
    _whole("not toml", "this is no case\n", "syntax", "line 1", "TOML"),
    _whole("unclosed text", "[rubber]\ncompound = 'yeoh\n", "syntax", "end of document", "TOML"),
    _whole("key twice", "[block]\nrigid = true\nrigid = true\n", "syntax", "overwrite", "TOML"),
    _whole("binary", bytes(range(256)), "file", "not UTF-8", "a TOML file"),
    _whole("nul bytes", b"\0\0\0\0", "syntax", "line 1", "TOML"),
    _whole("empty", "", "loading", "nothing", "no default"),
    _whole("xml", "<case>\n</case>\n", "syntax", "line 1", "TOML"),
]

KEYS = [
    _wrong("unknown section", "[blok]\nlength_mm = 20.0", "blok", "unknown", "[block]"),
    _wrong("unknown key", "[block]\nlenght_mm = 20.0", "block.lenght_mm", "unknown", "length_mm"),
    _wrong("without unit", "[block]\nlength = 20.0", "block.length", "unknown", "length_mm"),
    _wrong(
        "key of another section",
        "[rubber]\nemissivity = 0.9",
        "rubber.emissivity",
        "unknown",
        "emissivity in [heat]",
    ),
    _wrong(
        "unknown key in a nested table",
        "[heat]\npartition = {capp = 1.0}",
        "heat.partition.capp",
        "unknown",
        "cap",
    ),
    _wrong("nothing near", "[output]\nzzz = 1", "output.zzz", "unknown", "snapshots, vtu"),
    _whole(
        "missing loading key",
        "[loading]\nmean_pressure_N_per_mm2 = 0.25\ndistance_mm = 1.0\n",
        "loading.velocity_mm_per_s",
        "nothing",
        "no default",
    ),
    _whole("section is a number", "block = 3\n" + LOADING, "block", "3", "a table"),
    _wrong("section is an array", "[[block]]\nrigid = true", "block", "an array", "a table"),
]

TYPES = [
    _whole("text", _loading(distance_mm='"far"'), "loading.distance_mm", '"far"', "a number"),
    _whole("number in quotes", _loading(distance_mm='"9"'), "loading.distance_mm", '"9"', "number"),
    _whole("truth value", _loading(distance_mm="true"), "loading.distance_mm", "true", "number"),
    _whole(
        "date", _loading(distance_mm="2024-01-01"), "loading.distance_mm", "2024-01-01", "a number"
    ),
    _whole("array", _loading(distance_mm="[1, 2]"), "loading.distance_mm", "an array", "a number"),
    _wrong("number for truth value", "[block]\nrigid = 1", "block.rigid", "1", "true or false"),
    _wrong(
        "fraction for count",
        "[solver]\nfriction_passes = 1.5",
        "solver.friction_passes",
        "1.5",
        "a whole number",
    ),
    _wrong("number for name", "[rubber]\ncompound = 3", "rubber.compound", "3", "a text"),
    _wrong("array for mesh", "[block]\nmesh = [80, 40]", "block.mesh", "an array", '"coarse"'),
]

VALUES = [
    _wrong("negative length", "[block]\nlength_mm = -20.0", "block.length_mm", "-20.0", "than 0"),
    _wrong("zero height", "[block]\nheight_mm = 0", "block.height_mm", "0", "greater than 0"),
    _whole("nan", _loading(velocity_mm_per_s="nan"), "loading.velocity_mm_per_s", "nan", "finite"),
    _whole("inf", _loading(distance_mm="inf"), "loading.distance_mm", "inf", "finite"),
    _whole(
        "minus inf", _loading(velocity_mm_per_s="-inf"), "loading.velocity_mm_per_s", "-inf", "fin"
    ),
    _whole("zero distance", _loading(distance_mm="0.0"), "loading.distance_mm", "0.0", "than 0"),
    _whole(
        "zero velocity",
        _loading(velocity_mm_per_s="0"),
        "loading.velocity_mm_per_s",
        "0",
        "other than zero",
    ),
    _whole(
        "too fast",
        _loading(velocity_mm_per_s="3e8"),
        "loading.velocity_mm_per_s",
        "300000000.0",
        "from 1e-06 to 100000",
    ),
    _whole(
        "pressure in pascal",
        _loading(mean_pressure_N_per_mm2="250000"),
        "loading.mean_pressure_N_per_mm2",
        "250000",
        "from 1e-06 to 20",
    ),
    _wrong("mesh name", '[block]\nmesh = "fin"', "block.mesh", '"fin"', '"fine"'),
    _wrong(
        "huge mesh",
        "[block]\nmesh = {cells_x = 100000, cells_y = 100000, smallest_x_mm = 1e-4, "
        "smallest_y_mm = 1e-5}",
        "block.mesh.cells_x",
        "10000000000 elements",
        "at most 250000",
    ),
    _wrong(
        "cells that do not fit",
        "[block]\nmesh = {cells_x = 40, cells_y = 20, smallest_x_mm = 5.0, smallest_y_mm = 0.1}",
        "block.mesh.smallest_x_mm",
        "5.0",
        "at most 0.5",
    ),
    _wrong("emissivity", "[heat]\nemissivity = 1.5", "heat.emissivity", "1.5", "at most 1"),
    _wrong("below absolute zero", "[heat]\nambient_C = -300", "heat.ambient_C", "-300", "-273.15"),
    _wrong(
        "beyond the WLF pole",
        "[heat]\nambient_C = -80\n[friction]\nd2_K = 51.6",
        "heat.ambient_C",
        "-80",
        "above -31.6",
    ),
    _wrong(
        "steps in the wrong order",
        "[solver]\nstep_mm_min = 2.0",
        "solver.step_mm_min",
        "2.0",
        "at most 0.02",
    ),
]


def _value(name: str, section: str, entry: str, *parts: str) -> WrongCase:
    """A number that cannot be meant: `parts` are what is found and what is expected of it."""
    key = f"{section}.{entry.split(' =')[0]}"
    return _wrong(name, f"[{section}]\n{entry}", key, *parts)


#: Numbers that no run can mean: other units, or steps and sizes that never end.
RANGES = [
    _value("kelvin", "heat", "ambient_C = 293", "293.0, which looks like kelvin", "-90 to 200"),
    _value("hot", "heat", "ambient_C = 2000", "2000", "from -90 to 200 deg C"),
    _value("kelvin of the law", "friction", "T_ref_C = 293.15", "kelvin (20 deg C)", "-200 to 250"),
    _value("density in t/mm^3", "road", "density_kg_per_m3 = 2e-9", "t/mm^3 (2000", "100 to 25000"),
    _value("density in g/cm^3", "rubber", "density_kg_per_m3 = 1.2", "g/cm^3 (1200", "100 to 6000"),
    _value(
        "specific heat in J",
        "rubber",
        "specific_heat_kJ_per_kgK = 1450",
        "J/(kg K) (1.45",
        "0.05 to 20",
    ),
    _value("block in micrometres", "block", "length_mm = 20000", "micrometres (20 mm)", "to 1000"),
    _value("block in metres", "block", "height_mm = 0.008", "metres (8 mm)", "0.1 to 1000"),
    _value("block of a kilometre", "block", "length_mm = 1e6", "1000000.0", "to 1000 mm"),
    _value("huge factor on steps", "solver", "steps_scale = 1e20", "1e+20", "at most 100"),
    _value("tiny factor on steps", "solver", "steps_scale = 1e-20", "1e-20", "at least 0.001"),
    _value("tiny heat step", "solver", "heat_step_mm = 1e-300", "1e-300", "at least 1e-07"),
    _value("small heat step", "solver", "heat_step_mm = 1e-9", "1e-09", "at least 1e-07"),
    _value("tiny step", "solver", "step_mm_min = 1e-300", "1e-300", "at least 1e-07"),
    _value(
        "pressure of the heat partition in kPa",
        "heat.partition",
        "pressure = 300",
        "300.0, which looks like kPa",
        "from 1e-06 to 20",
    ),
    _value(
        "word for a pressure", "heat.partition", 'pressure = "maen"', '"maen"', '"mean" (or "local"'
    ),
    _value("tiny radius", "solver", "edge_radius_mm = 1e-300", "1e-300", "at least 1e-06"),
    _value("seven passes", "solver", "friction_passes = 7", "7", "at most 6"),
    _value("huge friction", "friction", "alpha = 1e300", "1e+300", "at most 1e+06"),
    _whole(
        "friction in per cent",
        '[friction]\nlaw = "coulomb"\nmu = 90\n' + LOADING,
        "friction.mu",
        "90.0, which looks like per cent (0.9)",
        "from 0 to 6",
    ),
    _wrong(
        "law in per cent",
        '[friction]\nlaw = "exponential"\nA = 70',
        "friction.law",
        "exponential with the coefficient",
        "a friction coefficient from 0 to 6",
    ),
    _wrong(
        "friction that pushes",
        "[friction]\nalpha = 0.0\nbeta = -0.2",
        "friction.law",
        "huemer with the coefficient -0.2",
        "0 or more at every pressure and speed of the run",
    ),
    _wrong(
        "friction that pushes at the peak pressure",
        "[friction]\nbeta = -0.1",
        "friction.law",
        "N/mm^2 and 1 mm/s",
        "(to 25 N/mm^2)",
    ),
    _wrong(
        "rubber in kPa",
        '[rubber]\nmodel = "neo-hooke"\nG_N_per_mm2 = 600.0',
        "rubber.G_N_per_mm2",
        "600 N/mm^2, which looks like kPa (0.6 N/mm^2)",
        "a shear modulus of rubber",
    ),
    _whole(
        "distance of km", _loading(distance_mm="1e9"), "loading.distance_mm", "1000000000", "1e+06"
    ),
    _wrong(
        "integer of 5000 digits", "[block]\nlength_mm = " + 5000 * "9", "syntax", "limit", "TOML"
    ),
    _wrong(
        "hexadecimal of 5000 digits",
        "[block]\nlength_mm = 0x" + 5000 * "9",
        "block.length_mm",
        "a whole number of 6021 digits",
        "a number",
    ),
    _wrong(
        "unknown user",
        '[heat]\nparameters = "~nobody9/heat.toml"',
        "heat.parameters",
        "~nobody9",
        "a user of this machine",
    ),
    _wrong(
        "a month of steps",
        "[solver]\nheat_step_mm = 1e-7\nsteps_scale = 0.001",
        "solver.steps_scale",
        "days on one core",
        "within 30 days",
    ),
]

RUBBER = [
    _wrong(
        "unknown compound",
        '[rubber]\ncompound = "yeoh-bars-series-3"',
        "rubber.compound",
        '"yeoh-bars-series-3"',
        '"yeoh-bars-series-',
    ),
    _wrong(
        "unknown model",
        '[rubber]\nmodel = "yeo"\nC10_N_per_mm2 = 1.0',
        "rubber.model",
        "yeo",
        "yeoh",
    ),
    _wrong(
        "compound and model",
        '[rubber]\ncompound = "yeoh-bars-series-1"\nmodel = "yeoh"\nC10_N_per_mm2 = 0.3',
        "rubber.compound",
        '"yeoh-bars-series-1" and model "yeoh"',
        "either",
    ),
    _wrong(
        "missing constant",
        '[rubber]\nmodel = "mooney-rivlin"\nC10_N_per_mm2 = 0.3',
        "rubber.C01_N_per_mm2",
        "nothing",
        "a number",
    ),
    _wrong(
        "constant of another model",
        '[rubber]\nmodel = "neo-hooke"\nG_N_per_mm2 = 0.6\nC10_N_per_mm2 = 0.3',
        "rubber.C10_N_per_mm2",
        "0.3",
        "G_N_per_mm2",
    ),
    _wrong(
        "constant without model",
        "[rubber]\nC10_N_per_mm2 = 0.3",
        "rubber.C10_N_per_mm2",
        "0.3",
        "a model",
    ),
    _wrong(
        "locking stretch below one",
        '[rubber]\nmodel = "van-der-waals"\nG_N_per_mm2 = 0.6\nlambda_m = 0.9\na = 0.7',
        "rubber.lambda_m",
        "0.9",
        "1.7321",
    ),
    _wrong(
        "negative stiffness",
        '[rubber]\nmodel = "mooney-rivlin"\nC10_N_per_mm2 = 0.3\nC01_N_per_mm2 = -0.4',
        "rubber.model",
        "C10 + C01",
        "above zero",
    ),
    _wrong("bulk ratio", "[rubber]\nbulk_ratio = 0.5", "rubber.bulk_ratio", "0.5", "0.666667"),
]

FRICTION = [
    _wrong("unknown law", '[friction]\nlaw = "hümer"', "friction.law", "hümer", '"huemer"'),
    _wrong("coulomb without mu", '[friction]\nlaw = "coulomb"', "friction.mu", "nothing", "mu"),
    _wrong(
        "negative mu", '[friction]\nlaw = "coulomb"\nmu = -0.5', "friction.mu", "-0.5", "at least 0"
    ),
    _wrong("parameter of another law", "[friction]\nmu = 0.9", "friction.mu", "0.9", "alpha"),
    _wrong("law with a pole", "[friction]\na = -1.0", "friction.law", "a = -1", "a + b s"),
]

REFERENCES = [
    _wrong(
        "missing parameter file",
        '[rubber]\nparameters = "fit.toml"',
        "rubber.parameters",
        "no such file",
        "a readable",
    ),
    _wrong(
        "reference is a folder", '[heat]\nparameters = "."', "heat.parameters", "a dir", "a read"
    ),
    _wrong(
        "reference is a number", "[friction]\nparameters = 7", "friction.parameters", "7", "name of"
    ),
    _wrong(
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
    _override("override to nan", "block.length_mm=nan", "block.length_mm", "nan", "finite"),
    _override("override unknown", "block.lengt_mm=3", "block.lengt_mm", "unknown", "length_mm"),
    _override("override of wrong type", "block.rigid=yes", "block.rigid", '"yes"', "true or false"),
    _override(
        "override inside a number", "block.length_mm.x=3", "block.length_mm", "a t", "number"
    ),
]

#: Faults of `--set` itself; there the option takes the place of the file.
SET_SYNTAX = [
    _override(
        "override without value", "block.length_mm", "block.length_mm", "block.length_mm", "value"
    ),
    _override("override without section", "length_mm=3", "length_mm", "length_mm=3", "section.key"),
    _override("override not toml", "block.mesh={", "block.mesh", '"{"', "a TOML value"),
    _override(
        "override of 5000 digits",
        "block.length_mm=" + 5000 * "9",
        "block.length_mm",
        "999...",
        "a TOML",
    ),
    _override(
        "override that is no text", "block.length_mm=\udcff3", "override", "length_mm", "printable"
    ),
    _override("override of two values", "block.mesh=1 2", "block.mesh", '"1 2"', "a TOML value"),
]

WRONG_CASES = FILES + KEYS + TYPES + VALUES + RANGES + RUBBER + FRICTION + REFERENCES + OVERRIDES
