"""The parts of a report as they lie in a folder of figures, and those that are missing."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from validation.report.captions import FIGURES, TABLES
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


def figure_parts(directory: Path) -> list[Part]:
    """Figures of the paper."""
    return [
        Part(
            anchor=f"fig{number}",
            title=f"Figure {number}",
            caption=caption,
            command=f"make fig{number}",
            picture=_picture(directory / f"fig{number}.png"),
        )
        for number, caption in FIGURES.items()
    ]


def table_parts(directory: Path) -> list[Part]:
    """Tables of the paper, each with all of its CSV files and the first paragraph of its text."""
    return [
        Part(
            anchor=f"table{number}",
            title=f"Table {number}",
            caption=caption,
            command=f"make table{number}",
            tables=_papers_first(_tables(sorted(directory.glob(f"table{number}[._]*csv")))),
            note=first_paragraph(directory / f"table{number}.txt"),
        )
        for number, caption in TABLES.items()
    ]


def claims_part(directory: Path) -> Part:
    """The paper's statements, checked."""
    return Part(
        anchor="claims",
        title="The paper's claims",
        command="make claims",
        tables=_tables([directory / "claims.csv"]),
    )


def sensitivity_part(directory: Path) -> Part:
    """The study of what the paper leaves open."""
    return Part(
        anchor="sensitivity",
        title="Sensitivity",
        caption="One parameter at a time: what the paper leaves open, and numerical settings on "
        "which the results should not depend. The strongest influence on T_max comes first.",
        command="make sensitivity",
        picture=_picture(directory / "sensitivity.png"),
        tables=_tables([directory / "sensitivity.csv"]),
        note=first_paragraph(directory / "sensitivity.txt"),
    )


def robustness_part(path: Path) -> Part:
    """The table of the robustness study, which lies beside the studies."""
    return Part(
        anchor="robustness",
        title="Robustness",
        caption="All parameter sets, friction coefficients from 0.3 to 1.2 and both friction laws, "
        "pressures from 0.1 to 0.5 N/mm²: one set of solver settings, 40 mm of sliding.",
        command="make robustness",
        tables=_tables([path]),
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
