"""Claims of section 5.2: influence of the friction law on the temperature."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import numpy as np

from fem.results.result import Result
from validation.claims import experiments
from validation.claims.claim import Claim, Finding, claim, unchecked
from validation.claims.evidence import EXPONENTIAL, HUEMER, LAWS, Evidence, Point
from validation.claims.paper_numbers import ACCEPTED_K, MEASURED_TO_K, relative_range
from validation.claims.warmth import (
    difference_words,
    mean_difference,
    middle_temperature,
    pressure_at_peak,
    profiles,
    rise,
    start_temperature,
)
from validation.drawing.compound_names import COMPOUND_LOOKS

_CURVES = "The measured values are drawn in Figs. 11 and 12 only, which are not in the text."
#: Change of a friction coefficient per relative change of velocity that is called very low: an
#: order of magnitude less than proportional.
VERY_LOW = 0.1


@claim(
    section="5.2",
    says="Abrasion and test conditions disturb the peak at the front edge more than T_max.",
    computed="-",
)
def edge_peak_is_disturbed_more(evidence: Evidence) -> Finding:
    return unchecked("Abrasion is not modelled, and the scatter between the tests is not printed.")


@claim(
    section="5.2",
    says="A_T depends strongly on the shape of the temperature distribution.",
    computed="range over the six sets of Table 1, relative to the mean, of A_T and of the rise to "
    "T_max; the sets change the distribution, hardly its maximum",
)
def area_sees_the_shape(evidence: Evidence) -> Finding:
    runs = list(evidence.compounds.values())
    area = relative_range([float(run.summary["A_T_K_mm"]) for run in runs])
    top = relative_range([rise(run) for run in runs])
    return Finding(
        ours=f"{100 * area:.1f} % in A_T, {100 * top:.1f} % in the rise to T_max",
        values={"range_of_A_T": area, "range_of_rise": top},
        criterion="larger in A_T than in the maximum",
        holds=area > top,
        explanation="" if area > top else "A_T varies no more than the maximum does.",
    )


@claim(
    section="5.2",
    says="Other compounds or pressures do not change the course of the temperature fundamentally.",
    computed="correlation of the curves of each pair of runs at the same velocity, over two "
    "compounds, three pressures and both laws",
)
def course_is_the_same(evidence: Evidence) -> Finding:
    lowest = 1.0
    for velocity in sorted({point.velocity for point in evidence.pressures}):
        runs = [
            run
            for point, laws in evidence.pressures.items()
            if point.velocity == velocity
            for run in laws.values()
        ]
        lowest = min(lowest, float(np.corrcoef(profiles(runs)).min()))
    return Finding(
        ours=f"at least {lowest:.2f}",
        values={"lowest_correlation": lowest},
        criterion="nearer to 1 (same course) than to 0: above 0.5",
        holds=lowest > 0.5,
        explanation="" if lowest > 0.5 else "Two runs have curves of different course.",
    )


@claim(
    section="5.2",
    says="Both friction laws give very similar temperature distributions at all three velocities.",
    computed="difference of the two curves, mean over the bottom surface, at each velocity",
)
def laws_give_similar_curves(evidence: Evidence) -> Finding:
    found = {
        v: mean_difference(laws[EXPONENTIAL], laws[HUEMER])
        for v, laws in evidence.velocities.items()
    }
    worst, limit = max(found, key=found.__getitem__), ACCEPTED_K
    most = found[worst]
    return Finding(
        ours=", ".join(f"{value:.2f} K at {v:g} mm/s" for v, value in found.items()),
        values={f"mean_difference_at_{v:g}_mm_per_s_K": value for v, value in found.items()},
        criterion=f"at most {limit:g} K each, the deviation that this section accepts",
        holds=most <= limit,
        explanation=_measurable(found)
        if most <= limit
        else f"At {worst:g} mm/s the laws differ by more; T_max itself by "
        f"{abs(_gap(evidence.velocities[worst])):.2f} K.",
        experiment=""
        if most <= limit
        else difference_words(*(evidence.velocities[worst][law] for law in (HUEMER, EXPONENTIAL)))
        + f" {_coefficients(evidence)}",
    )


@claim(
    section="5.2",
    says="The relative error of T_max is largest at 7 mm/s.",
    computed="-",
)
def relative_error_is_largest_at_7(evidence: Evidence) -> Finding:
    return unchecked(_CURVES)


@claim(
    section="5.2",
    says="The absolute error of T_max rarely exceeds 1.5 to 2 °C at any velocity.",
    computed="-",
)
def error_bound_of_T_max(evidence: Evidence) -> Finding:
    return unchecked(_CURVES + " With measured curves at hand, `treadfem compare` tells.")


@claim(
    section="5.2",
    says="The measured temperatures are good to 0.5 to 1 °C.",
    computed="-",
)
def accuracy_of_the_measurements(evidence: Evidence) -> Finding:
    return unchecked("A statement about the paper's pyrometer, of which no data are printed.")


@claim(
    section="5.2",
    says="Computed and measured T_max and A_T agree very well with both laws.",
    computed="-",
)
def agreement_with_measurements(evidence: Evidence) -> Finding:
    return unchecked(_CURVES)


@claim(
    section="5.2",
    says="The results of the two laws differ surprisingly little.",
    computed="largest difference of T_max between the laws over two compounds, three pressures and "
    "three velocities",
)
def laws_give_similar_maxima(evidence: Evidence) -> Finding:
    gaps = {point: _gap(laws) for point, laws in evidence.pressures.items()}
    where, most = max(gaps.items(), key=lambda item: abs(item[1]))
    holds = abs(most) <= ACCEPTED_K
    return Finding(
        ours=f"{abs(most):.2f} K ({_words(where)}), "
        f"{np.mean([abs(gap) for gap in gaps.values()]):.2f} K in the mean",
        values={"largest_difference_K": abs(most)},
        criterion=f"at most {ACCEPTED_K:g} K, the deviation from tests that the paper accepts",
        holds=holds,
        explanation="" if holds else f"The laws part most with {_words(where)}.",
        experiment="" if holds else _coefficients(evidence),
    )


@claim(
    section="5.2",
    says="T_max follows compound, velocity and pressure in the same way with both laws.",
    computed="differences of T_max between cases that differ in one of the three, with each law",
)
def trends_agree(evidence: Evidence) -> Finding:
    limit = MEASURED_TO_K[0]
    pairs = list(_neighbours(evidence))
    against = [
        (one, other) for one, other, (a, b) in pairs if a * b < 0.0 and min(abs(a), abs(b)) > limit
    ]
    holds = not against
    return Finding(
        ours=f"{len(against)} of {len(pairs)} differences have opposite signs",
        values={"opposite": float(len(against)), "compared": float(len(pairs))},
        criterion=f"none, if differences below {limit:g} K (not measurable) count as none",
        holds=holds,
        explanation=""
        if holds
        else "Opposite: " + "; ".join(f"{_words(a)} to {_words(b)}" for a, b in against[:3]) + ".",
    )


@claim(
    section="5.2",
    says="At high velocity the computed T_max grows with pressure.",
    computed="T_max at the highest less T_max at the lowest pressure, at 300 mm/s",
)
def pressure_raises_T_max_when_fast(evidence: Evidence) -> Finding:
    changes = _pressure_changes(evidence, 300.0)
    holds = min(changes.values()) > 0.0
    return Finding(
        ours=_change_words(changes),
        values=changes,
        criterion="above 0 for both compounds and laws",
        holds=holds,
        explanation="" if holds else _pressure_reason(evidence, 300.0),
        experiment="" if holds else _heat_flux_words(evidence),
    )


@claim(
    section="5.2",
    says="The pressure matters more at high velocity than at low ones.",
    computed="size of the change of T_max from the lowest to the highest pressure at each "
    "velocity, mean over compounds and laws",
)
def pressure_matters_more_when_fast(evidence: Evidence) -> Finding:
    velocities = sorted({point.velocity for point in evidence.pressures})
    sizes = {
        v: float(np.mean([abs(c) for c in _pressure_changes(evidence, v).values()]))
        for v in velocities
    }
    fastest = sizes[velocities[-1]]
    holds = all(fastest > sizes[v] for v in velocities[:-1])
    return Finding(
        ours=", ".join(f"{size:.2f} K at {v:g} mm/s" for v, size in sizes.items()),
        values={f"change_at_{v:g}_mm_per_s_K": size for v, size in sizes.items()},
        criterion="largest at the highest velocity",
        holds=holds,
        explanation="" if holds else "The pressure changes T_max more at a lower velocity.",
        experiment="" if holds else _heat_flux_words(evidence),
    )


@claim(
    section="5.2",
    says="At high velocity the pressure dependence is stronger in the simulations than in the "
    "tests, so that T_max is overestimated at 0.4 N/mm².",
    computed="-",
)
def overestimated_at_high_pressure(evidence: Evidence) -> Finding:
    return unchecked(_CURVES)


@claim(
    section="5.2",
    says="At 0.4 N/mm² and high velocity Huemer's law overestimates T_max more than the "
    "exponential one.",
    computed="T_max with Huemer's law less T_max with the exponential law at 300 mm/s and the "
    "highest pressure; the measured value is the same for both",
)
def huemer_overestimates_more(evidence: Evidence) -> Finding:
    highest = max(point.pressure for point in evidence.pressures)
    gaps = {
        point.compound: _gap(laws)
        for point, laws in evidence.pressures.items()
        if point.pressure == highest and point.velocity == 300.0
    }
    holds = min(gaps.values()) > 0.0
    return Finding(
        ours=", ".join(f"{gap:+.2f} K ({COMPOUND_LOOKS[c].label})" for c, gap in gaps.items()),
        values={f"difference_{c}_K": gap for c, gap in gaps.items()},
        criterion="above 0 for both compounds",
        holds=holds,
        explanation="" if holds else "The exponential law gives the higher temperature.",
        experiment="" if holds else _coefficients(evidence),
    )


@claim(
    section="5.2",
    says="In the tests at low velocity T_max hardly depends on pressure.",
    computed="-",
)
def tests_show_no_pressure_when_slow(evidence: Evidence) -> Finding:
    return unchecked(_CURVES)


@claim(
    section="5.2",
    says="At 50 mm/s the computed T_max falls slightly with pressure, with both laws.",
    computed="T_max at the highest less T_max at the lowest pressure, at 50 mm/s",
)
def pressure_lowers_T_max_at_50(evidence: Evidence) -> Finding:
    changes = _pressure_changes(evidence, 50.0)
    holds = all(-ACCEPTED_K < change < 0.0 for change in changes.values())
    return Finding(
        ours=_change_words(changes),
        values=changes,
        criterion="below 0 for both compounds and laws, and slight: by less than "
        f"{ACCEPTED_K:g} K, which the paper accepts as deviation",
        holds=holds,
        explanation="" if holds else _pressure_reason(evidence, 50.0),
        experiment="" if holds else _elsewhere_words(evidence, 50.0),
    )


@claim(
    section="5.2",
    says="A_T deviates from the tests more than T_max does.",
    computed="-",
)
def area_deviates_more(evidence: Evidence) -> Finding:
    return unchecked(_CURVES)


@claim(
    section="5.2",
    says="The exponential law does not have the measured peak of friction at low velocity.",
    computed="velocity of the highest coefficient between 1 and 1000 mm/s at 0.3 N/mm²",
)
def exponential_law_has_no_peak(evidence: Evidence) -> Finding:
    exponential, huemer = (_peak_velocity(law) for law in evidence.friction_laws)
    inside = 1.0 < huemer < 1000.0
    none = not 1.0 < exponential < 1000.0
    return Finding(
        ours=f"Huemer's law peaks at {huemer:.1f} mm/s, the exponential law at the end of the "
        f"range, {exponential:.0f} mm/s"
        if none
        else f"Huemer's law: {huemer:.1f} mm/s, exponential law: {exponential:.1f} mm/s",
        values={"huemer_mm_per_s": huemer, "exponential_mm_per_s": exponential},
        criterion="inside the range for Huemer's law only",
        holds=inside and none,
        explanation="" if inside and none else "The peaks are not where the paper has them.",
    )


@claim(
    section="5.2",
    says="The friction of this compound depends very little on velocity.",
    computed="change of the coefficient from 7 to 300 mm/s at 0.3 N/mm², as d ln(mu)/d ln(v), "
    "largest in that range",
)
def velocity_hardly_matters(evidence: Evidence) -> Finding:
    v = np.geomspace(7.0, 300.0, 401)
    slopes = {
        name: float(np.abs(np.gradient(np.log(law.coefficient(0.3, v)), np.log(v))).max())
        for name, law in zip(LAWS, evidence.friction_laws, strict=True)
    }
    holds = max(slopes.values()) < VERY_LOW
    return Finding(
        ours=", ".join(f"{slope:.3f} ({name})" for name, slope in slopes.items()),
        values={f"slope_{name}": slope for name, slope in slopes.items()},
        criterion=f"below {VERY_LOW:g}, an order of magnitude less than proportional",
        holds=holds,
        explanation="" if holds else "The coefficient depends on velocity more than that.",
    )


@claim(
    section="5.2",
    says="With a compound of pronounced velocity dependence the exponential law would fail.",
    computed="-",
)
def exponential_law_would_fail(evidence: Evidence) -> Finding:
    return unchecked("Friction parameters are printed for one compound only (Table 2).")


def _measurable(found: dict[float, float]) -> str:
    """At which velocities a difference, although accepted, could have been measured."""
    limit = MEASURED_TO_K[1]
    beyond = [f"{v:g} mm/s" for v, value in found.items() if value > limit]
    if not beyond:
        return ""
    return (
        f"With {limit:g} K, to which the paper could measure, as the limit, it would differ at "
        f"{', '.join(beyond)}."
    )


def _gap(laws: dict[str, Result]) -> float:
    """T_max with Huemer's law less T_max with the exponential one [K]."""
    return float(laws[HUEMER].summary["T_max_C"]) - float(laws[EXPONENTIAL].summary["T_max_C"])


