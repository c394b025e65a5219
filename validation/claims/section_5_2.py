"""Numbers behind the claims of section 5.2: influence of the friction law on the temperature."""

from functools import partial
from itertools import combinations, product
from typing import Any

import numpy as np

from fem.results import Result
from validation.analysis import (
    ACCEPTED_K,
    MEASURED_TO_K,
    ends,
    number,
    numbers,
    relative_range,
    warmth,
)
from validation.claims.claim import Numbers
from validation.claims.evidence import EXPONENTIAL, HUEMER, LAWS, Evidence, Point
from validation.drawing import COMPOUND_LOOKS

#: Pressures of the rigid block and of the estimate of its heat [N/mm^2].
LOW, HIGH = 0.2, 0.4


def area_sees_the_shape(evidence: Evidence) -> Numbers:
    runs = list(evidence.compounds.values())
    area = relative_range(numbers(runs, "A_T_K_mm"))
    return {"range_of_A_T": area, "range_of_rise": relative_range(map(warmth.rise, runs))}, {}


def course_is_the_same(evidence: Evidence) -> Numbers:
    runs: dict[float, list[Result]] = {}
    for point, laws in evidence.pressures.items():
        runs.setdefault(point.velocity, []).extend(laws.values())
    lowest = min(np.corrcoef(warmth.profiles(own)).min() for own in runs.values())
    return {"lowest_correlation": min(1.0, float(lowest))}, {}


def laws_give_similar_curves(evidence: Evidence) -> Numbers:
    runs = evidence.velocities
    found = {v: warmth.mean_difference(laws[EXPONENTIAL], laws[HUEMER]) for v, laws in runs.items()}
    worst = max(found, key=found.__getitem__)
    beyond = [f"{v:g} mm/s" for v, value in found.items() if value > MEASURED_TO_K[1]]
    return {f"mean_difference_at_{v:g}_mm_per_s_K": value for v, value in found.items()}, {
        "found": {f"{v:g}": value for v, value in found.items()},
        "could_be_measured": "measurable" if beyond else "",
        "beyond": ", ".join(beyond),
        "worst": f"{worst:g}",
        "gap": abs(_gap(runs[worst])),
        "difference": partial(
            warmth.curve_difference, runs[worst][HUEMER], runs[worst][EXPONENTIAL]
        ),
        "coefficients": partial(_coefficients, evidence),
    }


def laws_give_similar_maxima(evidence: Evidence) -> Numbers:
    gaps = {point: abs(_gap(laws)) for point, laws in evidence.pressures.items()}
    where = max(gaps, key=gaps.__getitem__)
    return {"largest_difference_K": gaps[where]}, {
        "where": _words(where),
        "mean_K": np.mean(list(gaps.values())),
        "coefficients": partial(_coefficients, evidence),
    }


def trends_agree(evidence: Evidence) -> Numbers:
    """Over pairs of points that differ in one thing only."""
    T = {
        point: np.array([number(laws[law], "T_max_C") for law in LAWS])
        for point, laws in evidence.pressures.items()
    }
    pairs = [
        (one, other)
        for one, other in combinations(T, 2)
        if sum(a != b for a, b in zip(one, other, strict=True)) == 1
    ]
    against = []
    for one, other in pairs:
        a, b = T[other] - T[one]
        if a * b < 0.0 and min(abs(a), abs(b)) > MEASURED_TO_K[0]:
            against.append(f"{_words(one)} to {_words(other)}")
    values = {"opposite": float(len(against)), "compared": float(len(pairs))}
    return values, {"opposites": "; ".join(against[:3])}


def pressure_raises_T_max_when_fast(evidence: Evidence) -> Numbers:
    changes = _pressure_changes(evidence, 300.0)
    return changes, _of_changes(changes) | {"grows": partial(_growth_of_heat, evidence)}


def pressure_matters_more_when_fast(evidence: Evidence) -> Numbers:
    sizes = {
        f"{v:g}": float(np.mean(np.abs(list(_pressure_changes(evidence, v).values()))))
        for v in sorted({point.velocity for point in evidence.pressures})
    }
    *slower, fastest = sizes.values()
    return {f"change_at_{v}_mm_per_s_K": size for v, size in sizes.items()}, {
        "sizes": sizes,
        "fastest": fastest,
        "most_of_the_slower": max(slower),
        "grows": partial(_growth_of_heat, evidence),
    }


def huemer_overestimates_more(evidence: Evidence) -> Numbers:
    highest = max(point.pressure for point in evidence.pressures)
    gaps = {
        point.compound: _gap(laws)
        for point, laws in evidence.pressures.items()
        if point.pressure == highest and point.velocity == 300.0
    }
    return {f"difference_{compound}_K": gap for compound, gap in gaps.items()}, {
        "gaps": {COMPOUND_LOOKS[compound].label: gap for compound, gap in gaps.items()},
        "coefficients": partial(_coefficients, evidence),
    }


def pressure_lowers_T_max_at_50(evidence: Evidence) -> Numbers:
    changes = _pressure_changes(evidence, 50.0)
    return changes, _of_changes(changes) | {
        "top": _end_pressures(evidence, 50.0),
        "hottest": partial(_at_the_hottest, evidence, 50.0),
        "rigid": partial(_rigid_changes, evidence),
    }


