"""Text that a spreadsheet would run gets an apostrophe; numbers and other text stay."""

import pandas as pd
import pytest

from fem import spreadsheet


@pytest.mark.parametrize("text", ["=1+1", "+cmd", "-x", "@SUM(A1)", "\t=1", "\r=1", "-1 mm"])
def test_text_that_begins_like_a_formula_is_quoted(text):
    assert spreadsheet.cell(text) == f"'{text}"


@pytest.mark.parametrize("value", ["-1.5", "+2e-3", "-inf", "run 7", "", "a=b", -1.5, None, True])
def test_numbers_and_plain_text_stay(value):
    assert spreadsheet.cell(value) is value


def test_tables_are_quoted_cell_by_cell():
    frame = pd.DataFrame({"run": ["=x", "y"], "T_C": [-1.0, 2.0]})
    assert spreadsheet.table(frame).to_csv(index=False) == "run,T_C\n'=x,-1.0\ny,2.0\n"
