"""From the bytes of a table file to its cells, as measuring programs and spreadsheets write them.

Read are UTF-8, UTF-16 and Windows Latin-1; commas, semicolons or tabs between columns; decimal
commas where they cannot be thousands; a header with units in brackets, in other capitals, behind
a # or below lines of metadata. What had to be understood is told in `Cells.notes`; what cannot
be understood raises `DataError`.
"""

from __future__ import annotations

import csv
import re
import stat
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import numpy as np

from calibration.data.errors import DataError
from materials.arrays import IntArray
from materials.plausible import COLUMNS

#: Every column that some reader knows: what a header may be recognised by.
KNOWN_COLUMNS = (
    *COLUMNS,
    *("stretch", "nominal_stress_N_per_mm2", "mode", "cycle", "branch"),
    *("aT", "log10_aT", "tan_delta", "sigma_K", "run", "compound", "law"),
)
_SEPARATORS = {";": "semicolons", "\t": "tabs", ",": "commas"}
_SIGNATURES = {
    b"PK\x03\x04": "an Excel workbook or zip archive",
    b"\xd0\xcf\x11\xe0": "an old Excel workbook",
    b"\x1f\x8b": "a gzip archive",
    b"BZh": "a bzip2 archive",
    b"\xfd7zXZ": "an xz archive",
    b"%PDF": "a PDF",
    b"PAR1": "a Parquet file",
    b"\x89PNG": "a picture",
}
_BLANK = " \t;,\ufeff\xa0"
#: Beyond that many lines no header is looked for.
_HEADER_LINES = 200
_CONTROL = re.compile("[\x00-\x08\x0e-\x1f\x7f]")
_QUOTED = re.compile(r'"[^"]*"')
_UNIT = re.compile(r"^(.*?)\s*[\[(]([^\[\]()]*(?:\([^()]*\))?[^\[\]()]*)[\])]$")
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?")
_DECIMAL_POINT = re.compile(r"[+-]?(?:\d+\.\d*|\.\d+)(?:[eE][+-]?\d+)?")
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")


@dataclass(frozen=True, kw_only=True)
class Cells:
    """The cells of a table file as text.

    Attributes
    ----------
    columns : dict of str to list of str
        Entries by name, without surrounding spaces.
    header_row : int
        Line of the header, counted from 1.
    rows : (n,) int array
        Line on which each row begins.
    notes : tuple of str
        What was understood rather than read.
    """

    columns: dict[str, list[str]]
    header_row: int
    rows: IntArray
    notes: tuple[str, ...]


def read_bytes(path: Path, what: str = "CSV file") -> bytes:
    """Content of a file of data; devices and pipes, which may never end, are refused."""
    try:
        kind = path.stat().st_mode
        if stat.S_ISREG(kind) or stat.S_ISDIR(kind):
            return path.read_bytes()
    except OSError as error:
        _refuse(str(path), error.strerror or str(error), f"a readable {what}")
    except ValueError as error:
        _refuse(str(path), str(error), "the name of a file")
    _refuse(str(path), "a device or a pipe", f"a {what}")


def read_cells(content: bytes, file: str) -> Cells:
    """Split the content of a table file into its cells.

    Raises
    ------
    DataError
        Naming file, row, what was found and what was expected.
    """
    text, notes = _decoded(content, file)
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    header_at, separator, remark = _header(lines, file)
    notes += remark
    first, end, header = next(_records(lines, header_at, separator, file))
    names, renamed = _names(header, first + 1, file)
    rows, entries = _rows(lines, end, names, separator, file)
    columns = dict(zip(names, entries, strict=True))
    if separator != "," or '"' in text:
        columns, remark = _with_points(columns, rows, file)
        notes += remark
    numbers = np.array(rows, dtype=np.int64)
    return Cells(columns=columns, header_row=first + 1, rows=numbers, notes=tuple(notes + renamed))


def _refuse(
    file: str, found: str, expected: str, *, row: int | None = None, column: str = ""
) -> NoReturn:
    raise DataError(file=file, row=row, column=column, found=found, expected=expected) from None


def _decoded(content: bytes, file: str) -> tuple[str, list[str]]:
    """The text, and how it was decoded if not as UTF-8."""
    for signature, what in _SIGNATURES.items():
        if content.startswith(signature):
            _refuse(file, what, "a CSV file (text)")
    encoding, note = _encoding(content)
    with suppress(UnicodeDecodeError):
        text = content.decode(encoding)
        if not _CONTROL.search(text):
            return text, [note] if note else []
    _refuse(file, "bytes that are no text", "a CSV file in UTF-8")


