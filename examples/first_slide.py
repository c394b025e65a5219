"""First slide: run a case, read its numbers, draw it.

Leaves results/first_slide, its pictures in `figures`.
"""

from pathlib import Path

from fem import Case, simulate
from validation.drawing.run_figures import write_run_figures

case = Case.from_toml(Path(__file__).with_name("short.toml"), {"friction.law": "exponential"})
result = simulate(case)
print(f"friction force {result.summary['friction_force_N_per_mm']:.3f} N per mm of depth")
print(f"warmest point of the bottom {result.summary['T_max_C']:.1f} °C")
result.write("results/first_slide")
for picture in write_run_figures("results/first_slide"):
    print(picture)
