"""Tables of the paper: what is read back from defaults, and forces against the published ones."""

from __future__ import annotations

import math

import pandas as pd
import pytest

from tests.validation.made_up_run import made_up_run
from validation.paper.figures import TABLES, make_table
from validation.paper.table4 import PAPER_N_PER_MM, force_table


def test_table_3_holds_the_papers_numbers(tmp_path):
    path = make_table(3, tmp_path / "tables")
    table = pd.read_csv(path.with_suffix(".csv")).set_index("parameter")
    assert table["rubber"].to_dict() == {
        "d1": 43.1,
        "d2": 509.4,
        "density": 1207.0,
        "conductivity": 0.284,
        "specific heat": 1.45,
    }
    assert table["asphalt"].iloc[2:].tolist() == [2000.0, 0.70, 0.92]
    assert "kJ/(kg K)" in path.read_text()


def test_table_4_compares_with_the_published_forces():
    runs = [made_up_run(rubber__compound=name) for name in list(PAPER_N_PER_MM)[:2]]
    table = force_table(runs).set_index("set")
    assert table.loc["van der Waals, bars, series 1", "computed_N_per_mm"] == 4.5
    assert table.loc["van der Waals, bars, series 1", "difference_percent"] == pytest.approx(
        100.0 * (4.5 / 4.56 - 1.0)
    )
    assert table.loc["Yeoh, bars, series 2", "status"] == "not run"
    assert math.isnan(table.loc["Yeoh, bars, series 2", "difference_percent"])


def test_tables_1_and_2_come_from_the_calibration(tmp_path):
    text = make_table(2, tmp_path).read_text()
    assert "SYNTHETIC" in text
    assert {1, 2, 3, 4} == set(TABLES)


def test_an_unknown_table_is_refused(tmp_path):
    with pytest.raises(ValueError, match="table 5 is not among .*1, 2, 3, 4"):
        make_table(5, tmp_path)
