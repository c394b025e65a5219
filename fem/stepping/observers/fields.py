"""Takes the field snapshots of a run."""

import numpy as np

from fem.case import Case
from fem.results import Snapshot
from fem.stepping.coupled_state import CoupledState
from fem.stepping.coupled_step import CoupledModel
from fem.stepping.moment import Moment
from fem.stepping.phases import Phase


class SnapshotTaker:
    """Fields at equal sliding distances of the last contact.

    Parameters
    ----------
    case : Case
        For the number of snapshots.
    model : CoupledModel
        For stresses and the road.
    phases : sequence of Phase
        All phases of the run.
    """

    def __init__(self, case: Case, model: CoupledModel, phases: list[Phase]) -> None:
        self.model = model
        self.snapshots: list[Snapshot] = []
        last = max(phase.contact for phase in phases)
        before = sum(phase.slid(phase.end) for phase in phases if phase.contact < last)
        length = sum(phase.slid(phase.end) for phase in phases if phase.contact == last)
        due = before + np.linspace(0.0, length, case.output.snapshots + 1)[1:]
        self.due = [float(distance) for distance in due]

    def see(self, moment: Moment) -> None:
        """Take a snapshot where one is due."""
        if self.due and moment.distance >= self.due[0] - 1e-9 * moment.distance:
            self.skip_to(moment.distance)
            self.take(moment.step.after, moment.distance)

    def skip_to(self, distance: float) -> None:
        """Forget what was due up to a distance."""
        self.due = [due for due in self.due if due > distance * (1.0 + 1e-9)]

    def take(self, state: CoupledState, distance: float) -> None:
        """Append the fields of an accepted state."""
        fields = self.model.mechanics.fields(state.mechanics, state.heat.T)
        road = self.model.heat.road_field(state.heat, state.position)
        self.snapshots.append(
            Snapshot(
                time_s=state.time,
                sliding_distance_mm=distance,
                displacement=state.mechanics.u,
                temperature=state.heat.T,
                cauchy_stress=fields.cauchy,
                stretch=fields.stretch,
                pressure=state.mechanics.p,
                softening=fields.softening,
                viscous_dissipation=state.mechanics.lost,
                road_points=road.points,
                road_cells=road.cells,
                road_temperature=road.temperature,
            )
        )
