"""A model curve to be fitted to observations."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from materials.arrays import FloatArray, IndexArray

Loss = Literal["linear", "soft_l1", "huber", "cauchy"]


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
    predict: Callable[[FloatArray], FloatArray]
    observed: FloatArray
    lower: FloatArray
    upper: FloatArray
    weights: FloatArray | None = None
    jacobian: Callable[[FloatArray], FloatArray] | None = None
    linear: bool = False
    subset: Callable[[IndexArray], "Problem"] | None = None
    canonical: Callable[[FloatArray], FloatArray] | None = None
    absolute: bool = False

    def residuals(self, theta: FloatArray) -> FloatArray:
        difference = self.predict(theta) - self.observed
        return difference if self.weights is None else self.weights * difference

    def slopes(self, theta: FloatArray) -> FloatArray:
        """Derivatives (n, k) of the residuals."""
        if self.jacobian is None:
            return self._differences(theta)
        J = self.jacobian(theta)
        return J if self.weights is None else self.weights[:, None] * J

    def _differences(self, theta: FloatArray) -> FloatArray:
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

        def full(theta: FloatArray) -> FloatArray:
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
