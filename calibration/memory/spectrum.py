"""As few relaxation times as the data support, whatever kind of test they come from.

A test asks for a slow curve of a few parameters and the response of one branch of modulus 1 to its
history, as a function of the relaxation time. The moduli of branches on a grid of relaxation times
then follow from one linear problem with non-negative unknowns [1]_; the few that are not zero,
neighbours taken together, begin a fit in which the times are free as well. Branches are then taken
away one by one, and the number with the lowest Bayesian criterion [2]_ is kept. A branch counts as
three parameters there, as its place was looked for on the whole axis [3]_, and the points as so
many independent ones, from how often the residuals change their sign [4]_.

References
----------
.. [1] Lawson, C. L., Hanson, R. J., Solving Least Squares Problems (1974), chapter 23.
.. [2] Schwarz, G., Ann. Statist. 6 (1978) 461-464.
.. [3] Zhang, N. R., Siegmund, D. O., Biometrics 63 (2007) 22-32.
.. [4] Wald, A., Wolfowitz, J., Ann. Math. Statist. 11 (1940) 147-162 (number of runs).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import nnls

from calibration.fitting import Problem, column_sizes, minimise, stage
from materials.arrays import BoolArray, FloatArray

NODES_PER_DECADE = 12
_MOST_BRANCHES = 24  # that the search begins with
_HOPELESS = 100.0  # a criterion above the lowest by that much only rises with fewer branches
_LEAST_MODULUS = 1e-6  # of the largest on the grid; smaller ones are none


@dataclass(frozen=True, kw_only=True)
class MemoryCurve:
    """Observations as a slow curve and branches.

    Attributes
    ----------
    names : tuple of str
        The k parameters of the slow curve.
    slow, slow_slopes : callable
        Slow curve (n,) of the parameters, and its derivatives (n, k).
    modulus : callable
        Slow modulus that those of the branches are relative to, and its derivatives (k,).
    branch : callable
        Response (n, branches) to branches of modulus 1 at logarithmic relaxation times (branches,)
        and its derivatives by these.
    lower, upper : (k,) arrays
        Bounds of the parameters.
    starts : (m, k) array
        Slow curves to begin with.
    moduli : (k,) bool array
        Parameters that the slow curve is proportional to, all together.
    tau_s : (low, high)
        Relaxation times that the observations can tell.
    observed : (n,) array
    weights : (n,) array or None
        Factors of the residuals.
    """

    names: tuple[str, ...]
    slow: Callable[[FloatArray], FloatArray]
    slow_slopes: Callable[[FloatArray], FloatArray]
    modulus: Callable[[FloatArray], tuple[float, FloatArray]]
    branch: Callable[[FloatArray], tuple[FloatArray, FloatArray]]
    lower: FloatArray
    upper: FloatArray
    starts: FloatArray
    moduli: BoolArray
    tau_s: tuple[float, float]
    observed: FloatArray
    weights: FloatArray | None = None


def log_grid(tau_s: tuple[float, float]) -> FloatArray:
    """Natural logarithms of relaxation times between two, evenly spread."""
    decades = np.log10(tau_s[1] / tau_s[0])
    count = max(4, int(np.ceil(NODES_PER_DECADE * decades)) + 1)
    return np.log(np.geomspace(*tau_s, count))


def branch_names(count: int) -> tuple[str, ...]:
    """Names of the moduli and relaxation times of that many branches."""
    numbers = range(1, count + 1)
    return (*(f"g{i}" for i in numbers), *(f"tau{i}_s" for i in numbers))


def memory_problem(curve: MemoryCurve, count: int, *, logarithmic: bool = False) -> Problem:
    """Least-squares problem of the slow parameters, `count` moduli over the slow one and times.

    The times are seconds, or natural logarithms of them for a search.
    """
    k = len(curve.names)

    def parts(theta: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        log_tau = theta[k + count :] if logarithmic else np.log(theta[k + count :])
        return theta[:k], theta[k : k + count], *curve.branch(log_tau)

    def predict(theta: FloatArray) -> FloatArray:
        slow, g, response, _ = parts(theta)
        return np.asarray(curve.slow(slow) + curve.modulus(slow)[0] * (response @ g))

    def jacobian(theta: FloatArray) -> FloatArray:
        slow, g, response, slope = parts(theta)
        G, G_slopes = curve.modulus(slow)
        scale = np.ones(count) if logarithmic else 1.0 / theta[k + count :]
        by_slow = curve.slow_slopes(slow) + np.outer(response @ g, G_slopes)
        return np.column_stack([by_slow, G * response, G * slope * (g * scale)])

    def in_order(theta: FloatArray) -> FloatArray:
        g, tau = theta[k : k + count], theta[k + count : k + 2 * count]
        order = np.argsort(tau)
        return np.concatenate([theta[:k], g[order], tau[order], theta[k + 2 * count :]])

    limits = np.log(curve.tau_s) if logarithmic else np.asarray(curve.tau_s)
    return Problem(
        names=(*curve.names, *branch_names(count)),
        predict=predict,
        jacobian=jacobian,
        observed=curve.observed,
        weights=curve.weights,
        lower=np.concatenate([curve.lower, np.zeros(count), np.full(count, limits[0])]),
        upper=np.concatenate([curve.upper, np.full(count, np.inf), np.full(count, limits[1])]),
        canonical=in_order,
    )


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """A number of branches, the best parameters with it and how they do.

    ``bic`` is the Bayesian criterion; ``theta`` has the times in seconds, rising.
    """

    count: int
    theta: FloatArray
    rmse: float
    bic: float


def candidates(curve: MemoryCurve, most: int | None = None) -> tuple[list[Candidate], float]:
    """Best parameters by number of branches, down to too few, and the share of independent points.

    Parameters
    ----------
    curve : MemoryCurve
    most : int or None
        Not more branches than that.
    """
    slow, g, log_tau = _on_grid(curve)
    limit = _MOST_BRANCHES if most is None else most
    while g.size > limit:
        slow, g, log_tau = _one_fewer(curve, slow, g, log_tau)
    found: list[Candidate] = []
    independent = 1.0
    while True:
        stage(f"fit with {g.size} branches")
        problem = memory_problem(curve, g.size, logarithmic=True)
        best = minimise(problem, np.concatenate([slow, g, log_tau])[None, :])
        slow, g, log_tau = np.split(best.x, [len(curve.names), len(curve.names) + g.size])
        residuals = problem.residuals(best.x)
        if not found:
            independent = independent_share(residuals)
        found.append(_candidate(curve, problem, best.x, g.size, independent))
        hopeless = found[-1].bic > fewest(found).bic + _HOPELESS
        if g.size == 0 or (hopeless and most is None):
            return found, independent
        slow, g, log_tau = _one_fewer(curve, slow, g, log_tau)


def fewest(found: Sequence[Candidate]) -> Candidate:
    """The candidate with the lowest criterion."""
    return min(found, key=lambda candidate: candidate.bic)


def independent_share(residuals: FloatArray) -> float:
    """Independent points over points: noise changes its sign at every other one [4]_."""
    runs = 1 + np.count_nonzero(np.diff(np.sign(residuals)))
    return min(1.0, 2.0 * runs / residuals.size)


def _candidate(
    curve: MemoryCurve, problem: Problem, x: FloatArray, count: int, independent: float
) -> Candidate:
    """Parameters of a search with their criterion."""
    assert problem.canonical is not None
    slow, g, log_tau = np.split(problem.canonical(x), [len(curve.names), len(curve.names) + count])
    residuals = problem.residuals(x)
    n = max(independent * curve.observed.size, 2.0)
    floor = 1e-24 * float(np.sum(curve.observed**2))
    free = len(curve.names) + 3 * count + 1
    squares = max(float(residuals @ residuals), floor)
    return Candidate(
        count=count,
        theta=np.concatenate([slow, g, np.exp(log_tau)]),
        rmse=float(np.sqrt(np.mean((problem.predict(x) - curve.observed) ** 2))),
        bic=float(n * np.log(squares) + free * np.log(n)),
    )


def _on_grid(curve: MemoryCurve) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Slow parameters, moduli over the slow one and logarithmic times from the grid."""
    nodes = log_grid(curve.tau_s)
    response = curve.branch(nodes)[0]
    fits = [_non_negative(curve, start, response) for start in curve.starts]
    slow, moduli, _ = min(fits, key=lambda one: one[2])
    G = curve.modulus(slow)[0]
    used = np.flatnonzero(moduli > _LEAST_MODULUS * max(float(moduli.max(initial=0.0)), 1e-300))
    groups = np.split(used, np.flatnonzero(np.diff(used) > 1) + 1) if used.size else []
    g = np.array([moduli[group].sum() / G for group in groups])
    log_tau = np.array([moduli[group] @ nodes[group] / moduli[group].sum() for group in groups])
    return slow, g, log_tau


