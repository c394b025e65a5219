"""Nominal stress of the hyperelastic models as curves of their parameters.

Every model gives the stress of incompressible homogeneous tests with its exact derivatives with
respect to the parameters, bounds that keep the energy admissible, and starting points. The starts
use that all models are linear in their moduli: for given exponents or locking stretches the moduli
follow from one small linear problem, so only the nonlinear parameters are spread.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", eqs. (1)-(4).
.. [2] Ogden, R. W., Proc. R. Soc. Lond. A 326 (1972) 565-584.
.. [3] Arruda, E. M., Boyce, M. C., J. Mech. Phys. Solids 41 (1993) 389-412.
"""

import itertools
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import nnls

from calibration.fitting import evenly_spread
from fem.case import CONSTANTS
from materials.arrays import FloatArray, IndexArray, WordArray
from materials.hyperelastic import (
    MODES,
    ArrudaBoyce,
    Hyperelastic,
    MooneyRivlin,
    NeoHooke,
    VanDerWaals,
    Yeoh,
    incompressible_kinematics,
)
from materials.hyperelastic_base import TRANSVERSE
from materials.ogden import Ogden

_CHAIN = np.array([1 / 2, 1 / 20, 11 / 1050, 19 / 7000, 519 / 673750])
_CLOSEST_TO_LOCKING = 0.9999
_POINTS_OF_THE_GRID = 100  # data on which the starts of Ogden's energy are compared
_GRID = {1: 40, 2: 40, 3: 24}  # exponents on the grid by number of terms; none of them is zero


@dataclass(frozen=True, kw_only=True)
class Kinematics:
    """What the models need to know of n homogeneous tests.

    ``P = k1 dW/dI1b + k2 dW/dI2b``; ``transverse`` is the exponent t of the transverse stretch
    ``lam^-t`` (0.5 uniaxial, 2 equibiaxial, 1 planar). All arrays have the shape (n,).
    """

    lam: FloatArray
    I1b: FloatArray
    I2b: FloatArray
    k1: FloatArray
    k2: FloatArray
    transverse: FloatArray

    @classmethod
    def of(cls, stretch: FloatArray, mode: WordArray) -> "Kinematics":
        """Kinematics of stretches (n,) in the modes (n,)."""
        columns = np.empty((4, stretch.size))
        transverse = np.empty(stretch.size)
        for name in MODES:
            here = mode == name
            columns[:, here] = incompressible_kinematics(stretch[here], name)
            transverse[here] = TRANSVERSE[name]
        I1b, I2b, k1, k2 = columns
        return cls(lam=stretch, I1b=I1b, I2b=I2b, k1=k1, k2=k2, transverse=transverse)

    def at(self, rows: IndexArray) -> "Kinematics":
        """Kinematics of some of the tests."""
        return Kinematics(**{key: getattr(self, key)[rows] for key in self.__dataclass_fields__})


class StressModel(ABC):
    """Nominal stress of one hyperelastic model as a function of its parameters."""

    names: tuple[str, ...]
    #: Bounds of the parameters, where the data do not move them.
    lower: tuple[float, ...]
    upper: tuple[float, ...]
    #: Class of the energy, which takes the parameters by name.
    energy: type[Hyperelastic]
    linear = False
    #: Parameters that are held unless the user frees them.
    held: dict[str, float] = {}  # noqa: RUF012

    @abstractmethod
    def stress(self, theta: FloatArray, kin: Kinematics) -> FloatArray:
        """Nominal stress (n,) [N/mm^2]."""

    @abstractmethod
    def jacobian(self, theta: FloatArray, kin: Kinematics) -> FloatArray:
        """Derivatives (n, k) of the stress with respect to the parameters."""

    def bounds(self, kin: Kinematics) -> tuple[FloatArray, FloatArray]:
        """Lower and upper bounds (k,) of the parameters."""
        return np.array(self.lower), np.array(self.upper)

    @abstractmethod
    def starts(
        self, kin: Kinematics, P: FloatArray, count: int, rng: np.random.Generator
    ) -> FloatArray:
        """Starting points (count, k) for the stresses P (n,)."""

    def build(self, values: dict[str, float]) -> Any:
        """Model object with the parameters."""
        return self.energy(**values)

    def section(self, model: str, values: dict[str, float]) -> dict[str, Any]:
        """Keys of the [rubber] section that take the parameters."""
        known = [key for part in CONSTANTS[model] for key in part]
        return {"model": model, **{key: values[key.removesuffix("_N_per_mm2")] for key in known}}

    def ordered(self, theta: FloatArray) -> FloatArray:
        """Parameters (k,) with terms that may change places in the order that makes them unique."""
        return theta

    def admissible(self, values: dict[str, float]) -> bool:
        """Whether the parameters make an energy; where bounds of each alone cannot say so."""
        return True

    def narrow_bounds(self, kin: Kinematics) -> tuple[FloatArray, FloatArray]:
        """Bounds for a second fit when the first one is not admissible."""
        return self.bounds(kin)


