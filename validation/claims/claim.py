"""A statement of the paper, and what our numbers say about it."""

import copy
import math
import operator
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from validation.claims.evidence import Evidence, UnfinishedError
from validation.claims.phrases import say
from validation.claims.statements import CHANGES, LIMITS, case_keys

VERDICTS = HOLDS, DIFFERS, UNCHECKED = "holds", "differs", "cannot be checked"

#: Numbers of the ledger's row by name, and whatever else the texts and comparisons name.
Numbers = tuple[dict[str, float], dict[str, Any]]

_COMPARISON = re.compile(r"(?P<left>.+?) (?P<sign><=|>=|==|<|>) (?P<limit>.+)")
_SIGNS: dict[str, Callable[[Any, Any], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
}


@dataclass(frozen=True, kw_only=True)
class Finding:
    """What came out of checking a claim.

    Attributes
    ----------
    ours, values : str, mapping
        Our numbers with units, as a reader wants them, and raw under names that carry their units.
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
    """A statement of the paper: its table in `statements.toml`, and what computes its numbers.

    Attributes
    ----------
    key, section : str
        Short name, and section of the paper.
    compute : callable or None
        From the evidence to the numbers; None where nothing can be compared.
    """

    key: str
    section: str
    says: str
    compute: Callable[..., Numbers] | None = None
    computed: str = "-"
    holds: list[str] = field(default_factory=list)
    criterion: str = "-"
    ours: str = "-"
    remark: str = ""
    because: str = ""
    experiment: str = ""
    tries: dict[str, Any] = field(default_factory=dict)
    unchecked: str = ""

    def find(self, evidence: Evidence) -> Finding:
        """Compute, compare, and put the outcome into words."""
        if self.compute is None:
            return unchecked(say(self.unchecked, {}))
        values, others = self.compute(evidence)
        failed = [left for left, met in self._compared(values, others).items() if not met]
        names = {**others, **values, "failed": ", ".join(failed)}
        experiment = say(self.experiment, names) if failed else ""
        return Finding(
            ours=say(self.ours, names),
            values=values,
            criterion=say(self.criterion, names),
            holds=not failed,
            explanation=say(self.because if failed else self.remark, names),
            experiment=self._tried(evidence) if failed and self.tries else experiment,
        )

    def _compared(self, values: dict[str, float], others: dict[str, Any]) -> dict[str, bool]:
        """Whether each comparison is met, by what is compared."""
        names = {**LIMITS, **others, **values}
        found: dict[str, bool] = {}
        for comparison in self.holds:
            match = _COMPARISON.fullmatch(comparison)
            if match is None:
                raise ValueError(f"{self.key}: {comparison!r} is no comparison")
            left, sign, limit = match["left"], _SIGNS[match["sign"]], _limit(match["limit"], names)
            measured = values.values() if left == "each" else [names[left]]
            found[left] = found.get(left, True) and all(sign(value, limit) for value in measured)
        return found

    def _tried(self, evidence: Evidence) -> str:
        """What comes out with each change of the introductory example, and if that is enough."""
        assert self.compute is not None
        parts = []
        for change in self.tries["changes"]:
            words = CHANGES[change]["words"]
            try:
                result = evidence.changed(case_keys(change))
            except UnfinishedError as error:
                parts.append(f"{words}: no result ({error})")
                continue
            other = copy.copy(evidence)
            other.introductory = result
            values, others = self.compute(other)
            met = all(self._compared(values, others).values())
            verdict = "meets the criterion" if met else "does not meet it"
            shown = f"{values[self.tries['shown']]:.3g} {self.tries['unit']}"
            parts.append(f"{words}: {shown}, {verdict}")
        return "With " + "; ".join(parts) + "."


def _limit(words: str, names: Mapping[str, Any]) -> Any:
    """A name, or a product of names and numbers."""
    if words in names:
        return names[words]
    return math.prod(names[word] if word in names else float(word) for word in words.split())


def unchecked(reason: str) -> Finding:
    """Finding for a claim that nothing can be compared with."""
    return Finding(ours="-", criterion="-", holds=None, explanation=reason)
