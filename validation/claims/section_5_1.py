"""Claims of section 5.1 on stress, deformation and temperature: influence of the material."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from scipy.stats import spearmanr

from validation.claims.claim import Claim, Finding, claim, unchecked
from validation.claims.evidence import Evidence
from validation.claims.paper_numbers import (
    ACCEPTED_K,
    MEASURED_TO_K,
    SIMILAR,
    SIMILAR_WORDS,
    relative_range,
)
from validation.claims.rubber_curves import (
    TESTED_STRETCH,
    secant_shear_modulus,
    stiffening,
    stiffer_ranges,
    upturn_stretch,
)
from validation.claims.shape import (
    amount_of_shear,
    deformation,
    extreme_place,
    stress_extremes,
)
from validation.claims.warmth import (
    difference_words,
    front_edge_temperature,
    mean_difference,
    profiles,
)
from validation.drawing.compound_names import COMPOUND_LOOKS
from validation.drawing.state_panels import last_state

MOONEY_RIVLIN, LOAD = "mooney-rivlin-dumbbells", "yeoh-bars-series-1-load"
YEOH = {1: "yeoh-bars-series-1", 2: "yeoh-bars-series-2"}
VAN_DER_WAALS = {1: "van-der-waals-bars-series-1", 2: "van-der-waals-bars-series-2"}
#: Smallest of Spearman's rank correlations of six pairs that is significant at the 5 % level (two
#: sides, from all 720 orders, which a test counts).
CRITICAL_RANK_CORRELATION = 31.0 / 35.0
_PHOTO = "The contour from the photograph is drawn in Fig. 9 only, which is not in the text."
_CURVE = "The measured temperature curve is drawn in Fig. 10 only, which is not in the text."


@claim(
    section="5.1",
    says="Fig. 9 shows stresses at a mean contact pressure of 3 N/mm².",
    computed="-",
)
def printed_pressure(evidence: Evidence) -> Finding:
    return unchecked(
        "An input, and taken as a misprint: section 4.2 has 0.3 N/mm² for the same event, and ten "
        "times the load would mean about ten times the forces of Table 4."
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


def _variation(evidence: Evidence, which: int) -> Finding:
    found = [stress_extremes(run)[which] for run in evidence.compounds.values()]
    spread = relative_range(found)
    holds = spread > SIMILAR
    return Finding(
        ours=f"from {min(found):.2f} to {max(found):.2f} N/mm² ({100 * spread:.0f} %)",
        values={"relative_range": spread},
        criterion=f"varies by more than {SIMILAR_WORDS}",
        holds=holds,
        explanation="" if holds else "The sets differ less than forces that are called similar.",
        experiment="" if holds else _away_from_the_platen(evidence, which),
    )


@claim(
    section="5.1",
    says="The smallest vertical stress (highest compression) varies considerably between the sets.",
    computed="smallest vertical stress of all elements: range over the six sets over its mean",
)
def highest_compression_varies(evidence: Evidence) -> Finding:
    return _variation(evidence, 0)


@claim(
    section="5.1",
    says="The largest vertical stress (highest tension) varies considerably between the sets.",
    computed="largest vertical stress of all elements: range over the six sets over its mean",
)
def highest_tension_varies(evidence: Evidence) -> Finding:
    return _variation(evidence, 1)


def _following(evidence: Evidence, which: int) -> Finding:
    runs = list(evidence.compounds.values())
    moved = [deformation(run) for run in runs]
    follows = _rank_correlation(
        np.abs([stress_extremes(run)[which] for run in runs]), np.array(moved)
    )
    # Rank correlations of six pairs are multiples of 1/35, far coarser than the tolerance.
    holds = abs(follows) < CRITICAL_RANK_CORRELATION - 1e-9
    word = "grows" if follows > 0.0 else "falls"
    return Finding(
        ours=f"{follows:+.2f}",
        values={"rank_correlation": follows},
        criterion=f"size below {CRITICAL_RANK_CORRELATION:.3f}, significant at 5 % for six sets",
        holds=holds,
        explanation="" if holds else f"It {word} with the deformation of the block.",
        experiment="" if holds else _away_from_the_platen(evidence, which),
    )


@claim(
    section="5.1",
    says="The highest compression does not follow the stiffness seen in the deformation.",
    computed="rank correlation of its size with the mean displacement of the free contour",
)
def compression_does_not_follow_stiffness(evidence: Evidence) -> Finding:
    return _following(evidence, 0)


@claim(
    section="5.1",
    says="The highest tension does not follow the stiffness seen in the deformation.",
    computed="rank correlation of its size with the mean displacement of the free contour",
)
def tension_does_not_follow_stiffness(evidence: Evidence) -> Finding:
    return _following(evidence, 1)


@claim(
    section="5.1",
    says="Van der Waals deforms less than Yeoh, from either test series.",
    computed="mean displacement of the free contour",
)
def van_der_waals_deforms_less(evidence: Evidence) -> Finding:
    pairs = {n: _displacements(evidence, VAN_DER_WAALS[n], YEOH[n]) for n in (1, 2)}
    against = [series for series, (waals, yeoh) in pairs.items() if not waals < yeoh]
    return Finding(
        ours="; ".join(
            f"series {n}: van der Waals {waals:.3f} mm, Yeoh {yeoh:.3f} mm"
            for n, (waals, yeoh) in pairs.items()
        ),
        values={
            f"{model}_series_{n}_mm": value
            for n, pair in pairs.items()
            for model, value in zip(("van_der_waals", "yeoh"), pair, strict=True)
        },
        criterion="van der Waals below Yeoh in both series",
        holds=not against,
        explanation=_why_it_deforms_more(evidence, against) if against else "",
        experiment=" ".join(_softness_tried(evidence, series) for series in against),
    )


def _displacements(evidence: Evidence, *names: str) -> tuple[float, ...]:
    return tuple(deformation(evidence.compounds[name]) for name in names)


@claim(
    section="5.1",
    says="Van der Waals shows the lower stiffness of the two models (said to follow from its "
    "smaller deformation).",
    computed="secant shear modulus of both models at the block's mean shear with Yeoh",
)
def van_der_waals_is_less_stiff(evidence: Evidence) -> Finding:
    ratios = {series: _stiffness_ratio(evidence, series) for series in (1, 2)}
    holds = all(ratio < 1.0 for ratio in ratios.values())
    names = [*YEOH.values(), *VAN_DER_WAALS.values()]
    return Finding(
        ours="van der Waals over Yeoh: "
        + ", ".join(f"{ratio:.3f} (series {series})" for series, ratio in ratios.items()),
        values={f"ratio_series_{series}": ratio for series, ratio in ratios.items()},
        criterion="below 1 for both series",
        holds=holds,
        explanation="This is about the models; it cannot follow from a smaller deformation, which "
        "means more stiffness."
        if holds
        else "In one of the series van der Waals is the stiffer model in the block.",
        experiment="" if holds else _stiffness_words(evidence, names),
    )


@claim(
    section="5.1",
    says="The sets of series 2 deform more than those of series 1, with either model.",
    computed="mean displacement of the free contour",
)
def series_2_deforms_more(evidence: Evidence) -> Finding:
    pairs = {
        model: _displacements(evidence, names[1], names[2])
        for model, names in {"Yeoh": YEOH, "van der Waals": VAN_DER_WAALS}.items()
    }
    holds = all(two > one for one, two in pairs.values())
    return Finding(
        ours="; ".join(
            f"{model}: series 1 {one:.3f} mm, series 2 {two:.3f} mm"
            for model, (one, two) in pairs.items()
        ),
        values={
            f"{model}_series_{n}_mm": value
            for model, pair in pairs.items()
            for n, value in enumerate(pair, 1)
        },
        criterion="series 2 above series 1 for both models",
        holds=holds,
        explanation="" if holds else "A set of series 2 is the stiffer one in the block.",
        experiment=""
        if holds
        else _stiffness_words(evidence, [*YEOH.values(), *VAN_DER_WAALS.values()]),
    )


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
    says="Series 2 deforms more because its curve turns up late.",
    computed="modulus of series 2 over series 1: initial shear modulus, and secant shear modulus "
    "at the mean shear of the series 1 block, which the upturn can change",
)
def late_upturn_is_the_reason(evidence: Evidence) -> Finding:
    found = {}
    for model, names in {"Yeoh": YEOH, "van der Waals": VAN_DER_WAALS}.items():
        one, two = (evidence.rubbers[names[series]] for series in (1, 2))
        shear = amount_of_shear(evidence.compounds[names[1]])
        secant = secant_shear_modulus(two, shear) / secant_shear_modulus(one, shear)
        found[model] = (two.initial_shear_modulus / one.initial_shear_modulus, secant)
    holds = all(secant < initial for initial, secant in found.values())
    return Finding(
        ours="; ".join(f"{name} {a:.3f} at first, {b:.3f} later" for name, (a, b) in found.items()),
        values={f"{name}_{k}": v[i] for name, v in found.items() for i, k in enumerate("ab")},
        criterion="series 2 loses stiffness against series 1 on the way, in both models",
        holds=holds,
        explanation=""
        if holds
        else "The sets of series 2 are softer from the start, and the difference does not grow up "
        "to the shear of the block: its strains are too small for the upturn.",
        experiment="" if holds else _neo_hookean_ratio(evidence),
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
    runs = evidence.compounds
    means = {pair: mean_difference(*map(runs.__getitem__, pair)) for pair in combinations(runs, 2)}
    (one, other), most = max(means.items(), key=lambda item: item[1])
    holds = most <= ACCEPTED_K
    without = max(value for pair, value in means.items() if MOONEY_RIVLIN not in pair)
    return Finding(
        ours=f"at most {most:.2f} K ({label(one)} and {label(other)}); {without:.2f} K among the "
        "sets from bars",
        values={"largest_mean_difference_K": most, "among_bars_K": without},
        criterion=f"at most {ACCEPTED_K:g} K, the deviation that section 5.2 accepts",
        holds=holds,
        explanation="" if holds else _why_curves_differ(evidence),
        experiment="" if holds else difference_words(runs[one], runs[other]),
    )


@claim(
    section="5.1",
    says="What the material does to the temperature curves comes from the deformation.",
    computed="rank correlation of A_T with the mean displacement of the free contour over the sets",
)
def curves_follow_deformation(evidence: Evidence) -> Finding:
    follows = _area_follows_deformation(evidence)
    holds = abs(follows) > CRITICAL_RANK_CORRELATION - 1e-9
    return Finding(
        ours=f"{follows:+.2f}",
        values={"rank_correlation": follows},
        criterion=f"size at least {CRITICAL_RANK_CORRELATION:.3f}: significant at 5 % for six sets",
        holds=holds,
        explanation="" if holds else "A_T does not go with the deformation.",
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
    computed="highest temperature of the front edge, where section 4.2 puts the peaks, of the five "
    "Yeoh and van der Waals sets",
)
def load_has_the_lowest_peak(evidence: Evidence) -> Finding:
    bars = {name: run for name, run in evidence.compounds.items() if name != MOONEY_RIVLIN}
    edge = {name: front_edge_temperature(run) for name, run in bars.items()}
    lowest = min(edge, key=edge.__getitem__)
    holds = lowest == LOAD
    reading = _as_interior_maximum({n: float(r.summary["T_max_C"]) for n, r in bars.items()})
    return Finding(
        ours=", ".join(f"{label(name)} {value:.1f} °C" for name, value in edge.items()),
        values={f"front_edge_{name}_C": value for name, value in edge.items()},
        criterion="lowest of the five",
        holds=holds,
        explanation=reading if holds else f"{label(lowest)} has the lowest peak. {reading}",
        experiment="" if holds else _what_orders_the_peaks(evidence, edge),
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
    off = {name: value / moved[LOAD] - 1.0 for name, value in moved.items() if name != LOAD}
    holds = abs(off[MOONEY_RIVLIN]) > SIMILAR
    return Finding(
        ours=", ".join(f"{label(name)} {100 * value:+.0f} %" for name, value in off.items()),
        values={f"displacement_{name}_mm": value for name, value in moved.items()},
        criterion=f"Mooney-Rivlin off by more than {SIMILAR_WORDS}",
        holds=holds,
        explanation=_also_far(off) if holds else "Mooney-Rivlin deforms like that set.",
        experiment="" if holds else _stiffness_words(evidence, list(moved)),
    )


def label(name: str) -> str:
    return COMPOUND_LOOKS[name].label.replace(", bars", "")


def _neo_hookean_ratio(evidence: Evidence) -> str:
    """Compare the blocks' deformations with what the initial moduli alone let expect."""
    parts = []
    for model, names in {"Yeoh": YEOH, "van der Waals": VAN_DER_WAALS}.items():
        moved = [deformation(evidence.compounds[names[series]]) for series in (1, 2)]
        G = [evidence.rubbers[names[series]].initial_shear_modulus for series in (1, 2)]
        parts.append(f"{model} {moved[1] / moved[0]:.3f} (inverse of G: {G[0] / G[1]:.3f})")
    return f"Displacement of series 2 over series 1: {', '.join(parts)}."


