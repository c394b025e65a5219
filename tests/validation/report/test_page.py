"""The report: complete, self-contained, honest about what is missing, and safe to open."""

from __future__ import annotations

import base64
import re
from html.parser import HTMLParser

import pytest

from tests.made_up_result import made_up_result
from validation.paper.figures import FIGURES, TABLES
from validation.paper.introductory import introductory_case
from validation.report import captions, page
from validation.report.made_with import MadeWith, programs_of_runs
from validation.report.page import find_page, render, tone, write_report
from validation.sensitivity.parameters import PARAMETERS

PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR42mNkYAAAAAYAAjCB0C8AAAAASUVORK5CYII="
)
CLAIMS = (
    "number,section,claim,computed,ours,values,criterion,verdict,explanation,experiment\n"
    '1,4.2,"<script>alert(1)</script> & curls, up",yes,48.070353,raw_K=48.1,T > 40,holds,,no\n'
    "2,4.3,lowest peak,yes,3,,lowest,differs,the block is lower,no\n"
)
MADE_WITH = MadeWith(
    date="2026-01-31 12:00 UTC+0000",
    program="1.2.3+abcdef01",
    commit="0123abc, clean tree",
    versions={"Python": "3.11.9", "numpy": "2.1.0"},
)


class _Links(HTMLParser):
    """Collects what a page would load or jump to, and whether every element is closed."""

    VOID = ("meta", "img", "br", "link", "input", "hr")

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.sources: list[str] = []
        self.jumps: list[str] = []
        self.anchors: list[str] = []
        self.open: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        given = dict(attrs)
        if "src" in given:
            self.sources.append(given["src"])
        if "href" in given:
            self.jumps.append(given["href"])
        if "id" in given:
            self.anchors.append(given["id"])
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with every part but the robustness table, which lies elsewhere."""
    figures = tmp_path / "figures"
    figures.mkdir()
    for number in FIGURES:
        (figures / f"fig{number}.png").write_bytes(PNG)
    for number in TABLES:
        (figures / f"table{number}.csv").write_text("set,paper\nfirst,0.123456789\n")
        (figures / f"table{number}.txt").write_text("SYNTHETIC, as\nsaid.\n\nset paper\n")
    (figures / "claims.csv").write_text(CLAIMS)
    (figures / "sensitivity.png").write_bytes(PNG)
    (figures / "sensitivity.csv").write_text("parameter,status\nbase,ok\nblock.mesh,ok\n")
    (figures / "sensitivity.txt").write_text("The base\nis here.\n\nA table.\n")
    result = made_up_result()
    result.summary["program_version"] = MADE_WITH.program
    result.write(tmp_path / "run")
    robustness = tmp_path / "robustness.csv"
    robustness.write_text("friction.mu,status\n0.3,ok\n1.2,not converged\n0.6,ok\n")
    monkeypatch.setattr(page, "ROBUSTNESS", robustness)
    monkeypatch.setattr(page, "made_with", lambda: MADE_WITH)
    return figures


def html_of(folder) -> str:
    return render(find_page(folder, MADE_WITH))


def seen(text: str) -> str:
    """What a reader sees, roughly: without style and tags, in one line."""
    without = re.sub(r"<style>.*?</style>|<[^>]*>", " ", text, flags=re.DOTALL)
    return " ".join(without.split())


def test_the_made_up_run_is_of_the_introductory_case():
    assert made_up_result().case == introductory_case()


def test_a_complete_folder_gives_a_page_that_misses_nothing(folder):
    text = html_of(folder)
    assert "not complete" not in text
    assert "Missing" not in text
    assert text.count(base64.b64encode(PNG).decode()) == len(FIGURES) + 1


def test_the_page_needs_no_other_file_no_script_and_no_network(folder):
    links = _Links(html_of(folder))
    assert links.sources
    assert all(source.startswith("data:image/png;base64,") for source in links.sources)
    assert all(jump.startswith("#") for jump in links.jumps)
    assert not {"script", "link", "iframe"} & set(links.tags)
    assert "url(" not in html_of(folder)


def test_every_jump_arrives_and_every_element_is_closed(folder):
    for directory in (folder, folder / "empty"):
        links = _Links(html_of(directory))
        assert {jump[1:] for jump in links.jumps} <= set(links.anchors)
        assert len(set(links.anchors)) == len(links.anchors)
        assert links.open == []


def test_what_is_missing_is_named_at_the_top_and_in_its_place_with_what_makes_it(folder):
    (folder / "fig9.png").unlink()
    (folder / "table4.csv").unlink()
    (folder / "claims.csv").unlink()
    (folder.parent / "run" / "summary.json").unlink()
    top, rest = (seen(part) for part in html_of(folder).split("<nav"))
    for title, command in (
        ("Figure 9", "make fig9"),
        ("Table 4", "make table4"),
        ("The paper&#39;s claims", "make claims"),
        ("Introductory example", "make run"),
    ):
        assert f"{title} ( {command} )" in top
        assert rest.count(command) == 1
    assert "make fig8" not in top + rest


def test_an_empty_folder_gives_a_page_that_names_every_part(tmp_path, monkeypatch):
    monkeypatch.setattr(page, "ROBUSTNESS", tmp_path / "none.csv")
    found = find_page(tmp_path / "nothing", MADE_WITH)
    assert len(found.missing) == len(FIGURES) + len(TABLES) + 4
    assert seen(render(found)).count("Missing:") == len(found.missing) + 1


def test_nothing_in_the_data_becomes_markup(folder):
    (folder / "table1.csv").write_text('a,"b<i>"\n"<img src=x onerror=y>",1\n')
    text = html_of(folder)
    assert "<script" not in text
    assert "onerror=y>" not in text
    assert "&lt;script&gt;alert(1)&lt;/script&gt; &amp; curls, up" in text


def test_claims_stand_with_their_verdicts_and_are_counted(folder):
    text = seen(html_of(folder))
    assert "holds: 1" in text
    assert "differs: 1" in text
    assert "the block is lower" in text
    assert "48.07" in text
    assert "raw_K" not in text


def test_verdicts_have_a_colour_by_what_they_say():
    assert [tone(word) for word in ("Holds", "differs", "cannot be checked")] == [
        "good",
        "bad",
        "open",
    ]
    assert (tone("ok"), tone("not converged")) == ("good", "bad")


def test_cases_of_the_robustness_study_are_counted_by_their_status(folder):
    assert "ok: 2 not converged: 1" in seen(html_of(folder))


def test_the_sensitivity_study_is_summed_up_and_its_ranges_are_explained(folder):
    text = seen(html_of(folder))
    assert "The base is here." in text
    assert "A table." not in text
    assert PARAMETERS["block.mesh"].why in text
    assert PARAMETERS["block.height_mm"].why not in text


def test_versions_commit_and_date_are_on_the_page(folder):
    text = seen(html_of(folder))
    for value in (MADE_WITH.date, MADE_WITH.program, MADE_WITH.commit, "numpy 2.1.0"):
        assert value in text


def test_a_run_of_the_same_program_is_shown_without_a_warning(folder):
    text = seen(html_of(folder))
    assert "4.500 N/mm" in text
    assert "another program" not in text


def test_a_run_of_another_program_or_one_that_stopped_early_is_marked(folder):
    result = made_up_result()
    result.summary.update(status="not converged", reason="too steep", program_version="0.9")
    result.write(folder.parent / "run")
    text = seen(html_of(folder))
    assert "Computed by another program (0.9)" in text
    assert "did not get to its end (not converged: too steep)" in text


def test_of_two_runs_the_one_of_the_present_program_is_shown(folder):
    result = made_up_result()
    result.summary.update(T_max_C=47.125, program_version="0.9")
    result.write(folder.parent / "run")
    result.summary.update(T_max_C=46.125, program_version=MADE_WITH.program)
    result.write(folder / "runs" / "introductory")
    text = seen(html_of(folder))
    assert "46.12 °C" in text
    assert "another program" not in text


def test_a_run_of_another_case_is_not_shown_as_the_introductory_one(folder):
    made_up_result(velocity_mm_per_s=50.0).write(folder.parent / "run")
    assert find_page(folder, MADE_WITH).run is None


def test_runs_are_counted_by_the_program_that_computed_them(folder):
    for number, program in enumerate(["0.1.0+b", "0.1.0+a", "0.1.0+b"]):
        result = made_up_result()
        result.summary["program_version"] = program
        result.write(folder / "runs" / str(number))
    (folder / "runs" / "damaged").mkdir()
    (folder / "runs" / "damaged" / "summary.json").write_text("{")
    assert programs_of_runs(folder) == [("0.1.0+b", 2), ("0.1.0+a", 1), ("unreadable", 1)]
    assert "computed by 0.1.0+b: 2, 0.1.0+a: 1, unreadable: 1" in seen(html_of(folder))


def test_every_figure_and_table_of_the_paper_has_its_place():
    assert set(captions.FIGURES) == set(FIGURES)
    assert set(captions.TABLES) == set(TABLES)


def test_the_note_that_data_is_synthetic_stands_above_its_table(folder):
    assert seen(html_of(folder)).count("SYNTHETIC, as said.") == len(TABLES)


def test_the_file_is_written_whole_into_a_new_folder(folder, monkeypatch):
    path = write_report(folder, folder.parent / "new" / "report.html")
    assert path.read_text(encoding="utf-8") == html_of(folder)
    monkeypatch.setattr(page, "render", lambda page: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        write_report(folder, path)
    assert path.read_text(encoding="utf-8") == html_of(folder)
    assert [p.name for p in path.parent.iterdir()] == ["report.html"]
