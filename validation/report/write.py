"""Writes the report."""

from __future__ import annotations

from pathlib import Path

from fem.files import write_text
from validation.report.made_with import made_with
from validation.report.page import find_page, render


def write_report(directory: Path, path: Path) -> Path:
    """Write everything that lies in a folder of figures into one HTML file.

    Parameters
    ----------
    directory : Path
        Folder of figures, tables, claims and sensitivity; the introductory run is looked for
        inside it and beside it. What is missing is named on the page with what makes it.
    path : Path
        The file; it is replaced only when the new one is complete.

    Returns
    -------
    Path
        The file.
    """
    write_text(path, render(find_page(Path(directory), made_with())))
    return Path(path)
