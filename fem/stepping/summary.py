"""Scalars of a run from its history: values at the end, largest values, means over the slide."""

import numpy as np
import pandas as pd

from fem.heat import HeatModel, HeatState, layer_error
from fem.results import Outcome
from fem.stepping.balance import balance_error, share


def last_values(history: pd.DataFrame, columns: tuple[str, ...]) -> dict[str, float]:
    """Values of the last row; NaN where there is none."""
    return {c: float(history[c].iloc[-1]) if len(history) else float("nan") for c in columns}


def largest(history: pd.DataFrame, column: str) -> float:
    """Largest value of a column; NaN where there is none."""
    return float(history[column].max()) if len(history) else float("nan")


#: What is averaged over the slide.
MEANS = (
    "friction_force_N_per_mm",
    "friction_coefficient",
    "contact_length_mm",
    "mean_contact_pressure_N_per_mm2",
)


def sliding_means(history: pd.DataFrame, columns: tuple[str, ...] = MEANS) -> dict[str, float]:
    """Means over the distance slid at full speed: force, coefficient, contact length, pressure."""
    if history.empty:
        return dict.fromkeys(columns, float("nan"))
    length = history["sliding_distance_mm"].diff().fillna(history["sliding_distance_mm"])
    speed = history["velocity_mm_per_s"].abs()
    full = np.isclose(speed, speed.max(), rtol=1e-6) & (length > 0.0)
    chosen, weight = history[full], length[full]
    if chosen.empty:
        return {c: float(history[c].iloc[-1]) for c in columns}
    return {c: float(np.average(chosen[c], weights=weight)) for c in columns}


def steady_share(history: pd.DataFrame, part: str, whole: str) -> float:
    """Share of one energy in another while sliding over the second half of the distance [-].

    The first half holds the onset of sliding, in which the block takes up its deformation.
    """
    if history.empty or not history["sliding_distance_mm"].iloc[-1] > 0.0:
        return 0.0
    distance = history["sliding_distance_mm"]
    late = (distance.diff().fillna(distance) > 0.0) & (distance >= 0.5 * distance.iloc[-1])
    energies = history[[part, whole]]
    change = energies.diff().fillna(energies)[late].sum()
    return share(float(change[part]), float(change[whole]))


def steady_shares(history: pd.DataFrame) -> dict[str, float]:
    """What becomes, in the second half of the slide, of the work that is not friction [-].

    `regularisation_share` is dissipated by the damping outside of snaps, `storage_share` stored as
    strain energy. In steady sliding both vanish: nothing is stored and no strain changes. A
    storage share of some per cent tells that the leading edge is still rolling under.
    """
    work = "work_in_mJ_per_mm"
    viscous, snaps = "viscous_dissipation_mJ_per_mm", "snap_dissipation_mJ_per_mm"
    rubber = "rubber_dissipation_mJ_per_mm"
    return {
        "regularisation_share": steady_share(history, viscous, work)
        - steady_share(history, snaps, work)
        - steady_share(history, rubber, work),
        "storage_share": steady_share(history, "strain_energy_mJ_per_mm", work),
    }


def lag_share(history: pd.DataFrame) -> float:
    """Share of the friction work by which the coefficient lags behind its contact [-]."""
    if history.empty:
        return float("nan")
    work = history["friction_dissipation_mJ_per_mm"].diff().abs().fillna(0.0)
    return share(float((work * history["friction_lag_error"]).sum()), float(work.sum()))


def heat_error(heat: HeatState) -> float:
    """Imbalance of the heat relative to what was turned over [-]."""
    lost = heat.radiated + heat.convected
    return balance_error(heat.generated, heat.in_block, heat.in_road, lost, heat.left)


def layer_errors(history: pd.DataFrame, heat: HeatModel) -> dict[str, float]:
    """How well the heated layers are resolved, by the rise of surface temperatures they miss [-].

    The block's surface is heated during all of the slide, a point of the road while the contact
    passes over it. Either is judged by its cells and by the sub-steps of the heat.
    """
    if history.empty or not history["sliding_distance_mm"].iloc[-1] > 0.0:
        return {"heat_layer_error": 0.0, "road_layer_error": 0.0}
    moved = history["sliding_distance_mm"].diff().fillna(history["sliding_distance_mm"])
    slide = history[moved > 0.0]
    if "contact" in history:
        # Heated anew in every contact: the shortest of them has the thinnest layer.
        one = slide.groupby("contact")["time_s"].agg(np.ptp).idxmin()
        slide = slide[slide["contact"] == one]
    dt = history["time_s"].diff().fillna(history["time_s"])
    time, distance = float(dt[slide.index].sum()), float(moved[slide.index].sum())
    step = _longest_heat_step(moved[slide.index], heat.heat_step_mm)
    passed = min(float(slide["contact_length_mm"].iloc[-1]), distance)
    block, road = heat.block.rubber, heat.road
    return {
        "heat_layer_error": layer_error(
            heat.mesh.bottom_cell_height, block.diffusivity, time, distance / step
        ),
        "road_layer_error": layer_error(
            road.depths[1], road.road.diffusivity, time * passed / distance, passed / step
        ),
    }


def _longest_heat_step(steps: pd.Series, heat_step_mm: float) -> float:
    """Longest sub-step of the heat [mm] in the second half of a slide of these steps."""
    distance = steps.cumsum()
    late = steps[distance > 0.5 * distance.iloc[-1]].to_numpy()
    return float(np.max(late / np.ceil(late / heat_step_mm - 1e-9)))


def closing_lines(outcome: Outcome, warnings: list[str]) -> list[str]:
    """Last lines of the log: the warnings, one each, and how the run ended."""
    status = f"status: {outcome.status} {outcome.reason}".rstrip()
    return [*(f"warning: {warning}" for warning in warnings), status]