def _encoding(content: bytes) -> tuple[str, str]:
    start = content[:400]
    if start.startswith((b"\xff\xfe", b"\xfe\xff")):
        return "utf-16", "read as UTF-16"
    if len(start) > 3 and not any(start[1::2]) and all(start[0::2]):
        return "utf-16-le", "read as UTF-16"
    if len(start) > 3 and not any(start[0::2]) and all(start[1::2]):
        return "utf-16-be", "read as UTF-16"
    try:
        content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return "cp1252", "no UTF-8: read as Latin-1 (Windows-1252)"
    return "utf-8-sig", ""


def _header(lines: list[str], file: str) -> tuple[int, str, list[str]]:
    """Index of the header's line, the separator, and what there is to say of them."""
    filled = [i for i, line in enumerate(lines) if line.strip(_BLANK)][:_HEADER_LINES]
    plain = [i for i in filled if not _is_comment(lines[i])]
    known = [i for i in plain if _known_names(lines[i])]
    above = [i for i in filled if _is_comment(lines[i]) and _all_known(lines[i])]
    notes = []
    if known:
        at = known[0]
        if at != plain[0]:
            notes.append(f"left out the lines before the header in line {at + 1}")
    elif above:
        at = above[-1]
        lines[at] = lines[at].lstrip("# \t")
        notes.append(f"header read from the comment in line {at + 1}")
    elif plain:
        at = plain[0]
    else:
        _refuse(file, "no header line", "a CSV file with a header")
    separator = _separator(lines[at])
    if separator == " ":
        lines[at:] = [line if _nothing(line) else "\t".join(line.split()) for line in lines[at:]]
        notes.append("read with spaces between the columns")
        return at, "\t", notes
    if separator != ",":
        notes.append(f"read with {_SEPARATORS[separator]} between the columns")
    return at, separator, notes


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith("#")


def _separator(line: str) -> str:
    bare = _QUOTED.sub("", line)
    found = next((sign for sign in _SEPARATORS if sign in bare), "")
    spaced = not found and sum(word in KNOWN_COLUMNS for word in bare.split()) > 1
    return found or (" " if spaced else ",")


def _split(line: str) -> list[str]:
    separator = _separator(line)
    return [cell.strip(' "') for cell in line.split(None if separator == " " else separator)]


def _known_names(line: str) -> int:
    return sum(_canonical(cell) in _CANONICAL for cell in _split(line))


def _all_known(line: str) -> bool:
    cells = _split(line.lstrip("# \t"))
    return sum(_canonical(cell) in _CANONICAL for cell in cells) == len(cells) > 1


def _canonical(name: str) -> str:
    """A column's name in one spelling: ``T [°C]`` and ``t_c`` are the same."""
    name = name.strip()
    with_unit = _UNIT.match(name)
    if with_unit:
        unit = with_unit[2].translate(_UNIT_SIGNS).replace("/", "_per_")
        name = f"{with_unit[1]}_{unit}" if unit.strip(" -1") else with_unit[1]
    name = re.sub(r"[\s_]+", "_", name.lower()).strip("_")
    return re.sub(r"_mpa$", "_n_per_mm2", name)


_UNIT_SIGNS = str.maketrans({"²": "2", "³": "3", "^": "", "°": "", "º": "", "·": "", "*": ""})
_CANONICAL: dict[str, list[str]] = {}
for _name in KNOWN_COLUMNS:
    _CANONICAL.setdefault(_canonical(_name), []).append(_name)


def _meant(name: str) -> str:
    """The known column that a name in a header stands for; the name itself where there is none."""
    found = [known for known in _CANONICAL.get(_canonical(name), []) if known[0] == name[0]]
    return (found or _CANONICAL.get(_canonical(name), [name]))[0]


def _nothing(line: str) -> bool:
    bare = line.strip(_BLANK)
    return not bare or bare[0] == "#"


