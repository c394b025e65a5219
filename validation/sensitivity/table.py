"""The table of a one-at-a-time study: what was changed, what came out, how far from the base."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fem.sweeps import StudyRun
from validation.sensitivity.parameters import AND, PARAMETERS

RESULTS = (
    "T_max_C",
    "A_T_K_mm",
    "friction_force_N_per_mm",
    "contact_length_mm",
    "mean_contact_pressure_N_per_mm2",
)
#: Column of a difference to the column it is of; temperatures in K, the rest in per cent, rounded
#: to four digits behind the point.
DIFFERENCES = {
    "T_max_difference_K": "T_max_C",
    "A_T_difference_percent": "A_T_K_mm",
    "friction_force_difference_percent": "friction_force_N_per_mm",
    "contact_pressure_difference_percent": "mean_contact_pressure_N_per_mm2",
}
BASE = "base"


def sensitivity_table(runs: list[StudyRun]) -> pd.DataFrame:
    """One row per run of a one-at-a-time study, the base first.

    Parameters
    ----------
    runs : list of StudyRun
        Exactly one of them without overrides: the base.

    Returns
    -------
    DataFrame
        Columns ``parameter, label, group, from, to, status, reason, reached_mm``, `RESULTS` and
        `DIFFERENCES`. A run that stopped early has results of where it stopped and no differences:
        they would compare different sliding distances.

    Raises
    ------
    ValueError
        If there is no base or more than one.
    """
    bases = [run for run in runs if not run.study_case.overrides]
    if len(bases) != 1:
        raise ValueError(f"{len(bases)} runs without overrides; expected one, the base")
    base = bases[0]
    ordered = [base, *(run for run in runs if run is not base)]
    table = pd.DataFrame([_row(run, base) for run in ordered])
    ok = (table["status"] == "ok").to_numpy()
    comparable = ok & ok[0]
    for column, of in DIFFERENCES.items():
        values = table[of].to_numpy(dtype=float)
        scale = 1.0 if column.endswith("_K") else 100.0 / values[0]
        change = np.round((values - values[0]) * scale, 4)
        table[column] = np.where(comparable, change, np.nan)
    return table


def _row(run: StudyRun, base: StudyRun) -> dict[str, Any]:
    keys = list(run.study_case.overrides)
    parameter = PARAMETERS[keys[0]] if keys else None
    summary, history = run.result.summary, run.result.history
    return {
        "parameter": AND.join(keys) or BASE,
        "label": parameter.label if parameter else "introductory example",
        "group": parameter.group if parameter else BASE,
        "from": ", ".join(_value(base, key) for key in keys),
        "to": ", ".join(_value(run, key) for key in keys),
        "status": summary["status"],
        "reason": summary.get("reason") or "",
        "reached_mm": float(history["sliding_distance_mm"].iloc[-1]) if len(history) else 0.0,
        **{key: float("nan") if summary[key] is None else float(summary[key]) for key in RESULTS},
    }


def _value(run: StudyRun, key: str) -> str:
    """Value of a key in a run; of a parameter file, which is not in its case, the name."""
    if key.endswith(".parameters"):
        named = run.study_case.overrides.get(key)
        return "none" if named is None else Path(str(named)).stem
    value = run[key]
    if isinstance(value, bool):
        return "on" if value else "off"
    return f"{value:g}" if isinstance(value, (int, float)) else str(value)