class _LinearModel(StressModel):
    """Models whose stress is linear in all parameters: the columns are all there is to say."""

    linear = True

    @abstractmethod
    def columns(self, kin: Kinematics) -> tuple[FloatArray, ...]:
        """Stress (n,) of each parameter at the value one."""

    def stress(self, theta: FloatArray, kin: Kinematics) -> FloatArray:
        return np.einsum("kn,k->n", np.array(self.columns(kin)), theta)

    def jacobian(self, theta: FloatArray, kin: Kinematics) -> FloatArray:
        return np.stack(self.columns(kin), axis=1)

    def starts(
        self, kin: Kinematics, P: FloatArray, count: int, rng: np.random.Generator
    ) -> FloatArray:
        moduli, *_ = np.linalg.lstsq(self.jacobian(np.empty(0), kin), P, rcond=None)
        return np.asarray(moduli[None, :], dtype=float)


class NeoHookeStress(_LinearModel):
    names, lower, upper = ("G",), (1e-9,), (np.inf,)
    energy = NeoHooke

    def columns(self, kin: Kinematics) -> tuple[FloatArray, ...]:
        return (0.5 * kin.k1,)


class MooneyRivlinStress(_LinearModel):
    names = ("C10", "C01")
    # Either constant may be negative as long as the shear modulus is not.
    lower, upper = (-np.inf, -np.inf), (np.inf, np.inf)
    energy = MooneyRivlin

    def columns(self, kin: Kinematics) -> tuple[FloatArray, ...]:
        return kin.k1, kin.k2

    def admissible(self, values: dict[str, float]) -> bool:
        return values["C10"] + values["C01"] > 0.0

    def narrow_bounds(self, kin: Kinematics) -> tuple[FloatArray, FloatArray]:
        return np.array([1e-9, 0.0]), np.full(2, np.inf)


class YeohStress(_LinearModel):
    names = ("C10", "C20", "C30")
    lower, upper = (1e-9, -np.inf, -np.inf), (np.inf, np.inf, np.inf)
    energy = Yeoh

    def columns(self, kin: Kinematics) -> tuple[FloatArray, ...]:
        x = kin.I1b - 3.0
        return kin.k1, 2.0 * x * kin.k1, 3.0 * x * x * kin.k1


