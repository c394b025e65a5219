"""Newton's method on small problems: convergence, cuts, named failures."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from fem.newton import Failure, NewtonOptions, solve


@dataclass
class Point:
    merit: float
    settled: bool
    residual: float
    signature: bytes = b""


@dataclass
class Scalar:
    """f(x) = 0 with an optional domain; merit |f| / tolerance.

    The discrete state is a new one at each iterate until the problem settles, unless `state` gives
    it from x.
    """

    f: object
    slope: object
    tolerance: float = 1e-10
    domain: tuple[float, float] = (-np.inf, np.inf)
    settles_after: int = 0
    longest: float = np.inf
    state: object = None
    seen: list = field(default_factory=list)

    def evaluate(self, x):
        self.seen.append(x)
        if not self.domain[0] < x < self.domain[1]:
            return Point(merit=np.inf, settled=False, residual=np.nan)
        r, count = self.f(x), len(self.seen)
        state = str(count if self.state is None else self.state(x)).encode()
        return Point(abs(r) / self.tolerance, count > self.settles_after, r, state)

    def direction(self, x, evaluation):
        slope = self.slope(x)
        if slope == 0.0:
            raise ArithmeticError("zero slope")
        return -evaluation.residual / slope

    def step_limit(self, x, direction):
        return min(1.0, self.longest / abs(direction))

    def moved(self, x, evaluation, direction, alpha):
        return x + alpha * direction


def root(**options):
    return Scalar(lambda x: x * x - 2.0, lambda x: 2.0 * x, **options)


def test_a_root_is_found_with_quadratic_convergence():
    problem = root()
    result = solve(problem, 1.0, NewtonOptions())
    assert result.converged
    assert result.x == pytest.approx(np.sqrt(2.0), abs=1e-10)
    assert result.iterations <= 6
    errors = np.abs(np.array(problem.seen[:4]) - np.sqrt(2.0))
    assert errors[3] < 2.0 * errors[2] ** 2


def test_a_solution_as_start_costs_no_iteration():
    result = solve(root(), np.sqrt(2.0), NewtonOptions())
    assert (result.converged, result.iterations) == (True, 0)


def test_a_small_residual_is_not_enough_while_the_status_changes():
    result = solve(root(settles_after=9), 1.0, NewtonOptions())
    assert result.converged
    assert result.iterations >= 8


def test_an_iterate_outside_the_domain_is_cut_back():
    """log x from 5: the full step goes to 5 - 5 log 5 < 0."""
    problem = Scalar(np.log, lambda x: 1.0 / x, domain=(0.0, np.inf))
    result = solve(problem, 5.0, NewtonOptions())
    assert result.converged
    assert result.x == pytest.approx(1.0)
    assert min(problem.seen) < 0.0


def test_no_step_is_longer_than_the_problem_allows():
    problem = root(longest=0.1)
    result = solve(problem, 1.0, NewtonOptions())
    assert result.converged
    assert np.abs(np.diff(problem.seen)).max() <= 0.1 * (1.0 + 1e-12)


def test_an_inadmissible_start_is_named():
    result = solve(Scalar(np.log, lambda x: 1.0 / x, domain=(0.0, 9.0)), -1.0, NewtonOptions())
    assert result.failure is Failure.INADMISSIBLE
    assert not result.converged


def test_a_wall_in_the_way_is_named():
    """The root at 2 lies outside the domain, which ends just above the start."""
    problem = Scalar(lambda x: x - 2.0, lambda x: 1.0, domain=(0.0, 1.0 + 1e-6))
    assert solve(problem, 1.0, NewtonOptions()).failure is Failure.INADMISSIBLE


def test_a_singular_tangent_is_named_with_its_detail():
    result = solve(Scalar(lambda x: x * x + 1.0, lambda x: 2.0 * x), 0.0, NewtonOptions())
    assert result.failure is Failure.SINGULAR
    assert "zero slope" in result.detail


def test_running_out_of_iterations_is_named():
    result = solve(Scalar(lambda x: x**3, lambda x: 3.0 * x**2), 1.0,
                   NewtonOptions(iterations_max=5))  # fmt: skip
    assert result.failure is Failure.ITERATIONS
    assert result.iterations == 5


def root_of_both_signs(**options):
    """sign(x) sqrt|x|: Newton's method jumps from x to -x for ever."""
    return Scalar(
        lambda x: np.sign(x) * np.sqrt(abs(x)), lambda x: 0.5 / np.sqrt(abs(x)), **options
    )


def test_a_cycle_of_states_without_progress_is_given_up_early_and_named():
    result = solve(root_of_both_signs(settles_after=99, state=np.sign), 1.0, NewtonOptions())
    assert result.failure is Failure.CYCLING
    assert result.iterations < 10


def test_the_same_jumps_in_a_settled_state_are_no_cycle():
    options = NewtonOptions(patience=99)
    result = solve(root_of_both_signs(state=np.sign), 1.0, options)
    assert result.failure is Failure.ITERATIONS


def test_a_residual_that_stops_falling_is_given_up_and_named():
    result = solve(root_of_both_signs(), 1.0, NewtonOptions(patience=4))
    assert result.failure is Failure.STALLED
    assert 4 < result.iterations < 10


def test_patience_counts_from_the_last_smallest_residual():
    """Each Newton step on x^3 leaves 8/27 of the residual, so there is never a pause."""
    problem = Scalar(lambda x: x**3, lambda x: 3.0 * x**2)
    assert solve(problem, 1.0, NewtonOptions(iterations_max=99, patience=1)).converged


def test_growth_beyond_the_bound_is_cut_and_named_if_it_stays():
    """A slope of the wrong sign leads uphill whatever the step."""
    problem = Scalar(lambda x: x + 1.0, lambda x: -1e-3)
    result = solve(problem, 0.0, NewtonOptions(growth_max=1.0))
    assert result.failure is Failure.DIVERGED


def test_the_merit_may_rise_within_the_bound():
    """A monotone search would cut the first step of arctan from 1.2; this one need not."""
    problem = Scalar(np.arctan, lambda x: 1.0 / (1.0 + x * x))
    result = solve(problem, 1.2, NewtonOptions())
    assert result.converged
    assert abs(problem.seen[1]) < 1.2
