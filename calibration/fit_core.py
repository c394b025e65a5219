"""One least-squares core for all fits, and the result they share.

References
----------
.. [1] Seber, G. A. F., Wild, C. J., Nonlinear Regression (1989), chapters 2, 3 and 5.
.. [2] Akaike, H., IEEE Trans. Autom. Control 19 (1974) 716-723.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy import optimize, stats

from calibration.parameter_file import write_parameter_file

Array = NDArray[np.float64]
Loss = Literal["linear", "soft_l1", "huber", "cauchy"]

CORRELATION_LIMIT = 0.99
_SINGULAR = 1e-10  # smallest singular value of the column-scaled Jacobian, relative to the largest
_ENOUGH_TO_SEARCH = 300  # points that the starts are compared on when there are more
_REFINED = 3  # rough minima, the lowest, that are refined
_AGREEMENT = 1e-2  # rough minima whose cost is that close to the lowest count as the same


@dataclass(frozen=True, kw_only=True)
class Problem:
    """A model curve to be fitted to observations.

    Parameters
    ----------
    names : tuple of str
        Names of the k parameters.
    predict : callable
        Maps the parameters (k,) to the predictions (n,).
    jacobian : callable, optional
        Maps the parameters to the derivatives (n, k); without it, forward differences are used.
    observed : ndarray, shape (n,)
    weights : ndarray, shape (n,)
        Factors of the residuals ``predict - observed`` (square roots of statistical weights).
    lower, upper : ndarray, shape (k,)
        Bounds that keep the model admissible.
    linear : bool
        Whether the prediction is linear in the parameters: then one solve replaces all starts.
    subset : callable, optional
        Gives the same problem on chosen observations (indices); large data sets are then thinned
        for the search over the starts, and only the last fit uses every point.
    canonical : callable, optional
        Puts parameters that may change places into the order that makes them unique.
    absolute : bool
        Whether the weights are reciprocals of known standard deviations. The covariance then
        follows from them alone, and not from the scatter about the fit.
    """

    names: tuple[str, ...]
    predict: Callable[[Array], Array]
    observed: Array
    lower: Array
    upper: Array
    weights: Array | None = None
    jacobian: Callable[[Array], Array] | None = None
    linear: bool = False
    subset: Callable[[NDArray[np.intp]], "Problem"] | None = None
    canonical: Callable[[Array], Array] | None = None
    absolute: bool = False

    def residuals(self, theta: Array) -> Array:
        difference = self.predict(theta) - self.observed
        return difference if self.weights is None else self.weights * difference

    def slopes(self, theta: Array) -> Array:
        """Derivatives (n, k) of the residuals."""
        if self.jacobian is None:
            return self._differences(theta)
        J = self.jacobian(theta)
        return J if self.weights is None else self.weights[:, None] * J

    def _differences(self, theta: Array) -> Array:
        r = self.residuals(theta)
        J = np.empty((r.size, theta.size))
        steps = 1e-7 * np.maximum(np.abs(theta), 1e-3)
        for k, step in enumerate(np.where(theta + steps > self.upper, -steps, steps)):
            moved = theta.copy()
            moved[k] += step
            J[:, k] = (self.residuals(moved) - r) / step
        return J

    def fixed(self, values: Mapping[str, float]) -> "Problem":
        """The same problem with some parameters held at given values."""
        if not values:
            return self
        free = np.array([name not in values for name in self.names])
        base = np.array([values.get(name, 0.0) for name in self.names])

        def full(theta: Array) -> Array:
            whole = base.copy()
            whole[free] = theta
            return whole

        jacobian, subset = self.jacobian, self.subset
        return replace(
            self,
            names=tuple(name for name in self.names if name not in values),
            predict=lambda theta: self.predict(full(theta)),
            jacobian=None if jacobian is None else lambda theta: jacobian(full(theta))[:, free],
            lower=self.lower[free],
            upper=self.upper[free],
            subset=None if subset is None else lambda rows: subset(rows).fixed(values),
            canonical=None,  # a held parameter has its place
        )


@dataclass(frozen=True, kw_only=True)
class FitResult:
    """Parameters with their uncertainty, and how well they describe the data.

    Parameters
    ----------
    values, stderr : dict
        Parameters and standard errors by name, in the units of the paper; the standard error is
        NaN for a parameter at its bound and infinite for one the data cannot determine.
    covariance : ndarray, shape (k, k)
        Covariance of the fitted parameters in the order of `names`.
    rmse : float
        Root mean square of the unweighted residuals [unit of the data].
    r2 : float
        Coefficient of determination of the unweighted residuals.
    n_data : int
    aic : float
        Akaike's criterion for normal errors of unknown variance [2]_.
    message : str
        What the optimiser said, and from how many starts the same minimum was found.
    warnings : tuple of str
        What a user must know before using the parameters.
    fixed : dict
        Parameters that were held.
    model : object
        The fitted law, ready for use.
    metadata : dict
        Data file, hash, selection, model and version behind the parameters.
    section : dict
        Table name and keys of a case file that take the parameters (empty if none does).
    """

    names: tuple[str, ...]
    values: dict[str, float]
    stderr: dict[str, float]
    covariance: Array
    rmse: float
    r2: float
    n_data: int
    aic: float
    success: bool
    message: str
    warnings: tuple[str, ...] = ()
    fixed: dict[str, float] = field(default_factory=dict)
    model: Any = None
    metadata: dict[str, Any] = field(default_factory=dict)
    section: dict[str, dict[str, Any]] = field(default_factory=dict)
    observed: Array = field(repr=False, default_factory=lambda: np.empty(0))
    predicted: Array = field(repr=False, default_factory=lambda: np.empty(0))
    problem: Problem | None = field(repr=False, default=None)

    @property
    def theta(self) -> Array:
        """Fitted parameters (k,) in the order of `names`."""
        return np.array([self.values[name] for name in self.names])

    @property
    def correlation(self) -> Array:
        """Correlation matrix (k, k) of the fitted parameters."""
        return correlation_of(self.covariance)

    def interval(self, level: float = 0.95) -> dict[str, tuple[float, float]]:
        """Confidence intervals from the covariance and Student's distribution."""
        factor = float(stats.t.ppf(0.5 + 0.5 * level, self._freedom))
        return {
            name: (self.values[name] - factor * error, self.values[name] + factor * error)
            for name, error in self.stderr.items()
        }

    def bootstrap(
        self, samples: int = 200, *, seed: int = 0, level: float = 0.95
    ) -> dict[str, Any]:
        """Percentile intervals from refits to resampled residuals."""
        problem = self._problem()
        rng = np.random.default_rng(seed)
        centred = self.observed - self.predicted
        centred = centred - centred.mean()
        draws = np.empty((samples, len(self.names)))
        for i in range(samples):
            observed = self.predicted + rng.choice(centred, centred.size)
            draws[i] = minimise(replace(problem, observed=observed), self.theta[None, :]).x
        low, high = np.quantile(draws, [0.5 - 0.5 * level, 0.5 + 0.5 * level], axis=0)
        return {name: (low[k], high[k]) for k, name in enumerate(self.names)}

    def profile(self, name: str, *, level: float = 0.95) -> tuple[float, float]:
        """Interval of one parameter from the profile of the sum of squares [1]_.

        The ends are where the best fit with the parameter held is worse by the F quantile; an end
        that is not reached within 50 standard errors or the bounds is infinite.
        """
        problem, k = self._problem(), self.names.index(name)
        least = float(np.sum(problem.residuals(self.theta) ** 2))
        if problem.absolute:
            limit = least + float(stats.chi2.ppf(level, 1))
        else:
            freedom = self._freedom
            limit = least * (1.0 + float(stats.f.ppf(level, 1, freedom)) / freedom)
        others = np.delete(self.theta, k)

        def excess(value: float) -> float:
            held = problem.fixed({name: value})
            if not held.names:
                return float(np.sum(held.residuals(others) ** 2)) - limit
            best = minimise(held, others[None, :])
            return float(np.sum(best.fun**2)) - limit

        return (
            _profile_end(excess, self.values[name], -self.stderr[name], problem.lower[k]),
            _profile_end(excess, self.values[name], self.stderr[name], problem.upper[k]),
        )

    def summary(self) -> str:
        """A few lines to print."""
        width = max(map(len, self.values), default=0)
        lines = [
            f"  {name:<{width}}  {value: .6g}"
            + (f" +- {self.stderr[name]:.2g}" if name in self.stderr else "  (held)")
            for name, value in self.values.items()
        ]
        lines.append(f"  RMSE {self.rmse:.4g}, R2 {self.r2:.6f}, {self.n_data} points")
        lines.append(f"  {self.message}")
        lines += [f"  warning: {warning}" for warning in self.warnings]
        return "\n".join(lines)

    def to_toml(self, path: str | Path) -> Path:
        """Write the parameter file that a case file refers to (``parameters = "..."``)."""
        return write_parameter_file(self, path)

    @property
    def _freedom(self) -> float:
        """Degrees of freedom of the scatter behind the standard errors."""
        if self.problem is not None and self.problem.absolute:
            return float("inf")
        return max(self.n_data - len(self.names), 1)

    def _problem(self) -> Problem:
        if self.problem is None:
            raise ValueError("this result does not hold its problem; expected one from a fit")
        return self.problem


