"""From TOML text to plain tables: files, references to parameter files, and overrides."""

import hashlib
import re
import stat
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn

from fem.case.errors import CaseError, describe
from fem.case.friction import all_parameters
from fem.case.rubber import ALL_CONSTANTS

#: Sections that may take a calibration's result by reference.
REFERRING_SECTIONS = ("rubber", "friction", "heat")
_BARE_WORD = re.compile(r"[A-Za-z_~./\\][^\s=\"'\[\]{}]*")

Table = dict[str, Any]


@dataclass
class Source:
    """Raw tables of a case, and which file each of their keys came from."""

    tables: Table
    file: str
    folder: Path
    origins: dict[tuple[str, ...], str] = field(default_factory=dict)

    def file_of(self, location: tuple[str, ...]) -> str:
        """File to blame for the value at `location`."""
        for length in range(len(location), 0, -1):
            if location[:length] in self.origins:
                return self.origins[location[:length]]
        return self.file


def read_toml(path: Path, *, named_by: tuple[str, str] | None = None) -> Table:
    """Read a TOML file.

    Parameters
    ----------
    path : Path
        The file.
    named_by : (file, key), optional
        The file and key that refer to `path`, blamed when it cannot be read.
    """
    file, key = named_by or (str(path), "file")
    shown = "" if named_by is None else f"{describe(str(path))}, which is "
    try:
        kind = path.stat().st_mode
        if not stat.S_ISREG(kind) and not stat.S_ISDIR(kind):
            _raise(file, key, f"{shown}a device or a pipe", "a readable TOML file")
        text = path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError:
        _raise(file, key, f"{shown}not UTF-8 text", "a TOML file")
    except FileNotFoundError:
        _raise(file, key, f"{shown}no such file", "a readable TOML file")
    except IsADirectoryError:
        _raise(file, key, f"{shown}a directory", "a readable TOML file")
    except CaseError:
        raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        _raise(file, key, f"{shown}unreadable ({reason})", "a readable TOML file")
    try:
        return tomllib.loads(text)
    except ValueError as error:  # of tomllib, or of int() for thousands of digits
        _raise(str(path), "syntax", f"text that is not TOML: {error}", "TOML")
    except RecursionError:
        _raise(str(path), "syntax", "tables nested too deeply", "TOML")


def _raise(file: str, key: str, found: str, expected: str) -> NoReturn:
    raise CaseError(file, key, found, expected) from None


def expanded(name: str, file: str, key: str) -> Path:
    """The path of a name, ``~`` and ``~user`` expanded; `file` and `key` are where it stands."""
    try:
        return Path(name).expanduser()
    except RuntimeError:
        _raise(file, key, describe(name), "a user of this machine after ~")


def expand_references(source: Source) -> None:
    """Replace ``parameters = "file.toml"`` by that file's table; the case's own keys win."""
    for section in REFERRING_SECTIONS:
        table = source.tables.get(section)
        if not isinstance(table, dict) or "parameters" not in table:
            continue
        name = table.pop("parameters")
        here = source.file_of((section, "parameters"))
        key = f"{section}.parameters"
        if not isinstance(name, str) or not name:
            _raise(here, key, describe(name), "the name of a parameter file in quotes")
        path = source.folder / expanded(name, here, key)
        content = read_toml(path, named_by=(here, key)).get(section)
        if not isinstance(content, dict):
            found = f"{describe(name)} without a table [{section}]"
            _raise(here, key, found, f"a parameter file with a table [{section}]")
        if section == "friction":
            content = _shift_of(content, table, here, name)
        for inner in content:
            if inner not in table:
                source.origins[(section, inner)] = str(path)
        source.tables[section] = {**content, **table}


def absolute_files(source: Source) -> None:
    """Names of recorded signals, relative to the file that names them, as absolute ones."""
    loading = source.tables.get("loading")
    phases = loading.get("phase") if isinstance(loading, dict) else None
    for number, phase in enumerate(phases if isinstance(phases, list | tuple) else ()):
        if isinstance(phase, dict) and isinstance(phase.get("file"), str) and phase["file"]:
            place = ("loading", "phase", str(number), "file")
            path = expanded(phase["file"], source.file_of(place), ".".join(place))
            phase["file"] = str((source.folder / path).absolute())


def _shift_of(content: Table, own: Table, file: str, name: str) -> Table:
    """A parameter file's [friction] without what would mix the temperatures of law and shift."""
    constants = [key for key in ("d1", "d2_K") if key in content]
    law = [key for key in ("law", *all_parameters()) if key in content]
    if "T_ref_C" in content and constants and not law:
        found = f"{describe(name)} with T_ref_C and {constants[0]} but no law"
        expected = "wlf_T_ref_C for the temperature of d1 and d2_K: T_ref_C is that of the law"
        _raise(file, "friction.parameters", found, expected)
    replaced = [key for key in ("d1", "d2_K") if key in own]
    if replaced and "wlf_T_ref_C" in content and "wlf_T_ref_C" not in own:
        if len(replaced) == 1:
            found = f"{replaced[0]} here and the other WLF constant in {describe(name)}"
            _raise(file, f"friction.{replaced[0]}", found, "both of d1 and d2_K, or neither")
        content = {key: value for key, value in content.items() if key != "wlf_T_ref_C"}
    return content


