"""The committed tables of the studies to the limit: a row per run, four to five digits each."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fem.case import Solver
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
_DIGITS = 5


def convergence_table(runs: list[SweptRun]) -> pd.DataFrame:
    """What was varied of the introductory example, and what came out."""
    rows = [
        {
            "mesh": run.study_case.case.block.mesh,
            "damping": _damping(run.study_case.case.solver),
            "steps_scale": run.study_case.case.solver.steps_scale,
            "memory_mm": run.study_case.case.friction.memory_mm,
            **_results(run),
        }
        for run in runs
    ]
    return _rounded(rows)


def onset_table(runs: list[SweptRun]) -> pd.DataFrame:
    """The onset of each case in each of its numerics, with the force of full slip."""
    rows = [
        {
            "compound": run.study_case.case.rubber.compound,
            "law": run.study_case.case.friction.law,
            "mu": run.study_case.case.friction.constants.get("mu"),
            "height_mm": run.study_case.case.block.height_mm,
            "velocity_mm_per_s": run.study_case.case.loading.velocity_mm_per_s,
            "step_mm_max": run.study_case.case.solver.step_mm_max,
            "damping": _damping(run.study_case.case.solver),
            "full_slip_N_per_mm": full_slip(run.study_case.case),
            **_results(run),
        }
        for run in runs
    ]
    return _rounded(rows)


def snaps_table(runs: list[SweptRun]) -> pd.DataFrame:
    """What large snaps release and what comes of it, by the damping that carries them."""
    rows = [
        {
            "compound": run.study_case.case.rubber.compound,
            "mean_pressure_N_per_mm2": run.study_case.case.loading.mean_pressure_N_per_mm2,
            "law": run.study_case.case.friction.law,
            "mu": run.study_case.case.friction.constants.get("mu"),
            "damping": _damping(run.study_case.case.solver),
            "status": run.summary["status"],
            "reason": run.summary.get("reason", ""),
            **{key: run.summary[key] for key in FOUND},
        }
        for run in runs
    ]
    return _rounded(rows)


def _results(run: SweptRun) -> dict[str, Any]:
    distances = np.array(ONSET_MM)
    return {
        "status": run.summary["status"],
        "reason": run.summary.get("reason", ""),
        **dict(zip(FORCES, force_at(run.history, distances), strict=True)),
        **dict(zip(DAMPING_FORCES, damping_force_at(run.history, distances), strict=True)),
        PLATEN: pressed_platen(run.history),
        **{key: run.summary[key] for key in FOUND},
    }


def _damping(solver: Solver) -> float:
    """Multiple of the default damping; both distances have to be scaled alike."""
    defaults = Solver()
    edge = solver.edge_viscous_distance_mm / defaults.edge_viscous_distance_mm
    block = solver.viscous_distance_mm / defaults.viscous_distance_mm
    if abs(edge - block) > 1e-3 * edge:
        raise ValueError(f"damping of the block times {block:g}, of its edge times {edge:g}")
    return edge


def _rounded(rows: list[dict[str, Any]]) -> pd.DataFrame:
    table = pd.DataFrame(rows)
    for column in table.select_dtypes("float"):
        table[column] = [float(f"{value:.{_DIGITS}g}") for value in table[column]]
    return table
