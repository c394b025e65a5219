"""A made-up run of a study."""

from __future__ import annotations

from fem.case.case import Case
from fem.results.result import Result
from fem.sweeps.runs import StudyRun
from fem.sweeps.study import StudyCase
from tests.made_up_result import made_up_result


def made_up_run(**overrides: object) -> StudyRun:
    """A run that says it is of the given case keys; the fields are made up."""
    keys = {key.replace("__", "."): value for key, value in overrides.items()}
    base = {
        "loading": {
            "mean_pressure_N_per_mm2": 0.25,
            "velocity_mm_per_s": 300.0,
            "distance_mm": 120.0,
        }
    }
    case = Case.from_dict(base, overrides=keys)
    result = made_up_result()
    summary = result.summary | {
        "mean_contact_pressure_N_per_mm2": 1.2 * case.loading.mean_pressure_N_per_mm2,
        "T_max_C": 20.0 + 1.4 * case.loading.velocity_mm_per_s**0.5,
    }
    result = Result.from_rows(
        case,
        result.geometry,
        result.history.to_dict("records"),
        result.boundary,
        summary,
        result.snapshots,
    )
    return StudyRun(study_case=StudyCase(name="made-up", overrides=keys, case=case), result=result)
