"""Result tables and summaries: complete, with the right names, valid and readable again."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pandas as pd
import pytest

from fem.results.columns import BOUNDARY, HISTORY, SUMMARY, SURFACE
from fem.results.result import Result, read_summary, write_summary
from tests.made_up_result import made_up_result, made_up_summary


@pytest.fixture(scope="module")
def result() -> Result:
    return made_up_result()


def from_parts(result: Result, **changed: object) -> Result:
    parts: dict = {
        "case": result.case,
        "geometry": result.geometry,
        "rows": result.history.to_dict("records"),
        "boundary": result.boundary,
        "summary": result.summary,
        "snapshots": result.snapshots,
    }
    return Result.from_rows(**(parts | changed))


def test_a_written_result_has_all_files_with_the_required_columns_first(result, tmp_path):
    result.write(tmp_path / "run")
    names = {path.name for path in (tmp_path / "run").iterdir()}
    assert names == {
        "case.toml",
        "run.log",
        "history.csv",
        "surface.csv",
        "boundary.csv",
        "bottom.npz",
        "fields.npz",
        "summary.json",
        "summary.csv",
        "block_0000.vtu",
        "block_0001.vtu",
        "road_0000.vtu",
        "road_0001.vtu",
        "block.pvd",
        "road.pvd",
    }
    header = (tmp_path / "run" / "history.csv").read_text().splitlines()[0]
    assert header == ",".join(HISTORY)
    header = (tmp_path / "run" / "surface.csv").read_text().splitlines()[0]
    assert header.startswith(",".join(SURFACE))
    header = (tmp_path / "run" / "boundary.csv").read_text().splitlines()[0]
    assert header == ",".join(BOUNDARY)
    columns = (*SUMMARY, "program_version")
    assert tuple(json.loads((tmp_path / "run" / "summary.json").read_text())) == columns
    one_row = pd.read_csv(tmp_path / "run" / "summary.csv")
    assert tuple(one_row.columns) == columns
    assert len(one_row) == 1


def test_reading_gives_back_what_was_written_to_the_last_digit(result, tmp_path):
    result.write(tmp_path)
    again = Result.read(tmp_path)
    pd.testing.assert_frame_equal(again.history, result.history, check_exact=True)
    pd.testing.assert_frame_equal(again.surface, result.surface, check_exact=True)
    pd.testing.assert_frame_equal(again.boundary, result.boundary, check_exact=True)
    for name in ("X_mm", "kind", "pressure"):
        np.testing.assert_array_equal(getattr(again.bottom, name), getattr(result.bottom, name))
    assert again.summary == result.summary
    assert again.case == result.case
    assert again.snapshots == result.snapshots
    assert again.log == result.log
    assert np.array_equal(again.geometry.cells, result.geometry.cells)


def test_extra_columns_follow_the_required_ones(result):
    rows = [{"extra_N": 1.0, **row} for row in result.history.to_dict("records")]
    assert tuple(from_parts(result, rows=rows).history.columns) == (*HISTORY, "extra_N")


@pytest.mark.parametrize("part, column", [("rows", "T_max_C"), ("boundary", "shear_N_per_mm2")])
def test_a_missing_column_is_named(result, part, column):
    parts = {"rows": result.history, "boundary": result.boundary}
    table = parts[part].drop(columns=column)
    changed = table.to_dict("records") if part == "rows" else table
    with pytest.raises(ValueError, match=column):
        from_parts(result, **{part: changed})


def test_a_missing_summary_key_is_named(result):
    short = {key: value for key, value in result.summary.items() if key != "heat_error"}
    with pytest.raises(ValueError, match="heat_error"):
        from_parts(result, summary=short)


def test_a_snapshot_of_another_mesh_is_refused(result):
    wrong = dataclasses.replace(result.snapshots[0], stretch=np.ones(3))
    with pytest.raises(ValueError, match=r"stretch has shape \(3,\), expected \(960,\)"):
        from_parts(result, snapshots=[wrong])


def test_summary_is_valid_json_whatever_it_holds(tmp_path):
    summary = made_up_summary() | {
        "T_max_C": float("nan"),
        "T_edge_C": np.float64("inf"),
        "A_T_K_mm": None,
        "steps": np.int64(7),
        "reason": 'comma, "quote" and ü',
    }
    write_summary(tmp_path, summary)
    text = (tmp_path / "summary.json").read_text(encoding="utf-8")
    strict = json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is not JSON"))
    assert strict["T_max_C"] is None
    assert strict["T_edge_C"] is None
    assert strict["steps"] == 7
    assert read_summary(tmp_path) == strict
    row = pd.read_csv(tmp_path / "summary.csv").iloc[0]
    assert np.isnan(row["T_max_C"])
    assert row["reason"] == summary["reason"]


def test_text_that_a_spreadsheet_would_run_is_quoted_in_the_summary(tmp_path):
    write_summary(tmp_path, {**made_up_summary(), "reason": "=cmd", "warnings": ["@a", "=b"]})
    table = pd.read_csv(tmp_path / "summary.csv")
    assert table["reason"].tolist() == ["'=cmd"]
    assert table["warnings"].tolist() == ["'@a | =b"]
    assert read_summary(tmp_path)["reason"] == "=cmd"


def test_a_run_without_accepted_steps_is_written_with_headers(result, tmp_path):
    empty = from_parts(result, rows=[], snapshots=[])
    empty.write(tmp_path)
    assert (tmp_path / "history.csv").read_text().strip() == ",".join(HISTORY)
    assert not list(tmp_path.glob("*.vtu"))


def test_case_decides_whether_field_files_are_written(result, tmp_path):
    quiet = dataclasses.replace(result, case=result.case.with_overrides({"output.vtu": False}))
    quiet.write(tmp_path)
    assert not list(tmp_path.glob("*.vtu"))
    assert not list(tmp_path.glob("*.pvd"))


def test_writing_again_removes_snapshots_of_the_earlier_run_and_keeps_foreign_files(tmp_path):
    made_up_result(snapshots=4).write(tmp_path)
    (tmp_path / "notes.txt").write_text("mine")
    made_up_result(snapshots=2).write(tmp_path)
    assert len(list(tmp_path.glob("block_*.vtu"))) == 2
    assert (tmp_path / "notes.txt").read_text() == "mine"


def test_reading_a_folder_that_is_no_result_says_which_file_is_missing(result, tmp_path):
    with pytest.raises(ValueError, match=r"fields\.npz is missing"):
        Result.read(tmp_path)
    result.write(tmp_path)
    (tmp_path / "surface.csv").unlink()
    with pytest.raises(ValueError, match=r"surface\.csv is missing"):
        Result.read(tmp_path)
    (tmp_path / "surface.csv").write_text("")
    with pytest.raises(ValueError, match=r"surface\.csv is not a table"):
        Result.read(tmp_path)


@pytest.mark.parametrize(
    "damage",
    ["5", "null", "[]", '"ok"', "{}", "{", "[" * 100_000, '{"status": 3}', '{"T_max_C": "hot"}'],
    ids=range(9),
)
def test_a_damaged_summary_is_named_in_one_line(damage, result, tmp_path):
    result.write(tmp_path)
    path = tmp_path / "summary.json"
    whole = json.loads(path.read_text())
    partial = damage.startswith('{"')
    path.write_text(json.dumps(whole | json.loads(damage)) if partial else damage)
    with pytest.raises(ValueError, match=r"summary\.json") as error:
        read_summary(tmp_path)
    assert "\n" not in str(error.value)
