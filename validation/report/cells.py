"""CSV files as tables of short cells: numbers to five digits, words as they are."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

from fem.case import CaseError

_DECIMAL = re.compile(r"[+-]?(\d+\.\d*|\.\d+|\d+(?=[eE]))([eE][+-]?\d+)?")


@dataclass(frozen=True, kw_only=True)
class CellTable:
    """A table ready to be shown.

    Attributes
    ----------
    name : str
        Of the file it came from.
    columns : tuple of str
        Column names as in the file, units included.
    rows : tuple of tuple of str
        One text per column.
    """

    name: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def column(self, name: str) -> list[str]:
        """Cells of a column; none if the table has no such column."""
        if name not in self.columns:
            return []
        place = self.columns.index(name)
        return [row[place] for row in self.rows]

    @property
    def records(self) -> list[dict[str, str]]:
        """Rows as dictionaries of column to cell."""
        return [dict(zip(self.columns, row, strict=True)) for row in self.rows]

    def without(self, *names: str) -> CellTable:
        """Leave out columns."""
        kept = [i for i, name in enumerate(self.columns) if name not in names]
        columns, *rows = (tuple(row[i] for i in kept) for row in (self.columns, *self.rows))
        return CellTable(name=self.name, columns=columns, rows=tuple(rows))


def read_cells(path: Path) -> CellTable:
    """Read a CSV file with a header line; short rows are filled up, long ones cut.

    Raises
    ------
    CaseError
        If it is no such file.
    """
    try:
        with path.open(encoding="utf-8", newline="") as file:
            lines = [line for line in csv.reader(file) if line]
    except (UnicodeDecodeError, csv.Error) as error:
        found, expected = f"no table in UTF-8 ({error})", "what the program wrote (make it again)"
        raise CaseError(str(path), "content", found, expected) from None
    columns = tuple(lines[0]) if lines else ()
    width = len(columns)
    filled = ([*line, *[""] * width][:width] for line in lines[1:])
    rows = tuple(tuple(map(short, line)) for line in filled)
    return CellTable(name=path.name, columns=columns, rows=rows)


def short(cell: str) -> str:
    """Round a decimal number to five digits; whole numbers and words stay."""
    if not _DECIMAL.fullmatch(cell):
        return cell
    value = float(cell)
    return f"{value:.0f}" if 1e5 <= abs(value) < 1e7 else f"{value:.5g}"


def is_number(cell: str) -> bool:
    """Whether a cell is set like a number: flush right."""
    try:
        float(cell.replace("−", "-"))
    except ValueError:
        return False
    return True