def _neighbours(evidence: Evidence) -> Iterator[tuple[Point, Point, tuple[float, float]]]:
    """Pairs of points that differ in one thing, with the difference of T_max for each law [K]."""
    for one, other in combinations(evidence.pressures, 2):
        if sum(a != b for a, b in zip(one, other, strict=True)) == 1:
            a, b = (
                float(evidence.pressures[other][law].summary["T_max_C"])
                - float(evidence.pressures[one][law].summary["T_max_C"])
                for law in LAWS
            )
            yield one, other, (a, b)


def _pressure_changes(evidence: Evidence, velocity: float) -> dict[str, float]:
    """T_max at the highest less T_max at the lowest pressure [K], by compound and law."""
    points = [point for point in evidence.pressures if point.velocity == velocity]
    low, high = min(p.pressure for p in points), max(p.pressure for p in points)
    changes = {}
    for compound in sorted({point.compound for point in points}):
        for law in LAWS:
            T_low, T_high = (
                float(evidence.pressures[Point(compound, p, velocity)][law].summary["T_max_C"])
                for p in (low, high)
            )
            changes[f"{COMPOUND_LOOKS[compound].label}, {law}"] = T_high - T_low
    return changes


def _change_words(changes: dict[str, float]) -> str:
    return ", ".join(f"{change:+.2f} K ({name})" for name, change in changes.items())


