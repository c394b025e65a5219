"""A friction law of your own: a class with mu(p, v) and its derivatives, and a slide with it.

Leaves results/own_law and `law.png` in it.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import matplotlib.pyplot as plt
import numpy as np

from contact import FrictionLaw
from contact.friction import FrictionCoefficient
from fem import Case, simulate
from fem.case.friction import Friction


@dataclass(frozen=True, kw_only=True)
class Logarithmic(FrictionLaw):
    """mu = mu_1 + k ln(v), v in mm/s: friction that rises by k ln 10 per decade of speed."""

    mu_1: float = 0.5
    k: float = 0.05

    def _law(self, p, v):
        mu = self.mu_1 + self.k * np.log(v) + 0.0 * p
        return FrictionCoefficient(mu, dmu_dp=0.0 * p, dmu_dv=self.k / v + 0.0 * p)


class OwnFriction(Friction):
    law: Literal["logarithmic"] = "logarithmic"

    def plain_law(self):
        return Logarithmic(p_min=self.p_min_N_per_mm2, v_min=self.v_min_mm_per_s)


class OwnCase(Case):
    friction: OwnFriction = OwnFriction()


case = OwnCase.from_toml(Path(__file__).with_name("short.toml"))
result = simulate(case)
print(f"friction coefficient {result.history['friction_coefficient'].iloc[-1]:.3f} at the end")
result.write("results/own_law")

v = np.geomspace(1.0, 1000.0, 100)
plt.semilogx(v, Logarithmic().coefficient(0.3, v))
plt.xlabel("v [mm/s]")
plt.ylabel("friction coefficient [-]")
plt.savefig("results/own_law/law.png")
plt.close()