class VanDerWaalsStress(StressModel):
    """Beyond 0.9999 of the locking limit the stress goes on linearly in eta.

    That keeps trial parameters finite; the bound of lambda_m keeps the result below it.
    """

    names = ("G", "lambda_m", "a", "beta")
    energy = VanDerWaals
    held = {"beta": 0.0}  # noqa: RUF012

    def _parts(self, theta: FloatArray, kin: Kinematics) -> tuple[FloatArray, ...]:
        _, lambda_m, _, beta = theta
        limit = lambda_m**2 - 3.0
        x = np.maximum((1.0 - beta) * kin.I1b + beta * kin.I2b - 3.0, 0.0)
        eta = np.sqrt(x / limit)
        within = np.minimum(eta, _CLOSEST_TO_LOCKING)
        steep = 1.0 / (1.0 - within) ** 2
        network = 1.0 / (1.0 - within) + (eta - within) * steep
        K = (1.0 - beta) * kin.k1 + beta * kin.k2
        return K, x, eta, network, steep, np.sqrt(0.5 * x)

    def stress(self, theta: FloatArray, kin: Kinematics) -> FloatArray:
        K, _, _, network, _, root = self._parts(theta, kin)
        return 0.5 * theta[0] * K * (network - theta[2] * root)

    def jacobian(self, theta: FloatArray, kin: Kinematics) -> FloatArray:
        G, lambda_m, a, _ = theta
        K, x, eta, network, steep, root = self._parts(theta, kin)
        limit = lambda_m**2 - 3.0
        half = 0.5 * G * K
        slope = network - a * root
        with np.errstate(divide="ignore", invalid="ignore"):
            bend = np.where(x > 1e-14, (steep * eta - a * root) / (2.0 * x), 0.0)
        d_beta = 0.5 * G * (kin.k2 - kin.k1) * slope + half * bend * (kin.I2b - kin.I1b)
        return np.stack(
            [0.5 * K * slope, -half * steep * eta * lambda_m / limit, -half * root, d_beta], axis=1
        )

    def bounds(self, kin: Kinematics) -> tuple[FloatArray, FloatArray]:
        least = np.sqrt(min(kin.I1b.max(), kin.I2b.max())) * (1.0 + 1e-6)
        return np.array([1e-9, max(least, 1.7321), 0.0, 0.0]), np.array([np.inf, 1e3, 1e3, 1.0])

    def starts(
        self, kin: Kinematics, P: FloatArray, count: int, rng: np.random.Generator
    ) -> FloatArray:
        least = self.bounds(kin)[0][1]
        points = []
        for lambda_m in least * (1.0 + np.geomspace(5e-3, 3.0, count)):
            _, _, _, network, _, root = self._parts(np.array([1.0, lambda_m, 0.0, 0.0]), kin)
            columns = 0.5 * kin.k1[:, None] * np.stack([network, -root], axis=1)
            G, Ga = nnls(columns, P)[0]
            points.append([max(G, 1e-6), lambda_m, Ga / G if G > 0.0 else 0.1, 0.1])
        return np.array(points)


class ArrudaBoyceStress(StressModel):
    names = ("C1", "lambda_m")
    lower, upper = (1e-9, 1.0 + 1e-6), (np.inf, 1e3)
    energy = ArrudaBoyce

    def _slopes(self, q: float, I1b: FloatArray) -> tuple[FloatArray, FloatArray]:
        """dW/dI1b for C1 = 1 and its derivative with respect to ``q = lambda_m^-2``."""
        order = np.arange(1, 6)
        weights = _CHAIN * order
        powers = I1b[:, None] ** (order - 1)
        return (
            powers @ (weights * q ** (order - 1)),
            powers[:, 1:] @ (weights[1:] * (order[1:] - 1) * q ** (order[1:] - 2)),
        )

    def stress(self, theta: FloatArray, kin: Kinematics) -> FloatArray:
        return theta[0] * kin.k1 * self._slopes(theta[1] ** -2, kin.I1b)[0]

    def jacobian(self, theta: FloatArray, kin: Kinematics) -> FloatArray:
        slope, slope_q = self._slopes(theta[1] ** -2, kin.I1b)
        return kin.k1[:, None] * np.stack([slope, -2.0 * theta[0] * theta[1] ** -3 * slope_q], 1)

    def starts(
        self, kin: Kinematics, P: FloatArray, count: int, rng: np.random.Generator
    ) -> FloatArray:
        points = []
        for lambda_m in np.geomspace(1.05, 30.0, count):
            column = kin.k1 * self._slopes(lambda_m**-2, kin.I1b)[0]
            points.append([max(float(column @ P) / float(column @ column), 1e-6), lambda_m])
        return np.array(points)


