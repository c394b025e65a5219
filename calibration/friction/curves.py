"""Friction laws as curves of their parameters, for fits.

The law of Huemer has a redundancy: multiplying alpha, beta, a, b, c by one number leaves mu as it
is. The fit holds ``a`` at the value of the paper's Table 2, 0.9203, so that the other six
parameters are unique and come out in the paper's scale.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping

import numpy as np

from contact import FRICTION_LAWS
from contact.friction import ExponentialFriction, FrictionLaw, HuemerFriction
from contact.registry import RegisteredLaw
from materials.arrays import FloatArray

HUEMER_SCALE = 0.9203  # Table 2's a, the normalisation of the fit


class FrictionCurve(ABC):
    """A friction law as a curve of its parameters, at pressures p and (shifted) speeds v."""

    names: tuple[str, ...]
    lower: tuple[float, ...]
    upper: tuple[float, ...]
    #: Class of the law, which takes the parameters by name.
    kind: Callable[..., FrictionLaw]

    def with_scale(self, fixed: dict[str, float]) -> dict[str, float]:
        """Parameters to hold so that the others are unique."""
        return fixed

    @abstractmethod
    def curve(
        self, theta: FloatArray, p: FloatArray, v: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """mu (n,), its derivatives (n, k) by the parameters, and its derivative by ln v (n,)."""

    @abstractmethod
    def starts(self, p: FloatArray, v: FloatArray, mu: FloatArray, count: int) -> FloatArray:
        """Starting points (count, k)."""

    def build(self, values: Mapping[str, float], **floors: float) -> FrictionLaw:
        """The law with the parameters."""
        return self.kind(**values, **floors)


class _Exponential(FrictionCurve):
    kind = ExponentialFriction
    names = ("A", "B", "C")
    lower = (1e-9, -5.0, -5.0)
    upper = (np.inf, 5.0, 5.0)

    def curve(
        self, theta: FloatArray, p: FloatArray, v: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        A, B, C = theta
        shape = p**B * v**C
        mu = A * shape
        return mu, np.stack([shape, mu * np.log(p), mu * np.log(v)], axis=1), C * mu

    def starts(self, p: FloatArray, v: FloatArray, mu: FloatArray, count: int) -> FloatArray:
        known = mu > 0.0
        columns = np.stack([np.ones(known.sum()), np.log(p[known]), np.log(v[known])], axis=1)
        lnA, B, C = np.linalg.lstsq(columns, np.log(mu[known]), rcond=None)[0]
        return np.array([[np.exp(lnA), B, C]])


class _Huemer(FrictionCurve):
    """The starts spread n and 1/m; for given ones the law is a linear problem in the others."""

    kind = HuemerFriction
    names = ("alpha", "beta", "n", "inverse_m", "a", "b", "c")
    lower = (0.0, -np.inf, -1.0, 0.01, 1e-9, -np.inf, 0.0)
    upper = (np.inf, np.inf, 3.0, 2.0, np.inf, np.inf, np.inf)

    def with_scale(self, fixed: dict[str, float]) -> dict[str, float]:
        scaled = any(fixed.get(name) for name in ("alpha", "beta", "a", "b", "c"))
        return fixed if scaled else {"a": HUEMER_SCALE, **fixed}

    def curve(
        self, theta: FloatArray, p: FloatArray, v: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        alpha, beta, n, inverse_m, a, b, c = theta
        log_p, log_v = np.log(p), np.log(v)
        s = np.exp(-inverse_m * log_v)
        power = np.exp((n - 1.0) * log_p)
        inverse = 1.0 / (a + s * (b + s * c))
        mu = (alpha * power + beta) * inverse
        fall = -mu * inverse
        by_s = fall * (b + 2.0 * c * s) * s
        by_alpha, by_n = power * inverse, alpha * power * log_p * inverse
        J = [by_alpha, inverse, by_n, -by_s * log_v, fall, fall * s, fall * s * s]
        return mu, np.stack(J, axis=1), -inverse_m * by_s

    def starts(self, p: FloatArray, v: FloatArray, mu: FloatArray, count: int) -> FloatArray:
        a = HUEMER_SCALE
        spread = max(2, round(np.sqrt(count)))
        points = []
        for n in np.linspace(0.2, 1.8, 2 * (spread // 2)):
            for inverse_m in np.geomspace(0.05, 0.8, -(-count // spread)):
                s = v**-inverse_m
                columns = np.stack([p ** (n - 1.0), np.ones_like(p), -mu * s, -mu * s * s], axis=1)
                alpha, beta, b, c = np.linalg.lstsq(columns, a * mu, rcond=None)[0]
                if c <= 0.0 or b * b >= 4.0 * a * c:
                    b, c = -0.9 * a, 0.8 * a
                points.append([max(alpha, 0.01), beta, n, inverse_m, a, b, c])
        return np.array(points)


class _AnyLaw(FrictionCurve):
    """A law by its class alone: differences for the derivatives, starts about its defaults."""

    def __init__(self, law: RegisteredLaw) -> None:
        self.law, self.kind = law, law.kind
        self.names = tuple(one.name for one in law.parameters)
        self.lower = tuple(one.low for one in law.parameters)
        self.upper = tuple(one.high for one in law.parameters)

    def curve(
        self, theta: FloatArray, p: FloatArray, v: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        steps = _STEP * np.maximum(np.abs(theta), 1e-3)
        J = np.empty((p.size, theta.size))
        for k, step in enumerate(steps):
            ends = [
                np.clip(theta[k] + sign * step, self.lower[k], self.upper[k]) for sign in (1, -1)
            ]
            up, down = (
                self._mu(np.where(np.arange(theta.size) == k, end, theta), p, v) for end in ends
            )
            J[:, k] = (up - down) / (ends[0] - ends[1])
        faster, slower = (self._mu(theta, p, v * np.exp(sign * _STEP)) for sign in (1, -1))
        return self._mu(theta, p, v), J, (faster - slower) / (2.0 * _STEP)

    def starts(self, p: FloatArray, v: FloatArray, mu: FloatArray, count: int) -> FloatArray:
        middle = np.array(
            [1.0 if one.default is None else one.default for one in self.law.parameters]
        )
        spread = np.random.default_rng(0).normal(0.0, 1.0, (count - 1, middle.size))
        spread = np.vstack([np.zeros(middle.size), spread])
        points = np.where(middle == 0.0, 0.1 * spread, middle * np.exp(spread))
        return np.clip(points, self.lower, self.upper)

    def _mu(self, theta: FloatArray, p: FloatArray, v: FloatArray) -> FloatArray:
        values = dict(zip(self.names, map(float, theta), strict=True))
        return self.build(values, p_min=_NO_FLOOR, v_min=_NO_FLOOR).coefficient(p, v)


#: Relative step of the differences.
_STEP = 1e-6
#: Below all data.
_NO_FLOOR = 1e-12
#: Laws with derivatives and starts of their own.
_OWN: dict[str, FrictionCurve] = {"exponential": _Exponential(), "huemer": _Huemer()}


def forms() -> dict[str, FrictionCurve]:
    """The laws that can be fitted, as curves of their parameters."""
    return {
        name: _OWN.get(name) or _AnyLaw(law) for name, law in FRICTION_LAWS.items() if law.fitted
    }
