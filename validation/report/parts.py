"""The parts of a report as they lie in a folder of figures, and those that are missing."""

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from validation.report.cells import CellTable, read_cells


@dataclass(frozen=True, kw_only=True)
class Part:
    """A picture, tables, a note: any of them may be absent, and all of them are if it is missing.

    Attributes
    ----------
    anchor : str
        Its place on the page.
    title : str
        Heading.
    caption : str
        What it shows.
    command : str
        What makes it.
    picture : str
        PNG in base 64, or empty.
    tables : tuple of CellTable
    note : str
        Paragraph from the text file beside it, or empty.
    """

    anchor: str
    title: str
    caption: str = ""
    command: str
    picture: str = ""
    tables: tuple[CellTable, ...] = ()
    note: str = ""

    @property
    def missing(self) -> bool:
        """Whether there is nothing to show."""
        return not (self.picture or self.tables)


def find_part(directory: Path, anchor: str, title: str, caption: str = "") -> Part:
    """The part whose files in a folder begin with its anchor; `make ANCHOR` makes it.

    Tables of the paper have all of their CSV files, figures only the picture.
    """
    stated = [] if anchor.startswith("fig") else sorted(directory.glob(f"{anchor}[._]*csv"))
    return Part(
        anchor=anchor,
        title=title,
        caption=caption,
        command=f"make {anchor}",
        picture=_picture(directory / f"{anchor}.png"),
        tables=_papers_first(_tables(stated)),
        note=first_paragraph(directory / f"{anchor}.txt"),
    )


def first_paragraph(path: Path) -> str:
    """Text before the first empty line; nothing if there is no such file."""
    if not path.is_file():
        return ""
    return " ".join(path.read_text(encoding="utf-8", errors="replace").split("\n\n")[0].split())


def _picture(path: Path) -> str:
    return base64.b64encode(path.read_bytes()).decode("ascii") if path.is_file() else ""


def _papers_first(tables: tuple[CellTable, ...]) -> tuple[CellTable, ...]:
    """Put what is compared with the paper before what goes beyond it."""
    return tuple(sorted(tables, key=lambda table: not any("paper" in c for c in table.columns)))


def _tables(paths: Sequence[Path]) -> tuple[CellTable, ...]:
    found = (read_cells(path) for path in paths if path.is_file())
    return tuple(table for table in found if table.columns)