def _words(point: Point) -> str:
    return (
        f"{COMPOUND_LOOKS[point.compound].label}, {point.pressure:.3g} N/mm² on top, "
        f"{point.velocity:g} mm/s"
    )


def _pressure_reason(evidence: Evidence, velocity: float) -> str:
    changes = _pressure_changes(evidence, velocity)
    rising = [name for name, change in changes.items() if change > 0.0]
    if len(rising) == len(changes):
        return "T_max rises with pressure in all cases."
    if not rising:
        return "T_max falls with pressure in all cases" + (
            ", by more than a slight change."
            if max(abs(c) for c in changes.values()) >= ACCEPTED_K
            else "."
        )
    return f"T_max rises with pressure with {', '.join(rising)}, and falls otherwise."


def _elsewhere_words(evidence: Evidence, velocity: float) -> str:
    """Pressure at the hottest point, and what happens in the middle of the block instead."""
    points = [point for point in evidence.pressures if point.velocity == velocity]
    ends = min(p.pressure for p in points), max(p.pressure for p in points)
    local, middle = [], []
    for compound in sorted({point.compound for point in points}):
        for law in LAWS:
            low, high = (evidence.pressures[Point(compound, p, velocity)][law] for p in ends)
            local += [pressure_at_peak(low), pressure_at_peak(high)]
            middle.append(middle_temperature(high) - middle_temperature(low))
    return (
        f"The hottest point of the interior is under {min(local):.2f} to {max(local):.2f} N/mm², "
        f"at mean pressures of {ends[0]:g} to {ends[1]:g} N/mm² on the top. In the middle of the "
        f"block, under about the mean pressure, the change is {min(middle):+.2f} to "
        f"{max(middle):+.2f} K. {_rigid_words(evidence)}"
    )


