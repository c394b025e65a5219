"""Text that a spreadsheet would run gets an apostrophe; numbers and other text stay."""

import numpy as np
import pandas as pd
import pytest

from fem.files import spreadsheet


@pytest.mark.parametrize("text", ["=1+1", "+cmd", "-x", "@SUM(A1)", "\t=1", "\r=1", "-1 mm"])
def test_text_that_begins_like_a_formula_is_quoted(text):
    assert spreadsheet.cell(text) == f"'{text}"


@pytest.mark.parametrize("value", ["-1.5", "+2e-3", "-inf", "run 7", "", "a=b", -1.5, None, True])
def test_numbers_and_plain_text_stay(value):
    assert spreadsheet.cell(value) is value


def test_tables_are_quoted_cell_by_cell():
    frame = pd.DataFrame({"=name": ["=x", "y"], "T_C": [-1.0, 2.0]})
    assert spreadsheet.csv_text(frame) == "'=name,T_C\n'=x,-1.0\ny,2.0\n"


def test_harmless_tables_are_written_as_pandas_writes_them():
    frame = pd.DataFrame(
        {
            "number": [1.5, np.nan, 0.0, -0.0, 0.1 + 0.2, np.inf, -1e-300, 1e22],
            "text": ["a", 'b,"c"', "d\ne", "", "a", "\r\n", "é", "nan"][::-1],
            "word": pd.Categorical(["a", "a", "b", None, "b", "a", "c", "a"]),
            "count": range(8),
            "flag": [True, False] * 4,
            "mixed": [None, 1, 1.0, True, "True", 0.0, -0.0, np.nan],
        }
    ).drop(index=2)
    for table in (frame, frame.iloc[:0]):
        assert spreadsheet.csv_text(table) == table.to_csv(index=False, lineterminator="\n")
