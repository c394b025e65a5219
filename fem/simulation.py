"""Run a case: build the model, press the block, slide it, and return the tables."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fem import newton
from fem.case import Case
from fem.files import program_version
from fem.heat import HeatModel
from fem.mechanics import BlockMechanics, Q1P0Elements, RigidMechanics, snap_damping
from fem.mesh import BlockMesh
from fem.results import (
    BlockGeometry,
    Checkpoint,
    Outcome,
    Result,
    judged,
    notes,
    sliding_regime,
    window_notes,
    window_warnings,
)
from fem.solvers import linear_solver
from fem.stepping import (
    ContactLaws,
    CoupledModel,
    Progress,
    Run,
    RunRecord,
    SelfContact,
    block_summaries,
    closing_lines,
    heat_error,
    lag_share,
    largest,
    last_values,
    layer_errors,
    mesh_of,
    sized,
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
    mesh, solver, deforms = mesh_of(case), case.solver, not case.block.rigid
    viscoelastic, mullins = case.rubber.viscoelastic, case.rubber.mullins
    laws = ContactLaws(
        friction=case.friction.law_object(),
        partition=case.heat.partition_object(),
        conductance=case.heat.conductance_object(),
    )
    return CoupledModel(
        _block_mechanics(case, mesh) if deforms else RigidMechanics(mesh),
        HeatModel.from_case(case, mesh),
        laws,
        damping=snap_damping(case, mesh) if deforms else None,
        mean_pressure=case.loading.mean_pressure_N_per_mm2,
        friction_passes=solver.friction_passes,
        options=newton.NewtonOptions(iterations_max=solver.newton_iterations_max),
        first_merit=FIRST_PASS_TOLERANCE / solver.tolerance,
        self_contact=self_contact_of(case, mesh) if deforms else None,
        viscosity_heats=viscoelastic is None or viscoelastic.heats,
        damage_heats=mullins is None or mullins.heats,
    )


def _block_mechanics(case: Case, mesh: BlockMesh) -> BlockMechanics:
    solver = case.solver
    force = case.loading.mean_pressure_N_per_mm2 * case.block.pressed_length_mm
    return BlockMechanics(
        mesh,
        Q1P0Elements(mesh, case.rubber.material(), case.rubber.bulk_modulus),
        density=case.rubber.thermal.density if solver.inertia else 0.0,
        top=case.loading.top,
        tolerance=solver.tolerance * force,
        solver=linear_solver(solver.linear_solver, 2 * len(mesh.points)),
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
    case = sized(case)
    kept_in = Checkpoint(checkpoint, case) if checkpoint is not None else None
    kept = kept_in.read(RunRecord) if kept_in is not None and resume else None
    run = Run(case, coupled_model(case), progress, kept_in)
    if kept is not None:
        run.go_on_from(kept)
    outcome = run.run()
    if kept_in is not None:
        # At the end, too: the disk may be full when the results are to be written.
        kept_in.keep(run.kept, now=True)
    fields, rows = run.fields, run.history.rows
    if not fields.snapshots or fields.snapshots[-1].time_s < run.state.time:
        fields.take(run.state, run.distance)
    summary = _summary(run, outcome)
    mesh = run.model.mechanics.mesh
    return Result.from_rows(
        case,
        BlockGeometry(points=mesh.points, cells=mesh.cells),
        rows,
        run.history.boundary(run.state),
        summary,
        fields.snapshots,
        log=[
            *run.log,
            *notes(kept_in),
            *window_notes(case, rows),
            *closing_lines(outcome, summary["warnings"]),
        ],
        bottom=run.bottom.table() if run.model.mechanics.deforms else None,
        pyrometer=run.pyrometer.table(),
    )


def _check_types(case: object, progress: object, checkpoint: object) -> None:
    if not isinstance(case, Case):
        how = "a Case, as Case.from_dict or Case.from_toml makes one"
        raise TypeError(f"case is a {type(case).__name__}, expected {how}")
    if progress is not None and not callable(progress):
        raise TypeError(f"progress is a {type(progress).__name__}, expected a function or None")
    if checkpoint is not None and not isinstance(checkpoint, str | os.PathLike):
        raise TypeError(f"checkpoint is a {type(checkpoint).__name__}, expected a path or None")


def _summary(run: Run, outcome: Outcome) -> dict[str, Any]:
    """Scalars of a run; forces and lengths are means over the sliding phase at full speed."""
    history = pd.DataFrame(run.history.rows)
    mechanics, heat, case = run.model.mechanics, run.state.heat, run.case
    regime = sliding_regime(history)
    summary: dict[str, Any] = {"status": outcome.status}
    if outcome.reason:
        summary |= {"reason": outcome.reason, "advice": outcome.advice}
    audit = run.auditor.audit
    summary |= {
        **last_values(history, ("T_max_C", "T_edge_C", "A_T_K_mm")),
        **sliding_means(history),
        "elements": len(mechanics.mesh.cells),
        "dofs": mechanics.size + heat.T.size,
        "steps": len(history),
        "newton_iterations": run.iterations,
        "wall_s": run.wall,
        "energy_error": audit.error,
        "heat_error": heat_error(heat),
        **steady_shares(history),
        "capped_heat_share": audit.capped_share,
        "rejected_steps": run.rejected,
        "regularisation_share_with_onset": audit.regularisation_share,
        "snap_share": audit.snap_share,
        "rubber_dissipation_share": audit.rubber_share,
        "damage_share": audit.damage_share,
        "friction_lag_error": largest(history, "friction_lag_error"),
        "friction_lag_share": lag_share(history),
        "largest_self_penetration": largest(history, "self_contact_penetration"),
        **layer_errors(history, run.model.heat),
        "min_J": run.history.smallest_J,
        "solver_s": run.solver_seconds,
        "program_version": program_version(),
        "sliding_regime": regime.name,
        "stick_slip_cycles": regime.cycles,
        **run.wear.summary(),
        **run.pyrometer.summary(),
        **block_summaries(history, mechanics.mesh.blocks),
        "warnings": [*case.warnings, *regime.warnings, *window_warnings(case, run.history.rows)],
    }
    return judged(summary)
