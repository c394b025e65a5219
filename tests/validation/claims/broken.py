"""For every checkable claim, a change of the made-up evidence after which it does not hold."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from contact.friction import ExponentialFriction, HuemerFriction
from fem.results.result import Result
from materials.compounds import COMPOUNDS
from materials.hyperelastic import NeoHooke, Yeoh
from tests.validation.claims.made_up_evidence import (
    SIZE,
    MadeUpEvidence,
    scaled,
    slabs,
    with_hotter_face,
    with_snapshot,
    with_summary,
    with_surface,
)
from validation.claims.evidence import (
    EXPONENTIAL,
    HUEMER,
    LOAD,
    MOONEY_RIVLIN,
    VAN_DER_WAALS,
    YEOH,
)
from validation.paper.table4 import PAPER_N_PER_MM

Change = Callable[[MadeUpEvidence], None]


def _introductory(change: Callable[[Result], Result]) -> Change:
    def apply(evidence: MadeUpEvidence) -> None:
        evidence.introductory = change(evidence.introductory)

    return apply


def _remembering(change: Callable[[Result], Result]) -> Change:
    def apply(evidence: MadeUpEvidence) -> None:
        evidence.remembering = change(evidence.remembering)

    return apply


def _compound(name: str, change: Callable[[Result], Result]) -> Change:
    def apply(evidence: MadeUpEvidence) -> None:
        evidence.compounds[name] = change(evidence.compounds[name])

    return apply


def _compounds(change: Callable[[int, Result], Result]) -> Change:
    def apply(evidence: MadeUpEvidence) -> None:
        evidence.compounds = {
            name: change(i, run) for i, (name, run) in enumerate(evidence.compounds.items())
        }

    return apply


def _rubber(name: str, model: Any) -> Change:
    def apply(evidence: MadeUpEvidence) -> None:
        evidence.rubbers = {**evidence.rubbers, name: model}

    return apply


def _laws(exponential: Any, huemer: Any) -> Change:
    def apply(evidence: MadeUpEvidence) -> None:
        evidence.friction_laws = (exponential, huemer)

    return apply


def _points(change: Callable[[Any, str, Result], Result]) -> Change:
    def apply(evidence: MadeUpEvidence) -> None:
        evidence.pressures = {
            point: {law: change(point, law, run) for law, run in laws.items()}
            for point, laws in evidence.pressures.items()
        }

    return apply


def _velocities(law: str, change: Callable[[float, Result], Result]) -> Change:
    def apply(evidence: MadeUpEvidence) -> None:
        for v, laws in evidence.velocities.items():
            laws[law] = change(v, laws[law])

    return apply


def _warm_through(result: Result, rise: float = 22.0) -> Result:
    """As warm everywhere as at the surface."""
    T = result.snapshots[-1].temperature
    return with_snapshot(result, temperature=20.0 + rise + 0.0 * T)


def _softer_slabs(evidence: MadeUpEvidence) -> None:
    evidence.slabs = slabs(softer=0.3)


def _T_max(by_pressure: Callable[[Any], float]) -> Change:
    return _points(lambda point, law, run: with_summary(run, T_max_C=by_pressure(point)))


def _same_force_at_all_velocities(evidence: MadeUpEvidence) -> None:
    evidence.velocities = {
        v: {law: with_summary(run, friction_force_N_per_mm=4.5) for law, run in laws.items()}
        for v, laws in evidence.velocities.items()
    }


def _stress_follows(i: int, run: Result) -> Result:
    size = list(SIZE.values())[i]
    unit = run.snapshots[-1].cauchy_stress / abs(run.snapshots[-1].cauchy_stress).max()
    return with_snapshot(run, cauchy_stress=size * unit)


def _same_stress(_: int, run: Result) -> Result:
    stress = run.snapshots[-1].cauchy_stress
    return with_snapshot(run, cauchy_stress=stress / abs(stress[:, 1]).max())


def _flat_top(result: Result) -> Result:
    history = result.history.assign(max_contact_pressure_N_per_mm2=0.3)
    return replace(result, history=history)


def _peak_at_rear(result: Result) -> Result:
    return with_snapshot(result, cauchy_stress=result.snapshots[-1].cauchy_stress * 0.01)


def _lies_flat(result: Result) -> Result:
    up = result.snapshots[-1].displacement.copy()
    up[:, 1] = 0.0
    return with_snapshot(result, displacement=up)


def _in_full_contact(result: Result) -> Result:
    return with_surface(result, in_contact=True)


def _cold_edge(result: Result) -> Result:
    X = result.geometry.points[:, 0]
    T = np.where(X > 15.0, 20.0, result.snapshots[-1].temperature)
    surface = result.surface
    cold = np.where(surface["X_mm"] > 15.0, 20.0, surface["T_C"])
    result = with_surface(with_snapshot(result, temperature=T), T_C=cold)
    return with_summary(result, T_edge_C=20.0)


def _hotter(result: Result) -> Result:
    return with_surface(result, T_C=result.surface["T_C"] + 5.0)


def _turned_round(point: Any, law: str, run: Result) -> Result:
    if point.pressure < 0.2:
        return with_surface(run, T_C=run.surface["T_C"].to_numpy()[::-1])
    return run


BROKEN: dict[str, Change] = {
    # 2.1
    "bulk_may_be_elastic": _remembering(
        lambda r: replace(
            r,
            history=r.history.assign(
                friction_force_N_per_mm=1.5 * r.history["friction_force_N_per_mm"]
            ),
        )
    ),
    "damage_may_be_left_out": _remembering(lambda r: with_summary(r, T_max_C=0.0)),
    # 4.1
    "middle_is_in_plane_strain": _softer_slabs,
    # 4.2
    "mean_contact_pressure": _introductory(
        lambda r: with_summary(r, mean_contact_pressure_N_per_mm2=0.36)
    ),
    "pressure_concentration": _introductory(_flat_top),
    "edge_is_held_back": _introductory(_flat_top),
    "front_edge_curls": _introductory(_lies_flat),
    "front_edge_detaches": _introductory(_in_full_contact),
    "temperature_peak_at_edge": _introductory(_cold_edge),
    "stress_peak_at_edge": _introductory(_peak_at_rear),
    "heated_layer_is_thin": _introductory(_warm_through),
    "gradients_are_steep": _introductory(_warm_through),
    "diffusion_sets_the_depth": _velocities(EXPONENTIAL, lambda v, run: _warm_through(run)),
    "most_rubber_is_cold": _introductory(_warm_through),
    "constant_parameters_suffice": _introductory(_warm_through),
    # 5.1
    "stress_fields_alike": _compound(
        LOAD, lambda r: with_snapshot(r, cauchy_stress=-r.snapshots[-1].cauchy_stress)
    ),
    "highest_compression_varies": _compounds(_same_stress),
    "highest_tension_varies": _compounds(_same_stress),
    "compression_does_not_follow_stiffness": _compounds(_stress_follows),
    "tension_does_not_follow_stiffness": _compounds(_stress_follows),
    "van_der_waals_deforms_less": _compound(VAN_DER_WAALS[2], lambda r: scaled(r, 2.0)),
    "van_der_waals_is_less_stiff": _rubber(VAN_DER_WAALS[1], NeoHooke(G=1.5)),
    "series_2_deforms_more": _compound(VAN_DER_WAALS[2], lambda r: scaled(r, 0.5)),
    "series_2_stiffens_later": _rubber(YEOH[2], Yeoh(C10=0.345, C20=0.1, C30=0.1)),
    "late_upturn_is_the_reason": _rubber(YEOH[2], Yeoh(C10=0.3, C20=0.01)),
    "material_leaves_temperature_curve": _compound(MOONEY_RIVLIN, _hotter),
    "curves_follow_deformation": _compounds(lambda i, r: with_summary(r, A_T_K_mm=i % 3)),
    "material_leaves_T_max": _compound(LOAD, lambda r: with_summary(r, T_max_C=40.0)),
    "load_has_the_lowest_peak": _compound(LOAD, lambda r: with_hotter_face(r, 100.0)),
    "mooney_rivlin_does_not_stiffen": _rubber(MOONEY_RIVLIN, COMPOUNDS[LOAD]),
    "mooney_rivlin_deforms_differently": _compound(MOONEY_RIVLIN, lambda r: scaled(r, 2.1)),
    **{
        f"force_{name}": _compound(
            name, lambda r, force=printed: with_summary(r, friction_force_N_per_mm=0.9 * force)
        )
        for name, printed in PAPER_N_PER_MM.items()
    },
    "forces_are_similar": _compound(LOAD, lambda r: with_summary(r, friction_force_N_per_mm=6.0)),
    "order_of_forces": _compound(LOAD, lambda r: with_summary(r, friction_force_N_per_mm=4.3)),
    "forces_reflect_friction": _same_force_at_all_velocities,
    # 5.2
    "area_sees_the_shape": _compounds(lambda i, r: with_summary(r, A_T_K_mm=400.0)),
    "course_is_the_same": _points(_turned_round),
    "laws_give_similar_curves": _velocities(HUEMER, lambda v, run: _hotter(run)),
    "laws_give_similar_maxima": _points(
        lambda point, law, run: with_summary(
            run, T_max_C=run.summary["T_max_C"] + 3.0 * (law == HUEMER)
        )
    ),
    "trends_agree": _points(
        lambda point, law, run: with_summary(
            run, T_max_C=40.0 + (20.0 if law == HUEMER else -20.0) * point.pressure
        )
    ),
    "pressure_raises_T_max_when_fast": _T_max(lambda point: 50.0 - 10.0 * point.pressure),
    "pressure_matters_more_when_fast": _T_max(
        lambda point: 40.0 + 1000.0 * point.pressure / point.velocity
    ),
    "huemer_overestimates_more": _T_max(lambda point: 40.0),
    "pressure_lowers_T_max_at_50": _T_max(lambda point: 30.0 + 1.0 * point.pressure),
    "exponential_law_has_no_peak": _laws(HuemerFriction(), HuemerFriction()),
    "velocity_hardly_matters": _laws(ExponentialFriction(C=0.3), HuemerFriction()),
    # 6
    "coupling_matters": lambda evidence: setattr(evidence, "with_changes", evidence.introductory),
    "material_decides_deformation": _compounds(
        lambda i, r: scaled(r, 1.0 / list(SIZE.values())[i])
    ),
    "lack_of_stiffening_is_the_reason": lambda evidence: setattr(
        evidence, "with_changes", evidence.compounds[LOAD]
    ),
    "material_affects_stability": _compounds(lambda i, r: with_summary(r, newton_iterations=500)),
    "test_data_matter": _compounds(
        lambda i, r: scaled(r, 0.2) if list(SIZE)[i] in VAN_DER_WAALS.values() else r
    ),
    "tests_must_cover_the_strain": _compounds(
        lambda i, r: with_snapshot(r, stretch=1.1 + 0.0 * r.snapshots[-1].stretch)
    ),
    "law_leaves_heat": _points(
        lambda point, law, run: with_summary(run, A_T_K_mm=300.0 + 100.0 * (law == HUEMER))
    ),
    "law_leaves_mechanics": _velocities(HUEMER, lambda v, run: scaled(run, 1.3)),
}
