"""One answer to whether a folder holds the finished run of a case by this program."""

from __future__ import annotations

import numpy as np
import pytest

from fem import Case, simulate
from fem.results import checkpoint, run_folder
from fem.results.checkpoint import CHECKPOINT_FILE, CheckpointError
from fem.results.result import RUN_FILES, Result
from fem.results.run_folder import RunFolder
from tests.made_up_result import made_up_result

LOADING = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 6.0}
CASE = Case.from_dict(
    {
        "loading": LOADING,
        "block": {"rigid": True, "mesh": "coarse"},
        "output": {"snapshots": 3, "checkpoint_s": 0.0, "figures": False, "vtu": False},
    }
)
OUTPUT = {"output.snapshots": 5, "output.vtu": True, "output.figures": True}


@pytest.fixture(scope="module")
def result() -> Result:
    return simulate(CASE)


@pytest.fixture
def folder(tmp_path, result) -> RunFolder:
    result.write(tmp_path / "run")
    return RunFolder(tmp_path / "run", CASE)


def of(folder: RunFolder, **overrides: object) -> RunFolder:
    keys = {key.replace("__", "."): value for key, value in overrides.items()}
    return RunFolder(folder.directory, CASE.with_overrides(keys))


def test_a_folder_offers_nothing_a_checkpoint_or_the_finished_run(tmp_path):
    folder = RunFolder(tmp_path / "run", CASE)
    assert folder.offers() == "nothing"
    assert folder.of_case() is None
    result = simulate(CASE, checkpoint=folder.checkpoint)
    assert folder.offers() == "checkpoint"
    result.write(folder.directory)
    assert folder.offers() == "checkpoint"
    (folder.directory / CHECKPOINT_FILE).unlink()
    assert folder.offers() == "finished"
    assert folder.finished() is not None
    assert folder.finished() == folder.of_case()
    folder.forget()
    assert folder.offers() == "nothing"
    assert folder.finished() is None


def test_keys_of_the_output_do_not_count_and_all_others_do(folder):
    assert RunFolder(folder.directory, CASE.with_overrides(OUTPUT)).finished() is not None
    assert RunFolder(folder.directory, CASE.with_overrides(OUTPUT)).offers() == "finished"
    other = of(folder, loading__distance_mm=7.0)
    assert other.finished() is other.of_case() is None
    with pytest.raises(CheckpointError, match=r"case\.toml: loading\.distance_mm: found 6\.0"):
        other.offers()


def test_a_checkpoint_counts_for_other_keys_of_the_output(tmp_path):
    folder = RunFolder(tmp_path, CASE)
    simulate(CASE, checkpoint=folder.checkpoint)
    assert RunFolder(tmp_path, CASE.with_overrides(OUTPUT)).offers() == "checkpoint"
    with pytest.raises(CheckpointError, match="distance_mm"):
        of(folder, loading__distance_mm=7.0).offers()


def test_a_result_of_another_program_is_of_the_case_but_not_finished(folder, monkeypatch):
    monkeypatch.setattr(run_folder, "program_version", lambda: "9.9+abc")
    assert folder.of_case() is not None
    assert folder.finished() is None
    with pytest.raises(CheckpointError, match=r"summary\.json: program version"):
        folder.offers()


def test_a_checkpoint_of_another_program_is_refused(tmp_path, monkeypatch):
    folder = RunFolder(tmp_path, CASE)
    simulate(CASE, checkpoint=folder.checkpoint)
    monkeypatch.setattr(checkpoint, "program_version", lambda: "9.9+abc")
    with pytest.raises(CheckpointError, match="program version"):
        folder.offers()


@pytest.mark.parametrize(
    "status, finished", [("ok", True), ("not converged", True), ("interrupted", False)]
)
def test_what_would_end_in_the_same_way_is_finished(status, finished, tmp_path):
    result = made_up_result()
    result.summary["status"] = status
    result.write(tmp_path)
    assert (RunFolder(tmp_path, result.case).finished() is not None) == finished
    assert RunFolder(tmp_path, result.case).offers() == (
        "finished" if status == "ok" else "nothing"
    )


@pytest.mark.parametrize("name", RUN_FILES)
def test_a_run_without_one_of_its_files_is_not_finished(name, folder):
    (folder.directory / name).unlink()
    assert folder.offers() == "nothing"
    assert folder.finished() is None


@pytest.mark.parametrize("content", [b"", b"a,b\n1,2\n", b"\xff\xfe", b'"'])
def test_a_run_with_a_damaged_table_is_not_finished(content, folder):
    (folder.directory / "history.csv").write_bytes(content)
    assert folder.offers() == "nothing"
    assert folder.finished() is None


def test_a_case_file_with_other_keys_is_refused(folder):
    path = folder.directory / "case.toml"
    path.write_text(path.read_text().replace("height_mm", "tallness_mm"))
    assert folder.finished() is None
    with pytest.raises(CheckpointError, match="tallness_mm"):
        folder.offers()


def test_vtu_files_are_exported_later_from_the_fields(folder, result):
    folder.export()
    assert not list(folder.directory.glob("*.vtu"))
    of(folder, output__vtu=True).export()
    assert len(list(folder.directory.glob("block_*.vtu"))) == len(result.snapshots) == 3
    assert (folder.directory / "road.pvd").is_file()
    for path in folder.directory.glob("*.vtu"):
        path.unlink()
    again = Result.read(folder.directory)
    assert again.snapshots == result.snapshots
    assert np.array_equal(again.geometry.points, result.geometry.points)
