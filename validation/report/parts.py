"""The parts of a report as they lie in a folder of figures, and those that are missing."""

import base64
from dataclasses import dataclass
from pathlib import Path

from validation.report.cells import CellTable, read_cells


@dataclass(frozen=True, kw_only=True)
class Part:
    """A picture, tables, a note: any of them may be absent, and all of them are if it is missing.

    Attributes
    ----------
    anchor, title, caption : str
        Its place on the page, its heading, and what it shows.
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
    tables = [table for path in stated if path.is_file() and (table := read_cells(path)).columns]
    # What is compared with the paper comes before what goes beyond it.
    tables.sort(key=lambda table: not any("paper" in column for column in table.columns))
    picture = directory / f"{anchor}.png"
    return Part(
        anchor=anchor,
        title=title,
        caption=caption,
        command=f"make {anchor}",
        picture=base64.b64encode(picture.read_bytes()).decode() if picture.is_file() else "",
        tables=tuple(tables),
        note=first_paragraph(directory / f"{anchor}.txt"),
    )


def first_paragraph(path: Path) -> str:
    """Text before the first empty line; nothing if there is no such file."""
    if not path.is_file():
        return ""
    return " ".join(path.read_text(encoding="utf-8", errors="replace").split("\n\n")[0].split())