class OgdenStress(StressModel):
    """Ogden's energy with n terms ``2 mu_i/alpha_i^2 (lam1^a + lam2^a + lam3^a - 3)`` [2]_.

    Positive mu_i make every term, and so the sum, convex in the logarithmic stretches.
    """

    def __init__(self, terms: int) -> None:
        self.terms = terms
        self.names = tuple(f"{kind}{i}" for i in range(1, terms + 1) for kind in ("mu", "alpha"))
        self.lower, self.upper = (0.0, -30.0) * terms, (np.inf, 30.0) * terms

    def _terms(self, alpha: FloatArray, kin: Kinematics) -> tuple[FloatArray, FloatArray]:
        """Stress (n, terms) for mu = 1, and its derivative with respect to alpha."""
        alpha = np.where(np.abs(alpha) < 1e-6, 1e-6, alpha)
        t, log = kin.transverse[:, None], np.log(kin.lam)[:, None]
        along = np.exp((alpha - 1.0) * log)
        across = np.exp((-t * alpha - 1.0) * log)
        P = 2.0 / alpha * (along - across)
        return P, -P / alpha + 2.0 / alpha * log * (along + t * across)

    def stress(self, theta: FloatArray, kin: Kinematics) -> FloatArray:
        return self._terms(theta[1::2], kin)[0] @ theta[0::2]

    def jacobian(self, theta: FloatArray, kin: Kinematics) -> FloatArray:
        P, P_alpha = self._terms(theta[1::2], kin)
        J = np.empty((kin.lam.size, 2 * self.terms))
        J[:, 0::2] = P
        J[:, 1::2] = theta[0::2] * P_alpha
        return J

    def starts(
        self, kin: Kinematics, P: FloatArray, count: int, rng: np.random.Generator
    ) -> FloatArray:
        """The best of all combinations of exponents on a grid, each with its best moduli.

        For given exponents the moduli are a small linear problem with mu >= 0, so the grid costs
        little; its spacing follows the largest strain, over which ``lam^alpha`` must not explode.
        """
        few = evenly_spread(P.size, _POINTS_OF_THE_GRID)
        fewer, stress = kin.at(few), P[few]
        strain = np.abs(np.log(fewer.lam)).max() * max(1.0, float(fewer.transverse.max()))
        largest = min(25.0, max(6.0, 10.0 / max(strain, 0.1)))
        grid = largest * np.linspace(-1.0, 1.0, _GRID[self.terms])
        columns = self._terms(grid, fewer)[0]
        size = np.linalg.norm(columns, axis=0)
        combinations = np.array(list(itertools.combinations(range(grid.size), self.terms)))
        found = [nnls(columns[:, chosen] / size[chosen], stress) for chosen in combinations]
        best = np.argsort([misfit for _, misfit in found], kind="stable")[:count]
        least = 1e-3 * np.abs(P).max() / largest  # a term at zero would not move
        points = [
            np.stack([found[i][0] / size[combinations[i]] + least, grid[combinations[i]]], axis=1)
            for i in best
        ]
        return np.array([point.ravel() for point in points])

    def ordered(self, theta: FloatArray) -> FloatArray:
        return theta.reshape(self.terms, 2)[np.argsort(-theta[1::2])].ravel()

    def section(self, model: str, values: dict[str, float]) -> dict[str, Any]:
        energy = self.build(values)
        moduli, exponents = CONSTANTS["ogden"][0]
        return {"model": "ogden", moduli: list(energy.mu), exponents: list(energy.alpha)}

    def build(self, values: dict[str, float]) -> Ogden:
        indices = range(1, self.terms + 1)
        return Ogden(
            mu=tuple(values[f"mu{i}"] for i in indices),
            alpha=tuple(values[f"alpha{i}"] for i in indices),
        )


STRESS_MODELS: dict[str, StressModel] = {
    "neo-hooke": NeoHookeStress(),
    "mooney-rivlin": MooneyRivlinStress(),
    "yeoh": YeohStress(),
    "van-der-waals": VanDerWaalsStress(),
    "arruda-boyce": ArrudaBoyceStress(),
    "ogden-2": OgdenStress(2),
    "ogden-3": OgdenStress(3),
}
