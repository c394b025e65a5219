"""The committed tables of the studies to the limit: a row per run, four to five digits each."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fem.case import Case, Solver
from validation.analysis import rounded
from validation.convergence.onset import (
    ONSET_MM,
    SweptRun,
    damping_force_at,
    force_at,
    full_slip,
    pressed_platen,
)

CONVERGENCE = Path(__file__).parents[1] / "convergence.csv"
ONSET = CONVERGENCE.with_name("onset.csv")
SNAPS = CONVERGENCE.with_name("snaps.csv")
#: Columns of the forces at `ONSET_MM`.
FORCES = tuple(f"force_at_{distance:g}_mm_N_per_mm" for distance in ONSET_MM)
#: Columns of what of these is the damping's.
DAMPING_FORCES = tuple(f"damping_{force}" for force in FORCES)
PLATEN = "pressed_platen_mm"
#: Results, and how they were come by; explained in `docs/files.md`.
FOUND = (
    "T_max_C",
    "T_edge_C",
    "A_T_K_mm",
    "contact_length_mm",
    "friction_force_N_per_mm",
    "regularisation_share_with_onset",
    "snap_share",
    "energy_error",
    "steps",
    "rejected_steps",
    "newton_iterations",
    "sliding_regime",
    "program_version",
)


def convergence_table(runs: list[SweptRun]) -> pd.DataFrame:
    """What was varied of the introductory example, and what came out."""
    return _table(runs, ("mesh", "damping", "steps_scale", "memory_mm"))


def onset_table(runs: list[SweptRun]) -> pd.DataFrame:
    """The onset of each case in each of its numerics, with the force of full slip."""
    numerics = ("step_mm_max", "damping", "full_slip_N_per_mm")
    return _table(runs, ("compound", "law", "mu", "height_mm", "velocity_mm_per_s", *numerics))


def snaps_table(runs: list[SweptRun]) -> pd.DataFrame:
    """What large snaps release and what comes of it, by the damping that carries them and steps."""
    varied = ("compound", "mean_pressure_N_per_mm2", "law", "mu", "damping", "steps_scale")
    return _table(runs, varied, onset=False)


def _table(runs: list[SweptRun], varied: tuple[str, ...], *, onset: bool = True) -> pd.DataFrame:
    """A row per run: what was varied, how it ended, its onset, and `FOUND`."""
    rows = [
        {key: _VARIED[key](run.study_case.case) for key in varied}
        | {"status": run.summary["status"], "reason": run.summary.get("reason", "")}
        | (_onset(run.history) if onset else {})
        | {key: run.summary[key] for key in FOUND}
        for run in runs
    ]
    return rounded(pd.DataFrame(rows), 5)


def _onset(history: pd.DataFrame) -> dict[str, float]:
    distances = np.array(ONSET_MM)
    return {
        **dict(zip(FORCES, force_at(history, distances), strict=True)),
        **dict(zip(DAMPING_FORCES, damping_force_at(history, distances), strict=True)),
        PLATEN: pressed_platen(history),
    }


def _damping(case: Case) -> float:
    """Multiple of the default damping; both distances have to be scaled alike."""
    defaults = Solver()
    edge = case.solver.edge_viscous_distance_mm / defaults.edge_viscous_distance_mm
    block = case.solver.viscous_distance_mm / defaults.viscous_distance_mm
    if abs(edge - block) > 1e-3 * edge:
        raise ValueError(f"damping of the block times {block:g}, of its edge times {edge:g}")
    return edge


#: What a study varies, by its column.
_VARIED: dict[str, Callable[[Case], Any]] = {
    "mesh": lambda case: case.block.mesh,
    "height_mm": lambda case: case.block.height_mm,
    "compound": lambda case: case.rubber.compound,
    "law": lambda case: case.friction.law,
    "mu": lambda case: case.friction.constants.get("mu"),
    "memory_mm": lambda case: case.friction.memory_mm,
    "mean_pressure_N_per_mm2": lambda case: case.loading.mean_pressure_N_per_mm2,
    "velocity_mm_per_s": lambda case: case.loading.velocity_mm_per_s,
    "step_mm_max": lambda case: case.solver.step_mm_max,
    "steps_scale": lambda case: case.solver.steps_scale,
    "damping": _damping,
    "full_slip_N_per_mm": full_slip,
}
