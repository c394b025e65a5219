"""A rigid-block case recorded with the same tables as a deformable one.

The block does not deform, so its pressure is uniform, all of its bottom slips, and there is no
elastic, viscous or kinetic energy: the work of the platen is the friction work.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

from contact.active_set import OPEN, SLIP
from fem.case.case import Case
from fem.files.program_version import program_version
from fem.heat.model import HeatModel
from fem.results.boundary import BoundaryContact, boundary_table
from fem.results.checkpoint import Checkpoint, notes
from fem.results.fitted_window import contact_columns, window_notes, window_warnings
from fem.results.outcome import OK, Outcome, stoppable
from fem.results.result import Result
from fem.results.sliding_regime import STEADY
from fem.results.snapshot import BlockGeometry, Snapshot
from fem.results.trust import judged
from fem.stepping.balance import balance_error, share
from fem.stepping.model_parts import Progress, mesh_of
from fem.stepping.point import Records, RigidPoint, RigidRecord, columns, snapshots_due
from fem.stepping.recorder import temperature_columns
from fem.stepping.rigid_block import RigidSliding, RigidStep, slide_rigid_block
from fem.stepping.summary import (
    closing_lines,
    heat_error,
    lag_share,
    largest,
    last_values,
    layer_errors,
    sliding_means,
)


class _RigidRun:
    """Accepted state of a rigid run and what was recorded of it."""

    def __init__(
        self,
        case: Case,
        progress: Callable[[Progress], None] | None,
        checkpoint: Checkpoint | None = None,
    ) -> None:
        self.case, self.progress, self.checkpoint = case, progress, checkpoint
        self.started = time.perf_counter()
        self.mesh = mesh_of(case)
        self.model = HeatModel.from_case(case, self.mesh)
        self.sliding = RigidSliding.from_case(case)
        self.heat = self.model.initial_state()
        self.rows: list[dict[str, Any]] = []
        self.snapshots: list[Snapshot] = []
        self.work = self.created = self.capped = self.time = self.distance = self.position = 0.0
        self._due = snapshots_due(case)
        self.log = [f"rigid {case.block.length_mm:g} x {case.block.height_mm:g} mm block, "
                    f"{len(self.mesh.cells)} elements", case.friction.described()]  # fmt: skip
        self.point = self._point()

    @property
    def geometry(self) -> BlockGeometry:
        """Mesh for output."""
        return BlockGeometry(points=self.mesh.points, cells=self.mesh.cells)

    def _point(self) -> RigidPoint:
        return RigidPoint(
            steps=len(self.rows), heat=self.heat, time=self.time, distance=self.distance,
            position=self.position, work=self.work, created=self.created, capped=self.capped,
            snapshots=len(self.snapshots),
        )  # fmt: skip

    def kept(self) -> RigidRecord:
        """What a checkpoint holds: the last point, and the records up to it."""
        point = self.point
        records = Records(
            history=columns(self.rows[: point.steps]), snapshots=self.snapshots[: point.snapshots],
            log=self.log, wall_s=time.perf_counter() - self.started,
        )  # fmt: skip
        return RigidRecord(point=point, records=records)

    def go_on_from(self, kept: RigidRecord) -> None:
        """Take over the point and the records of an interrupted run."""
        point, records = kept.point, kept.records
        self.point, self.heat = point, point.heat
        self.time, self.distance, self.position = point.time, point.distance, point.position
        self.work, self.created, self.capped = point.work, point.created, point.capped
        self.rows, self.snapshots = records.rows, records.snapshots
        self._due = snapshots_due(self.case, self.distance)
        self.log = [*records.log, f"resumed after {point.steps} steps, {self.distance:.6g} mm"]
        self.started -= records.wall_s

    def run(self) -> Outcome:
        """Slide to the end, or until the user interrupts."""

        def steps() -> Outcome:
            heat, done = self.point.heat, self.point.steps
            for step in slide_rigid_block(self.model, self.sliding, heat, done):
                self._accept(step)
            return Outcome(status=OK)

        return stoppable(steps)

    def _accept(self, step: RigidStep) -> None:
        self.heat, self.time, self.position = step.heat, step.time_s, step.position_mm
        self.work += step.dissipation
        self.created += max(-step.dissipation, 0.0)
        self.capped += step.capped_dissipation
        end = self.case.loading.distance_mm
        self.distance = end if np.isclose(step.distance_mm, end) else step.distance_mm
        self.rows.append(self._row(step))
        if self._due and self.distance >= self._due[0]:
            self._due = [distance for distance in self._due if distance > self.distance]
            self.snapshot()
        self.point = self._point()
        if self.checkpoint is not None:
            self.checkpoint.keep(self.kept)
        if self.progress is not None:
            self.progress(
                Progress(
                    sliding_distance_mm=self.distance,
                    T_max_C=self.rows[-1]["T_max_C"],
                    newton_iterations=0,
                )
            )

    def _row(self, step: RigidStep) -> dict[str, Any]:
        normal, friction = step.normal_force, step.friction_force
        row: dict[str, Any] = {
            "time_s": step.time_s,
            "sliding_distance_mm": self.distance,
            "velocity_mm_per_s": self.sliding.velocity,
            "normal_force_N_per_mm": normal,
            "friction_force_N_per_mm": friction,
            "friction_coefficient": friction / normal,
            "contact_length_mm": float(step.tributary_mm.sum()),
            "mean_contact_pressure_N_per_mm2": self.sliding.pressure,
            "max_contact_pressure_N_per_mm2": float(step.pressure.max()),
            "mean_slip_velocity_mm_per_s": abs(self.sliding.velocity),
            "platen_displacement_mm": 0.0,
        }
        row |= temperature_columns(self.mesh, self.heat.T, self.case.heat.ambient_C)
        row |= {"newton_iterations": 0}
        row |= self._energies()
        row |= {"friction_lag_error": self._lag_error(step), "min_J": 1.0}
        row |= {"sticking_nodes": 0, "slipping_nodes": len(step.nodes)}
        return row | contact_columns(
            self.case,
            p=step.pressure,
            v=np.full(len(step.nodes), self.sliding.velocity),
            T=self.heat.T[step.nodes],
            length=step.tributary_mm,
            slipping=np.ones(len(step.nodes), dtype=bool),
        )

    def _energies(self) -> dict[str, float]:
        heat = self.heat
        return {
            "work_in_mJ_per_mm": self.work,
            "strain_energy_mJ_per_mm": 0.0,
            "friction_dissipation_mJ_per_mm": self.work,
            "viscous_dissipation_mJ_per_mm": 0.0,
            "snap_dissipation_mJ_per_mm": 0.0,
            "kinetic_energy_mJ_per_mm": 0.0,
            "frictional_heat_mJ_per_mm": heat.generated,
            "heat_in_rubber_mJ_per_mm": heat.in_block,
            "heat_in_road_mJ_per_mm": heat.in_road + heat.left,
            "radiated_mJ_per_mm": heat.radiated,
        }

    def _coefficient(self) -> np.ndarray:
        """Friction coefficient of the bottom nodes at their present temperature [-]."""
        T = self.heat.T[self.mesh.bottom]
        p = np.full(len(T), self.sliding.pressure)
        return self.sliding.friction.coefficient(p, abs(self.sliding.velocity), T)

    def _lag_error(self, step: RigidStep) -> float:
        """Relative change of the friction force with the temperatures at the end of the step."""
        change = np.abs(self._coefficient() - step.mu)
        total = float(np.sum(step.mu * step.tributary_mm))
        return float(np.sum(change * step.tributary_mm)) / total if total > 0.0 else 0.0

    def snapshot(self) -> None:
        """Append the fields of the accepted state; a rigid block has no stress of its own."""
        cells = len(self.mesh.cells)
        road = self.model.road_field(self.heat, self.position)
        self.snapshots.append(
            Snapshot(
                time_s=self.time,
                sliding_distance_mm=self.distance,
                displacement=np.zeros_like(self.mesh.points),
                temperature=self.heat.T,
                cauchy_stress=np.zeros((cells, 4)),
                stretch=np.ones(cells),
                pressure=np.zeros(cells),
                road_points=road.points,
                road_cells=road.cells,
                road_temperature=road.temperature,
            )
        )

    def boundary(self) -> pd.DataFrame:
        """Table of the free boundary: all of the bottom slips, the faces are open."""
        on_bottom = self.mesh.on_bottom
        shear = np.zeros(on_bottom.size)
        shear[on_bottom] = -self.mesh.direction * self._coefficient() * self.sliding.pressure
        contact = BoundaryContact(
            kind=np.where(on_bottom, SLIP, OPEN),
            pressure=np.where(on_bottom, self.sliding.pressure, 0.0),
            shear=shear,
            slip_velocity=np.full(on_bottom.size, self.sliding.velocity),
        )
        at_rest = np.zeros_like(self.mesh.points)
        return boundary_table(self.mesh, at_rest, self.heat.T, contact)

    def summary(self, outcome: Outcome) -> dict[str, Any]:
        """Scalars of the run."""
        history = pd.DataFrame(self.rows)
        summary: dict[str, Any] = {"status": outcome.status}
        if outcome.reason:
            summary |= {"reason": outcome.reason, "advice": outcome.advice}
        summary |= last_values(history, ("T_max_C", "T_edge_C", "A_T_K_mm"))
        summary |= sliding_means(history, self.sliding.velocity)
        summary |= {
            "elements": len(self.mesh.cells),
            "dofs": len(self.mesh.points),
            "steps": len(history),
            "newton_iterations": 0,
            "wall_s": time.perf_counter() - self.started,
            "energy_error": balance_error(self.work, self.work, created=self.created),
            "heat_error": heat_error(self.heat),
            "regularisation_share": 0.0,
            "snap_share": 0.0,
            "capped_heat_share": share(self.capped, self.work),
            "rejected_steps": 0,
            "friction_lag_error": largest(history, "friction_lag_error"),
            "friction_lag_share": lag_share(history),
            **layer_errors(history, self.model),
            "min_J": 1.0,
            "program_version": program_version(),
            "sliding_regime": STEADY,
            "warnings": [*self.case.warnings, *window_warnings(self.case, self.rows)],
        }
        return judged(summary)


def simulate_rigid(
    case: Case,
    progress: Callable[[Progress], None] | None = None,
    checkpoint: Checkpoint | None = None,
    resume: bool = False,
) -> Result:
    """Simulate the rigid block of a case.

    Parameters
    ----------
    case : Case
        The resolved case; the contact pressure is its mean pressure.
    progress : callable, optional
        Called with a `Progress` after each step.
    checkpoint : Checkpoint, optional
        Where to keep what is needed to go on after an interruption.
    resume : bool, optional
        Go on from the checkpoint if there is one.

    Returns
    -------
    Result
        The tables of a deformable run. When the user interrupts, everything up to then.
    """
    kept = checkpoint.read(RigidRecord) if checkpoint is not None and resume else None
    run = _RigidRun(case, progress, checkpoint)
    if kept is not None:
        run.go_on_from(kept)
    outcome = run.run()
    if checkpoint is not None:
        checkpoint.keep(run.kept, now=True)
    if not run.snapshots or run.snapshots[-1].sliding_distance_mm < run.distance:
        run.snapshot()
    summary = run.summary(outcome)
    return Result.from_rows(
        case,
        run.geometry,
        run.rows,
        run.boundary(),
        summary,
        run.snapshots,
        log=[
            *run.log,
            *notes(checkpoint),
            *window_notes(case, run.rows),
            *closing_lines(outcome, summary["warnings"]),
        ],
    )