def _non_negative(
    curve: MemoryCurve, start: FloatArray, response: FloatArray
) -> tuple[FloatArray, FloatArray, float]:
    """Slow parameters, non-negative moduli and misfit at given responses, from a slow curve.

    Slow curves that are linear in their parameters are found as a whole, others by their scale
    about the start: both are one step of the linear problem there.
    """
    slopes, observed = curve.slow_slopes(start), curve.observed
    linear = np.allclose(slopes @ start, curve.slow(start), rtol=1e-9, atol=1e-12)
    columns = slopes if linear else curve.slow(start)[:, None]
    w = np.ones_like(observed) if curve.weights is None else curve.weights
    A = w[:, None] * np.hstack([columns, -columns, response])
    scale = column_sizes(A)
    R = np.asarray(np.linalg.qr(np.column_stack([A / scale, w * observed]), mode="r"))
    x, misfit = nnls(R[:, :-1], R[:, -1], maxiter=50 * A.shape[1])
    x = x / scale
    m = columns.shape[1]
    factor = x[:m] - x[m : 2 * m]
    slow = factor if linear else start * np.where(curve.moduli, factor[0], 1.0)
    inside = np.clip(slow, curve.lower, curve.upper)
    return inside, x[2 * m :], float(misfit) if np.array_equal(slow, inside) else float(misfit) * 2


def _one_fewer(
    curve: MemoryCurve, slow: FloatArray, g: FloatArray, log_tau: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The same with one branch dropped or two neighbours joined, whichever does least harm."""
    options = [np.delete(log_tau, i) for i in range(g.size)]
    for i, j in pairwise(range(g.size)):
        share = g[j] / max(g[i] + g[j], 1e-300)
        joined = log_tau[i] + share * (log_tau[j] - log_tau[i])
        options.append(np.append(np.delete(log_tau, [i, j]), joined))
    fits = [(_non_negative(curve, slow, curve.branch(times)[0]), times) for times in options]
    (fewer, moduli, _), times = min(fits, key=lambda one: one[0][2])
    order = np.argsort(times)
    return fewer, moduli[order] / curve.modulus(fewer)[0], times[order]
