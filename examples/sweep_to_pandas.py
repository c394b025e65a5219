"""A sweep as a pandas table: run a study, group its rows, plot them.

Leaves results/velocities with `summary.csv` and `friction.png`. The same on the command line:
treadfem sweep examples/velocities.toml -o results/velocities
"""

from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd

from fem.sweeps import sweep

study, out = Path(__file__).with_name("velocities.toml"), Path("results/velocities")
if __name__ == "__main__":  # the cases run in processes of their own, which read this file too
    sweep(study, out, resume=True)
    table = pd.read_csv(out / "summary.csv")
    friction = table.pivot(
        index="loading.velocity_mm_per_s", columns="friction.law", values="friction_coefficient"
    )
    print(friction)
    friction.plot(style="o-", logx=True, xlabel="v [mm/s]", ylabel="friction coefficient [-]")
    plt.savefig(out / "friction.png")
    plt.close()
