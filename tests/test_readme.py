"""What the README and the pages behind it tell a newcomer to type works."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
import tomllib
from dataclasses import fields
from pathlib import Path

import pytest

import treadfem
from contact import FRICTION_LAWS
from fem.case.case import Case
from fem.case.rubber import CONSTANTS
from fem.results.columns import BOUNDARY, HISTORY, SUMMARY, SURFACE
from fem.results.snapshot import Snapshot
from tests.documents import PAGES, ROOT, TEXT

#: Models and laws of the program; tests register laws of their own later.
NAMED = (*CONSTANTS, *FRICTION_LAWS)
LOADING = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 1.0}


def fenced(language: str) -> list[str]:
    """Fenced blocks of one language."""
    return re.findall(rf"```{language}\n(.*?)```", TEXT, flags=re.DOTALL)


def commands(program: str) -> list[list[str]]:
    """Words of every indented command line of a program, without redirections."""
    lines = re.findall(rf"^    (?:\.venv/bin/)?{program} (.*)$", TEXT, flags=re.MULTILINE)
    return [shlex.split(line.split(" > ")[0], comments=True) for line in lines]


@pytest.mark.parametrize("words", commands("treadfem"), ids=" ".join)
def test_command_is_understood(words):
    treadfem._parser(words[0]).parse_args(words)


def test_the_way_from_template_to_check_works(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert ["template"] in commands("treadfem")
    assert treadfem.main(["template"]) == 0
    Path("my_case.toml").write_text(capsys.readouterr().out)
    assert treadfem.main(["check", "my_case.toml"]) == 0


@pytest.mark.skipif(shutil.which("make") is None, reason="make is not installed")
@pytest.mark.parametrize("words", commands("make"), ids=" ".join)
def test_make_target_exists(words):
    dry = ["make", "--dry-run", *words]
    done = subprocess.run(dry, cwd=ROOT, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("text", fenced("toml"))
def test_case_snippet_is_a_case(text, tmp_path):
    signals = (
        "time_s,velocity_mm_per_s,mean_pressure_N_per_mm2\n0,0,0.2\n0.1,100,0.2\n0.2,100,0.2\n"
    )
    (tmp_path / "signals.csv").write_text(signals)
    tables = tomllib.loads(text)
    Case.from_dict({"loading": LOADING, **tables}, folder=tmp_path)


@pytest.mark.parametrize("text", fenced("python"))
def test_python_example_runs(text, tmp_path, monkeypatch, capsys):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    exec(compile(text, "README.md", "exec"), {})
    assert "N/mm" in capsys.readouterr().out
    assert (tmp_path / "results/short/summary.json").exists()


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_to_files(page):
    targets = re.findall(r"\]\(([^)#:]+)\)", page.read_text(encoding="utf-8"))
    assert [target for target in targets if not (page.parent / target).exists()] == []


def test_every_page_is_linked_from_the_readme():
    readme = PAGES[0].read_text(encoding="utf-8")
    pages = {f"docs/{path.name}" for path in (ROOT / "docs").glob("*.md")}
    assert pages == {str(page.relative_to(ROOT)) for page in PAGES[1:]}
    assert [page for page in sorted(pages) if f"]({page})" not in readme] == []


@pytest.mark.parametrize(
    "table, columns",
    [
        ("history.csv", HISTORY),
        ("surface.csv", SURFACE),
        ("boundary.csv", BOUNDARY),
        ("summary.csv", SUMMARY),
    ],
)
def test_columns_of_a_table_are_listed_in_order(table, columns):
    files = (ROOT / "docs/files.md").read_text(encoding="utf-8")
    (line,) = re.findall(rf"^\| `{table}` \| (`.*`) \|$", files, flags=re.MULTILINE)
    assert re.findall(r"`(\w+)`", line) == list(columns)


def test_arrays_of_the_field_file_are_listed():
    files = (ROOT / "docs/files.md").read_text(encoding="utf-8")
    missing = [part.name for part in fields(Snapshot) if f"`{part.name}_0`" not in files]
    assert missing == []


def test_theory_names_every_model_and_law():
    theory = (ROOT / "docs/theory.md").read_text(encoding="utf-8").casefold()
    words = [name.replace("-", " ") for name in NAMED]
    assert [word for word in words if word not in theory.replace("-", " ")] == []
