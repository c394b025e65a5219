"""Study files: a base case and a grid of keys, and the runs they stand for.

A study file is TOML: ``base = "case.toml"`` (or ``"introductory"``, the paper's example), a table
``[grid]`` of dotted case keys to lists (the full product is run) and optionally tables ``[[case]]``
of dotted keys to single values, each combined with the whole grid. ``[names]`` may give short names
to long keys for the folders.
"""

from __future__ import annotations

import hashlib
import itertools
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import pandas as pd

from fem.case import Case
from fem.case_errors import CaseError, describe
from fem.case_reading import read_toml
from fem.program_version import program_version
from fem.results import Result, read_summary
from validation.sweeps.sweep_case import FAILED, FINAL, SweepTask, forget
from validation.sweeps.sweep_progress import SweepBar, SweepProgress
from validation.sweeps.sweep_workers import executor, number_of_workers

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


@dataclass(frozen=True, kw_only=True)
class StudyRun:
    """A finished run of a study.

    Attributes
    ----------
    study_case : StudyCase
        What was run.
    result : Result
        What came out.
    """

    study_case: StudyCase
    result: Result

    def __getitem__(self, key: str) -> Any:
        """Value of a dotted case key in this run, e.g. ``run["loading.velocity_mm_per_s"]``."""
        value: Any = self.study_case.case.to_dict()
        for part in key.split("."):
            value = value[part]
        return value


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


class StudyError(RuntimeError):
    """A run of a study could not be made (an error, not a lack of convergence)."""


def study_runs(study: str | Path, directory: str | Path) -> list[StudyRun]:
    """Finished runs of a study in ``DIR/runs/<case>``; what is missing is simulated there first.

    A sweep leaves its runs in the same place, so that figures find them. Missing runs are made
    side by side, like those of a sweep.

    Raises
    ------
    StudyError
        If a run raised an error; the others are kept.
    """
    cases = read_study(study)
    runs = Path(directory).absolute() / "runs"
    simulate_missing([(runs / study_case.name, study_case.case) for study_case in cases])
    return [StudyRun(study_case=c, result=Result.read(runs / c.name)) for c in cases]


def simulate_missing(wanted: Sequence[tuple[Path, Case]]) -> None:
    """Simulate the cases whose folders do not hold their runs, without drawing them.

    Raises
    ------
    StudyError
        If a run raised an error.
    """
    waiting = [
        SweepTask(
            name=folder.name,
            case=case.with_overrides({"output.figures": False}),
            folder=str(folder),
            version=program_version(),
        )
        for folder, case in wanted
        if not holds(folder, case)
    ]
    if not waiting:
        return
    counts: Counter[str] = Counter()
    workers = min(number_of_workers(None, None), len(waiting))
    with executor(workers=workers, scheduler=None) as execute, SweepBar() as bar:
        for task in waiting:
            forget(task, checkpoint=False)
            Path(task.folder).parent.mkdir(parents=True, exist_ok=True)
        for outcome in execute(waiting):
            if outcome is not None:
                counts[outcome.summary["status"]] += 1
                if outcome.summary["status"] == FAILED:
                    raise StudyError(f"{outcome.name}: {outcome.summary['reason']}")
            done = counts.total()
            bar(SweepProgress(cases=len(waiting), done=done, earlier=0, status=dict(counts)))


def holds(folder: Path, case: Case) -> bool:
    """Whether a folder holds the finished run of a case by this program, with fields."""
    try:
        summary = read_summary(folder)
        found = Case.from_toml(folder / "case.toml")
    except (CaseError, ValueError):
        # Written by a version with other keys, or damaged: it has to be run again.
        return False
    if summary["status"] not in FINAL or summary.get("program_version") != program_version():
        return False
    if not any(folder.glob("block_*.vtu")):
        return False
    return found == case.with_overrides(
        {f"output.{key}": value for key, value in found.to_dict()["output"].items()}
    )


def summary_table(runs: list[StudyRun]) -> pd.DataFrame:
    """One row per run: the grid's columns, then the summary."""
    return pd.DataFrame([run.study_case.overrides | run.result.summary for run in runs])


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