def _area_follows_deformation(evidence: Evidence) -> float:
    """Rank correlation of A_T with the deformation over the sets [-]."""
    runs = list(evidence.compounds.values())
    area = np.array([float(run.summary["A_T_K_mm"]) for run in runs])
    return _rank_correlation(area, np.array([deformation(run) for run in runs]))


def _why_curves_differ(evidence: Evidence) -> str:
    follows = _area_follows_deformation(evidence)
    if abs(follows) < CRITICAL_RANK_CORRELATION - 1e-9:
        return f"Not by way of the deformation (rank correlation with A_T: {follows:+.2f})."
    return (
        f"The more a block deforms, the {'less' if follows < 0.0 else 'more'} of its bottom gets "
        f"warm (rank correlation with A_T: {follows:+.2f})."
    )


def _also_far(off: dict[str, float]) -> str:
    farther = [name for name in off if abs(off[name]) > abs(off[MOONEY_RIVLIN])]
    if not farther:
        return ""
    return f"It is not the only one: {', '.join(map(label, farther))} is farther away."


def _rank_correlation(a: np.ndarray, b: np.ndarray) -> float:
    """Spearman's rank correlation; 0 where one of the two does not vary."""
    if np.ptp(a) == 0.0 or np.ptp(b) == 0.0:
        return 0.0
    return float(spearmanr(a, b).statistic)


