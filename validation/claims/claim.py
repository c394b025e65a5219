"""A statement of the paper, and what our numbers say about it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from validation.claims.evidence import Evidence

HOLDS, DIFFERS, UNCHECKED = "holds", "differs", "cannot be checked"


@dataclass(frozen=True, kw_only=True)
class Finding:
    """What came out of checking a claim.

    Attributes
    ----------
    ours : str
        Our numbers with units, as a reader wants them.
    values : mapping
        The same numbers raw, under names that carry their units.
    criterion : str
        When the claim holds, and where the threshold comes from.
    holds : bool or None
        Result of the comparison; None where none is possible.
    explanation : str
        Why it differs or cannot be checked; a remark where it holds.
    experiment : str
        What was run to find the reason, and its numbers; empty where nothing had to be.
    """

    ours: str
    values: Mapping[str, float] = field(default_factory=dict)
    criterion: str
    holds: bool | None
    explanation: str = ""
    experiment: str = ""

    @property
    def verdict(self) -> str:
        """`HOLDS`, `DIFFERS` or `UNCHECKED`."""
        if self.holds is None:
            return UNCHECKED
        return HOLDS if self.holds else DIFFERS


@dataclass(frozen=True, kw_only=True)
class Claim:
    """A statement of the paper in our words, and the function that checks it.

    Attributes
    ----------
    key : str
        Short name.
    section : str
        Section of the paper.
    says : str
        The statement, paraphrased.
    computed : str
        What is computed to check it.
    find : callable
        From the evidence to the finding.
    """

    key: str
    section: str
    says: str
    computed: str
    find: Callable[[Evidence], Finding]


def claim(
    *, section: str, says: str, computed: str
) -> Callable[[Callable[[Evidence], Finding]], Claim]:
    """Make a claim of the function below, whose name becomes the key."""

    def bind(find: Callable[[Evidence], Finding]) -> Claim:
        return Claim(key=find.__name__, section=section, says=says, computed=computed, find=find)

    return bind


def unchecked(reason: str) -> Finding:
    """Finding for a claim that nothing can be compared with."""
    return Finding(ours="-", criterion="-", holds=None, explanation=reason)
