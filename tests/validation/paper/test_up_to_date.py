"""What is up to date stays; what is not is made again."""

import pytest

from validation.paper import up_to_date as module
from validation.paper.up_to_date import kept


@pytest.fixture
def making(tmp_path):
    """A figure of two files, and how often it was made."""
    made = []

    def make():
        made.append("fig1")
        (tmp_path / "fig1.csv").write_text("x_mm\n1\n")
        (tmp_path / "fig1.png").write_bytes(b"picture")
        return tmp_path / "fig1.png"

    make.count = made
    return make


def test_what_is_up_to_date_is_not_made_again(tmp_path, making):
    first = kept("fig1", tmp_path, making)
    assert first == (tmp_path / "fig1.png", True)
    assert kept("fig1", tmp_path, making) == (tmp_path / "fig1.png", False)
    assert len(making.count) == 1


@pytest.mark.parametrize("name", ["fig1.png", "fig1.csv", "made/fig1.json"])
@pytest.mark.parametrize("change", ["removed", "changed"])
def test_missing_or_changed_files_are_made_again(tmp_path, making, name, change):
    kept("fig1", tmp_path, making)
    path = tmp_path / name
    path.unlink() if change == "removed" else path.write_text("something else")
    assert kept("fig1", tmp_path, making).again
    assert not kept("fig1", tmp_path, making).again


def test_it_is_made_again_on_request(tmp_path, making):
    kept("fig1", tmp_path, making)
    assert kept("fig1", tmp_path, making, again=True).again
    assert not kept("fig1", tmp_path, making).again


def test_another_program_makes_it_again(tmp_path, making, monkeypatch):
    kept("fig1", tmp_path, making)
    monkeypatch.setattr(module, "_program_fingerprint", lambda: "another")
    assert kept("fig1", tmp_path, making).again


def test_a_changed_docstring_or_comment_leaves_it_and_a_changed_constant_does_not(
    tmp_path, making, monkeypatch
):
    source = tmp_path / "program" / "validation" / "fig1.py"
    source.parent.mkdir(parents=True)
    program = module.program_version()
    monkeypatch.setattr(module, "program_version", lambda: program)
    monkeypatch.setattr(module, "_FOLDERS", (source.parent,))
    monkeypatch.setattr("fem.files.version.ROOT", tmp_path / "program")

    def made_again(text):
        source.write_text(text)
        module._program_fingerprint.cache_clear()
        return kept("fig1", tmp_path, making).again

    assert made_again('"""Figure 1."""\n\nWIDTH = 80.0  # mm\n')
    assert not made_again('"""Figure 1 of the paper."""\nWIDTH = 80.0  # of the page\n')
    assert made_again('"""Figure 1 of the paper."""\nWIDTH = 81.0  # of the page\n')
    monkeypatch.undo()
    module._program_fingerprint.cache_clear()


def test_changed_input_makes_it_again(tmp_path, making):
    measured = tmp_path / "measured.csv"
    measured.write_text("T_max_C\n48.0\n")
    assert kept("fig1", tmp_path, making, [measured]).again
    assert not kept("fig1", tmp_path, making, [measured]).again
    measured.write_text("T_max_C\n49.0\n")
    assert kept("fig1", tmp_path, making, [measured]).again
    assert kept("fig1", tmp_path, making).again


def test_files_of_other_figures_do_not_count(tmp_path, making):
    kept("fig1", tmp_path, making)
    (tmp_path / "fig10.png").write_bytes(b"another figure")
    assert not kept("fig1", tmp_path, making).again


def test_figure_that_could_not_be_made_is_tried_again(tmp_path, making):
    kept("fig1", tmp_path, making)
    (tmp_path / "fig1.csv").unlink()

    def fails():
        raise OSError("disk full")

    with pytest.raises(OSError, match="disk full"):
        kept("fig1", tmp_path, fails)
    assert kept("fig1", tmp_path, making).again


def test_every_source_of_validation_and_calibration_counts():
    names = {path.name for path in module._sources()}
    assert {"fig9.py", "compounds.toml", "treloar1944.csv", "stress_models.py"} <= names


@pytest.mark.parametrize("main", [None, 5, "../secret.txt", "/etc/passwd", "fig2.png"])
def test_record_that_was_changed_leads_nowhere_else(tmp_path, making, main):
    import json

    (tmp_path.parent / "secret.txt").write_text("secret")
    kept("fig1", tmp_path, making)
    record = tmp_path / "made" / "fig1.json"
    known = json.loads(record.read_text()) | {"main": main}
    if main is None:
        del known["main"]
    record.write_text(json.dumps(known))
    assert kept("fig1", tmp_path, making) == (tmp_path / "fig1.png", True)


@pytest.mark.parametrize("text", ["", "5", "null", "{}", '{"files": 3}', "\udcff", "[" * 100000])
def test_damaged_record_means_that_it_is_made_anew(tmp_path, making, text):
    kept("fig1", tmp_path, making)
    (tmp_path / "made" / "fig1.json").write_bytes(text.encode(errors="surrogateescape"))
    assert kept("fig1", tmp_path, making).again
