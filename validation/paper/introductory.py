"""The paper's introductory example (section 4.2) and where its run lies."""

from pathlib import Path

from fem.case import Case
from fem.results import Result, RunFolder
from fem.sweeps import read_run, simulate_missing
from validation.studies import BASES


def introductory_case() -> Case:
    """The introductory example as a case."""
    return Case.from_toml(BASES["introductory"])


def introductory_run(directory: str | Path) -> Result:
    """Read the introductory run that belongs to a folder of figures; simulate it if there is none.

    `make run` leaves it in `run` beside the folder; otherwise it is simulated once into
    `runs/introductory` inside the folder.
    """
    directory = Path(directory)
    own = directory.absolute() / "runs" / "introductory"
    case = introductory_case()
    beside = directory.parent / "run"
    if RunFolder(beside, case).finished() is not None:
        return read_run(beside)
    simulate_missing({own: case})
    return read_run(own)
