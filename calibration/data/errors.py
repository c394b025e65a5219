"""The one error that measured data can raise."""

_LONGEST = 160


class DataError(ValueError):
    """Something in a data table that cannot be used; its text is always one line.

    Parameters
    ----------
    file : str
        The file (or "table" for a DataFrame).
    found, expected : str
        What the table holds and what it should hold.
    row : int, optional
        Line number in the file, counted from 1 with comments and header; for a DataFrame the
        number of the row counted from 1.
    column : str, optional
        Name of the column.
    """

    def __init__(
        self, *, file: str, found: str, expected: str, row: int | None = None, column: str = ""
    ) -> None:
        self.file, self.row, self.column = str(file), row, column
        self.found, self.expected = found, expected
        place = [str(file)]
        if row is not None:
            place.append(f"row {row}")
        if column:
            place.append(f"column {_shortened(column)}")
        text = f"{', '.join(place)}: found {_shortened(found)}, expected {_shortened(expected)}"
        super().__init__(" ".join("".join(c if c.isprintable() else " " for c in text).split()))


def _shortened(text: str) -> str:
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."
