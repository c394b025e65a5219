"""Where a run stands between two steps, and the tables it has collected so far."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fem.case import Case
from fem.heat import HeatState
from fem.results import BottomHistory, Snapshot
from fem.stepping.audit import EnergyAudit
from fem.stepping.coupled_step import CoupledState
from fem.stepping.step_control import StepPlan
from materials.arrays import AnyArray


@dataclass(frozen=True, kw_only=True)
class RunPoint:
    """A point between two accepted steps of a deformable run.

    Attributes
    ----------
    phase : int
        Number of the phase; -1 before the first one.
    at : float
        Coordinate of the phase.
    plan : StepPlan
        How the next step is to be tried.
    state : CoupledState
        Accepted state.
    audit : EnergyAudit
        Energies up to there.
    iterations, rejected : int
        Newton iterations and rejected steps up to there.
    smallest_J : float
        Smallest volume ratio of a Gauss point up to there [-].
    rows, snapshots, log : int
        How many history rows, snapshots and lines of the log there were.
    """

    phase: int
    at: float
    plan: StepPlan
    state: CoupledState
    audit: EnergyAudit
    iterations: int
    rejected: int
    smallest_J: float
    rows: int
    snapshots: int
    log: int


@dataclass(frozen=True, kw_only=True)
class RigidPoint:
    """A point between two steps of a rigid run.

    Attributes
    ----------
    steps : int
        Steps made, which is also the number of history rows.
    heat : HeatState
        Heat of block and road.
    time, distance, position : float
        Time [s], sliding distance and signed displacement of the platen [mm].
    work, created, capped : float
        Friction work, that of steps in which it was negative, and the part of it whose heat
        partition was capped [mJ/mm].
    snapshots : int
        How many snapshots there were.
    """

    steps: int
    heat: HeatState
    time: float
    distance: float
    position: float
    work: float
    created: float
    capped: float
    snapshots: int


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
    """What the checkpoint of a deformable run holds."""

    point: RunPoint
    records: Records


@dataclass(frozen=True, kw_only=True)
class RigidRecord:
    """What the checkpoint of a rigid run holds."""

    point: RigidPoint
    records: Records


def columns(rows: Sequence[Mapping[str, Any]]) -> dict[str, AnyArray]:
    """History rows, which have the same keys, as columns."""
    return {key: np.array([row[key] for row in rows]) for key in (rows[0] if rows else ())}


def snapshots_due(case: Case, after: float = -np.inf) -> list[float]:
    """Sliding distances behind `after` at which a snapshot is to be taken [mm]."""
    distances = np.linspace(0.0, case.loading.distance_mm, case.output.snapshots + 1)[1:]
    return [float(distance) for distance in distances if distance > after]
