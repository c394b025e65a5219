"""Tables as the text of CSV files that a spreadsheet program opens without running any of it."""

import re
from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

_FORMULA = ("=", "+", "-", "@", "\t", "\r")
_NEEDS_QUOTES = re.compile(r'[,"\r\n]')


def cell(value: Any) -> Any:
    """The value for a cell of a CSV file; text that begins like a formula gets an apostrophe.

    Spreadsheet programs run such text when they open the file. Numbers stay, written out ones too.
    """
    if not isinstance(value, str) or not value.startswith(_FORMULA):
        return value
    try:
        float(value)
    except ValueError:
        return f"'{value}"
    return value


def row(values: Mapping[str, Any]) -> dict[str, Any]:
    """The cells of a row."""
    return {key: cell(value) for key, value in values.items()}


def csv_text(table: pd.DataFrame) -> str:
    """A table with its header, without its index, as `DataFrame.to_csv` writes it.

    Each value that a column holds is written out once, however often it occurs: with a million
    rows, and words and conditions that repeat, that takes a third of the time.
    """
    columns = [_written(table.iloc[:, i]) for i in range(table.shape[1])]
    header = ",".join(_text(str(name)) for name in table.columns)
    return "\n".join([header, *map(",".join, zip(*columns, strict=True)), ""])


def _written(column: pd.Series) -> list[str]:
    """The cells of a column, empty where a value is missing."""
    if column.dtype == object and pd.api.types.infer_dtype(column) != "string":
        # Of 1, 1.0 and True only one would be written out.
        return [*map(_text, column)]
    if column.dtype == np.float64:
        # Bit by bit, for the same reason: 0.0 and -0.0.
        codes, bits = pd.factorize(column.to_numpy().view(np.int64))
        texts = [
            "" if text == "nan" else text for text in map(repr, bits.view(np.float64).tolist())
        ]
    else:
        codes, values = pd.factorize(column)
        texts = [*map(_text, values.tolist())]
    return list(np.array([*texts, ""], dtype=object)[codes])


def _text(value: Any) -> str:
    if value is None or value != value:
        return ""
    text = str(cell(value))
    return '"' + text.replace('"', '""') + '"' if _NEEDS_QUOTES.search(text) else text
