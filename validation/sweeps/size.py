"""How much a study asks for, said before it is begun."""

from __future__ import annotations

from pathlib import Path

from fem.case import Case
from fem.model_parts import mesh_of
from validation.sweeps.study import number_of_cases, some_cases

#: A study with more cases is not begun without being asked for.
MANY_CASES = 1000
#: How many cases are looked at for an estimate.
_SAMPLE = 20
#: Rough costs of a run: on one core of a present machine [s], and in field files [bytes].
_SECONDS_PER_CELL_AND_MM = 2.5e-4
_BYTES_PER_CELL_AND_SNAPSHOT = 700.0
_UNITS = ((86400.0 * 365.0, "years"), (86400.0, "days"), (3600.0, "hours"), (60.0, "minutes"))


def size_of_study(path: str | Path, workers: int) -> str:
    """Say how many cases a study has, and roughly how long they take and how much they leave.

    Some cases stand for all of them.
    """
    number, some = number_of_cases(path), some_cases(path, _SAMPLE)
    seconds, space = (sum(values) / len(some) for values in zip(*map(costs, some), strict=True))
    took = _time(number * seconds / workers)
    return f"{number} cases: about {took} with {workers} workers, {number * space / 1e9:.3g} GB"


def costs(case: Case) -> tuple[float, float]:
    """Rough time of a run [s] and size of what it leaves [bytes]."""
    cells = len(mesh_of(case).cells)
    snapshots = case.output.snapshots if case.output.vtu else 0
    seconds = _SECONDS_PER_CELL_AND_MM * cells * case.loading.distance_mm
    return seconds, _BYTES_PER_CELL_AND_SNAPSHOT * cells * snapshots


def _time(seconds: float) -> str:
    for length, unit in _UNITS:
        if seconds >= length:
            return f"{seconds / length:.3g} {unit}"
    return f"{seconds:.2g} seconds"
