"""What is varied, what it is called, and why over this range: `parameters.toml`."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

PHYSICS, NUMERICS = "physics", "numerics"


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A case key that is varied.

    Attributes
    ----------
    label, unit : str
        What a reader calls it, and the unit of its values; empty where they are words or numbers.
    group : str
        `PHYSICS`: the paper leaves it open, or what it does is not obvious. `NUMERICS`: the
        results should not depend on it.
    why : str
        Where the range comes from.
    """

    label: str
    unit: str = ""
    group: str
    why: str


#: By the case key that a case of the study names first.
PARAMETERS = {
    key: Parameter(**entry)
    for key, entry in tomllib.loads(
        Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
    ).items()
}

#: Between the keys of a case that changes more than one.
AND = " and "


def first_key(parameter: str) -> str:
    """Key of `PARAMETERS` for a cell of the table's column ``parameter``."""
    return parameter.split(AND)[0]
