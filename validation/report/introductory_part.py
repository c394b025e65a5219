"""The introductory example in the report: its results, its picture, and who computed it."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fem.case import Case
from fem.results import RunFolder
from validation.paper import introductory_case

#: Results that are shown: key of the summary to its name, unit and format.
SHOWN = {
    "T_max_C": ("highest temperature T_max", "°C", ".2f"),
    "A_T_K_mm": ("area A_T under the temperature curve", "K mm", ".1f"),
    "friction_force_N_per_mm": ("friction force per depth", "N/mm", ".3f"),
    "friction_coefficient": ("friction coefficient", "", ".3f"),
    "contact_length_mm": ("contact length", "mm", ".2f"),
    "mean_contact_pressure_N_per_mm2": ("mean contact pressure", "N/mm²", ".3f"),
    "T_edge_C": ("temperature peak at the front edge", "°C", ".2f"),
    "energy_error": ("energy error", "", ".2%"),
    "heat_error": ("heat error", "", ".1e"),
    "regularisation_share": ("share of the regularisation in the work", "", ".2%"),
    "capped_heat_share": ("share of the heat where eq. (14) is capped", "", ".1%"),
    "elements": ("elements", "", "d"),
    "steps": ("steps", "", "d"),
    "wall_s": ("computing time", "s", ".1f"),
}
#: How many of them stand at the top of the page.
HEADLINES = 6


@dataclass(frozen=True, kw_only=True)
class IntroductoryRun:
    """Results of the introductory example, each with name, value and unit.

    `status` has the reason if it is not "ok"; `program` is "unknown" if the run does not say.
    """

    results: tuple[tuple[str, str, str], ...]
    status: str
    program: str

    @property
    def headlines(self) -> tuple[tuple[str, str, str], ...]:
        """The results an engineer asks for first."""
        return self.results[:HEADLINES]


def find_introductory(directory: Path, program: str) -> IntroductoryRun | None:
    """Look for the run beside a folder of figures (`make run`) and inside it.

    One that was computed by `program` is preferred, as figure 8 prefers it.
    """
    case = introductory_case()
    folders = (directory.parent / "run", directory / "runs" / "introductory")
    found = [run for folder in folders if (run := _read(folder, case)) is not None]
    return min(found, key=lambda run: run.program != program, default=None)


def _read(folder: Path, case: Case) -> IntroductoryRun | None:
    """Results of a run of the case by whatever program; None if there is none."""
    summary = RunFolder(folder, case).of_case()
    if summary is None:
        return None
    return IntroductoryRun(
        results=tuple(_result(summary, key) for key in SHOWN),
        status=": ".join(filter(None, [summary["status"], summary.get("reason")])),
        program=str(summary.get("program_version", "unknown")),
    )


def _result(summary: dict[str, Any], key: str) -> tuple[str, str, str]:
    name, unit, form = SHOWN[key]
    value = summary.get(key)
    try:
        return name, "-" if value is None else format(value, form), unit
    except ValueError:  # a number of another kind, in a file that was edited
        return name, str(value), unit