def exponential_law_has_no_peak(evidence: Evidence) -> Numbers:
    v = np.geomspace(1.0, 1000.0, 6001)
    exponential, huemer = (
        float(v[int(np.argmax(law.coefficient(0.3, v)))]) for law in evidence.friction_laws
    )
    inside = 1.0 < exponential < 1000.0
    return {"huemer_mm_per_s": huemer, "exponential_mm_per_s": exponential}, {
        "huemer_peaks_inside": 1.0 < huemer < 1000.0,
        "exponential_peaks_inside": inside,
        "peaks": "two_peaks" if inside else "one_peak",
    }


def velocity_hardly_matters(evidence: Evidence) -> Numbers:
    v = np.geomspace(7.0, 300.0, 401)
    slopes = {
        name: np.gradient(np.log(law.coefficient(0.3, v)), np.log(v))
        for name, law in zip(LAWS, evidence.friction_laws, strict=True)
    }
    return {f"slope_{name}": float(np.abs(slope).max()) for name, slope in slopes.items()}, {}


def rigid_block(law: str, pressure: float) -> dict[str, Any]:
    """Case keys of a rigid block at 50 mm/s: the same pressure [N/mm^2] everywhere."""
    return {
        "block.rigid": True,
        "loading.velocity_mm_per_s": 50.0,
        "loading.mean_pressure_N_per_mm2": pressure,
        "friction.law": law,
    }


def _gap(laws: dict[str, Result]) -> float:
    """T_max with Huemer's law less T_max with the exponential one [K]."""
    return number(laws[HUEMER], "T_max_C") - number(laws[EXPONENTIAL], "T_max_C")


def _end_pressures(evidence: Evidence, velocity: float) -> tuple[float, float]:
    """Lowest and highest pressure at a velocity [N/mm^2]."""
    return ends(point.pressure for point in evidence.pressures if point.velocity == velocity)


def _pairs(evidence: Evidence, velocity: float) -> dict[str, tuple[Result, Result]]:
    """Runs at the lowest and at the highest pressure, by the words for compound and law."""
    compounds = sorted({p.compound for p in evidence.pressures if p.velocity == velocity})
    low, high = _end_pressures(evidence, velocity)
    return {
        f"{COMPOUND_LOOKS[compound].label}, {law}": (
            evidence.pressures[Point(compound, low, velocity)][law],
            evidence.pressures[Point(compound, high, velocity)][law],
        )
        for compound, law in product(compounds, LAWS)
    }


def _pressure_changes(evidence: Evidence, velocity: float) -> dict[str, float]:
    """T_max at the highest less T_max at the lowest pressure [K], by compound and law."""
    return {
        name: number(high, "T_max_C") - number(low, "T_max_C")
        for name, (low, high) in _pairs(evidence, velocity).items()
    }


def _of_changes(changes: dict[str, float]) -> dict[str, Any]:
    """The changes, and the text that says how T_max goes with pressure."""
    rising = [name for name, change in changes.items() if change > 0.0]
    falls = "falls_much" if max(map(abs, changes.values())) >= ACCEPTED_K else "falls"
    fewer = "rises_and_falls" if rising else falls
    reason = "rises" if len(rising) == len(changes) else fewer
    return {"changes": changes, "rising": ", ".join(rising), "reason": reason}


def _words(point: Point) -> str:
    return (
        f"{COMPOUND_LOOKS[point.compound].label}, {point.pressure:.3g} N/mm² on top, "
        f"{point.velocity:g} mm/s"
    )


def _at_the_hottest(evidence: Evidence, velocity: float) -> dict[str, tuple[float, float]]:
    """Pressure at the hottest point, and what happens in the middle of the block instead."""
    pairs = _pairs(evidence, velocity).values()
    return {
        "local": ends(warmth.pressure_at_peak(run) for pair in pairs for run in pair),
        "middle": ends(
            warmth.middle_temperature(high) - warmth.middle_temperature(low) for low, high in pairs
        ),
    }


def _rigid_changes(evidence: Evidence) -> dict[str, float]:
    """Change of T_max with pressure where nothing deforms [K], by law."""
    found = {}
    for law in LAWS:
        low, high = (evidence.changed(rigid_block(law, p)) for p in (LOW, HIGH))
        found[law] = number(high, "T_max_C") - number(low, "T_max_C")
    return found


def _growth_of_heat(evidence: Evidence) -> dict[str, float]:
    """What raises and what lowers the temperature when the pressure grows: factors."""
    case = next(iter(evidence.pressures[min(evidence.pressures)].values())).case
    kappa, law = case.heat.partition_object(), evidence.friction_laws[1]
    heat = [float(kappa(p) * law.coefficient(p, 300.0) * p) for p in (LOW, HIGH)]
    h = [float(case.heat.conductance_object().conductance(p)) for p in (LOW, HIGH)]
    return {"heat": heat[1] / heat[0], "conductance": h[1] / h[0]}


def _coefficients(evidence: Evidence) -> dict[str, dict[str, float]]:
    """Coefficients of both laws at the velocities of the study, cold and at the found T_max."""
    found = {}
    for v, laws in evidence.velocities.items():
        for name, run in laws.items():
            T, law = number(run, "T_max_C"), run.case.friction.law_object()
            cold = float(law.coefficient(0.3, v, warmth.start_temperature(run)))
            warm = float(law.coefficient(0.3, v, T))
            found[f"{name} at {v:g}"] = {"cold": cold, "warm": warm, "T": T}
    return found