def _rigid_words(evidence: Evidence) -> str:
    """Change of T_max with pressure where nothing deforms."""
    parts = []
    for law in LAWS:
        low, high = (
            float(evidence.changed(experiments.rigid_block(law, p)).summary["T_max_C"])
            for p in (0.2, 0.4)
        )
        parts.append(f"{high - low:+.2f} K ({law})")
    return f"In a rigid block from 0.2 to 0.4 N/mm², the same everywhere: {', '.join(parts)}."


def _heat_flux_words(evidence: Evidence) -> str:
    """What raises and what lowers the temperature when the pressure grows, in numbers."""
    points = sorted(evidence.pressures)
    case = next(iter(evidence.pressures[points[0]].values())).case
    low, high = 0.2, 0.4
    kappa = case.heat.partition_object()
    conductance = case.heat.conductance_object()
    law = evidence.friction_laws[1]
    heat = [float(kappa(p) * law.coefficient(p, 300.0) * p) for p in (low, high)]
    h = [float(conductance.conductance(p)) for p in (low, high)]
    return (
        f"From 0.2 to 0.4 N/mm² the frictional heat kappa mu p grows by a factor of "
        f"{heat[1] / heat[0]:.2f} and the conductance to the road by {h[1] / h[0]:.2f}."
    )


