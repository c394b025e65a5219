"""Blocks of a page that commands write."""

import pytest

from validation.analysis import markdown_table, with_block

BEGIN, END = "<!-- a:begin -->", "<!-- a:end -->"


def test_only_what_stands_between_the_markers_of_a_name_is_replaced():
    other = "<!-- b:begin -->\nkept\n<!-- b:end -->\n"
    page = f"before\n{other}{BEGIN}\nold\n{END}\nafter"
    assert with_block(page, "a", "new\n") == page.replace("old", "new")


@pytest.mark.parametrize("page", [f"{BEGIN}\n", f"{BEGIN}\n{END}\n{BEGIN}\n{END}", "nothing"])
def test_a_page_without_its_markers_is_refused(page):
    with pytest.raises(ValueError, match="once each"):
        with_block(page, "a", "text")


def test_a_table_has_a_line_per_row_below_its_head():
    text = markdown_table(["x", "y"], [["1", "2"]])
    assert text.splitlines() == ["| x | y |", "| --- | --- |", "| 1 | 2 |"]
