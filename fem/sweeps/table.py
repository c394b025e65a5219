"""The table of a sweep: a row per finished case, always in the order of the study."""

import csv
import io
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from fem.files import spreadsheet, write_text
from fem.results import SUMMARY, SUMMARY_CSV, joined
from fem.sweeps.case import CaseOutcome, SweepTask
from fem.sweeps.study import StudyCase

TIMINGS_CSV = "timings.csv"
#: Differ from run to run; they stand in a table of their own so that the results can be compared.
_TIMES = ("wall_s", "solver_s")
_OF_THE_CASE = ("wall_s", "cpu_s")
_BEFORE = ("case", "status", "reason", "advice")
_AFTER = ("case_hash", "program_version")


class SweepTable:
    """Rows of `summary.csv` and `timings.csv`, rewritten as a whole whenever a case has finished.

    A reader never sees half a row, and the rows are in the order of the study at any time.

    Parameters
    ----------
    directory : Path
        Folder of the sweep.
    cases : sequence of StudyCase
        All cases of the study.
    """

    def __init__(self, directory: Path, cases: Sequence[StudyCase]) -> None:
        self.directory = directory
        self.grid = list(dict.fromkeys(key for case in cases for key in case.overrides))
        self.settings = {case.name: grid_values(case, self.grid) for case in cases}
        self.rows: dict[str, dict[str, Any]] = {}
        self.times: dict[str, dict[str, Any]] = {}

    def add(self, task: SweepTask, outcome: CaseOutcome) -> None:
        """Take the outcome of a case."""
        summary = outcome.summary
        self.rows[task.name] = {
            **self.settings[task.name],
            "case": task.name,
            **{key: value for key, value in summary.items() if key not in _TIMES},
            "warnings": joined(summary.get("warnings", ())),
            "case_hash": task.case.hash(),
            "program_version": task.version,
        }
        solver_s = summary.get("solver_s", "")
        self.times[task.name] = {"case": task.name, **outcome.timing, "solver_s": solver_s}

    def earlier_times(self) -> dict[str, dict[str, Any]]:
        """Times by case that an earlier sweep wrote; none where there is no such table."""
        try:
            with (self.directory / TIMINGS_CSV).open(newline="", encoding="utf-8") as file:
                return {
                    row["case"]: {key: row[key] for key in _OF_THE_CASE}
                    for row in csv.DictReader(file)
                }
        except (OSError, ValueError, KeyError, csv.Error):
            return {}

    def write(self) -> None:
        """Write both tables with the cases that have finished so far."""
        found = dict.fromkeys(key for row in self.rows.values() for key in row)
        results = [key for key in SUMMARY if key not in _TIMES]
        first = dict.fromkeys([*self.grid, *_BEFORE, *results])
        others = [key for key in found if key not in first and key not in _AFTER]
        columns = [*first, *others, *_AFTER]
        self._write(SUMMARY_CSV, columns, self.rows)
        self._write(TIMINGS_CSV, ["case", *_OF_THE_CASE, "solver_s"], self.times)

    def _write(self, name: str, columns: list[str], rows: Mapping[str, Mapping[str, Any]]) -> None:
        text = io.StringIO()
        writer = csv.DictWriter(text, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(spreadsheet.row(rows[case]) for case in self.settings if case in rows)
        write_text(self.directory / name, text.getvalue())


def grid_values(case: StudyCase, grid: Sequence[str]) -> dict[str, Any]:
    """Values of the dotted keys in a case; those that it has no use for are empty."""
    resolved = case.case.to_dict()
    return {key: _plain(case.overrides.get(key, _resolved(resolved, key))) for key in grid}


def _resolved(tables: Mapping[str, Any], dotted: str) -> Any:
    value: Any = tables
    for part in dotted.split("."):
        if isinstance(value, list | tuple):
            value = value[int(part)] if part.isdecimal() and int(part) < len(value) else None
        else:
            value = value.get(part) if isinstance(value, Mapping) else None
    return value


def _plain(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, (dict, list)) else value