def _records(
    lines: list[str], start: int, separator: str, file: str
) -> Iterator[tuple[int, int, list[str]]]:
    """First line and the one after the last of each record (from 0), and its cells.

    At the beginning of a record empty lines and comments are skipped; inside a quoted cell every
    line counts.
    """
    first, at, begins = start, start, True

    def source() -> Iterator[str]:
        nonlocal first, at, begins
        while True:
            if begins:
                while at < len(lines) and _nothing(lines[at]):
                    at += 1
                first, begins = at, False
            if at >= len(lines):
                return
            at += 1
            yield lines[at - 1] + "\n"

    try:
        for cells in csv.reader(source(), delimiter=separator, strict=True, skipinitialspace=True):
            yield first, at, cells
            begins = True
    except csv.Error as error:
        found, expected = f"a cell that cannot be read ({error})", "quotes in pairs"
        if "unexpected end" in str(error):
            found = "a quote that is never closed"
        elif "field limit" in str(error):
            limit = csv.field_size_limit()
            found, expected = f"a cell of more than {limit} characters", "a short cell"
        _refuse(file, found, expected, row=first + 1)


def _names(header: list[str], row: int, file: str) -> tuple[list[str], list[str]]:
    """Names of the columns, those that are meant for known ones replaced, and what was replaced."""
    cleaned = [" ".join(name.split()) for name in header]
    names, notes = [], []
    for number, name in enumerate(cleaned, 1):
        meant = _meant(name)
        if meant != name and meant not in cleaned:
            notes.append(f"column {name} read as {meant}")
        else:
            meant = name
        names.append(meant or f"(column {number})")
    for name in names:
        if names.count(name) > 1:
            _refuse(file, "the name twice", "it once", row=row, column=name)
    return names, notes


def _rows(
    lines: list[str], start: int, names: list[str], separator: str, file: str
) -> tuple[list[int], list[list[str]]]:
    """Line numbers of the rows, and the entries by column; rows without an entry are left out."""
    width = len(names)
    rows: list[int] = []
    flat: list[str] = []  # one list, as a million small ones keep the garbage collector busy
    if any('"' in line for line in lines):
        for first, _, cells in _records(lines, start, separator, file):
            if any(map(str.strip, cells)):
                rows.append(first + 1)
                flat += _fitted(cells, first + 1, names, separator, file)
    else:
        kept = [i for i in range(start, len(lines)) if not _nothing(lines[i])]
        for i in kept:
            if lines[i].count(separator) != width - 1:
                cells = lines[i].split(separator)
                lines[i] = separator.join(_fitted(cells, i + 1, names, separator, file))
        rows = [i + 1 for i in kept]
        flat = separator.join([lines[i] for i in kept]).split(separator) if kept else []
    return rows, [list(map(str.strip, flat[k::width])) for k in range(width)]


def _fitted(cells: list[str], row: int, names: list[str], separator: str, file: str) -> list[str]:
    """The cells without empty ones at the end, or with them where the columns have no names."""
    width = len(names)
    while len(cells) > width and not cells[-1].strip():
        cells = cells[:-1]
    missing = names[len(cells) :]
    if all(name.startswith("(column ") for name in missing):
        cells = cells + [""] * len(missing)
    if len(cells) == width:
        return cells
    kind = {",": "comma-separated", ";": "semicolon-separated", "\t": "tab-separated"}[separator]
    expected = f"{width} as in the header"
    if separator == "," and len(cells) > width:
        expected += " (decimal commas need ; between the columns)"
    _refuse(file, f"{len(cells)} {kind} entries", expected, row=row)


def _with_points(
    columns: dict[str, list[str]], rows: list[int], file: str
) -> tuple[dict[str, list[str]], list[str]]:
    """The columns with decimal points for decimal commas, where these cannot be anything else."""
    commas = {
        name: [i for i, cell in enumerate(cells) if "," in cell and _DECIMAL_COMMA.fullmatch(cell)]
        for name, cells in columns.items()
    }
    if not any(commas.values()):
        return columns, []
    expected = ""
    if any(_DECIMAL_POINT.fullmatch(cell) for cells in columns.values() for cell in cells):
        expected = "decimal points or decimal commas, not both"
    elif all(_THOUSANDS.fullmatch(columns[name][i]) for name, at in commas.items() for i in at):
        expected = "a decimal point (this may be a comma of thousands)"
    if expected:
        name, first = next((name, at[0]) for name, at in commas.items() if at)
        _refuse(file, repr(columns[name][first]), expected, row=rows[first], column=name)
    changed = {
        name: [c.replace(",", ".") if _DECIMAL_COMMA.fullmatch(c) else c for c in cells]
        if commas[name]
        else cells
        for name, cells in columns.items()
    }
    return changed, ["read with decimal commas"]
