"""Text that a spreadsheet program would take for a formula, made harmless."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd

_FORMULA = ("=", "+", "-", "@", "\t", "\r")


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


def table(frame: pd.DataFrame) -> pd.DataFrame:
    """The cells of a table."""
    texts = frame.select_dtypes(exclude="number").columns
    return frame.assign(**{str(name): frame[name].map(cell) for name in texts})
