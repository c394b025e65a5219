"""Keeps stick, slip and pressure along the bottom at every accepted step."""

import numpy as np

from fem.mesh import BlockMesh
from fem.results import BottomHistory
from fem.stepping.moment import Moment
from materials.arrays import AnyArray


class BottomRecorder:
    """A row per accepted step."""

    def __init__(self, mesh: BlockMesh) -> None:
        self.mesh = mesh
        self.kinds: list[AnyArray] = []
        self.pressures: list[AnyArray] = []

    def see(self, moment: Moment) -> None:
        """Append a row."""
        contact, bottom = moment.step.after.contact, self.mesh.on_bottom
        self.kinds.append(contact.status.kind[bottom].astype(np.int8))
        self.pressures.append(contact.pressure[bottom].astype(np.float32))

    def table(self, rows: int | None = None) -> BottomHistory:
        """The first rows."""
        X = self.mesh.from_trailing(self.mesh.bottom)
        return BottomHistory(
            X_mm=X,
            kind=np.array(self.kinds[:rows], dtype=np.int8).reshape(-1, X.size),
            pressure=np.array(self.pressures[:rows], dtype=np.float32).reshape(-1, X.size),
        )

    def go_on_from(self, bottom: BottomHistory | None) -> None:
        """Take over what was recorded before an interruption."""
        if bottom is not None:
            self.kinds, self.pressures = list(bottom.kind), list(bottom.pressure)
