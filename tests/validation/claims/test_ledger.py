"""The ledger as a table, as text and as files."""

from __future__ import annotations

import pandas as pd
import pytest

from tests.validation.claims.broken import BROKEN
from tests.validation.claims.made_up_evidence import MadeUpEvidence, paper_like_evidence
from validation.claims.claim import DIFFERS, HOLDS, UNCHECKED, Claim, Numbers
from validation.claims.evidence import Evidence, UnfinishedError
from validation.claims.ledger import CLAIMS, COLUMNS, counts, ledger_table
from validation.claims.text import closing_line, ledger_text
from validation.claims.write import write_claims


@pytest.fixture(scope="module")
def evidence() -> MadeUpEvidence:
    """Holds and differs both occur."""
    evidence = paper_like_evidence()
    BROKEN["mean_contact_pressure"](evidence)
    BROKEN["temperature_peak_at_edge"](evidence)
    return evidence


@pytest.fixture(scope="module")
def table(evidence: MadeUpEvidence) -> pd.DataFrame:
    return ledger_table(evidence)


def test_a_row_per_claim_numbered_in_the_order_of_the_paper(table):
    assert list(table.columns) == list(COLUMNS)
    assert list(table["number"]) == list(range(1, len(CLAIMS) + 1))
    assert list(table["claim"]) == [claim.says for claim in CLAIMS]
    assert list(dict.fromkeys(table["section"])) == ["2.1", "4.1", "4.2", "5.1", "5.2", "6"]


def test_what_differs_has_an_explanation_and_only_that_has_an_experiment(table):
    differs = table["verdict"] == DIFFERS
    assert differs.any()
    assert (table.loc[differs, "explanation"] != "").all()
    assert (table.loc[~differs, "experiment"] == "").all()


def test_counts_add_up(table):
    found = counts(table)
    assert sum(found.values()) == len(table)
    assert closing_line(table) == (
        f"{len(table)} claims: {found[HOLDS]} hold, {found[DIFFERS]} differ, "
        f"{found[UNCHECKED]} cannot be checked"
    )


def test_the_text_fits_a_terminal_and_says_every_claim(table):
    text = ledger_text(table)
    assert max(map(len, text.splitlines())) <= 100
    assert text.splitlines()[-1] == closing_line(table)
    words = " ".join(text.split())
    assert [c.says for c in CLAIMS if " ".join(c.says.split()) not in words] == []


def test_the_verdict_is_that_of_the_comparison():
    claims = tuple(
        Claim(
            key="k", section="4.2", says="s", ours="{x:.1p} %", holds=[comparison], compute=compute
        )
        for comparison, compute in (
            ("x < 0.5 limit", lambda evidence: ({"x": 0.9}, {"limit": 2.0})),
            ("x < 0.5 limit", lambda evidence: ({"x": 0.9}, {"limit": 1.0})),
            ("", None),
        )
    )
    table = ledger_table(MadeUpEvidence(), claims)
    assert list(table["verdict"]) == [HOLDS, DIFFERS, UNCHECKED]
    assert list(table["ours"]) == ["90.0 %", "90.0 %", "-"]


def test_a_run_that_did_not_end_leaves_its_claims_without_verdict():
    def needs_a_run(evidence: Evidence) -> Numbers:
        raise UnfinishedError("the run x, stopped at 3 mm: it cycles")

    claim = Claim(key="k", section="4.2", says="s", compute=needs_a_run)
    row = ledger_table(MadeUpEvidence(), (claim,)).iloc[0]
    assert row["verdict"] == UNCHECKED
    assert "stopped at 3 mm: it cycles" in row["explanation"]


def test_writes_csv_and_text_and_nothing_else(tmp_path, evidence, table, monkeypatch):
    monkeypatch.setattr("validation.claims.write.Evidence", lambda directory: evidence)
    text = write_claims(tmp_path)
    csv = text.with_suffix(".csv")
    assert sorted(tmp_path.iterdir()) == [csv, text]
    read = pd.read_csv(csv, keep_default_na=False, dtype={"section": str})
    pd.testing.assert_frame_equal(read, table, check_dtype=False)
    assert text.read_text(encoding="utf-8") == ledger_text(table)
