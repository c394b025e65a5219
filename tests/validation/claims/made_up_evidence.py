"""Made-up evidence in which every checkable claim of the paper holds. Nothing in it is computed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fem.results.result import Result
from materials.compounds import COMPOUNDS
from materials.hyperelastic import Yeoh
from tests.made_up_result import made_up_result
from validation.claims.evidence import (
    LAWS,
    LOAD,
    MOONEY_RIVLIN,
    VAN_DER_WAALS,
    YEOH,
    Evidence,
    Point,
)
from validation.paper.table4 import PAPER_N_PER_MM

#: Size of the deformation, T_max and stress of each parameter set, as the paper describes them.
SIZE = {
    VAN_DER_WAALS[1]: 0.95,
    VAN_DER_WAALS[2]: 1.15,
    YEOH[1]: 1.0,
    YEOH[2]: 1.2,
    LOAD: 1.05,
    MOONEY_RIVLIN: 0.5,
}
T_MAX = dict(zip(SIZE, (45.4, 45.2, 45.3, 45.1, 44.6, 45.6), strict=True))
STRESS = dict(zip(SIZE, (1.4, 0.8, 1.0, 1.2, 0.9, 1.1), strict=True))
ITERATIONS = dict(zip(SIZE, (500, 520, 560, 600, 580, 700), strict=True))
COMPOUNDS_OF_FIG_12 = (LOAD, VAN_DER_WAALS[1])


class MadeUpEvidence(Evidence):
    """Evidence that is given, not gathered."""

    def __init__(self) -> None:
        super().__init__(Path("nowhere"))
        self.with_changes: Result
        self.remembering: Result

    def changed(self, overrides: Mapping[str, Any]) -> Result:
        """The same run for whatever is changed, but that of rubber that remembers."""
        return self.remembering if "rubber.parameters" in overrides else self.with_changes


def paper_like_evidence() -> MadeUpEvidence:
    """Evidence as the paper describes its own results."""
    base = curled(made_up_result())
    evidence = MadeUpEvidence()
    evidence.introductory = with_summary(base, mean_contact_pressure_N_per_mm2=0.3)
    evidence.remembering = evidence.introductory
    evidence.compounds = {name: of_compound(base, name) for name in SIZE}
    evidence.velocities = {v: of_velocity(base, v) for v in (7.0, 50.0, 300.0)}
    evidence.pressures = {
        Point(compound, p, v): of_point(base, v, p)
        for compound in COMPOUNDS_OF_FIG_12
        for p in (0.17, 0.25, 0.33)
        for v in (7.0, 50.0, 300.0)
    }
    hotter = with_summary(base, T_max_C=base.summary["T_max_C"] + 3.0)
    evidence.with_changes = scaled(hotter, SIZE[MOONEY_RIVLIN] + 0.05)
    evidence.rubbers = {**COMPOUNDS, **made_up_rubbers()}
    evidence.slabs = slabs()
    return evidence


def slabs(softer: float = 0.05) -> pd.DataFrame:
    """Slabs of three depths that are a little softer than plane strain."""
    return pd.DataFrame(
        {
            "depth_over_height": [1.0, 5.0, 20.0],
            "force_at_2_mm": 1.0,
            "middle_platen_at_equal_load": 1.0 + softer,
            "platen_pressed": 1.0 + softer,
            "depth_strain_share_pressed": 0.02,
            "depth_strain_share_slid": 0.03,
        }
    )


def made_up_rubbers() -> dict[str, Yeoh]:
    """Sets of which series 2 turns up later, and the ones called van der Waals are softer."""
    series = {1: {"C20": 0.0, "C30": 0.013}, 2: {"C20": -0.02, "C30": 0.0019}}
    stiffness = {YEOH[1]: 0.350, YEOH[2]: 0.345, VAN_DER_WAALS[1]: 0.330, VAN_DER_WAALS[2]: 0.325}
    return {
        names[i]: Yeoh(C10=stiffness[names[i]], **series[i])
        for names in (YEOH, VAN_DER_WAALS)
        for i in (1, 2)
    }


def curled(result: Result) -> Result:
    """With the lowest part of the leading face on the road, and a bulging stress at its corner."""
    snapshot, points = result.snapshots[-1], result.geometry.points
    displacement = snapshot.displacement.copy()
    rolled = np.isclose(points[:, 0], points[:, 0].max()) & (points[:, 1] < 0.6)
    displacement[rolled, 1] = -points[rolled, 1]
    place = points[result.geometry.cells].mean(axis=1)
    stress = snapshot.cauchy_stress.copy()
    stress[:, 1] -= 6.0 * np.exp(-((20.0 - place[:, 0]) ** 2) / 0.1 - place[:, 1] ** 2 / 0.01)
    return with_snapshot(result, displacement=displacement, cauchy_stress=stress)


def of_compound(base: Result, name: str) -> Result:
    """A parameter set with its own deformation, stress, force and place where contact begins."""
    run = scaled(base, SIZE[name])
    stress = run.snapshots[-1].cauchy_stress * STRESS[name]
    run = with_snapshot(run, cauchy_stress=stress, stretch=1.0 + SIZE[name] * np.ones(len(stress)))
    if name != "yeoh-bars-series-1-load":
        run = with_hotter_face(run, 20.0)
    X = run.surface["X_mm"]
    run = with_surface(run, T_C=run.surface["T_C"] + 10.0 * SIZE[name] * (np.abs(X - 3.0) < 0.3))
    return with_summary(
        run,
        T_max_C=T_MAX[name],
        A_T_K_mm=300.0 + 100.0 * SIZE[name],
        friction_force_N_per_mm=PAPER_N_PER_MM[name],
        newton_iterations=ITERATIONS[name],
        mean_contact_pressure_N_per_mm2=3.0,
    )


def of_velocity(base: Result, velocity: float) -> dict[str, Result]:
    """Both laws at a velocity, with a layer that grows as the square root of time."""
    depth = 0.2 * np.sqrt(300.0 / velocity)
    Y = base.geometry.points[:, 1]
    T = 20.0 + (base.snapshots[-1].temperature - 20.0) * np.exp(Y / 0.2 - Y / depth)
    run = with_snapshot(at(base, velocity), temperature=T)
    force = {7.0: 3.5, 50.0: 4.2, 300.0: 4.5}[velocity]
    return {
        law: with_summary(run, friction_force_N_per_mm=force * factor)
        for law, factor in zip(LAWS, (1.0, 1.05), strict=True)
    }


def of_point(base: Result, velocity: float, pressure: float) -> dict[str, Result]:
    """Both laws at a point of Fig. 12, with the paper's trends."""
    slope = {7.0: 0.0, 50.0: -4.0, 300.0: 30.0}[velocity]
    T = 20.0 + 1.4 * velocity**0.5 + slope * (pressure - 0.25)
    return {
        law: with_summary(base, T_max_C=T + higher)
        for law, higher in zip(LAWS, (0.0, 0.4), strict=True)
    }


def at(result: Result, velocity: float) -> Result:
    """The same result as that of another velocity."""
    return replace(result, case=result.case.with_overrides({"loading.velocity_mm_per_s": velocity}))


def scaled(result: Result, factor: float) -> Result:
    """The same result with its displacement multiplied."""
    return with_snapshot(result, displacement=factor * result.snapshots[-1].displacement)


def with_hotter_face(result: Result, by: float) -> Result:
    """The same result with its leading face hotter, from the road up to the platen."""
    X = result.geometry.points[:, 0]
    face = np.isclose(X, X.max())
    hotter = with_snapshot(result, temperature=result.snapshots[-1].temperature + by * face)
    return with_summary(hotter, T_edge_C=result.summary["T_edge_C"] + by)


def with_summary(result: Result, **values: Any) -> Result:
    """The same result with other numbers in its summary."""
    return replace(result, summary=result.summary | values)


def with_surface(result: Result, **columns: Any) -> Result:
    """The same result with other columns of its bottom surface."""
    return replace(result, surface=result.surface.assign(**columns))


def with_snapshot(result: Result, **fields: Any) -> Result:
    """The same result with other fields in its last state."""
    return replace(result, snapshots=[replace(result.snapshots[-1], **fields)])
