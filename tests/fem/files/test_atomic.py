"""Nothing half-written ever stands under a final name."""

from __future__ import annotations

import os

import pytest

from fem.files.atomic import replacing, staged_directory, write_text


def interrupted_file(path):
    with replacing(path) as temporary:
        temporary.write_text("sec")
        raise KeyboardInterrupt


def interrupted_folder(path):
    with staged_directory(path, last="end") as stage:
        (stage / "end").write_text("new")
        raise OSError("disk full")


def test_an_interrupted_file_leaves_the_earlier_one_and_no_remains(tmp_path):
    write_text(tmp_path / "a.csv", "first")
    with pytest.raises(KeyboardInterrupt):
        interrupted_file(tmp_path / "a.csv")
    assert (tmp_path / "a.csv").read_text() == "first"
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_an_interrupted_folder_never_appears(tmp_path):
    with pytest.raises(OSError, match="disk full"):
        interrupted_folder(tmp_path / "run")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_does_not_exist_before_it_is_complete(tmp_path):
    with staged_directory(tmp_path / "run") as stage:
        (stage / "half.csv").write_text("1")
        assert not (tmp_path / "run").exists()
    assert (tmp_path / "run" / "half.csv").exists()


def test_an_interrupted_rewrite_leaves_the_earlier_folder_untouched(tmp_path):
    with staged_directory(tmp_path / "run", last="end") as stage:
        (stage / "end").write_text("old")
    with pytest.raises(OSError, match="disk full"):
        interrupted_folder(tmp_path / "run")
    assert (tmp_path / "run" / "end").read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["run"]


def test_an_existing_folder_is_written_without_touching_its_parent(tmp_path):
    target = tmp_path / "mounted"
    target.mkdir()
    with staged_directory(target) as stage:
        assert [path.name for path in tmp_path.iterdir()] == ["mounted"]
        (stage / "a.csv").write_text("1")
    assert [path.name for path in target.iterdir()] == ["a.csv"]


def test_the_current_folder_can_be_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with staged_directory(".") as stage:
        (stage / "a.csv").write_text("1")
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_the_marker_of_completeness_arrives_last(tmp_path, monkeypatch):
    target = tmp_path / "run"
    target.mkdir()
    for name in ("a_end", "z.csv", "old_1"):
        (target / name).write_text("old")
    seen = []
    replace = os.replace
    monkeypatch.setattr(
        os,
        "replace",
        lambda a, b: (seen.append((b.name, (target / "a_end").exists())), replace(a, b)),
    )
    with staged_directory(target, outdated=["old_*"], last="a_end") as stage:
        (stage / "a_end").write_text("new")
        (stage / "sub").mkdir()
        (stage / "sub" / "z.csv").write_text("new")
    assert seen == [("z.csv", False), ("a_end", False)]
    assert not (target / "old_1").exists()
    assert (target / "z.csv").read_text() == "old"


def test_the_folder_has_the_usual_permissions(tmp_path):
    (tmp_path / "plain").mkdir()
    with staged_directory(tmp_path / "run"):
        pass
    assert (tmp_path / "run").stat().st_mode == (tmp_path / "plain").stat().st_mode
