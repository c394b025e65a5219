"""Interrupt a run and go on: the result is that of a run that was never interrupted.

Leaves results/resumed and `interrupted.png` in it. On the command line: treadfem run ... --resume
"""

from pathlib import Path

import matplotlib.pyplot as plt

from fem import Case, simulate

out = Path("results/resumed")
out.mkdir(parents=True, exist_ok=True)
kept = out / "checkpoint.npz"
case = Case.from_toml(Path(__file__).with_name("short.toml"))


def stop_half_way(progress):
    """Press Ctrl-C after 2 mm."""
    if progress.sliding_distance_mm > 2.0:
        raise KeyboardInterrupt


first = simulate(case, checkpoint=kept, progress=stop_half_way)
print(f"{first.summary['status']} after {first.history['sliding_distance_mm'].max():.2f} mm")
whole = simulate(case, checkpoint=kept, resume=True)
print(f"{whole.summary['status']} after {whole.history['sliding_distance_mm'].max():.2f} mm")
never = simulate(case)
assert whole.history["friction_force_N_per_mm"].equals(never.history["friction_force_N_per_mm"])

x, y = "sliding_distance_mm", "friction_coefficient"
plt.plot(whole.history[x], whole.history[y], label="resumed")
plt.plot(first.history[x], first.history[y], "o", label="before the interruption")
plt.xlabel("sliding distance [mm]")
plt.ylabel("friction coefficient [-]")
plt.legend()
plt.savefig(out / "interrupted.png")
plt.close()
whole.write(out)
kept.unlink()
