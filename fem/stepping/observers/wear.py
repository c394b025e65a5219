"""Adds up what wears off the block's surface."""

from __future__ import annotations

import numpy as np

from fem.case import Case
from fem.mesh import BlockMesh
from fem.results import EDGE_ZONE
from fem.stepping.moment import Moment
from fem.stepping.wear import Wear, worn
from materials.arrays import BoolArray


class WearRecorder:
    """Wear of the candidates since the start."""

    def __init__(self, case: Case, mesh: BlockMesh) -> None:
        self.law, self.length = case.wear.law(), mesh.candidate_lengths
        self.mesh, self.wear = mesh, Wear.none(mesh)

    def see(self, moment: Moment) -> None:
        """Add the wear of a step."""
        step = moment.step
        self.wear = worn(self.wear, step.power, step.target.dt, self.law, self.length)

    @property
    def volume(self) -> float:
        """Volume that wore off, per depth of the block [mm^2]."""
        return float(self.wear.depth @ self.length)

    def summary(self) -> dict[str, float]:
        """Volume per depth of the block, and the share of the front edge in it; {} without wear."""
        if self.law.coefficient == 0.0:
            return {}
        front = float((self.wear.depth * self.length)[front_edge(self.mesh)].sum())
        return {
            "wear_volume_mm3_per_mm": self.volume,
            "wear_front_share": front / self.volume if self.volume > 0.0 else 0.0,
        }


def front_edge(mesh: BlockMesh) -> BoolArray:
    """Candidates of a leading face, which may roll under, and of the leading fifth of a bottom."""
    front = []
    for chain in mesh.chains:
        X = mesh.from_trailing(chain.nodes)
        ahead = X[-1] - EDGE_ZONE * (X[-1] - X[0]) <= X
        front.append(ahead if chain.kind == "bottom" else np.full(X.size, chain.kind == "leading"))
    return np.concatenate(front)
