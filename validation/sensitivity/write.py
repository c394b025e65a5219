"""Runs the sensitivity study, or reads its runs, and writes table, picture and text."""

from pathlib import Path

from fem.files import write_table, write_text
from validation.drawing import save
from validation.sensitivity.table import sensitivity_table
from validation.sensitivity.text import sensitivity_text
from validation.sensitivity.tornado import draw
from validation.studies import runs_of

STUDY = "sensitivity"


def write_sensitivity(directory: Path) -> Path:
    """Write ``sensitivity.csv``, ``.png`` and ``.txt``; the text's path is returned.

    Runs that are missing in ``directory/runs`` are simulated there first.
    """
    directory = Path(directory)
    table = sensitivity_table(runs_of(STUDY, directory))
    write_table(directory / "sensitivity.csv", table)
    save(draw(table), directory / "sensitivity.png")
    path = directory / "sensitivity.txt"
    write_text(path, sensitivity_text(table))
    return path
