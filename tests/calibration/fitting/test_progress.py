"""A fit shows on a terminal that it is at work, and nothing in a pipe."""

import pytest

import treadfem

WORDS = ("calibrate", "friction", "rig.csv", "--law", "exponential", "-o", "out")


@pytest.fixture(autouse=True)
def rig(tmp_path, monkeypatch):
    rows = [f"{p},{v},{0.9 * p**-0.1 * v**0.05:.5f}" for p in (0.1, 0.3) for v in (3, 30, 300)]
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rig.csv").write_text("\n".join(["p_N_per_mm2,v_mm_per_s,mu", *rows, ""]))


def test_fit_on_a_terminal_shows_its_stages_and_counts_its_looks_at_the_data(capsys, monkeypatch):
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    assert treadfem.main([*WORDS, "--intervals", "profile"]) == 0
    shown = capsys.readouterr().err
    stages = ("fit to rig.csv", "profile intervals", "comparing with huemer", "tables and pictures")
    assert [text for text in stages if text not in shown] == []
    assert "huemer: 0 evaluations" not in shown


@pytest.mark.parametrize("quiet", [True, False])
def test_fit_in_a_pipe_and_a_quiet_one_show_nothing(quiet, capsys, monkeypatch):
    monkeypatch.setattr("sys.stderr.isatty", lambda: quiet)
    assert treadfem.main([*WORDS, *(["--quiet"] if quiet else [])]) == 0
    assert capsys.readouterr().err == ""