def _away_from_the_platen(evidence: Evidence, which: int) -> str:
    """Where the extreme is, and what the lower half of the block has instead."""
    runs = list(evidence.compounds.values())
    places = [extreme_place(run, which) for run in runs]
    lower = [stress_extremes(run, below=0.5)[which] for run in runs]
    along, up = (f"{100 * min(x):.0f} to {100 * max(x):.0f} %" for x in zip(*places, strict=True))
    follows = _rank_correlation(np.abs(lower), np.array([deformation(run) for run in runs]))
    return (
        f"It sits at {along} of the length and {up} of the height. In the lower half of the block, "
        f"away from the platen the top is glued to, it is from {min(lower):.2f} to "
        f"{max(lower):.2f} N/mm² ({100 * relative_range(lower):.0f} %), rank correlation with the "
        f"displacement {follows:+.2f}."
    )


def _stiffness_ratio(evidence: Evidence, series: int) -> float:
    """Secant shear modulus of van der Waals over that of Yeoh at the Yeoh block's shear [-]."""
    shear = amount_of_shear(evidence.compounds[YEOH[series]])
    waals, yeoh = (
        secant_shear_modulus(evidence.rubbers[names[series]], shear)
        for names in (VAN_DER_WAALS, YEOH)
    )
    return waals / yeoh


