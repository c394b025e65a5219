"""Stability of a fitted incompressible energy: Drucker's criterion and ellipticity.

With ``e1, e2`` the logarithmic principal stretches and ``e3 = -e1 - e2``, the energy is a function
``W(e1, e2)``. Drucker's criterion asks that every increment of strain meets an increment of stress
that does positive work on it, i.e. that the Hessian of W is positive definite. Ellipticity in plane
strain asks that the shear stress keeps rising with the amount of shear ``k = lam - 1/lam``:
``d tau/dk > 0`` with ``tau = dW/dk`` on the path ``lam, 1/lam, 1`` [2]_; where it is lost, a finite
element solution localises.

References
----------
.. [1] Drucker, D. C., J. Appl. Mech. 26 (1959) 101-106.
.. [2] Abeyaratne, R., J. Elasticity 10 (1980) 255-293.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.optimize import brentq

from materials.arrays import FloatArray
from materials.hyperelastic import MODES, Hyperelastic

SCAN = (0.1, 20.0)  # stretches between which an end of stability is looked for

#: Stretches that a block sees, whatever the tests cover. In the introductory example the largest
#: stretch of a Gauss point is 2.3 on the coarse and 2.8 on the default mesh, where the edge rolls
#: under (99 % of them stay below 1.27); in plane strain the smallest is its reciprocal.
BLOCK = (0.3, 3.0)


@dataclass(frozen=True, kw_only=True)
class Stability:
    """Range of stretch, around 1, in which the energy is stable.

    Parameters
    ----------
    drucker : dict
        Lowest and highest stable stretch by mode; 0 and infinity where no end was found.
    ellipticity : tuple of float
        The same for ellipticity in plane strain.
    window : dict
        Lowest and highest stretch of the data by mode.
    """

    drucker: dict[str, tuple[float, float]]
    ellipticity: tuple[float, float]
    window: dict[str, tuple[float, float]]

    @property
    def stable(self) -> bool:
        """Whether the energy is stable over the whole window of the data."""
        return not self.warnings

    @property
    def warnings(self) -> tuple[str, ...]:
        """One sentence for every end of stability inside the window of the data."""
        found: list[str] = []
        for mode, (low, high) in self.window.items():
            found += _inside(mode, self.drucker[mode], low, high, _UNSTABLE)
        if self.window:
            low = min(low for low, _ in self.window.values())
            high = max(high for _, high in self.window.values())
            found += _inside("plane strain", self.ellipticity, low, high, _NOT_ELLIPTIC)
        return tuple(found)

    @property
    def elsewhere(self) -> tuple[str, ...]:
        """One sentence for every other end of stability in the range that a block sees."""
        found: list[str] = []
        for mode, ends in self.drucker.items():
            found += _inside(mode, ends, *BLOCK, _UNSTABLE)
        found += _inside("plane strain", self.ellipticity, *BLOCK, _NOT_ELLIPTIC)
        return tuple(f"outside the tests, {text}" for text in found if text not in self.warnings)

    @property
    def text(self) -> str:
        """What a result file says."""
        return "; ".join((*self.warnings, *self.elsewhere)) or (
            f"stable over the data and from {BLOCK[0]:g} to {BLOCK[1]:g} in every mode"
        )


_UNSTABLE, _NOT_ELLIPTIC = "is not stable (Drucker)", "loses ellipticity"


def _inside(name: str, ends: tuple[float, float], low: float, high: float, what: str) -> list[str]:
    first, last = ends
    sentences = []
    if low < first:
        sentences.append(f"{name}: the energy {what} below the stretch {first:.4g}")
    if high > last:
        sentences.append(f"{name}: the energy {what} above the stretch {last:.4g}")
    return sentences


def drucker_margin(model: Hyperelastic, stretch: FloatArray, mode: str) -> FloatArray:
    """Smaller eigenvalue of the Hessian over the shear modulus [-]; negative where unstable."""
    e = np.log(stretch)
    transverse = {"uniaxial": -0.5 * e, "equibiaxial": e, "planar": np.zeros_like(e)}[mode]
    _, H = model.log_derivatives(e, transverse)
    mean = 0.5 * (H[:, 0, 0] + H[:, 1, 1])
    spread = np.hypot(0.5 * (H[:, 0, 0] - H[:, 1, 1]), H[:, 0, 1])
    return np.asarray((mean - spread) / model.initial_shear_modulus)


def ellipticity_margin(model: Hyperelastic, stretch: FloatArray) -> FloatArray:
    """Slope ``d tau/dk`` over the shear modulus [-] in plane strain; negative where unstable."""
    e = np.log(stretch)
    gradient, H = model.log_derivatives(e, -e)
    W_e = gradient[:, 0] - gradient[:, 1]
    W_ee = H[:, 0, 0] - 2.0 * H[:, 0, 1] + H[:, 1, 1]
    k_e = 2.0 * np.cosh(e)
    tau = W_e / k_e
    return np.asarray((W_ee - tau * 2.0 * np.sinh(e)) / k_e**2 / model.initial_shear_modulus)


def check_stability(model: Hyperelastic, window: dict[str, tuple[float, float]]) -> Stability:
    """Find where the energy loses stability, in every mode and in plane strain.

    Parameters
    ----------
    model : Hyperelastic
    window : dict
        Lowest and highest stretch of the data by mode.
    """
    drucker = {mode: _stable_range(partial(drucker_margin, model, mode=mode)) for mode in MODES}
    ellipticity = _stable_range(partial(ellipticity_margin, model))
    return Stability(drucker=drucker, ellipticity=ellipticity, window=dict(window))


def _stable_range(margin: Callable[[FloatArray], FloatArray]) -> tuple[float, float]:
    down = _first_end(margin, np.geomspace(1.0, SCAN[0], 600))
    up = _first_end(margin, np.geomspace(1.0, SCAN[1], 600))
    return (0.0 if down is None else down), (np.inf if up is None else up)


def _first_end(margin: Callable[[FloatArray], FloatArray], stretch: FloatArray) -> float | None:
    values = margin(stretch)
    locked = np.flatnonzero(~np.isfinite(values))
    if locked.size:  # beyond the locking stretch there is no state to be unstable
        values, stretch = values[: locked[0]], stretch[: locked[0]]
    bad = np.flatnonzero(values <= 0.0)
    if not bad.size:
        return None
    i = int(bad[0])
    if i == 0:
        return float(stretch[0])
    inner, outer = float(stretch[i - 1]), float(stretch[i])
    return float(brentq(lambda lam: float(margin(np.array([lam]))[0]), inner, outer, xtol=1e-10))
