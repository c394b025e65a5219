"""Newton iteration with admissibility cuts and a non-monotone line search; it knows no physics."""

from dataclasses import dataclass
from enum import Enum
from typing import Generic, Protocol, TypeVar

import numpy as np

X = TypeVar("X")
E = TypeVar("E", bound="Evaluation")


class Evaluation(Protocol):
    """What the iteration needs to know of an iterate."""

    @property
    def merit(self) -> float:
        """Size of the residual, in the units of the tolerance; inf if not admissible."""
        ...

    @property
    def settled(self) -> bool:
        """Whether the discrete choices (active set) of the iterate no longer change."""
        ...

    @property
    def signature(self) -> bytes:
        """Name of the discrete choices; equal for equal ones."""
        ...


class Problem(Protocol[X, E]):
    """A nonlinear problem with iterates X and evaluations E; neither changes state."""

    def evaluate(self, x: X) -> E:
        """Residual and status of an iterate."""
        ...

    def direction(self, x: X, evaluation: E) -> X:
        """Newton direction at the iterate; raises `ArithmeticError` when there is none."""
        ...

    def step_limit(self, x: X, direction: X) -> float:
        """Longest sensible step (at most 1), e.g. so that no element deforms too much at once."""
        ...

    def moved(self, x: X, evaluation: E, direction: X, alpha: float) -> X:
        """Iterate at ``x + alpha direction``."""
        ...


class Failure(Enum):
    """Why an iteration ended without a solution; the value says what it means."""

    ITERATIONS = "no convergence within the allowed iterations"
    INADMISSIBLE = "no admissible step (an element would invert or reach the locking stretch)"
    SINGULAR = "the tangent is singular (limit point or missing support)"
    DIVERGED = "the residual grows whatever the step length"
    STALLED = "the residual stops falling"
    CYCLING = "the active set cycles: no contact state fits a step of this length"
    PENETRATION = "the surface passes through itself in a step of this length"


@dataclass(frozen=True, kw_only=True)
class NewtonOptions:
    """Limits of the iteration.

    Attributes
    ----------
    tolerance : float
        Merit below which an iterate is a solution.
    iterations_max : int
        Allowed iterations (factorisations).
    halvings_max : int
        Allowed cuts of one step.
    growth_max : float
        Largest accepted growth of the merit over the largest of the last iterates. Above one,
        since the merit jumps when the active set changes.
    cycles_max : int
        Allowed returns to an active set seen before without a clearly smaller merit.
    patience : int
        Allowed iterations in a row without a new smallest merit. A Newton iteration that goes on
        longer without one rarely ends in a solution.
    """

    tolerance: float = 1.0
    iterations_max: int = 25
    halvings_max: int = 8
    growth_max: float = 20.0
    cycles_max: int = 2
    patience: int = 4


@dataclass(frozen=True, kw_only=True)
class NewtonResult(Generic[X, E]):
    """Last iterate, its evaluation, and how the iteration ended (failure None: converged)."""

    x: X
    evaluation: E
    iterations: int
    failure: Failure | None = None
    detail: str = ""

    @property
    def converged(self) -> bool:
        """Whether `x` is a solution."""
        return self.failure is None


def solve(problem: Problem[X, E], x: X, options: NewtonOptions) -> NewtonResult[X, E]:
    """Solve a problem by Newton's method from the start value `x`.

    Parameters
    ----------
    problem : Problem
        Evaluates iterates and gives Newton directions.
    x : X
        Start value; never changed.
    options : NewtonOptions
        Limits.

    Returns
    -------
    NewtonResult
    """

    def ended(
        iterations: int, failure: Failure | None = None, detail: str = ""
    ) -> NewtonResult[X, E]:
        return NewtonResult(
            x=x, evaluation=evaluation, iterations=iterations, failure=failure, detail=detail
        )

    evaluation = problem.evaluate(x)
    if not np.isfinite(evaluation.merit):
        return ended(0, Failure.INADMISSIBLE)
    merits, cycles = [evaluation.merit], _CycleCount()
    progress = _Progress()
    for iteration in range(options.iterations_max):
        if evaluation.settled and evaluation.merit <= options.tolerance:
            return ended(iteration)
        try:
            direction = problem.direction(x, evaluation)
        except ArithmeticError as error:
            return ended(iteration + 1, Failure.SINGULAR, str(error))
        bound = options.growth_max * max(max(merits[-3:]), options.tolerance)
        step = _line_search(problem, x, evaluation, direction, bound, options.halvings_max)
        if step is None:
            admissible = problem.evaluate(problem.moved(x, evaluation, direction, 1e-3))
            finite = np.isfinite(admissible.merit)
            return ended(iteration + 1, Failure.DIVERGED if finite else Failure.INADMISSIBLE)
        x, evaluation = step
        merits.append(evaluation.merit)
        if progress.pause(evaluation) > options.patience:
            return ended(iteration + 1, Failure.STALLED)
        if cycles.returns(evaluation) > options.cycles_max:
            return ended(iteration + 1, Failure.CYCLING)
    if evaluation.settled and evaluation.merit <= options.tolerance:
        return ended(options.iterations_max)
    last = f"last merit {evaluation.merit:.2e}"
    return ended(options.iterations_max, Failure.ITERATIONS, last)


class _Progress:
    """Counts iterations since the last new smallest merit.

    That of the start does not count: a start without contact or with the old friction may violate
    little and still be far away.
    """

    #: A merit below this share of the smallest so far counts as a new smallest one.
    SHARE = 0.9

    def __init__(self) -> None:
        self.smallest, self.count = np.inf, 0

    def pause(self, evaluation: Evaluation) -> int:
        """Iterations since the last new smallest merit, with this evaluation."""
        self.count += 1
        if evaluation.merit < self.SHARE * self.smallest:
            self.smallest, self.count = evaluation.merit, 0
        return self.count


class _CycleCount:
    """Counts returns to active sets seen before that bring no progress."""

    #: A merit below this share of the last one with the same set counts as progress.
    PROGRESS = 0.7

    def __init__(self) -> None:
        self.merits: dict[bytes, float] = {}
        self.count = 0

    def returns(self, evaluation: Evaluation) -> int:
        """Number of returns so far, with this evaluation."""
        if evaluation.settled:
            return 0
        last = self.merits.get(evaluation.signature)
        self.count += last is not None and evaluation.merit > self.PROGRESS * last
        self.merits[evaluation.signature] = evaluation.merit
        return self.count


def _line_search(
    problem: Problem[X, E], x: X, evaluation: E, direction: X, bound: float, halvings: int
) -> tuple[X, E] | None:
    """First of the step limit, its half, ... whose merit is below the bound; None if none is."""
    alpha = problem.step_limit(x, direction)
    for _ in range(halvings + 1):
        trial = problem.moved(x, evaluation, direction, alpha)
        trial_evaluation = problem.evaluate(trial)
        if trial_evaluation.merit <= bound:
            return trial, trial_evaluation
        alpha *= 0.5
    return None
