"""The onset of sliding in a few numbers: force at some distances, sinking of the pressed platen."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fem.case import Case
from fem.results import HISTORY, HISTORY_FILE, RunFolder, read_table
from fem.sweeps import RUNS_FOLDER, StudyCase
from materials.arrays import FloatArray
from validation.studies import cases_of

#: Motions of the platen at which the onset is looked at [mm].
ONSET_MM = (0.1625, 0.4156, 0.9852, 1.8)


@dataclass(frozen=True, kw_only=True)
class SweptRun:
    """History and summary of a run that a sweep left, without its fields."""

    study_case: StudyCase
    history: pd.DataFrame
    summary: dict[str, Any]


def swept_runs(study: str, directory: Path) -> list[SweptRun]:
    """Runs of a study in the folder of its sweep, in the order of the study.

    Raises
    ------
    ValueError
        If one is missing, naming it.
    """
    runs = []
    for case in cases_of(study):
        folder = directory / RUNS_FOLDER / case.name
        summary = RunFolder(folder, case.case).of_case()
        if summary is None:
            raise ValueError(f"{folder} does not hold the run of this case of the study")
        history = read_table(folder / HISTORY_FILE, HISTORY)
        runs.append(SweptRun(study_case=case, history=history, summary=summary))
    return runs


def force_at(history: pd.DataFrame, distances: FloatArray) -> FloatArray:
    """Friction force at motions of the platen [mm], linear between the steps, (n,) [N/mm].

    It is not a number beyond the end of the history.
    """
    from_rest = _from_rest(history)
    return _interpolated(from_rest, from_rest["friction_force_N_per_mm"].to_numpy(), distances)


def damping_force_at(history: pd.DataFrame, distances: FloatArray) -> FloatArray:
    """Part of the friction force that the damping takes: what it dissipates per motion [N/mm].

    Parameters and result as those of `force_at`; the dissipation of a step counts at its end.
    """
    from_rest = _from_rest(history)
    dissipated = from_rest["viscous_dissipation_mJ_per_mm"].to_numpy()
    motion = from_rest["sliding_distance_mm"].to_numpy()
    rate = np.append(0.0, np.diff(dissipated) / np.diff(motion))
    return _interpolated(from_rest, rate, distances)


def _from_rest(history: pd.DataFrame) -> pd.DataFrame:
    """The pressed block and every step of the slide."""
    return history.drop_duplicates("sliding_distance_mm", keep="last")


def _interpolated(from_rest: pd.DataFrame, values: FloatArray, distances: FloatArray) -> FloatArray:
    return np.interp(distances, from_rest["sliding_distance_mm"], values, right=np.nan)


def pressed_platen(history: pd.DataFrame) -> float:
    """Sinking of the platen when the block is pressed and has not yet moved [mm]."""
    pressed = history[history["sliding_distance_mm"] == 0.0]
    return float(pressed["platen_displacement_mm"].iloc[-1])


def full_slip(case: Case) -> float:
    """Friction force mu p L of the whole block at its mean pressure, cold [N/mm]."""
    p, v = case.loading.mean_pressure_N_per_mm2, abs(case.loading.velocity_mm_per_s)
    mu = case.friction.law_object().coefficient(p, v, case.heat.ambient_C)
    return float(mu) * p * case.block.length_mm
