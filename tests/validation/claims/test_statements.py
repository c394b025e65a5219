"""The file of statements: comparisons, templates, and nothing in it that is not used."""

from __future__ import annotations

import inspect
import re

import numpy as np
import pytest

from tests.validation.claims.made_up_evidence import MadeUpEvidence
from validation.claims.claim import Claim
from validation.claims.ledger import CLAIMS, SECTIONS
from validation.claims.phrases import say
from validation.claims.statements import CHANGES, STATEMENTS, TEXTS

NUMBERS = {"a": 1.0, "b": 3.0}


@pytest.mark.parametrize(
    "comparison, holds",
    [
        ("a < b", True),
        ("a >= b", False),
        ("b <= 3", True),
        ("b > 0.5 twice a", False),
        ("a == b", False),
        ("word == same", True),
        ("each > 0", True),
        ("each < 2", False),
        ("two words < b", True),
        ("nan < b", False),
    ],
)
def test_comparison(comparison, holds):
    others = {"twice": 6.0, "word": "x", "same": "x", "two words": 2.0, "nan": np.nan}
    claim = Claim(
        key="k", section="6", says="s", holds=[comparison], compute=lambda _: (NUMBERS, others)
    )
    assert claim.find(MadeUpEvidence()).holds is holds


@pytest.mark.parametrize(
    "template, text",
    [
        ("{a:.1f} K", "1.0 K"),
        ("{a:+.1p} %", "+100.0 %"),
        ("{table:%(name)s %(value).1f}", "x 1.0, y 2.0"),
        ("{table:; |%(percent)+.0f %% (%(name)s)}", "+100 % (x); +200 % (y)"),
        ("{rows: and |%(name)s %(p)d}", "u 7 and v 8"),
        ("{later[0]:.2f}", "5.00"),
        ("{none:text}{which:text}", "."),
        ("{similar:.0p}", "17"),
    ],
)
def test_template(template, text):
    names = {
        "a": 1.0,
        "table": {"x": 1.0, "y": 2.0},
        "rows": {"u": {"p": 7}, "v": {"p": 8}},
        "later": lambda: (5.0,),
        "none": "",
        "which": "full_stop",
    }
    assert say(template, names) == text


def test_what_is_not_said_is_not_computed():
    def costly():
        raise AssertionError

    assert say("{a}", {"a": 1, "b": costly}) == "1"


def test_every_text_and_every_change_is_used():
    words = " ".join([str(STATEMENTS), str(TEXTS), *map(inspect.getsource, SECTIONS.values())])
    names = [*TEXTS, *CHANGES]
    assert [name for name in names if not re.search(rf"[{{\"']{name}[}}\"':]", words)] == []


def test_every_claim_has_either_numbers_and_texts_or_a_reason():
    for claim in CLAIMS:
        if claim.compute is None:
            assert claim.unchecked
        else:
            assert claim.holds
            assert all((claim.ours, claim.criterion, claim.because))
            assert not claim.unchecked
