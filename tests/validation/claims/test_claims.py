"""Every claim holds where the evidence says so and differs where it does not."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from scipy.stats import spearmanr

from tests.validation.claims.broken import BROKEN
from tests.validation.claims.made_up_evidence import MadeUpEvidence, paper_like_evidence
from validation.analysis.ranges import CRITICAL_RANK_CORRELATION
from validation.claims.claim import DIFFERS, HOLDS, UNCHECKED, Claim
from validation.claims.ledger import CLAIMS, judged

BY_KEY = {claim.key: claim for claim in CLAIMS}
CHECKABLE = [BY_KEY[key] for key in BROKEN]
UNCHECKABLE = [claim for claim in CLAIMS if claim.key not in BROKEN]


@pytest.fixture(scope="module")
def paper_like() -> MadeUpEvidence:
    return paper_like_evidence()


@pytest.fixture
def evidence(paper_like: MadeUpEvidence) -> MadeUpEvidence:
    """A copy that a test may change."""
    fresh = MadeUpEvidence()
    fresh.__dict__ |= paper_like.__dict__
    fresh.compounds = dict(paper_like.compounds)
    fresh.velocities = {v: dict(laws) for v, laws in paper_like.velocities.items()}
    return fresh


@pytest.mark.parametrize("claim", CHECKABLE, ids=lambda claim: claim.key)
def test_holds_with_evidence_as_the_paper_describes_it(claim: Claim, evidence):
    finding = judged(claim, evidence)
    assert finding.verdict == HOLDS, f"{finding.ours}; {finding.criterion}"
    assert finding.values
    assert finding.criterion
    assert finding.experiment == ""


@pytest.mark.parametrize("claim", CHECKABLE, ids=lambda claim: claim.key)
def test_differs_with_evidence_against_it_and_says_why(claim: Claim, evidence):
    BROKEN[claim.key](evidence)
    finding = judged(claim, evidence)
    assert finding.verdict == DIFFERS, f"{finding.ours}; {finding.criterion}"
    assert finding.explanation


@pytest.mark.parametrize("claim", UNCHECKABLE, ids=lambda claim: claim.key)
def test_what_has_nothing_to_be_compared_with_has_a_reason(claim: Claim, evidence):
    finding = judged(claim, evidence)
    assert finding.verdict == UNCHECKED
    assert finding.explanation
    assert claim.computed == "-"


def test_critical_rank_correlation_comes_from_all_orders_of_six():
    first = np.arange(6)
    found = np.array([spearmanr(first, order).statistic for order in permutations(range(6))])
    share = np.mean(np.abs(found) > CRITICAL_RANK_CORRELATION)
    next_lower = np.abs(found)[np.abs(found) < CRITICAL_RANK_CORRELATION].max()
    assert share <= 0.05 < np.mean(np.abs(found) >= next_lower - 1e-9)


def test_no_key_stands_twice():
    assert len(BY_KEY) == len(CLAIMS)


def test_there_are_at_least_28_checkable_claims():
    assert len(CHECKABLE) >= 28
