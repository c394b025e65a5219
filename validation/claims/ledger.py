"""All claims in the order of the paper, and the table of what came out."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import pandas as pd

from validation.analysis import PAPER_N_PER_MM
from validation.claims import (
    section_2_1,
    section_4_1,
    section_4_2,
    section_5_1,
    section_5_2,
    section_6,
)
from validation.claims.claim import VERDICTS, Claim, Finding, unchecked
from validation.claims.evidence import Evidence, UnfinishedError
from validation.claims.phrases import say
from validation.claims.statements import STATEMENTS
from validation.drawing import COMPOUND_LOOKS

#: Where the computations of a section are.
SECTIONS = {
    "2.1": section_2_1,
    "4.1": section_4_1,
    "4.2": section_4_2,
    "5.1": section_5_1,
    "5.2": section_5_2,
    "6": section_6,
}


def _claims() -> Iterator[Claim]:
    for section, statements in STATEMENTS.items():
        for key, table in statements.items():
            compute = None if "unchecked" in table else getattr(SECTIONS[section], key)
            claim = Claim(key=key, section=section, compute=compute, **table)
            claim = replace(claim, computed=say(claim.computed, {}))
            yield from _of_each_set(claim) if key == "force" else [claim]


def _of_each_set(claim: Claim) -> Iterator[Claim]:
    """The claim about each set of Table 4."""
    for name, printed in PAPER_N_PER_MM.items():
        assert claim.compute is not None
        names = {"set": COMPOUND_LOOKS[name].label, "printed_N_per_mm": printed}
        yield replace(
            claim,
            key=f"{claim.key}_{name}",
            says=say(claim.says, names),
            compute=partial(claim.compute, name=name),
        )


CLAIMS: tuple[Claim, ...] = tuple(_claims())
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
    rows = []
    for number, claim in enumerate(claims, 1):
        finding = judged(claim, evidence)
        values = "; ".join(f"{name} = {value:.6g}" for name, value in finding.values.items())
        stated = (number, claim.section, claim.says, claim.computed)
        found = (finding.ours, values, finding.criterion, finding.verdict)
        rows.append((*stated, *found, finding.explanation, finding.experiment))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def judged(claim: Claim, evidence: Evidence) -> Finding:
    """What a claim finds; without a verdict if a run it needs did not get to its end."""
    try:
        return claim.find(evidence)
    except UnfinishedError as error:
        return unchecked(f"Not for lack of text: {error}.")


def counts(table: pd.DataFrame) -> dict[str, int]:
    """How many rows have each verdict."""
    return {verdict: int((table["verdict"] == verdict).sum()) for verdict in VERDICTS}
