"""Study files of the paper's figures and tables."""

from pathlib import Path

from fem.sweeps import StudyCase, StudyRun, read_study, study_runs

STUDIES = Path(__file__).parent
#: Case files that a study file may name as its base.
BASES = {"introductory": STUDIES / "introductory.toml"}


def cases_of(study: str) -> list[StudyCase]:
    """Cases of one of the studies here, e.g. ``compounds``."""
    return read_study(STUDIES / f"{study}.toml", BASES).cases()


def runs_of(study: str, directory: str | Path) -> list[StudyRun]:
    """Runs of one of the studies in a folder; what is missing there is simulated first."""
    return study_runs(cases_of(study), directory)
