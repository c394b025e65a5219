"""A heating rig from a TOML file.

The file has a table ``[rig]`` with the attributes of `HeatingRig` as keys (unit in the name), a
table per material ``[rig.rubber]``, ``[rig.copper]``, ``[rig.asphalt]`` with the thermal keys of a
case file, and ``[rig.thermocouples]`` with ``C1 = {x_mm = 0.0, y_mm = 7.0}`` and so on. What is
left out keeps its default; given thermocouples replace all of the default ones. A table
``[surface]`` with the attributes of `ContactSurface` is optional; with it the constant C of
eq. (11) follows.
"""

import difflib
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, NoReturn

from calibration.conductance.heating_rig import HeatingRig, Thermocouple
from calibration.data import DataError
from contact.conductance import ContactSurface
from fem.case import CaseError, describe, read_toml
from materials.plausible import (
    PRESSURE,
    SOLID_CONDUCTIVITY,
    SOLID_DENSITY,
    SPECIFIC_HEAT,
    START_TEMPERATURE,
    judge,
)
from materials.thermal import ThermalProperties

MATERIALS = ("rubber", "copper", "asphalt")
_THERMAL_KEYS = ("conductivity_W_per_mK", "density_kg_per_m3", "specific_heat_kJ_per_kgK")
_PLACE_KEYS = ("x_mm", "y_mm")
_LARGEST = 1e300
#: What the keys of a rig are, for their physical ranges.
_QUANTITIES = {
    "ambient_C": START_TEMPERATURE,
    "pressure_N_per_mm2": PRESSURE,
    "conductivity_W_per_mK": SOLID_CONDUCTIVITY,
    "density_kg_per_m3": SOLID_DENSITY,
    "specific_heat_kJ_per_kgK": SPECIFIC_HEAT,
}


def read_heating_rig(path: str | Path) -> HeatingRig:
    """Read the dimensions, materials and thermocouples of a heating rig.

    Raises
    ------
    DataError
        In one line: file, key, what was found and what was expected.
    """
    path = Path(path)
    content = _read(path)
    _check_keys(path, content, ["rig", "surface"], "the file")
    rig = _table(path, content, "rig", "[rig]")
    numbers = [f.name for f in fields(HeatingRig) if f.name not in (*MATERIALS, "thermocouples")]
    _check_keys(path, rig, [*numbers, *MATERIALS, "thermocouples"], "[rig]")
    given: dict[str, Any] = {
        key: _number(path, rig[key], f"[rig] {key}") for key in numbers if key in rig
    }
    for name in MATERIALS:
        if name in rig:
            given[name] = _material(path, _table(path, rig, name, f"[rig.{name}]"), name)
    if "thermocouples" in rig:
        places = _table(path, rig, "thermocouples", "[rig.thermocouples]")
        given["thermocouples"] = {
            name: Thermocouple(**_numbers(path, places, name, _PLACE_KEYS)) for name in places
        }
    try:
        return HeatingRig(**given)
    except ValueError as error:
        _refuse(path, "", str(error), "a rig that fits")


def read_contact_surface(path: str | Path) -> ContactSurface | None:
    """Read the table ``[surface]`` of a rig file; None without one."""
    path = Path(path)
    content = _read(path)
    if "surface" not in content:
        return None
    keys = tuple(f.name for f in fields(ContactSurface))
    values = _numbers(path, content, "surface", keys)
    try:
        return ContactSurface(**values)
    except ValueError as error:
        _refuse(path, "[surface]", str(error), "a rough surface")


def _refuse(path: Path, column: str, found: str, expected: str) -> NoReturn:
    raise DataError(file=str(path), column=column, found=found, expected=expected) from None


def _read(path: Path) -> dict[str, Any]:
    try:
        return read_toml(path)
    except CaseError as error:
        raise DataError(file=error.file, found=error.found, expected=error.expected) from None


def _table(path: Path, parent: Mapping[str, Any], key: str, name: str) -> dict[str, Any]:
    value = parent.get(key)
    if not isinstance(value, dict):
        found = "nothing" if value is None else repr(value)
        _refuse(path, name, found, f"a table {name}")
    return value


def _check_keys(path: Path, table: Mapping[str, Any], allowed: list[str], name: str) -> None:
    for key in table:
        if key not in allowed:
            near = difflib.get_close_matches(key, allowed, n=1)
            expected = near[0] if near else f"one of {', '.join(allowed)}"
            _refuse(path, name, f"the key {key}", expected)


def _number(path: Path, value: object, name: str) -> float:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not abs(value) < _LARGEST:  # type: ignore[arg-type]
        _refuse(path, name, describe(value), "a number")
    key = name.split()[-1]
    finding = judge(value, _QUANTITIES[key]) if key in _QUANTITIES else None  # type: ignore[arg-type]
    if finding is not None and finding.impossible:
        found = describe(value) + (f", which {finding.likely}" if finding.likely else "")
        _refuse(path, name, found, finding.expected)
    return float(value)  # type: ignore[arg-type]


def _numbers(
    path: Path, parent: Mapping[str, Any], key: str, keys: tuple[str, ...]
) -> dict[str, float]:
    table = _table(path, parent, key, key)
    _check_keys(path, table, list(keys), key)
    return {name: _number(path, table.get(name), f"{key} {name}") for name in keys}


def _material(path: Path, table: dict[str, Any], name: str) -> ThermalProperties:
    values = _numbers(path, {name: table}, name, _THERMAL_KEYS)
    try:
        return ThermalProperties.from_paper_units(**values)
    except ValueError as error:
        _refuse(path, f"[rig.{name}]", str(error), "a material")
