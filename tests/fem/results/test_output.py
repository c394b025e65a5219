"""One program at a time in a folder, and no trace of one that wrote nothing."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from fem.case.errors import CaseError
from fem.results.output import (
    LOCK_FILE,
    check_output_file,
    check_output_folder,
    output_folder,
)

ROOT = Path(__file__).parents[3]
HOLDER = """
import sys
from fem.results.output import output_folder
with output_folder(sys.argv[1]):
    print("held", flush=True)
    sys.stdin.read()
"""


def test_folder_made_for_nothing_disappears(tmp_path):
    with output_folder(tmp_path / "a" / "b") as folder:
        assert folder.is_dir()
    assert list(tmp_path.iterdir()) == []


def test_folder_that_was_written_or_there_before_stays(tmp_path):
    (tmp_path / "empty").mkdir()
    with output_folder(tmp_path / "empty"):
        pass
    with output_folder(tmp_path / "a" / "b") as folder:
        (folder / "x").write_text("1")
    assert sorted(p.relative_to(tmp_path).as_posix() for p in tmp_path.rglob("*")) == [
        "a",
        "a/b",
        "a/b/x",
        "empty",
    ]


def test_second_program_is_refused_until_the_first_is_dead(tmp_path):
    command = [sys.executable, "-c", HOLDER, str(tmp_path)]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, cwd=ROOT, stdin=pipe, stdout=pipe, text=True) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline() == "held\n"
        with (
            pytest.raises(CaseError, match="another run that is using it"),
            output_folder(tmp_path),
        ):
            pass
        holder.kill()
    assert (tmp_path / LOCK_FILE).exists()
    with output_folder(tmp_path):
        pass
    assert list(tmp_path.iterdir()) == []


def test_lock_holds_within_a_process_too(tmp_path):
    with output_folder(tmp_path), pytest.raises(CaseError), output_folder(tmp_path):
        pass


def test_remains_in_the_named_folders_are_removed_and_nothing_else(tmp_path):
    for place in ("", "runs", "mine"):
        (tmp_path / place / ".unfinished-1").mkdir(parents=True)
        (tmp_path / place / ".hidden").write_text("mine")
    with output_folder(tmp_path, folders=["runs"]):
        pass
    left = sorted(p.relative_to(tmp_path).as_posix() for p in tmp_path.rglob("*"))
    assert left == [".hidden", "mine", "mine/.hidden", "mine/.unfinished-1", "runs", "runs/.hidden"]


@pytest.mark.parametrize("name", ["link", "link/x", "file", "file/x", "n" * 300])
def test_what_cannot_be_a_folder_is_refused(name, tmp_path):
    (tmp_path / "link").symlink_to("nowhere")
    (tmp_path / "file").write_text("")
    with pytest.raises(CaseError, match="-o"), output_folder(tmp_path / name):
        pass
    if "n" not in name:
        with pytest.raises(CaseError, match="-o"):
            check_output_folder(tmp_path / name)


def test_file_that_is_a_folder_or_a_link_to_nowhere_is_refused(tmp_path):
    (tmp_path / "link").symlink_to("nowhere")
    for path in (tmp_path, tmp_path / "link"):
        with pytest.raises(CaseError, match="-o"):
            check_output_file(path)
    check_output_file(tmp_path / "new")