def fit(
    problem: Problem,
    starts: Array,
    *,
    fixed: Mapping[str, float] | None = None,
    loss: Loss = "linear",
    noise: float = 0.1,
) -> FitResult:
    """Fit a problem from several starts.

    Parameters
    ----------
    problem : Problem
    starts : ndarray, shape (m, k)
        Starting parameters, clipped to the bounds; those that are not finite are dropped.
    fixed : mapping, optional
        Parameters to hold, by name.
    loss : {"linear", "soft_l1", "huber", "cauchy"}
        Robust losses bound the pull of outliers; `noise` is the residual where that begins. The
        covariance is then that of the reweighted problem, an approximation: prefer the bootstrap.
    """
    fixed = dict(fixed or {})
    unknown = set(fixed) - set(problem.names)
    if unknown:
        raise ValueError(
            f"fixed holds {', '.join(sorted(unknown))}; "
            f"expected names of {', '.join(problem.names)}"
        )
    free = np.array([name not in fixed for name in problem.names])
    if not free.any():
        raise ValueError("every parameter is fixed; expected at least one to fit")
    reduced = problem.fixed(fixed)
    best = minimise(reduced, np.atleast_2d(starts)[:, free], loss=loss, noise=noise)
    if reduced.canonical is not None:
        best.x = reduced.canonical(best.x)
        best.fun = reduced.residuals(best.x)
    return _result(reduced, best, fixed, problem.names, loss)


