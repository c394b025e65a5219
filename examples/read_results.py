"""Read what a run has written: tables with pandas, fields with meshio (or open them in ParaView).

Reads results/first_slide, which first_slide.py makes, and leaves `temperature.png` there.
"""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import meshio
import pandas as pd

run = Path("results/first_slide")
summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
history = pd.read_csv(run / "history.csv")
surface = pd.read_csv(run / "surface.csv")
print(f"{len(history)} steps, status {summary['status']}")
print(surface.loc[surface["in_contact"], ["pressure_N_per_mm2", "T_C"]].describe().round(2))

# In ParaView: open block.pvd and road.pvd, warp the block by displacement_mm.
block = meshio.read(sorted(run.glob("block_*.vtu"))[-1])
x, y = (block.points + block.point_data["displacement_mm"])[:, :2].T
quads = block.cells_dict["quad"]
triangles = [*quads[:, [0, 1, 2]], *quads[:, [0, 2, 3]]]
plt.figure(figsize=(8.0, 3.5))
plt.tripcolor(x, y, triangles, block.point_data["temperature_C"], shading="gouraud", cmap="inferno")
plt.colorbar(label="T [°C]")
plt.gca().set_aspect("equal")
plt.savefig(run / "temperature.png")
plt.close()
