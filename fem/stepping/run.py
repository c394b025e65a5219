"""The time loop: from phase to phase and from step to step, whatever is done to whichever block.

After each accepted step the observers look at it in one fixed order: energy audit, wear, history,
bottom, snapshots, pyrometer; then the run stands at its next point, which a checkpoint may keep
and progress reports.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

from fem.case import Case
from fem.mechanics import damping_lines
from fem.results import OK, Checkpoint, Outcome, failed, stoppable
from fem.stepping.audit import EnergyAuditor
from fem.stepping.coupled_state import AcceptedStep, RejectedStep
from fem.stepping.coupled_step import CoupledModel
from fem.stepping.model_parts import Progress
from fem.stepping.moment import Moment, Observer
from fem.stepping.observers import (
    BottomRecorder,
    HistoryRecorder,
    PyrometerReader,
    SnapshotTaker,
    WearRecorder,
)
from fem.stepping.phases import Phase
from fem.stepping.point import Records, RunPoint, RunRecord, columns
from fem.stepping.programme import programme
from fem.stepping.relaxation import Damping, relaxed
from fem.stepping.step_control import StepController, StepPlan

#: Shortest step where the rubber itself damps the snaps, over the shortest one elsewhere: there
#: only the step is left to take a snap, or a sudden change of contact, in parts.
RUBBER_STEP_MIN = 0.01


class Run:
    """A run between its steps: the accepted state, what observers saw of it, and counts.

    Parameters
    ----------
    case : Case
        The resolved case.
    model : CoupledModel
        Its block and road.
    progress : callable, optional
        Called with a `Progress` after each accepted step.
    checkpoint : Checkpoint, optional
        Where to keep what is needed to go on after an interruption.
    """

    def __init__(
        self,
        case: Case,
        model: CoupledModel,
        progress: Callable[[Progress], None] | None = None,
        checkpoint: Checkpoint | None = None,
    ) -> None:
        self.case, self.model = case, model
        self.progress, self.checkpoint = progress, checkpoint
        self.started, self.solver_seconds_before = time.perf_counter(), 0.0
        self.phases = programme(case)
        mechanics, mesh = model.mechanics, model.mechanics.mesh
        self.auditor = EnergyAuditor(mesh, mechanics.start_weight)
        self.wear = WearRecorder(case, mesh)
        self.history = HistoryRecorder(case, model, self.auditor, self.wear)
        self.bottom = BottomRecorder(mesh)
        self.fields = SnapshotTaker(case, model, self.phases)
        self.pyrometer = PyrometerReader(case, model, self.phases)
        self.observers: tuple[Observer, ...] = (
            self.auditor,
            self.wear,
            self.history,
            self.bottom,
            self.fields,
            self.pyrometer,
        )
        self.state = model.initial_state()
        self.iterations = self.rejected = 0
        rigid = "" if mechanics.deforms else "rigid "
        size = f"{case.block.length_mm:g} x {case.block.height_mm:g} mm block"
        self.log = [f"{rigid}{size}, {len(mesh.cells)} elements", case.friction.described()]
        if mechanics.deforms:
            self.log += damping_lines(case)
        self.point = self._point(-1, StepPlan(step=0.0), 0.0)

    @property
    def wall(self) -> float:
        """Time spent on the run, that before an interruption included [s]."""
        return time.perf_counter() - self.started

    @property
    def solver_seconds(self) -> float:
        """Time spent in sparse factorisations and solves, of mechanics and heat [s]."""
        mechanics, heat = self.model.mechanics.solver, self.model.heat.block.stopwatch
        return self.solver_seconds_before + mechanics.seconds + heat.seconds

    @property
    def distance(self) -> float:
        """Distance slid up to the last accepted step [mm]."""
        rows = self.history.rows
        return float(rows[-1]["sliding_distance_mm"]) if rows else 0.0

    def _point(self, phase: int, plan: StepPlan, distance: float) -> RunPoint:
        return RunPoint(
            phase=phase,
            plan=plan,
            distance=distance,
            state=self.state,
            audit=self.auditor.audit,
            wear=self.wear.wear,
            reading=self.pyrometer.reading,
            iterations=self.iterations,
            rejected=self.rejected,
            smallest_J=self.history.smallest_J,
            rows=len(self.history.rows),
            snapshots=len(self.fields.snapshots),
            log=len(self.log),
        )

    def kept(self) -> RunRecord:
        """What a checkpoint holds: the last point, and the records up to it."""
        point = self.point
        records = Records(
            history=columns(self.history.rows[: point.rows]),
            snapshots=self.fields.snapshots[: point.snapshots],
            log=self.log[: point.log],
            wall_s=self.wall,
            solver_s=self.solver_seconds,
            bottom=self.bottom.table(point.rows),
        )
        return RunRecord(point=point, records=records)

    def go_on_from(self, kept: RunRecord) -> None:
        """Take over the point and the records of an interrupted run."""
        point, records = kept.point, kept.records
        self.point, self.state = point, point.state
        self.auditor.audit, self.wear.wear = point.audit, point.wear
        self.pyrometer.reading = point.reading
        self.iterations, self.rejected = point.iterations, point.rejected
        self.history.rows, self.history.smallest_J = records.rows, point.smallest_J
        self.bottom.go_on_from(records.bottom)
        self.fields.snapshots = records.snapshots
        self.fields.skip_to(self.distance)
        self.log = [*records.log, f"resumed after {point.rows} steps, {self.distance:.6g} mm"]
        self.started -= records.wall_s
        self.solver_seconds_before = records.solver_s

    def run(self) -> Outcome:
        """Go through all phases; the outcome says whether the end was reached."""

        def phases() -> Outcome:
            for number, phase in enumerate(self.phases):
                if number >= self.point.phase:
                    outcome = self._phase(number, phase)
                    if outcome.status != OK:
                        return outcome
            return Outcome(status=OK)

        return stoppable(phases)

    def _phase(self, number: int, phase: Phase) -> Outcome:
        control, tried = self._control(phase), 0.0
        plan, before = self._begun(number, phase)
        while plan.at < phase.end:
            length, stop = control.trial(plan, phase.longest(plan.at), phase.end)
            attempt, left = self._attempt(phase, plan, stop)
            self.iterations += attempt.iterations
            if isinstance(attempt, AcceptedStep):
                self._accept(
                    Moment(
                        step=attempt,
                        phase=phase,
                        number=number,
                        snaps=plan.failed,
                        distance=before + phase.slid(stop),
                        ends=stop == phase.end,
                    )
                )
                plan = control.accepted(
                    plan,
                    length,
                    attempt.hardest_pass,
                    help_left=left.level,
                    rest=left.rest,
                    at=stop,
                )
                tried = 0.0
                self.point = self._point(number, plan, before)
                self._report()
                continue
            self._reject(phase, plan, length, attempt)
            tried = max(tried, length)
            plan = self._after_failure(control, plan, length, tried)
            if control.exhausted(plan):
                where = f"{phase.name} {plan.at:.4g}{phase.unit}"
                return failed(attempt.failure, attempt.detail, where)
        return Outcome(status=OK)

    def _begun(self, number: int, phase: Phase) -> tuple[StepPlan, float]:
        """First plan of a phase, or that of its point, and the distance slid before the phase."""
        if number == self.point.phase:
            return self.point.plan, self.point.distance
        if phase.touches_down:
            fresh = self.case.loading.road == "fresh"
            self.state = self.model.touched_down(self.state, fresh_road=fresh)
        return StepPlan(step=phase.step_initial), self.distance

    def _reject(self, phase: Phase, plan: StepPlan, length: float, attempt: RejectedStep) -> None:
        self.rejected += 1
        self.log.append(
            f"{phase.name} {plan.at:.6g}: step {length:.3g} rejected with damping "
            f"{plan.help:.3g}, {attempt.failure.value}"
        )

    def _control(self, phase: Phase) -> StepController:
        """Control of a phase's steps; where rubber damps the snaps itself, failed ones are cut."""
        control = StepController(
            step_max=phase.step_max, step_min=phase.step_min, growth=phase.growth
        )
        damping = self.model.damping
        if damping is None:
            return replace(control, enough_help=0.0)
        if not damping.last_resort:
            return control
        return replace(control, enough_help=0.0, step_min=RUBBER_STEP_MIN * phase.step_min)

    def _after_failure(
        self, control: StepController, plan: StepPlan, length: float, tried: float
    ) -> StepPlan:
        """Plan after a failed step; `tried` is the longest that failed at this place."""
        cut = control.rejected(plan, length)
        damping = self.model.damping
        if not control.exhausted(cut) or plan.help > 0.0 or damping is None:
            return cut
        self.log.append("no step length has a solution with the rubber's own damping: artificial")
        return control.helped(cut, tried)

    def _attempt(
        self, phase: Phase, plan: StepPlan, stop: float
    ) -> tuple[AcceptedStep | RejectedStep, Damping]:
        """A planned step, relaxed if it was damped, and the damping that this left."""
        attempt = self.model.advance(self.state, phase.target(plan.at, stop), plan.help)
        if plan.help > 0.0 and isinstance(attempt, AcceptedStep):
            return relaxed(self.model, attempt, Damping(plan.help, plan.rest))
        return attempt, Damping()

    def _accept(self, moment: Moment) -> None:
        self.state = moment.step.after
        for observer in self.observers:
            observer.see(moment)

    def _report(self) -> None:
        """Keep a checkpoint and tell the user; here an interruption finds a finished step."""
        if self.checkpoint is not None:
            self.checkpoint.keep(self.kept)
        if self.progress is not None:
            self.progress(
                Progress(
                    sliding_distance_mm=self.distance,
                    T_max_C=self.history.rows[-1]["T_max_C"],
                    newton_iterations=self.iterations,
                )
            )
