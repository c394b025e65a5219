"""What stands in `statements.toml`, and the limits it names."""

import tomllib
from pathlib import Path
from typing import Any

from validation.analysis import CRITICAL_RANK_CORRELATION, TESTED_STRETCH, paper_numbers

_TABLES: dict[str, Any] = tomllib.loads(
    Path(__file__).with_name("statements.toml").read_text(encoding="utf-8")
)
#: Texts that others refer to, by name.
TEXTS: dict[str, str] = _TABLES.pop("texts")
#: Changes of the introductory example by name: case keys, and ``words`` for a reader.
CHANGES: dict[str, dict[str, Any]] = _TABLES.pop("changes")
#: Statements by section of the paper and key.
STATEMENTS: dict[str, dict[str, dict[str, Any]]] = _TABLES
#: What comparisons and texts call the paper's numbers.
LIMITS: dict[str, float] = {
    "accepted_K": paper_numbers.ACCEPTED_K,
    "measurable_K": paper_numbers.MEASURED_TO_K[0],
    "measured_K": paper_numbers.MEASURED_TO_K[1],
    "similar": paper_numbers.SIMILAR,
    "half_similar": 0.5 * paper_numbers.SIMILAR,
    "critical": CRITICAL_RANK_CORRELATION,
    "tested_stretch": TESTED_STRETCH,
}


def case_keys(change: str) -> dict[str, Any]:
    """Case keys of a change, without its words."""
    return {key: value for key, value in CHANGES[change].items() if key != "words"}
