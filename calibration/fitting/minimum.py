"""Minima of sums of squares: starts compared on few points, the best one refined on more and all.

References
----------
.. [1] Nocedal, J., Wright, S. J., Numerical Optimization, 2nd ed. (2006), chapter 10.
"""

import numpy as np
from scipy import optimize

from calibration.fitting.problem import Loss, Problem
from calibration.fitting.progress import evaluated
from materials.arrays import FloatArray, IndexArray

_ENOUGH_TO_SEARCH = 300  # points that the starts are compared on when there are more
_ENOUGH_TO_REFINE = 20_000  # points that the best one is refined on before all
_TALL = 5_000  # rows from which a factorisation without Q is the faster solution
_ARRIVED = 1e-9  # share of the sum of squares that another step may promise at a minimum
_MOST_PASSES, _MOST_DAMPINGS = 10, 8  # over all rows, and tries of a shorter step in each
_REFINED = 4  # rough minima, the lowest, that are refined
_AGREEMENT = 1e-2  # rough minima whose cost is that close to the lowest count as the same


def minimise(
    problem: Problem, starts: FloatArray, *, loss: Loss = "linear", noise: float = 0.1
) -> optimize.OptimizeResult:
    """Best local minimum over all starts, polished by Gauss-Newton steps.

    Returns scipy's result with ``agreeing`` and ``tried``, the numbers of starts that reached the
    best minimum and of all starts.
    """
    if problem.linear and loss == "linear":
        linear = _solve_linear(problem)
        if linear is not None:
            return linear
    inside = np.clip(starts, problem.lower, problem.upper)
    inside = np.unique(inside[np.all(np.isfinite(inside), axis=1)], axis=0)
    small = thinned(problem, _ENOUGH_TO_SEARCH)
    found = _searched(small, inside, loss, noise)
    best = _lowest([_local(small, start, loss, noise) for start in _distinct(found)])
    larger = thinned(problem, _ENOUGH_TO_REFINE)
    if larger.observed.size > small.observed.size:
        small, best = larger, _lowest([_local(larger, best.x, loss, noise)])
    if small.observed.size < problem.observed.size:
        best = _finished(problem, best, loss, noise)
    best.tried = len(inside)
    best.agreeing = sum(result.cost <= (1.0 + _AGREEMENT) * found[0].cost for result in found)
    return _polished(problem, best) if loss == "linear" else best


def _distinct(found: list[optimize.OptimizeResult]) -> list[FloatArray]:
    """Starts for the refinement: rough minima, the lowest first, each valley once."""
    distinct: list[optimize.OptimizeResult] = []
    rest: list[optimize.OptimizeResult] = []
    for result in found:
        new = all(abs(result.cost - other.cost) > 1e-3 * other.cost for other in distinct)
        (distinct if new else rest).append(result)
    return [result.x for result in (distinct + rest)[:_REFINED]]


def _finished(
    problem: Problem, near: optimize.OptimizeResult, loss: Loss, noise: float
) -> optimize.OptimizeResult:
    """Minimum on all observations from the one on many of them.

    That is close enough for Gauss-Newton steps with the parameters at their bounds held there; each
    needs one pass over the data. Where these do not arrive, the trust region goes over all rows.
    """
    if loss == "linear":
        best = _descended(problem, near)
        if best is not None:
            return best
    return _lowest([_local(problem, near.x, loss, noise)])


def _descended(problem: Problem, near: optimize.OptimizeResult) -> optimize.OptimizeResult | None:
    """Gauss-Newton steps with the active bounds held; None where they reach no minimum."""
    tiny = 1e-6 * np.maximum(1e-6, np.abs(near.x))
    low, high = near.x - problem.lower <= tiny, problem.upper - near.x <= tiny
    x = np.where(low, problem.lower, np.where(high, problem.upper, near.x))
    held = {problem.names[k]: float(x[k]) for k in np.flatnonzero(low | high)}
    if len(held) == x.size:
        return None
    free = ~(low | high)
    reduced = problem.fixed(held)
    x[free], r, arrived = _levenberg_marquardt(reduced, x[free])
    descent = problem.slopes(x).T @ r
    if np.any(descent[low] < 0.0) or np.any(descent[high] > 0.0):
        return None
    end = {} if arrived else {"message": "stopped short of the minimum of all rows"}
    cost = 0.5 * float(r @ r)
    return optimize.OptimizeResult(
        {**near, "x": x, "fun": r, "cost": cost, "success": arrived, **end}
    )


def _levenberg_marquardt(problem: Problem, x: FloatArray) -> tuple[FloatArray, FloatArray, bool]:
    """Damped Gauss-Newton steps [1]_ that look at all rows once each; x, residuals, arrival."""
    r = problem.residuals(x)
    cost, damping, k = 0.5 * float(r @ r), 0.0, x.size
    nothing = 1e-20 * float(np.sum(problem.observed**2))
    for _ in range(_MOST_PASSES):
        evaluated()
        J = problem.slopes(x)
        scale = column_sizes(J)
        R = np.asarray(np.linalg.qr(np.column_stack([J / scale, r]), mode="r"))
        A, q = R[:k, :k], R[:k, k]
        if 0.5 * float(q @ q) <= _ARRIVED * cost + nothing:
            return x, r, True
        for _ in range(_MOST_DAMPINGS):
            rows = np.vstack([A, np.sqrt(damping) * np.eye(k)])
            trial = x - np.linalg.lstsq(rows, np.append(q, np.zeros(k)), rcond=None)[0] / scale
            if np.all(trial > problem.lower) and np.all(trial < problem.upper):
                with np.errstate(all="ignore"):
                    moved = problem.residuals(trial)
                    lower = 0.5 * float(moved @ moved)
                if lower < cost:
                    break
            damping = max(10.0 * damping, 1e-6)
        else:
            return x, r, False
        gained, x, r, cost = cost - lower, trial, moved, lower
        if gained <= _ARRIVED * cost:
            return x, r, True
        damping *= 0.1
    return x, r, False


