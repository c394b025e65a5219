"""Adaptive step length and help from the outcome of steps; it knows neither solver nor physics."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf


@dataclass(frozen=True, kw_only=True)
class StepPlan:
    """How the next step is tried.

    Attributes
    ----------
    step : float
        Its length.
    bound : float
        What an earlier failure bounds the next lengths by.
    help : float
        Level of the help it gets (damping); 0 for none.
    rest : int
        How many steps are still to keep that level.
    at : float
        Where the step starts.
    failed : bool
        Whether it has failed before, with less help or longer.
    """

    step: float
    bound: float = inf
    help: float = 0.0
    rest: int = 0
    at: float = 0.0
    failed: bool = False


@dataclass(frozen=True, kw_only=True)
class StepController:
    """The next plan from the last one and its outcome.

    A failed step gets help first, and is cut too when there is enough of that: a snap that no step
    length avoids is gone through in a few steps with help, in hundreds without.

    Attributes
    ----------
    step_max, step_min : float
        Bounds of the step.
    easy, hard : int
        Up to `easy` iterations the next step grows, above `hard` it shrinks.
    growth, shrink, cut : float
        Factors after an easy, a hard and a failed step.
    caution, recovery : float
        Steps after a cut stay below `caution` times the failed length, a bound that rises by
        `recovery` with each accepted step: what made a step fail is seldom gone after the next.
    first_help, more_help, enough_help, most_help : float
        Level after a first failure, its factor after another, from where on steps are cut too, and
        the largest one: with 64 at most, creases of single elements in a face that lies on the road
        ended runs at a coefficient of 1.2.
    """

    step_max: float
    step_min: float
    easy: int = 9
    hard: int = 14
    growth: float = 1.5
    shrink: float = 0.75
    cut: float = 0.5
    caution: float = 0.7
    recovery: float = 1.5
    first_help: float = 1.0
    more_help: float = 2.0
    enough_help: float = 4.0
    most_help: float = 4096.0

    def trial(self, plan: StepPlan, longest: float, end: float) -> tuple[float, float]:
        """Length and end of the next step; the last one lands on the end exactly."""
        length = landed(plan.at, min(plan.step, longest), end)
        return length, end if length == end - plan.at else plan.at + length

    def accepted(
        self,
        plan: StepPlan,
        length: float,
        iterations: int,
        *,
        help_left: float = 0.0,
        rest: int = 0,
        at: float = 0.0,
    ) -> StepPlan:
        """Plan from `at` on, after an accepted step of this length; the help left goes on."""
        step, bound = length, plan.bound * self.recovery
        if iterations <= self.easy:
            step *= self.growth
        elif iterations > self.hard:
            step *= self.shrink
        step = min(max(min(step, bound), self.step_min), self.step_max)
        return StepPlan(step=step, bound=bound, help=help_left, rest=rest, at=at)

    def rejected(self, plan: StepPlan, length: float) -> StepPlan:
        """Plan after a failed step of this length: more help, or more and a shorter step."""
        if plan.help < self.enough_help:
            level = max(self.first_help, self.more_help * plan.help)
            return replace(plan, step=length, help=level, failed=True)
        level = min(self.more_help * plan.help, self.most_help)
        shorter, bound = length * self.cut, self.caution * length
        return replace(plan, step=shorter, bound=bound, help=level, failed=True)

    def helped(self, plan: StepPlan, length: float) -> StepPlan:
        """Plan of that length with help, where cuts alone have led nowhere."""
        return replace(plan, step=length, bound=inf, help=self.first_help, failed=True)

    def exhausted(self, plan: StepPlan) -> bool:
        """Whether a step is too small to go on with."""
        return plan.step < self.step_min


def landed(position: float, step: float, end: float) -> float:
    """Step that lands on the end exactly and leaves no sliver before it."""
    remaining = end - position
    if step >= remaining * (1.0 - 1e-9):
        return remaining
    if 2.0 * step > remaining:
        return 0.5 * remaining
    return step
