"""Claims of section 5.1 on stress, deformation and temperature: influence of the material."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from scipy.stats import spearmanr

from fem.results import Result
from validation.claims.claim import Claim, Finding, claim, unchecked
from validation.claims.evidence import Evidence
from validation.claims.paper_numbers import (
    ACCEPTED_K,
    SIMILAR,
    SIMILAR_WORDS,
    relative_range,
)
from validation.claims.rubber_curves import (
    TESTED_STRETCH,
    secant_shear_modulus,
    stiffening,
    upturn_stretch,
)
from validation.claims.shape import amount_of_shear, deformation, stress_extremes
from validation.claims.warmth import profiles
from validation.drawing.compound_names import COMPOUND_LOOKS
from validation.drawing.state_panels import last_state

MOONEY_RIVLIN, LOAD = "mooney-rivlin-dumbbells", "yeoh-bars-series-1-load"
YEOH = {1: "yeoh-bars-series-1", 2: "yeoh-bars-series-2"}
VAN_DER_WAALS = {1: "van-der-waals-bars-series-1", 2: "van-der-waals-bars-series-2"}
#: Two-sided critical value of Spearman's rank correlation of six pairs at the 5 % level (Zar,
#: Significance testing of the Spearman rank correlation coefficient, J. Am. Stat. Assoc. 67, 1972).
CRITICAL_RANK_CORRELATION = 0.886
_PHOTO = "The contour from the photograph is drawn in Fig. 9 only, which is not in the text."
_CURVE = "The measured temperature curve is drawn in Fig. 10 only, which is not in the text."


@claim(
    section="5.1",
    says="Fig. 9 shows stresses at a mean contact pressure of 3 N/mm².",
    computed="mean contact pressures of the six runs, and the contact that Table 4's middle force "
    "would leave at 3 N/mm²",
)
def printed_pressure(evidence: Evidence) -> Finding:
    runs = evidence.compounds
    p = [float(run.summary["mean_contact_pressure_N_per_mm2"]) for run in runs.values()]
    holds = all(2.5 <= value < 3.5 for value in p)
    run = next(iter(runs.values()))
    load = run.case.loading.mean_pressure_N_per_mm2 * run.case.block.length_mm
    return Finding(
        ours=f"{min(p):.2f} to {max(p):.2f} N/mm²",
        values={"smallest_N_per_mm2": min(p), "largest_N_per_mm2": max(p)},
        criterion="round to the printed 3 N/mm²: from 2.5 to 3.5",
        holds=holds,
        explanation=""
        if holds
        else "Taken as a misprint of the 0.3 N/mm² that section 4.2 states for the same event.",
        experiment=""
        if holds
        else f"By the balance of forces, the {load:.1f} N/mm on top would stand on "
        f"{load / 3.0:.1f} mm of the {run.case.block.length_mm:g} mm; with ten times the load, the "
        "forces of Table 4 would be about ten times as large.",
    )


@claim(
    section="5.1",
    says="The stress fields of all material models look alike.",
    computed="rank correlation of the vertical stress over all elements, each pair of sets",
)
def stress_fields_alike(evidence: Evidence) -> Finding:
    fields = [last_state(run).snapshot.cauchy_stress[:, 1] for run in evidence.compounds.values()]
    lowest = min(_rank_correlation(a, b) for a, b in combinations(fields, 2))
    return Finding(
        ours=f"at least {lowest:.2f}",
        values={"lowest_rank_correlation": lowest},
        criterion="every pair nearer to 1 (same pattern) than to 0: above 0.5",
        holds=lowest > 0.5,
        explanation="" if lowest > 0.5 else "Two sets have different patterns of stress.",
    )


@claim(
    section="5.1",
    says="The extreme stresses vary considerably between the sets.",
    computed="smallest and largest vertical stress: range over the sets, relative to the mean",
)
def stress_extremes_vary(evidence: Evidence) -> Finding:
    lows, highs = zip(*map(stress_extremes, evidence.compounds.values()), strict=True)
    low, high = relative_range(list(lows)), relative_range(list(highs))
    holds = min(low, high) > SIMILAR
    return Finding(
        ours=f"smallest from {min(lows):.2f} to {max(lows):.2f} N/mm² ({100 * low:.0f} %), largest "
        f"from {min(highs):.2f} to {max(highs):.2f} N/mm² ({100 * high:.0f} %)",
        values={"range_of_smallest": low, "range_of_largest": high},
        criterion=f"both vary by more than {SIMILAR_WORDS}",
        holds=holds,
        explanation="" if holds else "The sets differ less than Table 4's similar forces.",
    )


@claim(
    section="5.1",
    says="The extreme stresses do not follow the stiffness seen in the deformation.",
    computed="rank correlation of both extremes with the mean displacement of the free contour",
)
def extremes_do_not_follow_stiffness(evidence: Evidence) -> Finding:
    runs = list(evidence.compounds.values())
    moved = [deformation(run) for run in runs]
    lows, highs = zip(*map(stress_extremes, runs), strict=True)
    low = _rank_correlation(np.abs(lows), np.array(moved))
    high = _rank_correlation(np.array(highs), np.array(moved))
    holds = max(abs(low), abs(high)) < CRITICAL_RANK_CORRELATION
    return Finding(
        ours=f"{low:+.2f} for the compression, {high:+.2f} for the tension",
        values={"of_compression": low, "of_tension": high},
        criterion=f"below {CRITICAL_RANK_CORRELATION:g}, significant at 5 % for six sets",
        holds=holds,
        explanation="" if holds else _which_follows(low, high),
    )


def _less_deformation(evidence: Evidence, series: int) -> Finding:
    waals, yeoh = (
        deformation(evidence.compounds[names[series]]) for names in (VAN_DER_WAALS, YEOH)
    )
    holds = waals < yeoh
    return Finding(
        ours=f"van der Waals {waals:.3f} mm, Yeoh {yeoh:.3f} mm",
        values={"van_der_waals_mm": waals, "yeoh_mm": yeoh},
        criterion="van der Waals below Yeoh",
        holds=holds,
        explanation="" if holds else "The van der Waals set is the softer one in the block.",
        experiment=""
        if holds
        else _stiffness_words(evidence, [YEOH[series], VAN_DER_WAALS[series]]),
    )


@claim(
    section="5.1",
    says="From series 1, van der Waals deforms less than Yeoh.",
    computed="mean displacement of the free contour",
)
def van_der_waals_deforms_less_1(evidence: Evidence) -> Finding:
    return _less_deformation(evidence, 1)


@claim(
    section="5.1",
    says="From series 2, van der Waals deforms less than Yeoh.",
    computed="mean displacement of the free contour",
)
def van_der_waals_deforms_less_2(evidence: Evidence) -> Finding:
    return _less_deformation(evidence, 2)


@claim(
    section="5.1",
    says="Deforming less means that van der Waals is the less stiff model.",
    computed="secant shear modulus of both models at the block's mean shear with Yeoh",
)
def less_deformation_is_less_stiff(evidence: Evidence) -> Finding:
    ratios = {}
    for series in (1, 2):
        shear = amount_of_shear(evidence.compounds[YEOH[series]])
        ratios[series] = secant_shear_modulus(
            evidence.rubbers[VAN_DER_WAALS[series]], shear
        ) / secant_shear_modulus(evidence.rubbers[YEOH[series]], shear)
    holds = all(ratio < 1.0 for ratio in ratios.values())
    names = [*YEOH.values(), *VAN_DER_WAALS.values()]
    return Finding(
        ours="van der Waals over Yeoh: "
        + ", ".join(f"{ratio:.3f} (series {series})" for series, ratio in ratios.items()),
        values={f"ratio_series_{series}": ratio for series, ratio in ratios.items()},
        criterion="below 1 for both series",
        holds=holds,
        explanation=""
        if holds
        else "A block that deforms less under the same load is stiffer, not less stiff; the word "
        "in the paper reads like a slip.",
        experiment="" if holds else _stiffness_words(evidence, names),
    )


def _more_deformation(evidence: Evidence, names: dict[int, str]) -> Finding:
    one, two = (deformation(evidence.compounds[names[series]]) for series in (1, 2))
    holds = two > one
    return Finding(
        ours=f"series 1 {one:.3f} mm, series 2 {two:.3f} mm",
        values={"series_1_mm": one, "series_2_mm": two},
        criterion="series 2 above series 1",
        holds=holds,
        explanation="" if holds else "The set of series 2 is the stiffer one in the block.",
        experiment="" if holds else _stiffness_words(evidence, list(names.values())),
    )


@claim(
    section="5.1",
    says="The Yeoh set of series 2 deforms more than that of series 1.",
    computed="mean displacement of the free contour",
)
def series_2_deforms_more_yeoh(evidence: Evidence) -> Finding:
    return _more_deformation(evidence, YEOH)


@claim(
    section="5.1",
    says="The van der Waals set of series 2 deforms more than that of series 1.",
    computed="mean displacement of the free contour",
)
def series_2_deforms_more_van_der_waals(evidence: Evidence) -> Finding:
    return _more_deformation(evidence, VAN_DER_WAALS)


@claim(
    section="5.1",
    says="The sets of series 2 stiffen at a larger strain than those of series 1.",
    computed="stretch at which the slope of the uniaxial curve is twice its lowest value",
)
def series_2_stiffens_later(evidence: Evidence) -> Finding:
    at = {
        name: upturn_stretch(evidence.rubbers[name])
        for names in (YEOH, VAN_DER_WAALS)
        for name in names.values()
    }
    holds = all(at[names[2]] > at[names[1]] for names in (YEOH, VAN_DER_WAALS))
    return Finding(
        ours="Yeoh {:.2f} and {:.2f}, van der Waals {:.2f} and {:.2f}".format(*at.values()),
        values={f"upturn_{name}": value for name, value in at.items()},
        criterion="series 2 above series 1 for both models",
        holds=holds,
        explanation="" if holds else "In one of the models series 2 stiffens first.",
    )


@claim(
    section="5.1",
    says='"Yeoh, series 1, load" comes nearest to the contour of the tested block.',
    computed="-",
)
def load_fits_the_contour(evidence: Evidence) -> Finding:
    return unchecked(_PHOTO)


@claim(
    section="5.1",
    says="The material model does not change the temperature of the bottom considerably.",
    computed="difference of the curves of each pair of sets, mean over the bottom surface",
)
def material_leaves_temperature_curve(evidence: Evidence) -> Finding:
    names, curves = list(evidence.compounds), profiles(list(evidence.compounds.values()))
    means = {
        (names[i], names[j]): float(np.abs(curves[i] - curves[j]).mean())
        for i, j in combinations(range(len(names)), 2)
    }
    (one, other), most = max(means.items(), key=lambda item: item[1])
    holds = most <= ACCEPTED_K
    return Finding(
        ours=f"at most {most:.2f} K ({label(one)} and {label(other)})",
        values={"largest_mean_difference_K": most},
        criterion=f"at most {ACCEPTED_K:g} K, the deviation that section 5.2 accepts",
        holds=holds,
        explanation="" if holds else _where_curves_differ(evidence, one, other),
        experiment="" if holds else _difference_inside(evidence, one, other),
    )


@claim(
    section="5.1",
    says="The interior maximum of the temperature changes especially little with the material.",
    computed="range of T_max over the six sets, and largest range of the curves at one place",
)
def material_leaves_T_max(evidence: Evidence) -> Finding:
    T = [float(run.summary["T_max_C"]) for run in evidence.compounds.values()]
    spread = max(T) - min(T)
    anywhere = float(np.ptp(profiles(list(evidence.compounds.values())), axis=0).max())
    holds = spread <= ACCEPTED_K and spread < anywhere
    return Finding(
        ours=f"{spread:.2f} K ({min(T):.2f} to {max(T):.2f} °C), elsewhere up to {anywhere:.1f} K",
        values={"range_of_T_max_K": spread, "largest_range_K": anywhere},
        criterion=f"at most {ACCEPTED_K:g} K (accepted in section 5.2) and less than elsewhere",
        holds=holds,
        explanation="" if holds else "The maximum depends on the material as the curves do.",
    )


@claim(
    section="5.1",
    says='"Yeoh, series 1, load" has the lowest peak of the sets from bars.',
    computed="T_max of the five Yeoh and van der Waals sets (and of Mooney-Rivlin, to see)",
)
def load_has_the_lowest_peak(evidence: Evidence) -> Finding:
    T = {name: float(run.summary["T_max_C"]) for name, run in evidence.compounds.items()}
    bars = {name: value for name, value in T.items() if name != MOONEY_RIVLIN}
    lowest = min(bars, key=bars.__getitem__)
    holds = lowest == LOAD
    return Finding(
        ours=", ".join(f"{label(name)} {value:.2f} °C" for name, value in T.items()),
        values={f"T_max_{name}_C": value for name, value in T.items()},
        criterion="lowest of the five",
        holds=holds,
        explanation=""
        if holds
        else f"{label(lowest)} is lower by {bars[LOAD] - bars[lowest]:.2f} K; all five lie within "
        f"{max(bars.values()) - min(bars.values()):.2f} K.",
        experiment="" if holds else _pressure_words(evidence, bars),
    )


@claim(
    section="5.1",
    says='"Yeoh, series 1, load" comes nearest to the measured peak.',
    computed="-",
)
def load_fits_the_measured_peak(evidence: Evidence) -> Finding:
    return unchecked(_CURVE)


@claim(
    section="5.1",
    says="Over the whole curve, Mooney-Rivlin fits the measured temperatures best.",
    computed="-",
)
def mooney_rivlin_fits_the_curve(evidence: Evidence) -> Finding:
    return unchecked(_CURVE)


@claim(
    section="5.1",
    says="Mooney-Rivlin cannot show the stiffening of rubber at large strain.",
    computed=f"largest later slope over lowest slope of the uniaxial curve up to a stretch of "
    f"{TESTED_STRETCH:g}",
)
def mooney_rivlin_does_not_stiffen(evidence: Evidence) -> Finding:
    found = {name: stiffening(model) for name, model in evidence.rubbers.items()}
    others = [value for name, value in found.items() if name != MOONEY_RIVLIN]
    holds = found[MOONEY_RIVLIN] <= 1.0 + 1e-9 < min(others)
    return Finding(
        ours=f"Mooney-Rivlin {found[MOONEY_RIVLIN]:.2f}, the other sets {min(others):.2f} or more",
        values={f"stiffening_{name}": value for name, value in found.items()},
        criterion="1 for Mooney-Rivlin (the slope never rises again), more for all others",
        holds=holds,
        explanation="" if holds else "Mooney-Rivlin stiffens, or another set does not.",
    )


@claim(
    section="5.1",
    says="Mooney-Rivlin represents the deformation badly.",
    computed='mean displacement of the free contour against "Yeoh, series 1, load", the set the '
    "paper found nearest to the tested block",
)
def mooney_rivlin_deforms_differently(evidence: Evidence) -> Finding:
    moved = {name: deformation(run) for name, run in evidence.compounds.items()}
    away = {name: abs(value / moved[LOAD] - 1.0) for name, value in moved.items() if name != LOAD}
    farthest = max(away, key=away.__getitem__)
    holds = farthest == MOONEY_RIVLIN
    return Finding(
        ours=", ".join(f"{label(name)} {value:.3f} mm" for name, value in moved.items()),
        values={f"displacement_{name}_mm": value for name, value in moved.items()},
        criterion="farthest of all sets from that set",
        holds=holds,
        explanation="" if holds else f"{label(farthest)} is farther away.",
        experiment="" if holds else _stiffness_words(evidence, list(moved)),
    )


def label(name: str) -> str:
    return COMPOUND_LOOKS[name].label.replace(", bars", "")


def _rank_correlation(a: np.ndarray, b: np.ndarray) -> float:
    return float(spearmanr(a, b).statistic)


def _which_follows(low: float, high: float) -> str:
    words = []
    for name, value in (("compression", low), ("tension", high)):
        if abs(value) >= CRITICAL_RANK_CORRELATION:
            words.append(f"the largest {name} {'grows' if value > 0 else 'falls'} with it")
    return f"The softer the block: {' and '.join(words)}."


def _stiffness_words(evidence: Evidence, names: list[str]) -> str:
    parts = []
    for name in names:
        shear, model = amount_of_shear(evidence.compounds[name]), evidence.rubbers[name]
        parts.append(
            f"{label(name)} {secant_shear_modulus(model, shear):.3f} N/mm² (G "
            f"{model.initial_shear_modulus:.3f})"
        )
    return "Secant shear modulus at the block's mean shear: " + ", ".join(parts) + "."


def _pressure_words(evidence: Evidence, names: dict[str, float]) -> str:
    parts = [
        f"{label(name)} {evidence.compounds[name].summary['mean_contact_pressure_N_per_mm2']:.3f}"
        for name in names
    ]
    return "Mean contact pressures [N/mm²]: " + ", ".join(parts) + "."


def _where_curves_differ(evidence: Evidence, one: str, other: str) -> str:
    surface = evidence.compounds[one].surface
    X = np.linspace(float(surface["X_mm"].min()), float(surface["X_mm"].max()), 401)
    a, b = profiles([evidence.compounds[one], evidence.compounds[other]])
    place = int(np.argmax(np.abs(a - b)))
    return (
        f"{label(one)} and {label(other)} differ most, {abs(a[place] - b[place]):.1f} K, at "
        f"X = {X[place]:.1f} mm: contact begins and ends at other places."
    )


def _difference_inside(evidence: Evidence, one: str, other: str) -> str:
    runs = [evidence.compounds[one], evidence.compounds[other]]
    a, b = profiles(runs)
    inside = np.all([_in_contact(run) for run in runs], axis=0)
    both = float(np.abs(a - b)[inside].mean())
    return f"Where both are in contact, the same two differ by {both:.2f} K in the mean."


def _in_contact(result: Result) -> np.ndarray:
    surface = result.surface
    X = np.linspace(float(surface["X_mm"].min()), float(surface["X_mm"].max()), 401)
    flags = surface["in_contact"].to_numpy(dtype=float)
    return np.asarray(np.interp(X, surface["X_mm"], flags) > 0.5)


CLAIMS: tuple[Claim, ...] = (
    printed_pressure,
    stress_fields_alike,
    stress_extremes_vary,
    extremes_do_not_follow_stiffness,
    van_der_waals_deforms_less_1,
    van_der_waals_deforms_less_2,
    less_deformation_is_less_stiff,
    series_2_deforms_more_yeoh,
    series_2_deforms_more_van_der_waals,
    series_2_stiffens_later,
    load_fits_the_contour,
    material_leaves_temperature_curve,
    material_leaves_T_max,
    load_has_the_lowest_peak,
    load_fits_the_measured_peak,
    mooney_rivlin_fits_the_curve,
    mooney_rivlin_does_not_stiffen,
    mooney_rivlin_deforms_differently,
)
