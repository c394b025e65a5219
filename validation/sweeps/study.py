"""Study files: a base case and a grid of keys, and the cases they stand for.

A study file is TOML: ``base = "case.toml"`` (or ``"introductory"``, the paper's example), a table
``[grid]`` of dotted case keys to lists (the full product is run) and optionally tables ``[[case]]``
of dotted keys to single values, each combined with the whole grid. ``[names]`` may give short names
to long keys for the folders.
"""

from __future__ import annotations

import hashlib
import itertools
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

from fem.case import Case
from fem.case_errors import CaseError, describe
from fem.case_reading import read_toml

#: The study files of the paper's figures.
STUDIES = Path(__file__).parents[1] / "studies"
#: Stands for the paper's introductory example where a study names its base case.
INTRODUCTORY = "introductory"
_LONGEST_NAME = 120
_KEYS = ("base", "grid", "case", "names")


@dataclass(frozen=True, kw_only=True)
class StudyCase:
    """One run of a study.

    Attributes
    ----------
    name : str
        Name of the run's folder.
    overrides : dict
        Dotted case keys to the values that make this run differ from the base case.
    case : Case
        The resolved case.
    """

    name: str
    overrides: dict[str, Any]
    case: Case


def read_study(path: str | Path) -> list[StudyCase]:
    """Read a study file into its cases, in the order of the grid.

    Raises
    ------
    CaseError
        With file, key, what was found and what was expected, in one line.
    """
    path = Path(path)
    tables = read_toml(path)
    for key in tables:
        if key not in _KEYS:
            _refuse(path, key, "an unknown key", "one of " + ", ".join(_KEYS))
    base = tables.get("base")
    if not isinstance(base, str):
        _refuse(path, "base", describe(base), "the name of a case file")
    names = tables.get("names", {})
    cases = [
        StudyCase(
            name=_folder_name(overrides, names),
            overrides=overrides,
            case=Case.from_toml(_base_path(path, base), overrides),
        )
        for overrides in _combinations(path, tables)
    ]
    if len({case.name for case in cases}) < len(cases):
        _refuse(path, "grid", "the same combination twice", "different values")
    return cases


def _base_path(study: Path, base: str) -> Path:
    return STUDIES / "introductory.toml" if base == INTRODUCTORY else study.parent / base


def _combinations(path: Path, tables: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    grid = _flat(tables.get("grid", {}))
    for key, values in grid.items():
        if not isinstance(values, list) or not values:
            _refuse(path, f"grid.{key}", describe(values), "a list of at least one value")
    extra = tables.get("case", [{}])
    if not isinstance(extra, list) or not all(isinstance(table, dict) for table in extra):
        _refuse(path, "case", describe(extra), "tables [[case]] of case keys")
    for table in extra:
        for values in itertools.product(*grid.values()):
            yield dict(zip(grid, values, strict=True)) | _flat(table)


def _flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested tables as dotted keys."""
    flat: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict):
            flat |= _flat(value, f"{prefix}{key}.")
        else:
            flat[f"{prefix}{key}"] = value
    return flat


def _folder_name(overrides: Mapping[str, Any], names: Mapping[str, str]) -> str:
    words = [f"{names.get(key, key.split('.')[-1])}_{value}" for key, value in overrides.items()]
    name = re.sub(r"[^A-Za-z0-9._-]+", "-", "__".join(words)) or "base"
    if len(name) <= _LONGEST_NAME:
        return name
    return f"{name[: _LONGEST_NAME - 9]}-{hashlib.sha256(name.encode()).hexdigest()[:8]}"


def _refuse(path: Path, key: str, found: str, expected: str) -> NoReturn:
    raise CaseError(file=str(path), key=key, found=found, expected=expected)
