"""Reading of measured tables, with every refusal naming file, row and column."""

import csv
import difflib
import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from calibration.errors import DataError

Array = NDArray[np.float64]
ABSOLUTE_ZERO_C = -273.15


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
    """

    frame: pd.DataFrame
    file: str
    rows: NDArray[np.int64]
    sha256: str

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

    def numbers(self, column: str) -> Array:
        """Values of a column as finite numbers."""
        text = self.frame[column]
        values = pd.to_numeric(text, errors="coerce").to_numpy(dtype=float)
        bad = np.flatnonzero(~np.isfinite(values))
        if bad.size:
            entry = str(text.iloc[bad[0]]).strip()
            self.refuse_at(bad[0], column, repr(entry) if entry else "nothing", "a finite number")
        return values

    def words(self, column: str, allowed: Sequence[str]) -> NDArray[np.str_]:
        """Values of a column that must be one of the allowed words."""
        values = np.array([str(v).strip() for v in self.frame[column]], dtype=str)
        bad = np.flatnonzero(~np.isin(values, allowed))
        if bad.size:
            self.refuse_at(
                bad[0], column, repr(str(values[bad[0]])), f"one of {', '.join(allowed)}"
            )
        return values

    def require_all(self, column: str, valid: NDArray[np.bool_], expected: str) -> None:
        """Refuse the first row where `valid` is false."""
        bad = np.flatnonzero(~valid)
        if bad.size:
            entry = str(self.frame[column].iloc[bad[0]]).strip()
            self.refuse_at(bad[0], column, entry or "nothing", expected)

    def select(self, keep: NDArray[np.bool_]) -> "Table":
        """The rows where `keep` is true."""
        return Table(
            frame=self.frame[keep].reset_index(drop=True),
            file=self.file,
            rows=self.rows[keep],
            sha256=self.sha256,
        )

    def refuse_at(self, index: int, column: str, found: str, expected: str) -> None:
        self.refuse(row=int(self.rows[index]), column=column, found=found, expected=expected)

    def refuse(
        self, *, found: str, expected: str, row: int | None = None, column: str = ""
    ) -> None:
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
        Comma-separated UTF-8 with a header line; empty lines and those after # are skipped.
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
    file = str(path)
    try:
        content = path.read_bytes()
    except OSError as error:
        reason = error.strerror or str(error)
        raise DataError(file=file, found=reason, expected="a readable CSV file") from None
    try:
        lines = content.decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise DataError(
            file=file, found="bytes that are no UTF-8 text", expected="a CSV file"
        ) from None
    numbered = [
        (number, line)
        for number, line in enumerate(lines, 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not numbered:
        raise DataError(file=file, found="no header line", expected="a CSV file with a header")
    entries = list(csv.reader(line for _, line in numbered))
    header = [name.strip() for name in entries[0]]
    rows = np.array([number for number, _ in numbered], dtype=np.int64)
    _check_shape(file, header, entries, rows)
    frame = pd.DataFrame(entries[1:], columns=header, dtype=str)
    frame.attrs["header_row"] = int(rows[0])
    return Table(frame=frame, file=file, rows=rows[1:], sha256=hashlib.sha256(content).hexdigest())


def _check_shape(
    file: str, header: list[str], entries: list[list[str]], rows: NDArray[np.int64]
) -> None:
    if len(set(header)) != len(header):
        twice = next(name for name in header if header.count(name) > 1)
        raise DataError(
            file=file, row=int(rows[0]), column=twice, found="the name twice", expected="it once"
        )
    for row, entry in zip(rows[1:], entries[1:], strict=True):
        if len(entry) != len(header):
            raise DataError(
                file=file,
                row=int(row),
                found=f"{len(entry)} comma-separated entries",
                expected=f"{len(header)} as in the header",
            )
