"""The paper's tables by number."""

from collections.abc import Callable
from pathlib import Path

from calibration import write_table1, write_table2
from validation.paper import table3, table4

#: Number of the table to the function that writes it into a folder and returns the readable file.
TABLES: dict[int, Callable[[Path], Path]] = {
    1: lambda directory: write_table1(directory)[-1],
    2: lambda directory: write_table2(directory)[-1],
    3: table3.make,
    4: table4.make,
}


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
    if number not in TABLES:
        known = ", ".join(map(str, sorted(TABLES)))
        raise ValueError(f"table {number} is not among those that can be made: {known}")
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    return TABLES[number](folder)