def _coefficients(evidence: Evidence) -> str:
    """Coefficients of both laws at the velocities of the study, cold and at the found T_max."""
    parts = []
    for v, laws in evidence.velocities.items():
        for name, run in laws.items():
            T = float(run.summary["T_max_C"])
            law = run.case.friction.law_object()
            cold, warm = (float(law.coefficient(0.3, v, t)) for t in (start_temperature(run), T))
            parts.append(f"{name} at {v:g} mm/s {cold:.3f} cold, {warm:.3f} at {T:.1f} °C")
    return "Coefficients at 0.3 N/mm²: " + "; ".join(parts) + "."


def _peak_velocity(law: Any) -> float:
    v = np.geomspace(1.0, 1000.0, 6001)
    return float(v[int(np.argmax(law.coefficient(0.3, v)))])


CLAIMS: tuple[Claim, ...] = (
    edge_peak_is_disturbed_more,
    area_sees_the_shape,
    course_is_the_same,
    laws_give_similar_curves,
    relative_error_is_largest_at_7,
    error_bound_of_T_max,
    accuracy_of_the_measurements,
    agreement_with_measurements,
    laws_give_similar_maxima,
    trends_agree,
    pressure_raises_T_max_when_fast,
    pressure_matters_more_when_fast,
    overestimated_at_high_pressure,
    huemer_overestimates_more,
    tests_show_no_pressure_when_slow,
    pressure_lowers_T_max_at_50,
    area_deviates_more,
    exponential_law_has_no_peak,
    velocity_hardly_matters,
    exponential_law_would_fail,
)