def parse_override(text: str) -> tuple[str, Any]:
    """Split ``section.key=value`` and read the value as TOML; bare words are texts."""
    key, equals, value = text.partition("=")
    key, value = key.strip(), value.strip()
    if not text.isprintable():
        _raise("--set", "override", describe(text), "section.key=value in printable characters")
    if not equals or not all(key.split(".")) or "." not in key or not value:
        _raise("--set", key or "override", describe(text), "section.key=value")
    try:
        parsed = tomllib.loads(f"value = {value}")
        if list(parsed) == ["value"]:
            return key, parsed["value"]
    except (ValueError, RecursionError):
        if _BARE_WORD.fullmatch(value):
            return key, value
    _raise("--set", key, describe(value), 'a TOML value, e.g. 0.3, true, "text"')


def apply_overrides(source: Source, overrides: dict[str, Any]) -> None:
    """Set dotted keys, and put the content of parameter files in place.

    References go first, so that an override also wins over what a parameter file says.
    Naming another compound, model or law drops the constants of the old one.
    """
    references = {key: value for key, value in overrides.items() if key.endswith(".parameters")}
    for part in (references, {k: v for k, v in overrides.items() if k not in references}):
        for dotted in part:
            _drop_replaced(source.tables, dotted)
        for dotted, value in part.items():
            _set(source, dotted, value)
        if part is references:
            expand_references(source)


def _set(source: Source, dotted: str, value: Any) -> None:
    *sections, key = dotted.split(".")
    table: Any = source.tables
    for depth, section in enumerate(sections):
        if isinstance(table, list):
            table = _item(source, table, sections[: depth + 1])
            continue
        inner = table.get(section)
        if isinstance(inner, list | tuple):
            table[section] = table = list(inner)
            continue
        # A text gives way to a table: block.mesh.cells_x after block.mesh = "default".
        if inner is not None and not isinstance(inner, (dict, str)):
            _raise(source.file, ".".join(sections[: depth + 1]), describe(inner), "a table")
        table[section] = dict(inner) if isinstance(inner, dict) else {}
        table = table[section]
    if (key == "parameters" or dotted == "block.file") and isinstance(value, str):
        # A reference given on the command line is relative to where the command runs.
        value = str(expanded(value, "--set", dotted).absolute())
    if isinstance(table, list):
        table[_number(source, table, [*sections, key])] = value
    else:
        table[key] = value
    source.origins[tuple(dotted.split("."))] = f"{source.file} (overridden)"


def _item(source: Source, items: list[Any], location: list[str]) -> Table:
    """A table of an array of tables, by its number; the array gets a copy of it."""
    number = _number(source, items, location)
    if not isinstance(items[number], dict):
        _raise(source.file, ".".join(location), describe(items[number]), "a table")
    items[number] = item = dict(items[number])
    return item


def _number(source: Source, items: list[Any], location: list[str]) -> int:
    """Place in an array that a key names."""
    number = location[-1]
    if not number.isdecimal() or int(number) >= len(items):
        _raise(source.file, ".".join(location), number, f"a number from 0 to {len(items) - 1}")
    return int(number)


def _drop_replaced(tables: Table, dotted: str) -> None:
    replaced = {
        "rubber.compound": ("model", "window", *ALL_CONSTANTS),
        "rubber.model": ("compound", "window", *ALL_CONSTANTS),
        "rubber.parameters": ("compound", "model", "window", *ALL_CONSTANTS),
        "friction.law": ("window", *all_parameters()),
        "heat.partition.law": ("exponent",),
        "block.file": ("file_sha256", "length_mm", "height_mm"),
        "friction.parameters": ("law", "window", *all_parameters()),
    }.get(dotted, ())
    if not replaced:
        return
    *sections, _ = dotted.split(".")
    for section in sections[:-1]:
        inner = tables.get(section)
        tables = inner if isinstance(inner, dict) else {}
    table = tables.get(sections[-1])
    if isinstance(table, dict):
        tables[sections[-1]] = {k: v for k, v in table.items() if k not in replaced}


def find_mesh_file(source: Source) -> None:
    """Put the place of a mesh file and the sum of its content in place of its name.

    A file that is gone is no fault where its sum is known: the results of its run can be read.
    """
    table = source.tables.get("block")
    name = table.get("file") if isinstance(table, dict) else None
    if not isinstance(table, dict) or not isinstance(name, str):
        return
    here, known = source.file_of(("block", "file")), table.get("file_sha256")
    path = (source.folder / expanded(name, here, "block.file")).absolute()
    if not path.is_file():
        if known is None:
            _raise(here, "block.file", f"{describe(name)}, no such file", "a mesh file")
        return
    found = hashlib.sha256(path.read_bytes()).hexdigest()
    if known is not None and known != found:
        expected = f"{describe(str(known))[:20]}..., the file of before; leave file_sha256 out"
        _raise(here, "block.file_sha256", f"{name} with another content", expected)
    table["file"], table["file_sha256"] = str(path), found
