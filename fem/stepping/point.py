"""Where a run stands between two steps, and the tables it has collected so far."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fem.results import BottomHistory, Snapshot
from fem.stepping.audit import EnergyAudit
from fem.stepping.coupled_state import CoupledState
from fem.stepping.pyrometer import Reading
from fem.stepping.step_control import StepPlan
from fem.stepping.wear import Wear
from materials.arrays import AnyArray


@dataclass(frozen=True, kw_only=True)
class RunPoint:
    """A point between two accepted steps.

    Attributes
    ----------
    phase : int
        Number of the phase; -1 before the first one.
    plan : StepPlan
        Where in the phase, and how the next step is to be tried.
    distance : float
        Distance slid over the road in the phases before [mm].
    state : CoupledState
        Accepted state.
    audit : EnergyAudit
        Energies up to there.
    wear : Wear
        What has worn off up to there.
    reading : Reading or None
        What the pyrometer has read.
    iterations, rejected : int
        Newton iterations and rejected steps up to there.
    smallest_J : float
        Smallest volume ratio of a Gauss point up to there [-].
    rows, snapshots, log : int
        How many history rows, snapshots and lines of the log there were.
    """

    phase: int
    plan: StepPlan
    distance: float
    state: CoupledState
    audit: EnergyAudit
    wear: Wear
    reading: Reading | None
    iterations: int
    rejected: int
    smallest_J: float
    rows: int
    snapshots: int
    log: int


@dataclass(frozen=True, kw_only=True)
class Records:
    """What a run has recorded.

    Attributes
    ----------
    history : dict
        Column names to values, an entry per accepted step.
    snapshots : list of Snapshot
        Fields recorded so far.
    log : list of str
        Lines of the log.
    wall_s, solver_s : float
        Time spent, and the part of it in the linear solver [s].
    bottom : BottomHistory or None
        Stick, slip and pressure along the bottom; none of a rigid block.
    """

    history: dict[str, AnyArray]
    snapshots: list[Snapshot]
    log: list[str]
    wall_s: float
    solver_s: float = 0.0
    bottom: BottomHistory | None = None

    @property
    def rows(self) -> list[dict[str, Any]]:
        """The history row by row, with Python's numbers."""
        values = [column.tolist() for column in self.history.values()]
        return [dict(zip(self.history, row, strict=True)) for row in zip(*values, strict=True)]


@dataclass(frozen=True, kw_only=True)
class RunRecord:
    """What the checkpoint holds."""

    point: RunPoint
    records: Records


def columns(rows: Sequence[Mapping[str, Any]]) -> dict[str, AnyArray]:
    """History rows, which have the same keys, as columns."""
    return {key: np.array([row[key] for row in rows]) for key in (rows[0] if rows else ())}
