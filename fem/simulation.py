"""Run a case: build the model, press the block, slide it, and return the tables."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fem import newton
from fem.case.case import Case
from fem.files.program_version import program_version
from fem.heat.model import HeatModel
from fem.mechanics.elements import Q1P0Elements
from fem.mechanics.regularisation import damping_lines, snap_damping
from fem.mechanics.step import BlockMechanics
from fem.mesh.block import BlockMesh
from fem.results.checkpoint import Checkpoint, notes
from fem.results.fitted_window import window_notes, window_warnings
from fem.results.outcome import OK, Outcome, failed, stoppable
from fem.results.result import Result
from fem.results.sliding_regime import sliding_regime
from fem.results.trust import judged
from fem.solvers.kept_factors import linear_solver
from fem.stepping.audit import EnergyAudit, audited
from fem.stepping.coupled_step import (
    AcceptedStep,
    ContactLaws,
    CoupledModel,
    CoupledState,
    RejectedStep,
    SelfContact,
)
from fem.stepping.model_parts import Progress, mesh_of
from fem.stepping.point import Records, RunPoint, RunRecord, columns, snapshots_due
from fem.stepping.programme import Phase, programme
from fem.stepping.recorder import Recorder
from fem.stepping.relaxation import RELAXED_ONSET, relaxed
from fem.stepping.rigid_run import simulate_rigid
from fem.stepping.step_control import StepController, StepPlan, landed
from fem.stepping.summary import (
    closing_lines,
    heat_error,
    lag_share,
    largest,
    last_values,
    layer_errors,
    sliding_means,
    steady_shares,
)

#: Contact modulus of the block with itself over the contact's reference modulus: the bulk modulus,
#: or 100 initial shear moduli for more compressible rubber, whose crease stiffens just as much. A
#: pressure of 45 % of it presses a node in by 1 % of the local element size.
SELF_CONTACT_STIFFNESS = 45.0
SELF_CONTACT_BULK_RATIO = 100.0
#: Residual relative to the load to which a step is solved with a coefficient of friction that is
#: then corrected: the correction is larger.
FIRST_PASS_TOLERANCE = 1e-4


def coupled_model(case: Case) -> CoupledModel:
    """Mechanics, heat and contact laws of a case."""
    mesh, rubber, solver = mesh_of(case), case.rubber, case.solver
    force = case.loading.mean_pressure_N_per_mm2 * case.block.length_mm
    mechanics = BlockMechanics(
        mesh,
        Q1P0Elements(mesh, rubber.material(), rubber.bulk_modulus),
        density=rubber.thermal.density if solver.inertia else 0.0,
        top=case.loading.top,
        tolerance=solver.tolerance * force,
        solver=linear_solver(solver.linear_solver, 2 * len(mesh.points)),
    )
    laws = ContactLaws(
        friction=case.friction.law_object(),
        partition=case.heat.partition_object(),
        conductance=case.heat.conductance_object(),
    )
    return CoupledModel(
        mechanics,
        HeatModel.from_case(case, mesh),
        laws,
        damping=snap_damping(case, mesh),
        mean_pressure=case.loading.mean_pressure_N_per_mm2,
        friction_passes=solver.friction_passes,
        options=newton.NewtonOptions(iterations_max=solver.newton_iterations_max),
        first_merit=FIRST_PASS_TOLERANCE / solver.tolerance,
        self_contact=self_contact_of(case, mesh),
        rubber_heats=rubber.viscoelastic is None or rubber.viscoelastic.heats,
    )


def self_contact_of(case: Case, mesh: BlockMesh) -> SelfContact | None:
    """Contact of the block with itself; the search reaches over the longest boundary edge."""
    if not case.solver.self_contact:
        return None
    softest = SELF_CONTACT_BULK_RATIO * case.rubber.model().initial_shear_modulus
    edges = mesh.points[mesh.boundary_edges]
    longest = float(np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1).max())
    return SelfContact(
        mu=case.friction.rubber_on_rubber_mu,
        stiffness=SELF_CONTACT_STIFFNESS * max(case.rubber.bulk_modulus, softest),
        reach=longest,
    )


class _Run:
    """State of a run between its steps: the accepted state, audit, records and counts."""

    def __init__(
        self,
        case: Case,
        progress: Callable[[Progress], None] | None,
        checkpoint: Checkpoint | None = None,
    ) -> None:
        self.case, self.progress, self.checkpoint = case, progress, checkpoint
        self.started = time.perf_counter()
        self.solver_seconds_before = 0.0
        self.model = coupled_model(case)
        self.recorder = Recorder(case, self.model)
        self.state = self.model.initial_state()
        self.audit = EnergyAudit()
        self.iterations = self.rejected = 0
        self.log = [f"{case.block.length_mm:g} x {case.block.height_mm:g} mm block, "
                    f"{len(self.model.mechanics.mesh.cells)} elements",
                    case.friction.described(), *damping_lines(case)]  # fmt: skip
        self.snapshot_distances = snapshots_due(case)
        self.point = self._point(-1, 0.0, StepPlan(step=0.0))

    @property
    def wall(self) -> float:
        """Time spent on the run, that before an interruption included [s]."""
        return time.perf_counter() - self.started

    @property
    def solver_seconds(self) -> float:
        """Time spent in sparse factorisations and solves, of mechanics and heat [s]."""
        mechanics, heat = self.model.mechanics.solver, self.model.heat.block.stopwatch
        return self.solver_seconds_before + mechanics.seconds + heat.seconds

    def _point(self, phase: int, at: float, plan: StepPlan) -> RunPoint:
        recorder = self.recorder
        return RunPoint(
            phase=phase, at=at, plan=plan, state=self.state, audit=self.audit,
            iterations=self.iterations, rejected=self.rejected, smallest_J=recorder.smallest_J,
            rows=len(recorder.rows), snapshots=len(recorder.snapshots), log=len(self.log),
        )  # fmt: skip

    def kept(self) -> RunRecord:
        """What a checkpoint holds: the last point, and the records up to it."""
        point, recorder = self.point, self.recorder
        records = Records(
            history=columns(recorder.rows[: point.rows]),
            snapshots=recorder.snapshots[: point.snapshots], log=self.log[: point.log],
            wall_s=self.wall, solver_s=self.solver_seconds, bottom=recorder.bottom(point.rows),
        )  # fmt: skip
        return RunRecord(point=point, records=records)

    def go_on_from(self, kept: RunRecord) -> None:
        """Take over the point and the records of an interrupted run."""
        point, records, recorder = kept.point, kept.records, self.recorder
        self.point, self.state, self.audit = point, point.state, point.audit
        self.iterations, self.rejected = point.iterations, point.rejected
        recorder.rows, recorder.snapshots = records.rows, records.snapshots
        if records.bottom is not None:
            recorder.go_on_from(records.bottom)
        recorder.smallest_J = point.smallest_J
        distance = recorder.rows[-1]["sliding_distance_mm"] if recorder.rows else 0.0
        self.snapshot_distances = snapshots_due(self.case, distance)
        self.log = [*records.log, f"resumed after {point.rows} steps, {distance:.6g} mm"]
        self.started -= records.wall_s
        self.solver_seconds_before = records.solver_s

    def run(self) -> Outcome:
        """Go through all phases; the outcome says whether the end was reached."""

        def phases() -> Outcome:
            for number, phase in enumerate(programme(self.case)):
                outcome = self._phase(number, phase)
                if outcome.status != OK:
                    return outcome
            return Outcome(status=OK)

        return stoppable(phases)

    def _phase(self, number: int, phase: Phase) -> Outcome:
        if number < self.point.phase:
            return Outcome(status=OK)
        control = StepController(step_max=phase.step_max, step_min=phase.step_min)
        if self.model.damping is None:  # steps that fail can only be cut
            control = replace(control, enough_help=0.0)
        plan, at = StepPlan(step=phase.step_initial), 0.0
        if number == self.point.phase:
            plan, at = self.point.plan, self.point.at
        snaps = False
        while at < phase.end:
            length = landed(at, min(plan.step, phase.longest(at)), phase.end)
            stop = phase.end if length == phase.end - at else at + length
            attempt, left = self._attempt(phase, at, stop, plan.help)
            self.iterations += attempt.iterations
            if isinstance(attempt, AcceptedStep):
                at = stop
                self._accept(attempt, phase, at, snaps)
                plan, snaps = control.accepted(plan, length, attempt.hardest_pass, left), False
                self.point = self._point(number, at, plan)
                self._report()
                continue
            self.rejected += 1
            self.log.append(
                f"{phase.name} {at:.6g}: step {length:.3g} rejected with damping {plan.help:.3g}, "
                f"{attempt.failure.value}"
            )
            plan, snaps = control.rejected(plan, length), True
            if control.exhausted(plan):
                unit = " mm" if phase.slides else " of the load"
                return failed(attempt.failure, attempt.detail, f"{phase.name} {at:.4g}{unit}")
        return Outcome(status=OK)

    def _attempt(
        self, phase: Phase, at: float, stop: float, level: float
    ) -> tuple[AcceptedStep | RejectedStep, float | None]:
        """A step with damping of a level; at the onset relaxed, and which level that left."""
        attempt = self.model.advance(self.state, phase.target(at, stop), level)
        onset = phase.slides and at < RELAXED_ONSET
        if onset and level > 0.0 and isinstance(attempt, AcceptedStep):
            return relaxed(self.model, attempt, level)
        return attempt, None

    def _accept(self, step: AcceptedStep, phase: Phase, at: float, snaps: bool) -> None:
        self.audit = audited(self.audit, step, self.model.mechanics, snaps=snaps)
        self.state = step.after
        row = self.recorder.record(step, self.audit)
        distance = at if phase.slides else 0.0
        row["sliding_distance_mm"] = distance
        while phase.slides and self.snapshot_distances and distance >= self.snapshot_distances[0]:
            while self.snapshot_distances and distance >= self.snapshot_distances[0]:
                self.snapshot_distances.pop(0)
            self.recorder.snapshot(self.state, distance)

    def _report(self) -> None:
        """Tell the user and keep a checkpoint; here an interruption finds a finished step."""
        row = self.recorder.rows[-1]
        if self.checkpoint is not None:
            self.checkpoint.keep(self.kept)
        if self.progress is not None:
            self.progress(
                Progress(
                    sliding_distance_mm=row["sliding_distance_mm"],
                    T_max_C=row["T_max_C"],
                    newton_iterations=self.iterations,
                )
            )


def simulate(
    case: Case,
    *,
    progress: Callable[[Progress], None] | None = None,
    checkpoint: str | Path | None = None,
    resume: bool = False,
) -> Result:
    """Simulate the sliding tread block of a case.

    Parameters
    ----------
    case : Case
        The resolved case.
    progress : callable, optional
        Called with a `Progress` after each accepted step.
    checkpoint : str or Path, optional
        File that everything needed to go on is written to from time to time, and where the run
        ends early. It is for the caller to remove when the results are safe.
    resume : bool, optional
        Go on from that file if it is there. The result is that of an uninterrupted run.

    Returns
    -------
    Result
        Tables, summary and snapshots. A run that could not finish has everything up to the last
        accepted step and says why in its summary.

    Raises
    ------
    CheckpointError
        If the checkpoint to resume from is damaged or of another case or version.
    TypeError
        If an argument is of another type.

    Examples
    --------
    >>> from fem import Case
    >>> case = Case.from_toml("examples/short.toml", {"loading.distance_mm": 0.1})
    >>> result = simulate(case)
    >>> result.summary["status"]
    'ok'
    """
    _check_types(case, progress, checkpoint)
    kept_in = Checkpoint(checkpoint, case) if checkpoint is not None else None
    if case.block.rigid:
        return simulate_rigid(case, progress, kept_in, resume)
    kept = kept_in.read(RunRecord) if kept_in is not None and resume else None
    run = _Run(case, progress, kept_in)
    if kept is not None:
        run.go_on_from(kept)
    outcome = run.run()
    if kept_in is not None:
        # At the end, too: the disk may be full when the results are to be written.
        kept_in.keep(run.kept, now=True)
    recorder = run.recorder
    distance = recorder.rows[-1]["sliding_distance_mm"] if recorder.rows else 0.0
    if not recorder.snapshots or recorder.snapshots[-1].sliding_distance_mm < distance:
        recorder.snapshot(run.state, distance)
    summary = _summary(run, outcome)
    return Result.from_rows(
        case,
        recorder.geometry,
        recorder.rows,
        recorder.boundary(run.state),
        summary,
        recorder.snapshots,
        log=[
            *run.log,
            *notes(kept_in),
            *window_notes(case, recorder.rows),
            *closing_lines(outcome, summary["warnings"]),
        ],
        bottom=recorder.bottom(),
    )


def _check_types(case: object, progress: object, checkpoint: object) -> None:
    if not isinstance(case, Case):
        how = "a Case, as Case.from_dict or Case.from_toml makes one"
        raise TypeError(f"case is a {type(case).__name__}, expected {how}")
    if progress is not None and not callable(progress):
        raise TypeError(f"progress is a {type(progress).__name__}, expected a function or None")
    if checkpoint is not None and not isinstance(checkpoint, str | os.PathLike):
        raise TypeError(f"checkpoint is a {type(checkpoint).__name__}, expected a path or None")


def _summary(run: _Run, outcome: Outcome) -> dict[str, Any]:
    """Scalars of a run; forces and lengths are means over the sliding phase at full speed."""
    history = pd.DataFrame(run.recorder.rows)
    mechanics, heat, case = run.model.mechanics, run.state.heat, run.case
    regime = sliding_regime(history)
    summary: dict[str, Any] = {"status": outcome.status}
    if outcome.reason:
        summary |= {"reason": outcome.reason, "advice": outcome.advice}
    summary |= last_values(history, ("T_max_C", "T_edge_C", "A_T_K_mm"))
    summary |= sliding_means(history, case.loading.velocity_mm_per_s)
    summary |= {
        "elements": len(mechanics.mesh.cells),
        "dofs": mechanics.pattern.size + heat.T.size,
        "steps": len(history),
        "newton_iterations": run.iterations,
        "wall_s": run.wall,
        "energy_error": run.audit.error,
        "heat_error": heat_error(heat),
        **steady_shares(history),
        "capped_heat_share": run.audit.capped_share,
        "rejected_steps": run.rejected,
        "regularisation_share_with_onset": run.audit.regularisation_share,
        "snap_share": run.audit.snap_share,
        "rubber_dissipation_share": run.audit.rubber_share,
        "damage_share": run.audit.damage_share,
        "friction_lag_error": largest(history, "friction_lag_error"),
        "friction_lag_share": lag_share(history),
        "largest_self_penetration": largest(history, "self_contact_penetration"),
        **layer_errors(history, run.model.heat),
        "min_J": run.recorder.smallest_J,
        "solver_s": run.solver_seconds,
        "program_version": program_version(),
        "sliding_regime": regime.name,
        "stick_slip_cycles": regime.cycles,
        "warnings": [
            *case.warnings,
            *regime.warnings,
            *window_warnings(case, run.recorder.rows),
        ],
    }
    return judged(summary)


__all__ = ["CoupledState", "Progress", "coupled_model", "mesh_of", "simulate"]
