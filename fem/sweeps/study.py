"""Study files: a base case and a grid of keys, and the cases they stand for.

A study file is TOML: ``base = "case.toml"`` (or a name that the caller knows a case file of), a
table ``[grid]`` of dotted case keys to lists (the full product is run; a list of a section holds
tables, whose keys change together) and optionally tables ``[[case]]`` of dotted keys to single
values, each combined with the whole grid. ``[names]`` may give short names to long keys for the
folders.
"""

import hashlib
import itertools
import json
import math
import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

from fem.case import Case, CaseError, describe, read_toml, suggestion

_LONGEST_NAME = 120
_KEYS = ("base", "grid", "case", "names")
#: Case keys whose value names a file.
_FILE_KEYS = ("parameters", "file")


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


@dataclass(frozen=True, kw_only=True)
class Study:
    """What a study file says.

    Attributes
    ----------
    path, base : Path
        The file, and that of its base case.
    grid : dict
        Dotted case keys to their values.
    extra : list of dict
        Dotted keys to single values; at least one, which may be empty.
    names : dict
        Dotted keys to short names.
    """

    path: Path
    base: Path
    grid: dict[str, list[Any]]
    extra: list[dict[str, Any]]
    names: dict[str, str]

    @property
    def number(self) -> int:
        """How many cases it stands for."""
        return len(self.extra) * math.prod(len(values) for values in self.grid.values())

    def cases(self) -> list[StudyCase]:
        """All cases, in the order of the grid.

        Raises
        ------
        CaseError
            With file, key, what was found and what was expected, in one line.
        """
        overrides = [self._combination(number) for number in range(self.number)]
        if _has_twins(overrides):
            _refuse(self.path, "grid", "the same combination twice", "different values")
        return [
            StudyCase(name=name, overrides=values, case=self._case(values))
            for name, values in zip(_folder_names(overrides, self.names), overrides, strict=True)
        ]

    def some_cases(self, most: int) -> list[Case]:
        """Some cases, evenly spread over all of them."""
        count = min(most, self.number)
        chosen = (k * (self.number - 1) // max(1, count - 1) for k in range(count))
        return [self._case(self._combination(number)) for number in chosen]

    def _combination(self, number: int) -> dict[str, Any]:
        """One of them; the last key of the grid changes first, the extra tables last."""
        chosen = {}
        for key, values in reversed(self.grid.items()):
            number, place = divmod(number, len(values))
            chosen[key] = values[place]
        return _of_sections({key: chosen[key] for key in self.grid}) | self.extra[number]

    def _case(self, overrides: Mapping[str, Any]) -> Case:
        """The case of a combination; files that the study names are looked for beside it."""
        beside = {
            key: str(self.path.parent / value)
            if isinstance(value, str) and key.split(".")[-1] in _FILE_KEYS
            else value
            for key, value in overrides.items()
        }
        return Case.from_toml(self.base, beside)


def read_study(
    path: str | Path,
    bases: Mapping[str, Path] | None = None,
    base: str | Path | None = None,
) -> Study:
    """Read a study file.

    Parameters
    ----------
    path : str or Path
        The TOML file.
    bases : mapping, optional
        Case files that a study may name by a word, e.g. ``introductory``.
    base : str or Path, optional
        Another base case for its grid.

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
    own, grid = tables.get("base"), tables.get("grid", {})
    if not isinstance(own, str):
        _refuse(path, "base", describe(own), "the name of a case file")
    if not isinstance(grid, dict):
        _refuse(path, "grid", describe(grid), "a table [grid] of case keys to lists")
    grid = _flat(grid)
    for key, values in grid.items():
        if not isinstance(values, list) or not values:
            _refuse(path, f"grid.{key}", describe(values), "a list of at least one value")
    extra = tables.get("case", [{}])
    if not isinstance(extra, list) or not all(isinstance(table, dict) for table in extra):
        _refuse(path, "case", describe(extra), "tables [[case]] of case keys")
    extra = [_flat(table) for table in extra]
    parts = [_of_sections({name: value}) for name, values in grid.items() for value in values]
    keys = list(dict.fromkeys([*grid, *itertools.chain(*parts, *extra)]))
    names = _short_names(path, tables.get("names", {}), keys)
    known = dict(bases or {}).get(own, path.parent / own) if base is None else Path(base)
    return Study(path=path, base=known, grid=grid, extra=extra, names=names)


def _short_names(path: Path, table: Any, keys: list[str]) -> dict[str, str]:
    if not isinstance(table, dict):
        _refuse(path, "names", describe(table), "a table [names] of case keys to short names")
    names = _flat(table)
    for key, name in names.items():
        if key not in keys:
            expected = suggestion(key, keys) if keys else "keys of the grid"
            _refuse(path, f"names.{key}", "a key that the study does not vary", expected)
        if not isinstance(name, str) or not name:
            _refuse(path, f"names.{key}", describe(name), "a short name")
    return names


def _has_twins(overrides: list[dict[str, Any]]) -> bool:
    """Whether two combinations are the same; 1 and 1.0 are, true and 1 are not."""
    seen = {json.dumps(_comparable(values), sort_keys=True, default=str) for values in overrides}
    return len(seen) < len(overrides)


def _comparable(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _comparable(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_comparable(item) for item in value]
    return float(value) if isinstance(value, int) and not isinstance(value, bool) else value


def _flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested tables as dotted keys."""
    flat: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict):
            flat |= _flat(value, f"{prefix}{key}.")
        else:
            flat[f"{prefix}{key}"] = value
    return flat


def _of_sections(chosen: dict[str, Any]) -> dict[str, Any]:
    """Values of a combination, the tables of sections as their keys."""
    parts = [{key: value} if "." in key else _flat({key: value}) for key, value in chosen.items()]
    return {key: value for part in parts for key, value in part.items()}


def _folder_names(overrides: list[dict[str, Any]], names: Mapping[str, str]) -> list[str]:
    """A name for each combination; where they would be the same, each gets a mark of its own."""
    plain = [_folder_name(values, names) for values in overrides]
    # Some file systems take capital and small letters for the same.
    count = Counter(name.lower() for name in plain)
    return [
        name if count[name.lower()] == 1 else _marked(name, json.dumps(values, default=str))
        for name, values in zip(plain, overrides, strict=True)
    ]


def _folder_name(overrides: Mapping[str, Any], names: Mapping[str, str]) -> str:
    words = [f"{names.get(key) or _last(key)}_{value}" for key, value in overrides.items()]
    # A name that begins with a letter or digit is neither hidden nor an option nor a formula.
    name = re.sub(r"[^A-Za-z0-9._-]+", "-", "__".join(words)).lstrip("._-") or "base"
    return name if len(name) <= _LONGEST_NAME else _marked(name, name)


def _last(key: str) -> str:
    """The end of a dotted key; of one inside an array with the number of its table."""
    *_, number, last = ["", *key.split(".")]
    return f"{number}.{last}" if number.isdecimal() else last


def _marked(name: str, content: str) -> str:
    digest = hashlib.sha256(content.encode()).hexdigest()[:8]
    return f"{name[: _LONGEST_NAME - 9]}-{digest}"


def _refuse(path: Path, key: str, found: str, expected: str) -> NoReturn:
    raise CaseError(str(path), key, found, expected)
