"""The paper's introductory example (section 4.2) and where its run lies."""

from __future__ import annotations

from pathlib import Path

from fem.case import Case
from fem.results import SUMMARY_JSON, Result
from fem.simulate import simulate

#: Section 4.2: 300 mm/s, 0.25 N/mm^2 on the top, 120 mm, "Yeoh, bars, series 1, load", Huemer's
#: law; everything else is at the defaults of a case file.
INTRODUCTORY = {
    "rubber": {"compound": "yeoh-bars-series-1-load"},
    "friction": {"law": "huemer"},
    "loading": {
        "mean_pressure_N_per_mm2": 0.25,
        "velocity_mm_per_s": 300.0,
        "distance_mm": 120.0,
    },
}


def introductory_case() -> Case:
    """The introductory example as a case."""
    return Case.from_dict(INTRODUCTORY, source="introductory example")


def introductory_run(directory: str | Path) -> Result:
    """Read the introductory run that belongs to a folder of figures; simulate it if there is none.

    `make run` and `treadfem run` leave it in `run` beside the folder; otherwise it is simulated
    once into `runs/introductory` inside the folder.
    """
    directory = Path(directory)
    own = directory / "runs" / "introductory"
    case = introductory_case()
    for folder in (directory.parent / "run", own):
        if (folder / SUMMARY_JSON).is_file() and _same_physics(folder, case):
            return Result.read(folder)
    simulate(case).write(own)
    return Result.read(own)


def _same_physics(folder: Path, case: Case) -> bool:
    """Whether the folder holds this case; what it writes besides the last state does not matter."""
    found = Case.from_toml(folder / "case.toml")
    return found.output.vtu and found == case.with_overrides(
        {f"output.{key}": value for key, value in found.to_dict()["output"].items()}
    )