def minimise(
    problem: Problem, starts: Array, *, loss: Loss = "linear", noise: float = 0.1
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
    small = _thinned(problem)
    found = _searched(small, inside, loss, noise)
    best = _lowest([_local(small, result.x, loss, noise) for result in found[:_REFINED]])
    if small is not problem:
        best = _lowest([_local(problem, best.x, loss, noise)])
    best.tried = len(inside)
    best.agreeing = sum(result.cost <= (1.0 + _AGREEMENT) * found[0].cost for result in found)
    return _polished(problem, best) if loss == "linear" else best


def _lowest(results: list[optimize.OptimizeResult | None]) -> optimize.OptimizeResult:
    whole = [result for result in results if result is not None]
    if not whole:
        raise ValueError("no start gives finite predictions; expected data the model can follow")
    return min(whole, key=lambda result: float(result.cost))


def _thinned(problem: Problem) -> Problem:
    n = problem.observed.size
    if problem.subset is None or n <= _ENOUGH_TO_SEARCH:
        return problem
    return problem.subset(np.linspace(0, n - 1, _ENOUGH_TO_SEARCH).round().astype(np.intp))


def _searched(
    problem: Problem, starts: Array, loss: Loss, noise: float
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
    J = problem.slopes(origin)
    scale = np.linalg.norm(J, axis=0)
    scale[scale == 0.0] = 1.0
    scaled, *_ = np.linalg.lstsq(J / scale, -problem.residuals(origin), rcond=None)
    theta = scaled / scale
    if np.any(theta < problem.lower) or np.any(theta > problem.upper):
        return None  # a bound is active: leave it to the iterative solver
    r = problem.residuals(theta)
    return optimize.OptimizeResult(
        x=theta, fun=r, cost=0.5 * r @ r, success=True, message="linear problem, solved directly",
        agreeing=1, tried=1,
    )  # fmt: skip


def _local(
    problem: Problem,
    start: Array,
    loss: Loss,
    noise: float,
    *,
    tolerance: float = 1e-10,
    steps: int = 200,
) -> optimize.OptimizeResult | None:
    width = problem.upper - problem.lower
    inset = np.minimum(1e-8 * np.maximum(1.0, np.abs(start)), 0.25 * width)
    start = np.clip(start, problem.lower + inset, problem.upper - inset)
    with np.errstate(all="ignore"):
        if not np.all(np.isfinite(problem.residuals(start))):
            return None
        try:
            return optimize.least_squares(
                problem.residuals, start, jac=problem.slopes,
                bounds=(problem.lower, problem.upper), x_scale="jac", loss=loss, f_scale=noise,
                ftol=tolerance, xtol=tolerance, gtol=1e-12, max_nfev=steps,
            )  # fmt: skip
        except (ValueError, np.linalg.LinAlgError):
            return None  # the model stopped being finite on the way: another start will do


def _polished(problem: Problem, best: optimize.OptimizeResult) -> optimize.OptimizeResult:
    """Gauss-Newton steps to the last digits, which the trust region's tolerances leave open."""
    for _ in range(20):
        J = problem.slopes(best.x)
        scale = np.linalg.norm(J, axis=0)
        if not np.all(scale > 0.0):
            return best
        step = -np.linalg.lstsq(J / scale, best.fun, rcond=None)[0] / scale
        trial = best.x + step
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


def _result(
    problem: Problem,
    best: optimize.OptimizeResult,
    fixed: dict[str, float],
    order: tuple[str, ...],
    loss: Loss,
) -> FitResult:
    predicted = problem.predict(best.x)
    residual = predicted - problem.observed
    n, k = residual.size, best.x.size
    squares = float(residual @ residual)
    total = float(np.sum((problem.observed - problem.observed.mean()) ** 2))
    covariance, stderr, warnings = uncertainty(problem, best.x, best.fun)
    fitted = dict(zip(problem.names, map(float, best.x), strict=True))
    values = {name: fitted.get(name, fixed.get(name, np.nan)) for name in order}
    if loss != "linear":
        warnings = (*warnings, f"loss {loss}: standard errors are approximate, use the bootstrap")
    if not best.success:
        warnings = (*warnings, "the optimiser stopped before it converged")
    return FitResult(
        names=problem.names,
        values=values,
        stderr=dict(zip(problem.names, map(float, stderr), strict=True)),
        covariance=covariance,
        rmse=float(np.sqrt(squares / n)),
        r2=1.0 - squares / total if total > 0.0 else float("nan"),
        n_data=n,
        aic=n * float(np.log(max(squares, 1e-300) / n)) + 2.0 * (k + 1),
        success=bool(best.success),
        message=f"{best.message.rstrip('.')}; {best.agreeing} of {best.tried} starts agree",
        warnings=warnings,
        fixed=dict(fixed),
        observed=problem.observed,
        predicted=predicted,
        problem=problem,
    )


def uncertainty(
    problem: Problem, theta: Array, residuals: Array
) -> tuple[Array, Array, tuple[str, ...]]:
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


def _variance(problem: Problem, residuals: Array, fitted: int) -> float:
    """Variance of the weighted residuals: known to be one, or their scatter about the fit."""
    if problem.absolute:
        return 1.0
    return float(residuals @ residuals) / max(residuals.size - fitted, 1)


def _inverse_normal_matrix(J: Array) -> tuple[Array, NDArray[np.bool_]]:
    """``(J^T J)^-1`` and which parameters take part in a singular direction."""
    scale = np.linalg.norm(J, axis=0)
    empty = scale == 0.0
    scale = np.where(empty, 1.0, scale)
    _, singular, directions = np.linalg.svd(J / scale, full_matrices=False)
    good = singular > _SINGULAR * singular[0]
    weights = np.where(good, 1.0 / np.where(good, singular, 1.0) ** 2, 0.0)
    inverse = (directions.T * weights) @ directions / np.outer(scale, scale)
    undetermined = empty | np.any(np.abs(directions[~good]) > 1e-3, axis=0)
    return inverse, undetermined


def correlation_of(covariance: Array) -> Array:
    """Correlation matrix of a covariance matrix; NaN where a variance is not finite."""
    with np.errstate(invalid="ignore", divide="ignore"):
        error = np.sqrt(np.diag(covariance))
        return covariance / np.outer(error, error)


def _correlation_warnings(names: tuple[str, ...], covariance: Array) -> list[str]:
    correlation = correlation_of(covariance)
    return [
        f"{names[i]} and {names[j]} are correlated by {correlation[i, j]:+.4f}: "
        "the data determine their combination, not each of them"
        for i in range(len(names))
        for j in range(i + 1, len(names))
        if np.isfinite(correlation[i, j]) and abs(correlation[i, j]) > CORRELATION_LIMIT
    ]


def _curvature_warnings(
    problem: Problem, theta: Array, residuals: Array, covariance: Array
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
    curved = []
    for k in known:
        step = 2.0 * np.nan_to_num(covariance[:, k], posinf=0.0) / np.sqrt(variance[k])
        growth = [
            (_refitted(problem, int(k), theta + sign * step) - least) / (4.0 * s2)
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


def _refitted(problem: Problem, k: int, theta: Array) -> float:
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
            trial[others] -= np.linalg.lstsq(J, r, rcond=None)[0]
            trial = np.clip(trial, problem.lower, problem.upper)
            moved = problem.residuals(trial)
            if not float(moved @ moved) < float(r @ r):
                break
            theta, r = trial, moved
    return float(r @ r)


def _profile_end(
    excess: Callable[[float], float], centre: float, step: float, bound: float
) -> float:
    """Where `excess` changes sign, going from `centre` by growing multiples of `step`."""
    if not np.isfinite(step) or step == 0.0:
        return float(np.sign(step) * np.inf) if np.isinf(step) else float("nan")
    inner = centre
    for multiple in (1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0):
        outer = centre + multiple * step
        beyond = outer <= bound if step < 0.0 else outer >= bound
        if beyond:
            outer = bound
        if excess(outer) > 0.0:
            root = optimize.brentq(excess, inner, outer, xtol=1e-9 * abs(step) + 1e-15)
            return float(root)
        if beyond:
            break
        inner = outer
    return float(np.sign(step) * np.inf)
