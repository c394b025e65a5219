"""The runs of a study's folder, and tables of them with numbers of a few digits."""

from pathlib import Path

import pandas as pd

from fem.results import SUMMARY_JSON, Result


def runs_in(directory: Path) -> list[Result]:
    """Runs that a sweep left in a folder, by the names of their own."""
    return [Result.read(path.parent) for path in sorted(directory.glob(f"runs/*/{SUMMARY_JSON}"))]


def rounded(table: pd.DataFrame, digits: int) -> pd.DataFrame:
    """The table with so many significant digits of its decimal numbers."""
    table = table.copy()
    for column in table.select_dtypes("float"):
        table[column] = [float(f"{value:.{digits}g}") for value in table[column]]
    return table
