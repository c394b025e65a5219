"""Your own rubber: from a tensile test in a CSV file to a slide with the fitted model.

Leaves results/own_rubber, the fit in `parameters.toml` and `fit.png`. The test here is made up.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from calibration import fit_hyperelastic
from fem import Case, simulate

here, out = Path(__file__).parent, Path("results/own_rubber")
out.mkdir(parents=True, exist_ok=True)

test = here / "synthetic_bars.csv"  # stretch, nominal_stress_N_per_mm2, mode, ...
fit = fit_hyperelastic(test, model="yeoh", branch="load")  # of the last full cycle
for name, value in fit.values.items():
    print(f"{name} = {value:.4f} ± {fit.stderr[name]:.4f} N/mm²")
fit.to_toml(out / "parameters.toml")

cycles = pd.read_csv(test, comment="#")
stretch = np.linspace(1.0, cycles["stretch"].max(), 100)
plt.plot(cycles["stretch"], cycles["nominal_stress_N_per_mm2"], ".:", label="test (made up)")
plt.plot(stretch, fit.model.nominal_stress(stretch, "uniaxial"), label="Yeoh, last loading")
plt.xlabel("stretch [-]")
plt.ylabel("nominal stress [N/mm²]")
plt.legend()
plt.savefig(out / "fit.png")
plt.close()

parameters = str((out / "parameters.toml").resolve())
result = simulate(Case.from_toml(here / "short.toml", {"rubber.parameters": parameters}))
print(f"friction force {result.summary['friction_force_N_per_mm']:.3f} N/mm")
result.write(out / "slide")
