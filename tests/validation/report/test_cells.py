"""CSV files become short cells without losing rows or words."""

from __future__ import annotations

import pytest

from fem.case.errors import CaseError
from validation.report.cells import is_number, read_cells, short


@pytest.mark.parametrize(
    ("cell", "shown"),
    [
        ("48.070353595", "48.07"),
        ("0.99996", "0.99996"),
        ("6.399840427888094e-15", "6.3998e-15"),
        ("-1e-05", "-1e-05"),
        ("123456.789", "123457"),
        ("300.0", "300"),
        ("2880", "2880"),
        ("0.1.0", "0.1.0"),
        ("4.2 and 4.3", "4.2 and 4.3"),
        ("nan", "nan"),
        ("", ""),
    ],
)
def test_decimals_get_five_digits_and_everything_else_stays(cell, shown):
    assert short(cell) == shown


def test_commas_quotes_and_line_breaks_inside_a_cell_survive(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text('a,b\n"x, ""y""\nz",1\n', encoding="utf-8")
    assert read_cells(path).rows == (('x, "y"\nz', "1"),)


def test_rows_of_another_width_are_made_to_fit(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("a,b\n1\n1,2,3\n\n")
    assert read_cells(path).rows == (("1", ""), ("1", "2"))


def test_an_empty_file_is_a_table_without_columns(tmp_path):
    path = tmp_path / "t.csv"
    path.touch()
    assert read_cells(path).columns == ()


def test_columns_can_be_left_out_and_asked_for(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("a,b,c\n1,2,3\n4,5,6\n")
    table = read_cells(path)
    assert table.without("b").rows == (("1", "3"), ("4", "6"))
    assert table.column("c") == ["3", "6"]
    assert table.column("d") == []
    assert table.records[1] == {"a": "4", "b": "5", "c": "6"}


@pytest.mark.parametrize(("cell", "number"), [("-1.5e3", True), ("−0.2", True), ("4.2 K", False)])
def test_what_is_set_flush_right(cell, number):
    assert is_number(cell) is number


@pytest.mark.parametrize("content", [b"a,b\n\xff\xfe,1\n", b"a\n" + b"x" * 140_000])
def test_a_file_that_is_no_table_is_refused_in_one_line(content, tmp_path):
    path = tmp_path / "claims.csv"
    path.write_bytes(content)
    with pytest.raises(CaseError, match=r"claims\.csv: content: found no table") as error:
        read_cells(path)
    assert "\n" not in str(error.value)
