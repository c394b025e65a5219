"""Study files of the paper's figures and tables."""

from pathlib import Path

from fem.sweeps import StudyCase, read_study

STUDIES = Path(__file__).parent
#: Case files that a study file may name as its base.
BASES = {"introductory": STUDIES / "introductory.toml"}


def cases_of(study: str) -> list[StudyCase]:
    """Cases of one of the studies here, e.g. ``compounds``."""
    return read_study(STUDIES / f"{study}.toml", BASES).cases()
