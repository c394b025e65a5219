"""What the claims are judged by: runs, gathered when first asked for, and the laws themselves."""

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from contact.friction import ExponentialFriction, HuemerFriction
from fem.results import Result
from fem.sweeps import StudyRun
from materials.compounds import COMPOUNDS
from materials.hyperelastic import Hyperelastic
from validation.drawing import reached
from validation.paper import introductory_run
from validation.slab import TABLE as SLABS
from validation.studies import runs_of

EXPONENTIAL, HUEMER = "exponential", "huemer"
LAWS = (EXPONENTIAL, HUEMER)
MOONEY_RIVLIN, LOAD = "mooney-rivlin-dumbbells", "yeoh-bars-series-1-load"
YEOH = {1: "yeoh-bars-series-1", 2: "yeoh-bars-series-2"}
VAN_DER_WAALS = {1: "van-der-waals-bars-series-1", 2: "van-der-waals-bars-series-2"}


class UnfinishedError(Exception):
    """A run that a claim needs did not get to its end."""


class Point(NamedTuple):
    """A point of the paper's Fig. 12: compound, mean pressure on top [N/mm^2], speed [mm/s]."""

    compound: str
    pressure: float
    velocity: float


class Evidence:
    """Runs of the paper's studies in a folder; what is missing is simulated when it is asked for.

    Parameters
    ----------
    directory : str or Path
        Folder of figures and tables; runs are in ``runs`` inside it.

    Notes
    -----
    Every run that is handed out has reached its end. Otherwise `UnfinishedError` says which did
    not, since numbers of different sliding distances must not be compared.
    """

    def __init__(self, directory: str | Path) -> None:
        self.directory = Path(directory)

    @cached_property
    def introductory(self) -> Result:
        """The example of section 4.2."""
        return finished(introductory_run(self.directory), "the introductory example")

    @cached_property
    def compounds(self) -> dict[str, Result]:
        """The introductory example with each parameter set of Table 1, by name."""
        return {run["rubber.compound"]: _result(run) for run in self._study("compounds")}

    @cached_property
    def velocities(self) -> dict[float, dict[str, Result]]:
        """Runs of Fig. 11 by velocity [mm/s] and friction law."""
        found: dict[float, dict[str, Result]] = {}
        for run in self._study("velocities"):
            velocity, law = run["loading.velocity_mm_per_s"], run["friction.law"]
            found.setdefault(velocity, {})[law] = _result(run)
        return dict(sorted(found.items()))

    @cached_property
    def pressures(self) -> dict[Point, dict[str, Result]]:
        """Runs of Fig. 12 by compound, pressure and velocity, and friction law."""
        found: dict[Point, dict[str, Result]] = {}
        for run in self._study("pressures"):
            pressure = run["loading.mean_pressure_N_per_mm2"]
            point = Point(run["rubber.compound"], pressure, run["loading.velocity_mm_per_s"])
            found.setdefault(point, {})[run["friction.law"]] = _result(run)
        return dict(sorted(found.items()))

    @cached_property
    def slabs(self) -> pd.DataFrame:
        """Slabs against plane strain, the committed table of ``make slab``."""
        return pd.read_csv(SLABS)

    def changed(self, overrides: Mapping[str, Any]) -> Result:
        """The introductory example with other case keys, out of the ledger's own study."""
        for run in self._own_runs:
            if run.study_case.overrides == dict(overrides):
                return _result(run)
        raise ValueError(f"studies/claims.toml has no case {dict(overrides)}")

    @cached_property
    def friction_laws(self) -> tuple[ExponentialFriction, HuemerFriction]:
        """Both laws with the parameters of Table 2."""
        return ExponentialFriction(), HuemerFriction()

    @cached_property
    def rubbers(self) -> Mapping[str, Hyperelastic]:
        """The models of Table 1 by name."""
        return COMPOUNDS

    @cached_property
    def _own_runs(self) -> list[StudyRun]:
        return self._study("claims")

    def _study(self, name: str) -> list[StudyRun]:
        return runs_of(name, self.directory)


def finished(result: Result, name: str) -> Result:
    """The result itself if it reached its end."""
    if result.summary["status"] != "ok":
        reason = result.summary.get("reason") or result.summary["status"]
        raise UnfinishedError(f"{name}{reached(result)}: {reason}")
    return result


def _result(run: StudyRun) -> Result:
    return finished(run.result, f"the run {run.study_case.name}")
