"""Adaptive step length from the outcome of steps; it knows neither solver nor physics."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf


@dataclass(frozen=True, kw_only=True)
class StepController:
    """Next step length from the last one.

    Attributes
    ----------
    step_max, step_min : float
        Bounds of the step.
    easy, hard : int
        Up to `easy` iterations the next step grows, above `hard` it shrinks.
    growth, shrink, cut : float
        Factors after an easy, a hard and a failed step.
    caution, recovery : float
        Steps after a failed one stay below `caution` times its length, a bound that rises by
        `recovery` with each accepted step: what made a step fail is seldom gone after the next.
    """

    step_max: float
    step_min: float
    easy: int = 9
    hard: int = 14
    growth: float = 1.5
    shrink: float = 0.75
    cut: float = 0.5
    caution: float = 0.7
    recovery: float = 1.15

    def accepted(self, step: float, iterations: int, bound: float = inf) -> float:
        """Step after an accepted one, below the bound that a failed step has left."""
        if iterations <= self.easy:
            step *= self.growth
        elif iterations > self.hard:
            step *= self.shrink
        return min(max(min(step, bound), self.step_min), self.step_max)

    def rejected(self, step: float) -> float:
        """Step after a failed one; below `step_min` the run has to end."""
        return step * self.cut

    def exhausted(self, step: float) -> bool:
        """Whether a step is too small to go on with."""
        return step < self.step_min


def landed(position: float, step: float, end: float) -> float:
    """Step that lands on the end exactly and leaves no sliver before it."""
    remaining = end - position
    if step >= remaining * (1.0 - 1e-9):
        return remaining
    if 2.0 * step > remaining:
        return 0.5 * remaining
    return step
