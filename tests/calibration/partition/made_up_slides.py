"""Slides that a formula makes instead of a simulation, for tests of the heat partition."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from calibration.partition.simulation_store import Slide
from contact import InterfaceState
from fem.case.case import Case

X = np.linspace(0.0, 20.0, 81)
#: Rear lifted, pressure highest in the middle, peak at the leading edge.
SHAPE = np.where(X < 4.0, 0.0, 1.2 * np.sin(np.pi * (X - 4.0) / 17.0)) + 3.0 * np.exp(
    -(((X - 19.3) / 0.3) ** 2)
)
CONTACT = 0.75
#: A case file whose simulation takes a moment: a rigid block that slides 1 mm.
RIGID = """
[block]
mesh = "coarse"
rigid = true
[loading]
mean_pressure_N_per_mm2 = 0.3
velocity_mm_per_s = 300.0
distance_mm = 1.0
"""


class MadeUpStore:
    """A store whose slides heat up by (kappa p)^0.9 at every point, and count their cases."""

    def __init__(self) -> None:
        self.simulated = 0
        self.cases: list[Case] = []

    def slides(self, wanted: Sequence[tuple[Case, str]]) -> list[Slide]:
        return [self.slide(case) for case, _ in wanted]

    def slide(self, case: Case) -> Slide:
        self.simulated += 1
        self.cases.append(case)
        platen = case.loading.mean_pressure_N_per_mm2
        rigid = case.block.rigid
        share = 1.0 if rigid else CONTACT - 0.1 * platen
        p = (np.ones_like(X) if rigid else SHAPE) * platen / share
        speed = abs(case.loading.velocity_mm_per_s) / 300.0
        partition = case.heat.partition_object()
        kappa = partition.at(InterfaceState(p=p, mean_pressure=platen / share))
        rise = 80.0 * speed**0.4 * (kappa * p) ** 0.9
        T = case.heat.ambient_C + rise
        return Slide(X=X, T=T, pressure=p, mean_contact_pressure=platen / share)


def deformable(store: MadeUpStore) -> list[Case]:
    """The cases of a store that are not rigid blocks."""
    return [case for case in store.cases if not case.block.rigid]
