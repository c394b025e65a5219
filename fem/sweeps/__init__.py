"""Studies and sweeps: many cases, in parallel, resumable."""

from fem.sweeps.case import RUNS_FOLDER
from fem.sweeps.progress import SweepBar, SweepProgress, closing_line
from fem.sweeps.runs import (
    StudyError,
    StudyRun,
    read_run,
    simulate_missing,
    study_runs,
)
from fem.sweeps.study import StudyCase, read_study
from fem.sweeps.sweep import sweep
from fem.sweeps.workers import SchedulerLostError

__all__ = [
    "RUNS_FOLDER",
    "SchedulerLostError",
    "StudyCase",
    "StudyError",
    "StudyRun",
    "SweepBar",
    "SweepProgress",
    "closing_line",
    "read_run",
    "read_study",
    "simulate_missing",
    "study_runs",
    "sweep",
]
