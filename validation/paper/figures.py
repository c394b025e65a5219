"""The paper's figures and tables by number."""

from collections.abc import Callable, Collection
from pathlib import Path

from calibration import write_table1, write_table2
from validation.measured import Measurements
from validation.paper import (
    fig2,
    fig3,
    fig4,
    fig6,
    fig7,
    fig8,
    fig9,
    fig10,
    fig11,
    fig12,
    table3,
    table4,
)

#: Number of the figure to the function that draws it into a folder and returns the picture's path.
#: Figures 1 and 5 of the paper are a sketch and photographs.
FIGURES: dict[int, Callable[[Path], Path]] = {
    2: fig2.make,
    3: fig3.make,
    4: fig4.make,
    6: fig6.make,
    7: fig7.make,
    8: fig8.make,
    9: fig9.make,
    10: fig10.make,
    11: fig11.make,
    12: fig12.make,
}

#: Number of the table to the function that writes it into a folder and returns the readable file.
TABLES: dict[int, Callable[[Path], Path]] = {
    1: lambda directory: write_table1(directory)[-1],
    2: lambda directory: write_table2(directory)[-1],
    3: table3.make,
    4: table4.make,
}
#: Figures that show measurements beside the simulation.
MEASURABLE: dict[int, Callable[[Path, Measurements], Path]] = {11: fig11.make, 12: fig12.make}


def make_figure(number: int, directory: str | Path, measured: Measurements | None = None) -> Path:
    """Draw a figure of the paper, with a CSV of what it shows beside it.

    Parameters
    ----------
    number : int
        One of `FIGURES`.
    directory : str or Path
        Folder of the picture; made if it does not exist.
    measured : Measurements, optional
        Drawn into those of `MEASURABLE`.

    Returns
    -------
    Path
        The PNG.
    """
    folder = _folder_for("figure", number, FIGURES, directory)
    if measured is not None and number in MEASURABLE:
        return MEASURABLE[number](folder, measured)
    return FIGURES[number](folder)


def make_table(number: int, directory: str | Path) -> Path:
    """Write a table of the paper as CSV and as readable text.

    Parameters
    ----------
    number : int
        One of `TABLES`.
    directory : str or Path
        Folder of the files; made if it does not exist.

    Returns
    -------
    Path
        The text file.
    """
    folder = _folder_for("table", number, TABLES, directory)
    return TABLES[number](folder)


def _folder_for(what: str, number: int, known: Collection[int], directory: str | Path) -> Path:
    """The folder, made if it does not exist, once it is clear that the number is known."""
    if number not in known:
        listed = ", ".join(map(str, sorted(known)))
        raise ValueError(f"{what} {number} is not among those that can be made: {listed}")
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    return folder
