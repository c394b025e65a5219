"""Scalars of a run from its history: values at the end, largest values, means over the slide."""

from __future__ import annotations

import numpy as np
import pandas as pd


def last_values(history: pd.DataFrame, columns: tuple[str, ...]) -> dict[str, float]:
    """Values of the last row; NaN where there is none."""
    return {c: float(history[c].iloc[-1]) if len(history) else float("nan") for c in columns}


def largest(history: pd.DataFrame, column: str) -> float:
    """Largest value of a column; NaN where there is none."""
    return float(history[column].max()) if len(history) else float("nan")


def sliding_means(history: pd.DataFrame, velocity: float) -> dict[str, float]:
    """Means over the distance slid at full speed: force, coefficient, contact length, pressure."""
    columns = (
        "friction_force_N_per_mm",
        "friction_coefficient",
        "contact_length_mm",
        "mean_contact_pressure_N_per_mm2",
    )
    if history.empty:
        return dict.fromkeys(columns, float("nan"))
    length = history["sliding_distance_mm"].diff().fillna(history["sliding_distance_mm"])
    full = np.isclose(history["velocity_mm_per_s"], velocity, rtol=1e-6) & (length > 0.0)
    chosen, weight = history[full], length[full]
    if chosen.empty:
        return {c: float(history[c].iloc[-1]) for c in columns}
    return {c: float(np.average(chosen[c], weights=weight)) for c in columns}


def steady_share(history: pd.DataFrame, part: str, whole: str) -> float:
    """Share of one energy in another over the second half of the sliding distance [-].

    The first half holds the onset of sliding, in which the block takes up its deformation.
    """
    if history.empty or not history["sliding_distance_mm"].iloc[-1] > 0.0:
        return 0.0
    half = 0.5 * history["sliding_distance_mm"].iloc[-1]
    late = history[history["sliding_distance_mm"] >= half]
    first = history[history["sliding_distance_mm"] < half].iloc[-1:]
    span = pd.concat([first, late])[[part, whole]]
    change = span.iloc[-1] - span.iloc[0]
    return float(change[part] / change[whole]) if change[whole] > 0.0 else 0.0


def steady_shares(history: pd.DataFrame) -> dict[str, float]:
    """What becomes, in the second half of the slide, of the work that is not friction [-].

    `regularisation_share` is dissipated by the Kelvin-Voigt term, `storage_share` stored as
    strain energy. In steady sliding both vanish: nothing is stored and no strain changes. A
    storage share of some per cent tells that the leading edge is still rolling under; what its
    snaps release is then found in the regularisation share, however small the viscosity.
    """
    work = "work_in_mJ_per_mm"
    return {
        "regularisation_share": steady_share(history, "viscous_dissipation_mJ_per_mm", work),
        "storage_share": steady_share(history, "strain_energy_mJ_per_mm", work),
    }