def _why_it_deforms_more(evidence: Evidence, against: list[int]) -> str:
    ratios = {series: _stiffness_ratio(evidence, series) for series in against}
    if max(ratios.values()) >= 1.0:
        return "Not for a lack of stiffness in shear; the contact must differ."
    softer = " and ".join(f"{100 * (1 - r):.1f} % (series {n})" for n, r in ratios.items())
    return (
        "With the parameters of Table 1, van der Waals is the softer one at the block's shear, by "
        f"{softer}. The paper itself goes on to speak of its lower stiffness, which a larger "
        "deformation would show."
    )


def _softness_tried(evidence: Evidence, series: int) -> str:
    names = [YEOH[series], VAN_DER_WAALS[series]]
    waals, yeoh = (evidence.rubbers[name] for name in reversed(names))
    ranges = " and ".join(f"{a:.2f} to {b:.2f}" for a, b in stiffer_ranges(waals, yeoh))
    where = f"for an amount of shear of {ranges}" if ranges else "for no amount of shear"
    return (
        f"{_stiffness_words(evidence, names)} Of amounts up to 2, van der Waals is the stiffer one "
        f"{where}; the block's is {amount_of_shear(evidence.compounds[names[0]]):.2f}."
    )


def _stiffness_words(evidence: Evidence, names: list[str]) -> str:
    parts = []
    for name in names:
        shear, model = amount_of_shear(evidence.compounds[name]), evidence.rubbers[name]
        parts.append(
            f"{label(name)} {secant_shear_modulus(model, shear):.3f} N/mm² (G "
            f"{model.initial_shear_modulus:.3f})"
        )
    return "Secant shear modulus at the block's mean shear: " + ", ".join(parts) + "."


