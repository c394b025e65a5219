"""The commit of a report is the source tree's own, with what differs from it."""

from __future__ import annotations

import shutil
import subprocess

import pytest

from fem.files.version import program_version
from validation.report.made_with import PACKAGES, describe_commit, made_with

needs_git = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")


def git(folder, *arguments: str) -> str:
    identity = ["-c", "user.name=t", "-c", "user.email=t@example.org", "-c", "commit.gpgsign=false"]
    command = ["git", "-C", str(folder), *identity, *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


@pytest.fixture
def repository(tmp_path):
    git(tmp_path, "init", "--quiet")
    (tmp_path / "a.py").write_text("1\n")
    git(tmp_path, "add", "a.py")
    git(tmp_path, "commit", "--quiet", "-m", "first")
    return tmp_path


@needs_git
def test_a_clean_tree_is_called_clean(repository):
    assert describe_commit(repository) == f"{git(repository, 'rev-parse', 'HEAD')}, clean tree"


@needs_git
def test_changes_and_new_files_are_counted(repository):
    (repository / "a.py").write_text("2\n")
    assert describe_commit(repository).endswith("with 1 uncommitted file")
    (repository / "b.py").write_text("2\n")
    assert describe_commit(repository).endswith("with 2 uncommitted files")


@needs_git
def test_a_folder_inside_another_repository_has_no_commit_of_its_own(repository):
    (repository / "site-packages").mkdir()
    assert describe_commit(repository / "site-packages") == "not from a git repository"


def test_without_git_the_report_says_so(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    assert describe_commit(tmp_path) == "not from a git repository"


def test_program_and_versions_are_those_that_run():
    made = made_with()
    assert made.program == program_version()
    assert set(made.versions) == {"Python", *PACKAGES}
    assert "not installed" not in {made.versions[name] for name in ("numpy", "scipy", "jinja2")}
