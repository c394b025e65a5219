"""The result of a run: tables, summary and snapshots, written to and read from a folder."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fem.case import Case, describe
from fem.files import spreadsheet, staged_directory
from fem.results.bottom_history import BOTTOM_FILE, BottomHistory
from fem.results.boundary import surface_table
from fem.results.columns import BOUNDARY, HISTORY, SUMMARY, SURFACE, in_order
from fem.results.contacts import contacts_table
from fem.results.fields import FIELDS_FILE, read_fields, write_fields
from fem.results.pyrometer import PYROMETER, PYROMETER_FILE
from fem.results.snapshot import BlockGeometry, Snapshot

CASE_FILE = "case.toml"
LOG_FILE = "run.log"
HISTORY_FILE = "history.csv"
SURFACE_FILE = "surface.csv"
BOUNDARY_FILE = "boundary.csv"
CONTACTS_FILE = "contacts.csv"
SUMMARY_JSON = "summary.json"
SUMMARY_CSV = "summary.csv"
#: Of the export for ParaView; the last one is written last.
LAST_VTU_FILE = "road.pvd"
VTU_FILES = ("block_*.vtu", "road_*.vtu", "block.pvd", LAST_VTU_FILE)
FIGURES_FOLDER = "figures"
#: Files of every run.
RUN_FILES = (
    CASE_FILE,
    LOG_FILE,
    HISTORY_FILE,
    SURFACE_FILE,
    BOUNDARY_FILE,
    FIELDS_FILE,
    SUMMARY_CSV,
    SUMMARY_JSON,
)


@dataclass(frozen=True, kw_only=True, eq=False)
class Result:
    """What a simulation returns.

    Attributes
    ----------
    case : Case
        The resolved case.
    history : DataFrame
        One row per accepted step, columns of `fem.results.columns.HISTORY`.
    surface : DataFrame
        The bottom surface at the end, columns of `fem.results.columns.SURFACE`.
    boundary : DataFrame
        The free boundary at the end, columns of `fem.results.columns.BOUNDARY`.
    summary : dict
        The keys of `fem.results.columns.SUMMARY`, and a reason where the status is not "ok".
    geometry : BlockGeometry
        Reference mesh of the block.
    snapshots : list of Snapshot
        Fields at the recorded steps, the last one at the end of the run.
    log : tuple of str
        Lines of the run's log.
    bottom : BottomHistory or None
        Stick, slip and pressure along the bottom at every accepted step; none of a rigid block.
    pyrometer : DataFrame or None
        What a pyrometer reads, columns of `fem.results.pyrometer.PYROMETER`; None without one,
        and of a run that did not get to the end of its last contact.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from fem import simulate
    >>> case = Case.from_toml("examples/short.toml", {"loading.distance_mm": 0.1})
    >>> with TemporaryDirectory() as folder:
    ...     simulate(case).write(folder)
    ...     read = Result.read(folder)
    >>> float(read.history["sliding_distance_mm"].iloc[-1])
    0.1
    """

    case: Case
    history: pd.DataFrame
    surface: pd.DataFrame
    boundary: pd.DataFrame
    summary: dict[str, Any]
    geometry: BlockGeometry
    snapshots: list[Snapshot] = field(default_factory=list)
    log: tuple[str, ...] = ()
    bottom: BottomHistory | None = None
    pyrometer: pd.DataFrame | None = None

    @classmethod
    def from_rows(
        cls,
        case: Case,
        geometry: BlockGeometry,
        rows: Sequence[Mapping[str, Any]],
        boundary: pd.DataFrame,
        summary: Mapping[str, Any],
        snapshots: Sequence[Snapshot],
        log: Sequence[str] = (),
        *,
        bottom: BottomHistory | None = None,
        pyrometer: pd.DataFrame | None = None,
    ) -> Result:
        """Build a result from what the recorder collected.

        Parameters
        ----------
        rows : sequence of mappings
            One per accepted step, with at least the keys of `fem.results.columns.HISTORY`.
        boundary : DataFrame
            At least the columns of `fem.results.columns.BOUNDARY`; the surface is its bottom.
        summary : mapping
            At least the keys of `fem.results.columns.SUMMARY`.

        Raises
        ------
        ValueError
            If a column is missing or a snapshot does not fit the mesh.
        """
        for snapshot in snapshots:
            snapshot.check(geometry)
        return cls(
            case=case,
            history=_table(pd.DataFrame(list(rows)), HISTORY, "history"),
            boundary=_table(boundary, BOUNDARY, "boundary"),
            surface=_table(surface_table(boundary), SURFACE, "surface"),
            summary={key: summary[key] for key in in_order(list(summary), SUMMARY, "summary")},
            geometry=geometry,
            snapshots=list(snapshots),
            log=tuple(log),
            bottom=bottom,
            pyrometer=pyrometer,
        )

    @property
    def contacts(self) -> pd.DataFrame | None:
        """A row per contact of an event, columns of `fem.results.contacts.CONTACTS`, or None."""
        if "contact" not in self.history:
            return None
        return contacts_table(self.history, self.case.heat.ambient_C)

    def write(self, directory: str | Path) -> None:
        """Write case, log, tables, summary, fields and (if the case asks for them) VTU files.

        Everything is written into a temporary folder first; see `staged_directory`.
        """
        # Figures of an earlier result are drawn anew from this one, or they are not there.
        tables = (BOTTOM_FILE, CONTACTS_FILE, PYROMETER_FILE)
        outdated = (*VTU_FILES, *tables, f"{FIGURES_FOLDER}/*.*")
        with staged_directory(directory, outdated=outdated, last=SUMMARY_JSON) as stage:
            (stage / CASE_FILE).write_text(self.case.to_toml(), encoding="utf-8")
            (stage / LOG_FILE).write_text("".join(f"{x}\n" for x in self.log), encoding="utf-8")
            self.history.to_csv(stage / HISTORY_FILE, index=False, lineterminator="\n")
            self.surface.to_csv(stage / SURFACE_FILE, index=False, lineterminator="\n")
            self.boundary.to_csv(stage / BOUNDARY_FILE, index=False, lineterminator="\n")
            for name, table in ((CONTACTS_FILE, self.contacts), (PYROMETER_FILE, self.pyrometer)):
                if table is not None:
                    table.to_csv(stage / name, index=False, lineterminator="\n")
            if self.bottom is not None:
                self.bottom.write(stage / BOTTOM_FILE)
            write_summary(stage, self.summary)
            write_fields(stage / FIELDS_FILE, self.geometry, self.snapshots)
            if self.case.output.vtu and self.snapshots:
                from fem.results.vtu import write_vtu

                write_vtu(stage, self.geometry, self.snapshots)

    @classmethod
    def read(cls, directory: str | Path) -> Result:
        """Read a folder that `write` made, with or without VTU files.

        Raises
        ------
        ValueError
            If a file is missing or unreadable, naming it.
        """
        directory = Path(directory)
        geometry, snapshots = read_fields(directory / FIELDS_FILE)
        bottom, pyrometer = directory / BOTTOM_FILE, directory / PYROMETER_FILE
        return cls(
            case=Case.from_toml(_existing(directory / CASE_FILE)),
            history=read_table(directory / HISTORY_FILE, HISTORY),
            surface=read_table(directory / SURFACE_FILE, SURFACE),
            boundary=read_table(directory / BOUNDARY_FILE, BOUNDARY),
            summary=read_summary(directory),
            geometry=geometry,
            snapshots=snapshots,
            log=tuple(_existing(directory / LOG_FILE).read_text(encoding="utf-8").splitlines()),
            bottom=BottomHistory.read(bottom) if bottom.is_file() else None,
            pyrometer=read_table(pyrometer, PYROMETER) if pyrometer.is_file() else None,
        )


def write_summary(directory: str | Path, summary: Mapping[str, Any]) -> None:
    """Write `summary.json` and the same as the one row of `summary.csv`."""
    directory = Path(directory)
    clean = {key: plain(value) for key, value in summary.items()}
    row = {**clean, "warnings": joined(clean["warnings"])}
    for block in row.pop("blocks", []):
        number = block["block"]
        row |= {f"block_{number}_{key}": block[key] for key in block if key != "block"}
    text = json.dumps(clean, indent=2, allow_nan=False, ensure_ascii=False)
    table = spreadsheet.csv_text(pd.DataFrame([row]))
    (directory / SUMMARY_CSV).write_text(table, encoding="utf-8")
    (directory / SUMMARY_JSON).write_text(text + "\n", encoding="utf-8")


def joined(warnings: Sequence[str]) -> str:
    """The warnings of a summary in one cell of a table."""
    return " | ".join(warnings)


_NUMBER: tuple[Any, str] = (int | float | None, "a number")
#: What the entries of a summary are that are no numbers.
_KINDS: dict[str, tuple[Any, str]] = {"status": (str, "a word"), "warnings": (list, "an array")}


def read_summary(directory: str | Path) -> dict[str, Any]:
    """Read `summary.json`; a value that could not be computed is None.

    Raises
    ------
    ValueError
        If it is missing or damaged.
    """
    path = _existing(Path(directory) / SUMMARY_JSON)
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is not JSON ({error})") from None
    if not isinstance(summary, dict):
        raise ValueError(f"{path} holds {describe(summary)}, not the results of a run")
    in_order(list(summary), SUMMARY, str(path))
    for key in SUMMARY:
        kind, words = _KINDS.get(key, _NUMBER)
        if not isinstance(summary[key], kind) or isinstance(summary[key], bool):
            raise ValueError(f"{path}: {key} is {describe(summary[key])}, not {words}")
    return summary


def read_table(path: str | Path, required: tuple[str, ...]) -> pd.DataFrame:
    """Read a result table and check that its columns are there."""
    path = _existing(Path(path))
    try:
        table = pd.read_csv(path)
    except (pd.errors.ParserError, pd.errors.EmptyDataError, UnicodeDecodeError) as error:
        raise ValueError(f"{path} is not a table ({error})") from None
    return _table(table, required, str(path))


def plain(value: Any) -> Any:
    """Turn numpy numbers into Python's and what is not finite into None, which JSON can hold."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(item) for item in value]
    return value


def _table(table: pd.DataFrame, required: tuple[str, ...], name: str) -> pd.DataFrame:
    if table.empty and not len(table.columns):
        return pd.DataFrame(columns=list(required))
    return table[in_order([str(column) for column in table.columns], required, name)]


def _existing(path: Path) -> Path:
    if not path.is_file():
        raise ValueError(f"{path} is missing; expected a folder that a finished run wrote")
    return path
