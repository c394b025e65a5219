"""The same case for CalculiX or ABAQUS: write an input deck, read its mesh back, draw it.

Leaves results/calculix/short.inp and `short.png`. With CalculiX installed: ccx short
"""

from pathlib import Path

import matplotlib.pyplot as plt
import meshio
import numpy as np

from fem import Case
from validation.calculix.export_deck import write_deck

coulomb = {"friction.law": "coulomb", "friction.mu": 0.3}
case = Case.from_toml(Path(__file__).with_name("short.toml"), coulomb)
deck = write_deck(case, "results/calculix/short.inp")

mesh = meshio.read(deck)
front = np.isclose(mesh.points[:, 2], mesh.points[:, 2].max())
plt.figure(figsize=(8.0, 3.5))
plt.plot(*mesh.points[front, :2].T, ".", ms=3)
plt.gca().set_aspect("equal")
plt.xlabel("x [mm]")
plt.ylabel("y [mm]")
plt.title(f"{deck.name}: {sum(len(block.data) for block in mesh.cells)} elements")
plt.savefig(deck.with_suffix(".png"))
plt.close()
print(deck)
