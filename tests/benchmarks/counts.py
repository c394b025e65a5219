"""Counts of work in a few short runs that a baseline is compared with."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

from fem import Case, simulate
from fem.heat import block as heat_block
from fem.results.result import Result
from fem.solvers import direct as direct_solver
from tests.benchmarks.measured_run import introductory

Counts = dict[str, int]

#: The introductory example on the coarse mesh, shortened: press, snap and 5 mm of sliding.
RUNS: dict[str, dict[str, Any]] = {
    "huemer_5_mm": introductory(5.0, mesh="coarse"),
    "coulomb_0.9_5_mm": introductory(5.0, mesh="coarse")
    | {"friction": {"law": "coulomb", "mu": 0.9}},
    "rigid_20_mm": introductory(20.0, mesh="coarse", rigid=True),
}


@contextmanager
def counted_factorisations() -> Iterator[Counts]:
    """Count every call of SuperLU by the mechanics and by the heat."""
    counts = {"mechanical_factorisations": 0, "heat_factorisations": 0}

    def counting(name: str, factorise: Any) -> Any:
        def counted(*args: Any, **options: Any) -> Any:
            counts[name] += 1
            return factorise(*args, **options)

        return counted

    mechanical = counting("mechanical_factorisations", direct_solver.splu)
    thermal = counting("heat_factorisations", heat_block.splu)
    with patch.object(direct_solver, "splu", mechanical), patch.object(heat_block, "splu", thermal):
        yield counts


def counted_run(case: dict[str, Any]) -> tuple[Result, Counts]:
    """Result of a case, with its counts of work.

    Parameters
    ----------
    case : dict
        The case as in its file.
    """
    with counted_factorisations() as factorisations:
        result = simulate(Case.from_dict(case | {"solver": {"linear_solver": "superlu"}}))
    summary = result.summary
    if summary["status"] != "ok":
        raise RuntimeError(f"the run ended with {summary['status']}, expected ok")
    names = ("steps", "rejected_steps", "newton_iterations")
    return result, {name: int(summary[name]) for name in names} | factorisations
