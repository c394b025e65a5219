"""All claims in the order of the paper, and the table of what came out."""

from __future__ import annotations

import pandas as pd

from validation.claims import section_4_2, section_5_1, section_5_1_forces, section_5_2, section_6
from validation.claims.claim import DIFFERS, HOLDS, UNCHECKED, Claim, Finding, unchecked
from validation.claims.evidence import Evidence, UnfinishedError

CLAIMS: tuple[Claim, ...] = (
    *section_4_2.CLAIMS,
    *section_5_1.CLAIMS,
    *section_5_1_forces.CLAIMS,
    *section_5_2.CLAIMS,
    *section_6.CLAIMS,
)
COLUMNS = (
    "number",
    "section",
    "claim",
    "computed",
    "ours",
    "values",
    "criterion",
    "verdict",
    "explanation",
    "experiment",
)


def ledger_table(evidence: Evidence, claims: tuple[Claim, ...] = CLAIMS) -> pd.DataFrame:
    """Check the claims; a row each, numbered in the order of the paper, columns `COLUMNS`."""
    rows = [(number, claim, judged(claim, evidence)) for number, claim in enumerate(claims, 1)]
    return pd.DataFrame(
        [
            (
                number,
                claim.section,
                claim.says,
                claim.computed,
                finding.ours,
                "; ".join(f"{name} = {value:.6g}" for name, value in finding.values.items()),
                finding.criterion,
                finding.verdict,
                finding.explanation,
                finding.experiment,
            )
            for number, claim, finding in rows
        ],
        columns=list(COLUMNS),
    )


def judged(claim: Claim, evidence: Evidence) -> Finding:
    """What a claim finds; without a verdict if a run it needs did not get to its end."""
    try:
        return claim.find(evidence)
    except UnfinishedError as error:
        return unchecked(f"Not for lack of text: {error}.")


def counts(table: pd.DataFrame) -> dict[str, int]:
    """How many rows have each verdict."""
    return {
        verdict: int((table["verdict"] == verdict).sum()) for verdict in (HOLDS, DIFFERS, UNCHECKED)
    }
