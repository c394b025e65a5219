"""A friction law of your own: a registered class with mu, and a slide with it.

Leaves results/own_law and `law.png` in it.
"""

from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from contact import FrictionLaw, friction_law, parameter
from fem import Case, simulate


@friction_law("logarithmic", label="logarithmic law")
@dataclass(frozen=True, kw_only=True)
class Logarithmic(FrictionLaw):
    """Friction that rises by k ln 10 per decade of speed: mu_1 + k ln(v), v in mm/s."""

    mu_1: float = parameter("coefficient at 1 mm/s [-]", 0.5, low=0.0)
    k: float = parameter("growth with the logarithm of the speed [-]", 0.05, low=-1.0, high=1.0)

    def _mu(self, at):  # at.p, at.v, at.T_C, at.T_road_C, at.mean_pressure, at.slip
        return self.mu_1 + self.k * np.log(at.v)


case = Case.from_toml(
    Path(__file__).with_name("short.toml"), {"friction.law": "logarithmic", "friction.k": 0.04}
)
result = simulate(case)
print(f"friction coefficient {result.history['friction_coefficient'].iloc[-1]:.3f} at the end")
result.write("results/own_law")

v = np.geomspace(1.0, 1000.0, 100)
plt.semilogx(v, Logarithmic().coefficient(0.3, v))
plt.xlabel("v [mm/s]")
plt.ylabel("friction coefficient [-]")
plt.savefig("results/own_law/law.png")
plt.close()
