"""Reading of measured tables, with every refusal naming file, row and column."""

import difflib
import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
import pandas as pd

from calibration.data.errors import DataError
from calibration.data.table_text import read_bytes, read_cells
from materials.arrays import BoolArray, FloatArray, IntArray, WordArray
from materials.plausible import COLUMNS, Quantity, judge


@dataclass(frozen=True, kw_only=True)
class Table:
    """A table of measurements that remembers where its rows came from.

    Parameters
    ----------
    frame : DataFrame
        The columns as they were read (text until `numbers` is asked for).
    file : str
        Name of the file, or "table".
    rows : ndarray of int
        Row number of every entry, as a user would find it.
    sha256 : str
        Hash of the file's content.
    notes : list of str
        How the file was understood, where it was not plain CSV.
    unusual : list of str
        Numbers outside their usual range, found by `numbers` and `judge`; shared with the tables
        that `select` makes of this one.
    """

    frame: pd.DataFrame
    file: str
    rows: IntArray
    sha256: str
    notes: list[str] = field(default_factory=list)
    unusual: list[str] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.frame)

    def has(self, column: str) -> bool:
        return column in self.frame.columns

    def require(self, columns: Sequence[str]) -> None:
        """Refuse the table unless it holds the columns."""
        for column in columns:
            if not self.has(column):
                found = ", ".join(map(str, self.frame.columns)) or "no columns"
                near = difflib.get_close_matches(column, map(str, self.frame.columns), n=1)
                hint = f" (rename {near[0]}?)" if near else ""
                self.refuse(
                    row=self._header_row,
                    column=column,
                    found=f"the columns {found}",
                    expected=f"a column named {column}{hint}",
                )

    @property
    def origin(self) -> dict[str, Any]:
        """What a result file says of its data: file, hash, how it was read, what is unusual."""
        said = {"reading": self.notes, "unusual": self.unusual}
        found = {key: list(lines) for key, lines in said.items() if lines}
        return {"data_file": self.file, "data_sha256": self.sha256, **found}

    def judge(self, column: str, values: FloatArray, quantity: Quantity) -> None:
        """Refuse impossible numbers and keep unusual ones in `unusual`, by `materials.plausible`.

        `values` has an entry per row; `numbers` does this for the columns it knows.
        """
        finding = judge(values, quantity)
        if finding is None:
            return
        if finding.impossible:
            entry = str(self.frame[column].iloc[finding.index])
            likely = f", which {finding.likely}" if finding.likely else ""
            self.refuse_at(finding.index, column, entry + likely, finding.expected)
        line = f"row {self.rows[finding.index]}, column {column}: {finding.sentence}"
        if line not in self.unusual:
            self.unusual.append(line)

    def numbers(self, column: str, quantity: Quantity | None = None) -> FloatArray:
        """Values of a column as finite numbers within the physical range of what they are.

        Parameters
        ----------
        column : str
            Name of the column.
        quantity : Quantity, optional
            What the column holds; default what `materials.plausible.COLUMNS` says, else anything.
        """
        text = self.frame[column]
        values = pd.to_numeric(text, errors="coerce").to_numpy(dtype=float)
        bad = np.flatnonzero(~np.isfinite(values))
        if bad.size:
            entry = str(text.iloc[bad[0]]).strip()
            self.refuse_at(bad[0], column, repr(entry) if entry else "nothing", "a finite number")
        kind = quantity or COLUMNS.get(column)
        if kind is not None:
            self.judge(column, values, kind)
        return values

    def words(self, column: str, allowed: Sequence[str]) -> WordArray:
        """Values of a column that must be one of the allowed words."""
        values = np.array([str(v).strip() for v in self.frame[column]], dtype=str)
        bad = np.flatnonzero(~np.isin(values, allowed))
        if bad.size:
            self.refuse_at(
                bad[0], column, repr(str(values[bad[0]])), f"one of {', '.join(allowed)}"
            )
        return values

    def require_all(self, column: str, valid: BoolArray, expected: str) -> None:
        """Refuse the first row where `valid` is false."""
        bad = np.flatnonzero(~valid)
        if bad.size:
            entry = str(self.frame[column].iloc[bad[0]]).strip()
            self.refuse_at(bad[0], column, entry or "nothing", expected)

    def select(self, keep: BoolArray) -> "Table":
        """The rows where `keep` is true."""
        return replace(self, frame=self.frame[keep].reset_index(drop=True), rows=self.rows[keep])

    def refuse_at(self, index: int, column: str, found: str, expected: str) -> NoReturn:
        self.refuse(row=int(self.rows[index]), column=column, found=found, expected=expected)

    def refuse(
        self, *, found: str, expected: str, row: int | None = None, column: str = ""
    ) -> NoReturn:
        raise DataError(file=self.file, row=row, column=column, found=found, expected=expected)

    def require_rows(self, least: int, purpose: str) -> None:
        """Refuse the table if it holds fewer rows than the fit has parameters."""
        if len(self) < least:
            last = int(self.rows[-1]) if len(self) else None
            self.refuse(
                row=last,
                found=f"{len(self)} usable point{'' if len(self) == 1 else 's'}",
                expected=f"at least {least} for {purpose}",
            )

    @property
    def _header_row(self) -> int | None:
        return None if self.file == "table" else int(self.frame.attrs.get("header_row", 1))


def read_table(source: str | Path | pd.DataFrame, columns: Sequence[str]) -> Table:
    """Read a CSV file, or take a DataFrame, and require its columns.

    Parameters
    ----------
    source : path or DataFrame
        CSV with a header line (see `calibration.data.table_text` for the variants); empty lines and
        those after # are skipped.
    columns : sequence of str
        Columns that must be there; others are kept.
    """
    if isinstance(source, pd.DataFrame):
        content = source.to_csv(index=False).encode()
        table = Table(
            frame=source.reset_index(drop=True),
            file="table",
            rows=np.arange(1, len(source) + 1),
            sha256=hashlib.sha256(content).hexdigest(),
        )
    else:
        table = _read_csv(Path(source))
    table.require(columns)
    if not len(table):
        table.refuse(found="no rows of data", expected=f"rows of {', '.join(columns)}")
    return table


def _read_csv(path: Path) -> Table:
    content = read_bytes(path)
    cells = read_cells(content, str(path))
    frame = pd.DataFrame(cells.columns, dtype=object)
    frame.attrs["header_row"] = cells.header_row
    return Table(
        frame=frame,
        file=str(path),
        rows=cells.rows,
        sha256=hashlib.sha256(content).hexdigest(),
        notes=list(cells.notes),
    )
