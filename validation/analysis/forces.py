"""The friction force over the motion of the platen."""

import numpy as np
import pandas as pd


def force_at(history: pd.DataFrame, motion: float) -> float:
    """Friction force when the block has slid so far [N/mm]."""
    slide = history[history["sliding_distance_mm"] > 0.0]
    return float(np.interp(motion, slide["sliding_distance_mm"], slide["friction_force_N_per_mm"]))


def onset_difference(one: pd.DataFrame, other: pd.DataFrame, until: float) -> float:
    """Largest difference of two forces up to a motion [mm], over the largest force there [-]."""
    motions = np.linspace(0.0, until, 101)[1:]
    forces = np.array([[force_at(history, s) for s in motions] for history in (one, other)])
    return float(np.abs(forces[0] - forces[1]).max() / np.abs(forces).max())
