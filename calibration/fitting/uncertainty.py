"""Covariance of fitted parameters, and what makes it untrustworthy.

References
----------
.. [1] Seber, G. A. F., Wild, C. J., Nonlinear Regression (1989), chapters 2, 3 and 5.
"""

from dataclasses import replace

import numpy as np

from calibration.fitting.minimum import least_squares_solution, thinned
from calibration.fitting.problem import Problem
from materials.arrays import BoolArray, FloatArray

CORRELATION_LIMIT = 0.99
_SINGULAR = 1e-10  # smallest singular value of the column-scaled Jacobian, relative to the largest
_ENOUGH_FOR_CURVATURE = 20_000  # points on which the curvature of larger problems is judged


def uncertainty(
    problem: Problem, theta: FloatArray, residuals: FloatArray
) -> tuple[FloatArray, FloatArray, tuple[str, ...]]:
    """Covariance ``s^2 (J^T J)^-1`` [1]_, standard errors and warnings at a minimum.

    A parameter at its bound is left out (NaN); one that the data cannot determine has an infinite
    standard error.
    """
    n, k = residuals.size, theta.size
    J = problem.slopes(theta)
    tiny = 1e-6 * np.maximum(1e-6, np.abs(theta))
    bound = (theta - problem.lower <= tiny) | (problem.upper - theta <= tiny)
    warnings = [
        f"{problem.names[i]} = {theta[i]:.6g} is at its bound" for i in np.flatnonzero(bound)
    ]
    covariance, free = np.full((k, k), np.nan), np.flatnonzero(~bound)
    if n < free.size or (n == free.size and not problem.absolute):
        warnings.append(f"{n} points for {free.size} parameters leave nothing for standard errors")
        return covariance, np.full(k, np.nan), tuple(warnings)
    if free.size:
        s2 = _variance(problem, residuals, int(free.size))
        inverse, undetermined = _inverse_normal_matrix(J[:, free])
        covariance[np.ix_(free, free)] = s2 * inverse
        for i in np.flatnonzero(undetermined):
            warnings.append(f"{problem.names[free[i]]} is not determined by these data (singular)")
            covariance[free[i], free[i]] = np.inf
    warnings += _correlation_warnings(problem.names, covariance)
    warnings += _curvature_warnings(problem, theta, residuals, covariance)
    return covariance, np.sqrt(np.diag(covariance)), tuple(warnings)


def _variance(problem: Problem, residuals: FloatArray, fitted: int) -> float:
    """Variance of the weighted residuals: known to be one, or their scatter about the fit."""
    if problem.absolute:
        return 1.0
    return float(residuals @ residuals) / max(residuals.size - fitted, 1)


def _inverse_normal_matrix(J: FloatArray) -> tuple[FloatArray, BoolArray]:
    """``(J^T J)^-1`` and which parameters take part in a singular direction."""
    sizes = np.linalg.norm(J, axis=0)
    empty = sizes == 0.0
    scale = np.where(empty, 1.0, sizes)
    reduced = np.linalg.qr(J / scale, mode="r")
    _, singular, directions = np.linalg.svd(reduced, full_matrices=False)
    good = singular > _SINGULAR * singular[0]
    weights = np.where(good, 1.0 / np.where(good, singular, 1.0) ** 2, 0.0)
    inverse = (directions.T * weights) @ directions / np.outer(scale, scale)
    undetermined = empty | np.any(np.abs(directions[~good]) > 1e-3, axis=0)
    return inverse, undetermined


def correlation_of(covariance: FloatArray) -> FloatArray:
    """Correlation matrix of a covariance matrix; NaN where a variance is not finite."""
    with np.errstate(invalid="ignore", divide="ignore"):
        error = np.sqrt(np.diag(covariance))
        return covariance / np.outer(error, error)


def _correlation_warnings(names: tuple[str, ...], covariance: FloatArray) -> list[str]:
    correlation = correlation_of(covariance)
    return [
        f"{names[i]} and {names[j]} are correlated by {correlation[i, j]:+.4f}: "
        "the data determine their combination, not each of them"
        for i in range(len(names))
        for j in range(i + 1, len(names))
        if np.isfinite(correlation[i, j]) and abs(correlation[i, j]) > CORRELATION_LIMIT
    ]


def _curvature_warnings(
    problem: Problem, theta: FloatArray, residuals: FloatArray, covariance: FloatArray
) -> list[str]:
    """Name the parameters whose standard error a straight tangent does not justify.

    Two standard errors from the minimum, with the others fitted again, the sum of squares of a
    linear problem is larger by 4 s^2. Where the real one differs from that by more than 40 %,
    intervals from the covariance are not to be trusted.
    """
    variance = np.diag(covariance)
    known = np.flatnonzero(np.isfinite(variance) & (variance > 0.0))
    least = float(residuals @ residuals)
    s2 = _variance(problem, residuals, int(known.size))
    exact = not problem.absolute and least <= 1e-20 * float(np.sum(problem.observed**2))
    if problem.linear or exact or not known.size:
        return []
    problem, least, repeated = _for_curvature(problem, theta, least)
    curved = []
    for k in known:
        step = 2.0 * np.nan_to_num(covariance[:, k], posinf=0.0) / np.sqrt(variance[k])
        growth = [
            (_refitted(problem, int(k), theta + sign * step) - least) * repeated / (4.0 * s2)
            for sign in (1.0, -1.0)
        ]
        if not 0.6 <= min(growth) <= max(growth) <= 1.4:
            curved.append(problem.names[k])
    if not curved:
        return []
    return [
        f"the standard error of {', '.join(curved)} is that of a tangent that does not hold over "
        "two of them: use profile or bootstrap intervals"
    ]


def _for_curvature(
    problem: Problem, theta: FloatArray, least: float
) -> tuple[Problem, float, float]:
    """The problem, its least sum of squares, and how many times it stands for.

    Of very many points some stand for all: on the fitted curve itself, whose minimum they share.
    """
    small = thinned(problem, _ENOUGH_FOR_CURVATURE)
    if small is problem:
        return problem, least, 1.0
    on_curve = replace(small, observed=small.predict(theta))
    return on_curve, 0.0, problem.observed.size / small.observed.size


def _refitted(problem: Problem, k: int, theta: FloatArray) -> float:
    """Sum of squares with the k-th parameter held, the others after a few Gauss-Newton steps."""
    if np.any(theta < problem.lower) or np.any(theta > problem.upper):
        return float("inf")
    others = np.arange(theta.size) != k
    with np.errstate(all="ignore"):
        r = problem.residuals(theta)
        for _ in range(4 if others.any() else 0):
            J = problem.slopes(theta)[:, others]
            if not (np.all(np.isfinite(J)) and np.all(np.isfinite(r))):
                return float("inf")
            trial = theta.copy()
            trial[others] -= least_squares_solution(J, r)
            trial = np.clip(trial, problem.lower, problem.upper)
            moved = problem.residuals(trial)
            if not float(moved @ moved) < float(r @ r):
                break
            theta, r = trial, moved
    return float(r @ r)
