"""How much a study asks for, said before it is begun."""

from __future__ import annotations

from pathlib import Path

from fem.case.case import Case
from fem.stepping.cost import duration, estimated_cost
from validation.sweeps.study import number_of_cases, some_cases

#: A study with more cases is not begun without being asked for.
MANY_CASES = 1000
#: How many cases are looked at for an estimate.
_SAMPLE = 20
#: Rough size of the field files [bytes].
_BYTES_PER_CELL_AND_SNAPSHOT = 700.0


def size_of_study(path: str | Path, workers: int) -> str:
    """Say how many cases a study has, and roughly how long they take and how much they leave.

    Some cases stand for all of them.
    """
    number, some = number_of_cases(path), some_cases(path, _SAMPLE)
    seconds = sum(estimated_cost(case).seconds for case in some) / len(some)
    space = sum(map(_bytes, some)) / len(some)
    took = duration(number * seconds / workers)
    return f"{number} cases: about {took} with {workers} workers, {number * space / 1e9:.3g} GB"


def _bytes(case: Case) -> float:
    """Rough size of what a run leaves."""
    snapshots = case.output.snapshots if case.output.vtu else 0
    return _BYTES_PER_CELL_AND_SNAPSHOT * estimated_cost(case).elements * snapshots
