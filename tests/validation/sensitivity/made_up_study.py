"""Made-up runs of the sensitivity study: the real cases, invented results."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from fem.sweeps.runs import StudyRun
from tests.made_up_result import made_up_result
from validation.sensitivity.write import STUDY
from validation.studies import cases_of

BASE = {"T_max_C": 48.0, "A_T_K_mm": 400.0, "friction_force_N_per_mm": 4.5}


def made_up_study(changes: Mapping[str, Mapping[str, Any]] | None = None) -> list[StudyRun]:
    """Runs of the study with `BASE` as their results, changed by the name of the run's folder."""
    runs = []
    for study_case in cases_of(STUDY):
        result = made_up_result()
        summary = result.summary | BASE | (changes or {}).get(study_case.name, {})
        result = replace(result, case=study_case.case, summary=summary)
        runs.append(StudyRun(study_case=study_case, result=result))
    return runs