def column_sizes(J: FloatArray) -> FloatArray:
    """Norms of the columns to scale them by; one for a parameter without influence, which stays."""
    scale = np.linalg.norm(J, axis=0)
    return np.asarray(np.where(scale == 0.0, 1.0, scale))


def _lowest(results: list[optimize.OptimizeResult | None]) -> optimize.OptimizeResult:
    whole = [result for result in results if result is not None]
    if not whole:
        raise ValueError("no start gives finite predictions; expected data the model can follow")
    return min(whole, key=lambda result: float(result.cost))


def thinned(problem: Problem, rows: int) -> Problem:
    """The problem on at most that many of its observations, evenly spread over the table."""
    n = problem.observed.size
    if problem.subset is None or n <= rows:
        return problem
    return problem.subset(evenly_spread(n, rows))


def evenly_spread(n: int, most: int) -> IndexArray:
    """Indices of all of n rows, or of as many as asked for that are spread evenly over them."""
    return np.linspace(0, n - 1, min(n, most)).round().astype(np.intp)


def least_squares_solution(J: FloatArray, r: FloatArray) -> FloatArray:
    """Minimiser of ``|J x - r|``; tall problems are reduced by an orthogonal factorisation."""
    if J.shape[0] > _TALL:
        R = np.asarray(np.linalg.qr(np.column_stack([J, r]), mode="r"))
        J, r = R[:-1, :-1], R[:-1, -1]
    return np.asarray(np.linalg.lstsq(J, r, rcond=None)[0])


def _scaled_solution(J: FloatArray, r: FloatArray) -> FloatArray:
    scale = column_sizes(J)
    return least_squares_solution(J / scale, r) / scale


def _searched(
    problem: Problem, starts: FloatArray, loss: Loss, noise: float
) -> list[optimize.OptimizeResult]:
    """Rough minima from all starts, the lowest first."""
    if len(starts) <= _REFINED:
        return [optimize.OptimizeResult(x=start, cost=0.0) for start in starts]
    rough = [_local(problem, start, loss, noise, tolerance=1e-5, steps=60) for start in starts]
    return sorted(
        (result for result in rough if result is not None), key=lambda result: float(result.cost)
    )


def _solve_linear(problem: Problem) -> optimize.OptimizeResult | None:
    origin = np.zeros(len(problem.names))
    theta = -_scaled_solution(problem.slopes(origin), problem.residuals(origin))
    if np.any(theta < problem.lower) or np.any(theta > problem.upper):
        return None  # a bound is active: leave it to the iterative solver
    r = problem.residuals(theta)
    return optimize.OptimizeResult(
        x=theta,
        fun=r,
        cost=0.5 * r @ r,
        success=True,
        message="linear problem, solved directly",
        agreeing=1,
        tried=1,
    )


def _local(
    problem: Problem,
    start: FloatArray,
    loss: Loss,
    noise: float,
    *,
    tolerance: float = 1e-10,
    steps: int = 200,
) -> optimize.OptimizeResult | None:
    width = problem.upper - problem.lower
    inset = np.minimum(1e-8 * np.maximum(1.0, np.abs(start)), 0.25 * width)
    start = np.clip(start, problem.lower + inset, problem.upper - inset)

    def residuals(theta: FloatArray) -> FloatArray:
        evaluated()
        return problem.residuals(theta)

    with np.errstate(all="ignore"):
        if not np.all(np.isfinite(residuals(start))):
            return None
        try:
            return optimize.least_squares(
                residuals,
                start,
                jac=problem.slopes,
                bounds=(problem.lower, problem.upper),
                x_scale="jac",
                loss=loss,
                f_scale=noise,
                ftol=tolerance,
                xtol=tolerance,
                gtol=1e-12,
                max_nfev=steps,
            )
        except (ValueError, np.linalg.LinAlgError):
            return None  # the model stopped being finite on the way: another start will do


def _polished(problem: Problem, best: optimize.OptimizeResult) -> optimize.OptimizeResult:
    """Gauss-Newton steps to the last digits, which the trust region's tolerances leave open."""
    for _ in range(20):
        trial = best.x - _scaled_solution(problem.slopes(best.x), best.fun)
        if np.any(trial <= problem.lower) or np.any(trial >= problem.upper):
            return best
        with np.errstate(all="ignore"):
            r = problem.residuals(trial)
        cost = 0.5 * float(r @ r)
        if not cost < best.cost:
            return best
        gained = best.cost - cost
        best.x, best.fun, best.cost = trial, r, cost
        if gained <= 1e-14 * cost:
            return best
    return best
