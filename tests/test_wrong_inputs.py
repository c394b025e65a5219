"""Wrong input to any command is one line and exit code 2; unusual input is used, and said."""

from __future__ import annotations

import json

import pytest

import treadfem
from tests.validation.measured.test_comparison import write_run
from tests.wrong_inputs import LOADING, UNUSUAL_INPUTS, WRONG_INPUTS, WrongInput


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """A folder of two finished runs at 50 mm/s, which start at 20 deg C."""
    folder = tmp_path_factory.mktemp("runs")
    for law in ("huemer", "exponential"):
        write_run(folder / "results" / "runs" / law, **{"friction.law": law})
    return folder / "results"


def run(wrong: WrongInput, results, *more: str) -> int:
    words = [word.replace("{results}", str(results)) for word in wrong.words]
    try:
        return treadfem.main([*words, *more])
    except SystemExit as stop:
        return int(stop.code or 0)


@pytest.mark.parametrize("wrong", WRONG_INPUTS, ids=lambda wrong: wrong.kind)
def test_wrong_input_gives_one_line_and_writes_nothing(
    wrong, results, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    wrong.write(tmp_path)
    before = sorted(path.name for path in tmp_path.rglob("*"))

    code = run(wrong, results)

    printed = capsys.readouterr()
    assert printed.out == ""
    (line,) = printed.err.splitlines()
    assert line.startswith("treadfem: ")
    for part in wrong.expected:
        assert part in line
    assert code == 2
    assert sorted(path.name for path in tmp_path.rglob("*")) == before


def test_the_table_has_every_command_that_reads_and_no_kind_twice():
    kinds = [wrong.kind for wrong in WRONG_INPUTS]
    assert len(set(kinds)) == len(kinds) > 120
    verbs = {wrong.words[0] for wrong in WRONG_INPUTS}
    assert verbs == {"run", "check", "calibrate", "compare", "figure", "sweep", "export"}


@pytest.mark.parametrize("unusual", UNUSUAL_INPUTS, ids=lambda unusual: unusual.kind)
def test_unusual_input_is_used_and_said(unusual, results, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    unusual.write(tmp_path)
    assert run(unusual, results) == 0
    lines = capsys.readouterr().err.splitlines()
    (line,) = (line for line in lines if unusual.expected[-1] in line)
    for part in unusual.expected:
        assert part in line


def test_accepted_numbers_are_not_said_but_kept(results, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    bar, fahrenheit = UNUSUAL_INPUTS[1], UNUSUAL_INPUTS[4]
    bar.write(tmp_path)
    assert run(bar, results, "--accept-unusual") == 0
    assert capsys.readouterr().err == ""
    assert "looks like bar (0.25 N/mm^2)" in (tmp_path / "out" / "comparison.log").read_text()
    assert run(fahrenheit, results, "--accept-unusual") == 0
    assert capsys.readouterr().err == ""


def test_unusual_numbers_of_a_case_are_in_its_log_and_its_summary(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    UNUSUAL_INPUTS[4].write(tmp_path)
    fast = ["block.rigid=true", 'block.mesh="coarse"', "loading.distance_mm=1.0"]
    words = [word for key in [*fast, "output.figures=false", "heat.ambient_C=68"]
             for word in ("--set", key)]  # fmt: skip
    treadfem.main(["run", "case.toml", "-o", "out", "--accept-unusual", *words])
    assert "Fahrenheit" not in capsys.readouterr().err
    found = json.loads((tmp_path / "out" / "summary.json").read_text())["warnings"]
    assert found[0].startswith("heat.ambient_C: 68 is unusual; it looks like Fahrenheit")
    assert found[0] in (tmp_path / "out" / "run.log").read_text()


def test_a_sweep_says_once_what_is_unusual_about_its_cases(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    case = LOADING.replace("120.0", "1.0") + "[output]\nfigures = false\nvtu = false\n"
    (tmp_path / "case.toml").write_text(case + '[block]\nrigid = true\nmesh = "coarse"\n')
    grid = '"heat.ambient_C" = [68.0]\n"friction.law" = ["huemer", "exponential"]\n'
    (tmp_path / "study.toml").write_text(f'base = "case.toml"\n[grid]\n{grid}')
    words = ["sweep", "study.toml", "-o", "out", "--workers", "1"]
    for accepted in (False, True):
        assert treadfem.main([*words, *(["--accept-unusual"] if accepted else [])]) == 0
        said = [line for line in capsys.readouterr().err.splitlines() if "Fahrenheit" in line]
        assert len(said) == (0 if accepted else 1)
    assert (tmp_path / "out" / "summary.csv").read_text().count("Fahrenheit") == 2


def test_unusual_numbers_of_a_fit_are_in_its_parameter_file(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    rows = "".join(f"{p},{v},{0.9 * v**0.04:.4f}\n" for p in (1.0, 3.0) for v in (1, 10, 300))
    (tmp_path / "t.csv").write_text("p_N_per_mm2,v_mm_per_s,mu\n" + rows)
    words = ["calibrate", "friction", "t.csv", "--law", "exponential", "--no-compare", "-o", "out"]
    assert treadfem.main(words) == 0
    line = "row 5, column p_N_per_mm2: 3.0 and 2 more is unusual; it looks like bar (0.3 N/mm^2)"
    assert line.replace("3.0", "3") in capsys.readouterr().err
    assert "it looks like bar" in (tmp_path / "out" / "parameters.toml").read_text()
