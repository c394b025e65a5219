"""Adds up what wears off the block's surface."""

from fem.case import Case
from fem.mesh import BlockMesh
from fem.stepping.moment import Moment
from fem.stepping.wear import Wear, worn


class WearRecorder:
    """Wear of the candidates since the start."""

    def __init__(self, case: Case, mesh: BlockMesh) -> None:
        self.law, self.length = case.wear.law(), mesh.candidate_lengths
        self.wear = Wear.none(mesh)

    def see(self, moment: Moment) -> None:
        """Add the wear of a step."""
        step = moment.step
        self.wear = worn(self.wear, step.power, step.target.dt, self.law, self.length)

    @property
    def volume(self) -> float:
        """Volume that wore off, per depth of the block [mm^2]."""
        return float(self.wear.depth @ self.length)
