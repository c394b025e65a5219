"""Reads the pyrometer where the last contact ends."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from fem.case import Case
from fem.results import pyrometer_table
from fem.stepping.coupled_step import CoupledModel
from fem.stepping.moment import Moment
from fem.stepping.per_block import temperature_columns
from fem.stepping.phases import Phase
from fem.stepping.pyrometer import Reading, Spot
from materials.units import W_PER_M2_K


class PyrometerReader:
    """Looks once, at the end of the last phase on the road; never without a pyrometer.

    Parameters
    ----------
    case : Case
    model : CoupledModel
        For the heat of the block.
    phases : sequence of Phase
        All phases of the run.
    """

    def __init__(self, case: Case, model: CoupledModel, phases: Sequence[Phase]) -> None:
        self.case, self.model = case, model
        self.last = max(number for number, phase in enumerate(phases) if phase.on_road)
        self.reading: Reading | None = None

    def see(self, moment: Moment) -> None:
        """Read if the block is about to run off."""
        given = self.case.pyrometer
        if given is None or moment.number != self.last or not moment.ends:
            return
        state, target = moment.step.after, moment.step.target
        self.reading = Spot(gap=given.gap_mm, width=given.spot_mm).read(
            self.model.heat,
            state.heat,
            state.position,
            target.sweep / target.dt,
            W_PER_M2_K * self.case.heat.convection_W_per_m2K,
        )

    def table(self) -> pd.DataFrame | None:
        """Profile along the bottom as the pyrometer sees it."""
        if self.reading is None:
            return None
        mesh, reading = self.model.mechanics.mesh, self.reading
        return pyrometer_table(
            mesh.from_trailing(mesh.bottom), reading.seen, reading.T, reading.covered
        )

    def summary(self) -> dict[str, float]:
        """What the reading says of the surface, by the rules of the surface itself."""
        if self.reading is None:
            return {}
        mesh, T_C = self.model.mechanics.mesh, self.model.initial_state().heat.T
        T_C[mesh.bottom] = self.reading.seen
        found = temperature_columns(mesh, T_C, self.case.heat.ambient_C)
        return {
            "T_max_pyrometer_C": found["T_max_C"],
            "A_T_pyrometer_K_mm": found["A_T_K_mm"],
            "pyrometer_speed_mm_per_s": self.reading.speed,
        }
