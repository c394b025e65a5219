"""One least-squares core for all fits, and the result they share.

References
----------
.. [1] Seber, G. A. F., Wild, C. J., Nonlinear Regression (1989), chapters 2, 3 and 5.
.. [2] Akaike, H., IEEE Trans. Autom. Control 19 (1974) 716-723.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy import optimize, stats

from calibration.data import DataError
from calibration.fitting.minimum import minimise
from calibration.fitting.problem import Loss, Problem
from calibration.fitting.uncertainty import correlation_of, uncertainty
from fem.files import write_text
from materials.arrays import FloatArray

__all__ = ["FitResult", "Loss", "Problem", "correlation_of", "fit", "refuse_no_fit"]

LEAST_R2 = 0.1  # a curve that explains less of the data's scatter is none,
CONSTANT = 0.1  # where that scatter is more than this share of the data


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
    covariance: FloatArray
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
    observed: FloatArray = field(repr=False, default_factory=lambda: np.empty(0))
    predicted: FloatArray = field(repr=False, default_factory=lambda: np.empty(0))
    problem: Problem | None = field(repr=False, default=None)

    @property
    def theta(self) -> FloatArray:
        """Fitted parameters (k,) in the order of `names`."""
        return np.array([self.values[name] for name in self.names])

    @property
    def correlation(self) -> FloatArray:
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
        from calibration.fitting.parameter_file import parameter_text

        path = Path(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        write_text(path, parameter_text(self))
        return path

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


def refuse_no_fit(result: FitResult, file: str, column: str) -> None:
    """Refuse a curve that says no more than the mean of its data, unless the data are constant.

    Raises
    ------
    DataError
        Where R2 is near zero and the misfit is more than measuring errors make.
    """
    size = float(np.sqrt(np.mean(result.observed**2)))
    if result.r2 < LEAST_R2 and result.rmse > CONSTANT * size:
        raise DataError(
            file=file,
            column=column,
            found=f"values that the best fit does not follow (R2 = {result.r2:.2g}, "
            f"RMSE {result.rmse:.3g})",
            expected="another model, or data without outliers and mixed-up columns",
        )


def fit(
    problem: Problem,
    starts: FloatArray,
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