def _as_interior_maximum(T: dict[str, float]) -> str:
    """What the claim about peaks would come to if the paper meant the interior maximum."""
    lowest, apart = min(T, key=T.__getitem__), max(T.values()) - min(T.values())
    verdict = "hold" if lowest == LOAD else "differ"
    able = "less" if apart < MEASURED_TO_K[0] else "not less"
    return (
        "The paper does not say which peak. Read as the interior maximum the claim would "
        f"{verdict}: {label(lowest)} has the lowest, but all five lie within {apart:.2f} K, {able} "
        f"than the {MEASURED_TO_K[0]:g} K that could be measured."
    )


def _what_orders_the_peaks(evidence: Evidence, edge: dict[str, float]) -> str:
    """How the peaks go with the pressure that makes them."""
    p = [
        float(evidence.compounds[name].history["max_contact_pressure_N_per_mm2"].iloc[-1])
        for name in edge
    ]
    follows = _rank_correlation(np.array(p), np.array(list(edge.values())))
    return (
        "Rank correlation of the peaks with the highest contact pressure of each run, "
        f"{min(p):.2f} to {max(p):.2f} N/mm²: {follows:+.2f}."
    )


CLAIMS: tuple[Claim, ...] = (
    printed_pressure,
    stress_fields_alike,
    highest_compression_varies,
    highest_tension_varies,
    compression_does_not_follow_stiffness,
    tension_does_not_follow_stiffness,
    van_der_waals_deforms_less,
    van_der_waals_is_less_stiff,
    series_2_deforms_more,
    series_2_stiffens_later,
    late_upturn_is_the_reason,
    load_fits_the_contour,
    material_leaves_temperature_curve,
    curves_follow_deformation,
    material_leaves_T_max,
    load_has_the_lowest_peak,
    load_fits_the_measured_peak,
    mooney_rivlin_fits_the_curve,
    mooney_rivlin_does_not_stiffen,
    mooney_rivlin_deforms_differently,
)
