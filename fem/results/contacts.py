"""The contacts of an event with the road, from touch-down to lift-off, a row each."""

from typing import Any

import numpy as np
import pandas as pd

#: `contacts.csv`. Temperatures and `A_T_K_mm` are those at the end of the contact, works and heat
#: those of the contact alone.
CONTACTS = (
    "contact",
    "start_s",
    "end_s",
    "slid_mm",
    "T_max_C",
    "T_before_C",
    "A_T_K_mm",
    "friction_coefficient",
    "friction_work_mJ_per_mm",
    "heat_in_rubber_mJ_per_mm",
    "wear_volume_mm3_per_mm",
)
#: Sums since the start of the event, and what of them a contact adds.
_ADDED = {
    "friction_dissipation_mJ_per_mm": "friction_work_mJ_per_mm",
    "heat_in_rubber_mJ_per_mm": "heat_in_rubber_mJ_per_mm",
    "wear_volume_mm3_per_mm": "wear_volume_mm3_per_mm",
}


def contacts_table(history: pd.DataFrame, ambient_C: float) -> pd.DataFrame:
    """Table of the contacts of a history with the columns `contact` and `phase`.

    Parameters
    ----------
    history : DataFrame
        A row per accepted step.
    ambient_C : float
        Temperature of the block before the first contact [C].
    """
    history = history.assign(**{name: 0.0 for name in _ADDED if name not in history})
    rows = [
        _row(history, pressed.index[0], pressed.index[-1], ambient_C)
        for _, pressed in history[history["mean_pressure_N_per_mm2"] > 0.0].groupby("contact")
    ]
    return pd.DataFrame(rows, columns=list(CONTACTS)).astype({"contact": int})


def _row(history: pd.DataFrame, first: int, last: int, ambient_C: float) -> dict[str, float]:
    """Of the steps from `first` to `last`; in the one before them the block was in air.

    The sums have what it slips while it is lifted off, too, until it touches no more.
    """
    end: Any = history.loc[last]
    same = history["contact"] == end["contact"]
    touching = history.index[same & (history["contact_length_mm"] > 0.0)]
    left: Any = history.loc[min(max(touching[-1], last) + 1, history.index[-1])]
    before: Any = history.loc[first - 1] if first > 0 else None

    def change(column: str) -> float:
        return float(left[column] - (0.0 if before is None else before[column]))

    steps = history.loc[first:last]
    way = history["sliding_distance_mm"].diff().fillna(history["sliding_distance_mm"])
    way = way.loc[first:last]
    mu = steps["friction_coefficient"]
    return {
        "contact": int(end["contact"]),
        "start_s": 0.0 if before is None else float(before["time_s"]),
        "end_s": float(end["time_s"]),
        "slid_mm": change("sliding_distance_mm"),
        "T_max_C": float(end["T_max_C"]),
        "T_before_C": ambient_C if before is None else float(before["T_max_C"]),
        "A_T_K_mm": float(end["A_T_K_mm"]),
        "friction_coefficient": float(np.average(mu, weights=way)) if way.any() else 0.0,
        **{name: change(column) for column, name in _ADDED.items()},
    }
