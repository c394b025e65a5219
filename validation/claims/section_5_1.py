"""Numbers behind the claims of section 5.1: influence of the material."""

from functools import partial
from itertools import combinations
from typing import Any

import numpy as np

from fem.case import DEFAULT_COMPOUND
from fem.results import Result
from validation.analysis import (
    CRITICAL_RANK_CORRELATION,
    MEASURED_TO_K,
    PAPER_N_PER_MM,
    SIMILAR,
    ends,
    names_at_ends,
    number,
    numbers,
    rank_correlation,
    relative_range,
    rubber_curves,
    secant_shear_modulus,
    shape,
    warmth,
)
from validation.claims.claim import Numbers
from validation.claims.evidence import (
    LOAD,
    MOONEY_RIVLIN,
    VAN_DER_WAALS,
    YEOH,
    Evidence,
    UnfinishedError,
)
from validation.claims.statements import CHANGES, case_keys
from validation.drawing import COMPOUND_LOOKS, last_state

_MODELS = {"Yeoh": YEOH, "van der Waals": VAN_DER_WAALS}
_OF_BARS = [*YEOH.values(), *VAN_DER_WAALS.values()]
_FORCE = "friction_force_N_per_mm"


def stress_fields_alike(evidence: Evidence) -> Numbers:
    fields = [last_state(run).snapshot.cauchy_stress[:, 1] for run in evidence.compounds.values()]
    lowest = min(rank_correlation(a, b) for a, b in combinations(fields, 2))
    return {"lowest_rank_correlation": lowest}, {}


def _variation(evidence: Evidence, which: int) -> Numbers:
    found = [shape.stress_extremes(run)[which] for run in evidence.compounds.values()]
    extreme = partial(_away_from_the_platen, evidence, which)
    others = {"lowest": min(found), "highest": max(found), "extreme": extreme}
    return {"relative_range": relative_range(found)}, others


highest_compression_varies = partial(_variation, which=0)
highest_tension_varies = partial(_variation, which=1)


def _following(evidence: Evidence, which: int) -> Numbers:
    size = np.abs([shape.stress_extremes(run)[which] for run in evidence.compounds.values()])
    follows = rank_correlation(size, list(_moved(evidence).values()))
    others = {
        "size": abs(follows),
        "grows_or_falls": "grows" if follows > 0.0 else "falls",
        "extreme": partial(_away_from_the_platen, evidence, which),
    }
    return {"rank_correlation": follows}, others


compression_does_not_follow_stiffness = partial(_following, which=0)
tension_does_not_follow_stiffness = partial(_following, which=1)


def van_der_waals_deforms_less(evidence: Evidence) -> Numbers:
    models, moved = {"van_der_waals": VAN_DER_WAALS, "yeoh": YEOH}, _moved(evidence)
    values = {
        f"{model}_series_{n}_mm": moved[names[n]] for n in (1, 2) for model, names in models.items()
    }
    against = [n for n in (1, 2) if not moved[VAN_DER_WAALS[n]] < moved[YEOH[n]]]
    softness = {str(n): 1.0 - _stiffness_ratio(evidence, n) for n in against}
    return values, {
        "softer_or_not": "softer" if min(softness.values(), default=0.0) > 0.0 else "not_softer",
        "softness": softness,
        "tried": lambda: {str(n): _softness(evidence, n) for n in against},
    }


def van_der_waals_is_less_stiff(evidence: Evidence) -> Numbers:
    ratios = {f"ratio_series_{n}": _stiffness_ratio(evidence, n) for n in (1, 2)}
    return ratios, {"moduli": partial(_moduli, evidence, _OF_BARS)}


def series_2_deforms_more(evidence: Evidence) -> Numbers:
    moved = _moved(evidence)
    values = {
        f"{model}_series_{n}_mm": moved[name]
        for model, names in _MODELS.items()
        for n, name in names.items()
    }
    return values, {"moduli": partial(_moduli, evidence, _OF_BARS)}


def series_2_stiffens_later(evidence: Evidence) -> Numbers:
    return {
        f"upturn_{name}": rubber_curves.upturn_stretch(evidence.rubbers[name]) for name in _OF_BARS
    }, {}


def late_upturn_is_the_reason(evidence: Evidence) -> Numbers:
    found = {}
    for model, names in _MODELS.items():
        one, two = (evidence.rubbers[names[series]] for series in (1, 2))
        shear = shape.amount_of_shear(evidence.compounds[names[1]])
        found[f"{model}_a"] = two.initial_shear_modulus / one.initial_shear_modulus
        found[f"{model}_b"] = secant_shear_modulus(two, shear) / secant_shear_modulus(one, shear)
    return found, {"displacement_ratios": partial(_displacement_ratios, evidence)}


def material_leaves_temperature_curve(evidence: Evidence) -> Numbers:
    runs = evidence.compounds
    means = {(a, b): warmth.mean_difference(runs[a], runs[b]) for a, b in combinations(runs, 2)}
    (one, other), most = max(means.items(), key=lambda item: item[1])
    without = max(value for pair, value in means.items() if MOONEY_RIVLIN not in pair)
    follows = _area_follows_deformation(evidence)
    by_deformation = abs(follows) >= CRITICAL_RANK_CORRELATION
    return {"largest_mean_difference_K": most, "among_bars_K": without}, {
        "one": label(one),
        "other": label(other),
        "follows": follows,
        "by_deformation_or_not": "by_deformation" if by_deformation else "not_by_deformation",
        "less_or_more": "less" if follows < 0.0 else "more",
        "difference": partial(warmth.curve_difference, runs[one], runs[other]),
    }


def curves_follow_deformation(evidence: Evidence) -> Numbers:
    follows = _area_follows_deformation(evidence)
    return {"rank_correlation": follows}, {"size": abs(follows)}


def material_leaves_T_max(evidence: Evidence) -> Numbers:
    runs = list(evidence.compounds.values())
    lowest, highest = ends(numbers(runs, "T_max_C"))
    anywhere = float(np.ptp(warmth.profiles(runs), axis=0).max())
    values = {"range_of_T_max_K": highest - lowest, "largest_range_K": anywhere}
    return values, {"lowest": lowest, "highest": highest}


def load_has_the_lowest_peak(evidence: Evidence) -> Numbers:
    bars = {name: run for name, run in evidence.compounds.items() if name != MOONEY_RIVLIN}
    edge = {name: number(run, "T_edge_C") for name, run in bars.items()}
    p = [shape.highest_pressure(run) for run in bars.values()]
    return {f"front_edge_{name}_C": value for name, value in edge.items()}, {
        "load_C": edge[LOAD],
        "lowest_of_the_others_C": min(T for name, T in edge.items() if name != LOAD),
        "edge": {label(name): value for name, value in edge.items()},
        "lowest": label(names_at_ends(edge)[0]),
        "reading": partial(_as_interior_maximum, bars),
        "pressures": {"ends": ends(p), "follows": rank_correlation(p, list(edge.values()))},
    }


def mooney_rivlin_does_not_stiffen(evidence: Evidence) -> Numbers:
    found = {name: rubber_curves.stiffening(model) for name, model in evidence.rubbers.items()}
    others = min(value for name, value in found.items() if name != MOONEY_RIVLIN)
    values = {f"stiffening_{name}": value for name, value in found.items()}
    return values, {"mooney_rivlin": found[MOONEY_RIVLIN], "least_of_the_others": others}


def mooney_rivlin_deforms_differently(evidence: Evidence) -> Numbers:
    moved = _moved(evidence)
    off = {name: value / moved[LOAD] - 1.0 for name, value in moved.items() if name != LOAD}
    farther = [label(name) for name in off if abs(off[name]) > abs(off[MOONEY_RIVLIN])]
    return {f"displacement_{name}_mm": value for name, value in moved.items()}, {
        "mooney_rivlin_is_off": abs(off[MOONEY_RIVLIN]),
        "off": {label(name): value for name, value in off.items()},
        "also": "also_far" if farther else "",
        "farther": ", ".join(farther),
        "moduli": partial(_moduli, evidence, list(moved)),
    }


def force(evidence: Evidence, name: str) -> Numbers:
    run, printed = evidence.compounds[name], PAPER_N_PER_MM[name]
    found, load, law = number(run, _FORCE), _load(run), evidence.friction_laws[1]
    p = number(run, "mean_contact_pressure_N_per_mm2")
    # p mu(p) is concave, so an uneven pressure gives less than its mean.
    peak, off = float(law.coefficient(p, law.peak_velocity)), found / printed - 1.0
    return {_FORCE: found, "printed_N_per_mm": printed}, {
        "off": off,
        "off_by": abs(off),
        "load": load,
        "needed": printed / load,
        "own": found / load,
        "peak": peak,
        "whether_possible": "cannot_give" if printed / load > peak else "",
        "whether_tried": "forces_tried" if name in names_at_ends(PAPER_N_PER_MM) else "",
        "of_changes": lambda: {
            words: {"force": changed, "off": 100.0 * (changed / printed - 1.0)}
            for words, (changed,) in _changed_forces(evidence, name).items()
        },
        "coefficients": partial(_coefficients, evidence),
    }


def forces_are_similar(evidence: Evidence) -> Numbers:
    forces = numbers(evidence.compounds.values(), _FORCE)
    lowest, highest = ends(forces)
    return {"relative_range": relative_range(forces)}, {"lowest": lowest, "highest": highest}


def order_of_forces(evidence: Evidence) -> Numbers:
    forces = {name: number(run, _FORCE) for name, run in evidence.compounds.items()}
    at_ends, spread = names_at_ends(forces), relative_range(forces.values())
    pressures = ends(numbers(evidence.compounds.values(), "mean_contact_pressure_N_per_mm2"))
    v = next(iter(evidence.compounds.values())).case.loading.velocity_mm_per_s
    mu = [float(evidence.friction_laws[1].coefficient(p, v)) for p in pressures]
    mu_changes = abs(mu[0] / mu[1] - 1.0)
    printed = names_at_ends(PAPER_N_PER_MM)
    return {f"friction_force_{name}_N_per_mm": value for name, value in forces.items()}, {
        "lowest": COMPOUND_LOOKS[at_ends[0]].label,
        "highest": COMPOUND_LOOKS[at_ends[1]].label,
        "printed_lowest": COMPOUND_LOOKS[printed[0]].label,
        "printed_highest": COMPOUND_LOOKS[printed[1]].label,
        "smallest": forces[at_ends[0]],
        "largest": forces[at_ends[1]],
        "spread": spread,
        "how_different": "small_differences" if spread < 0.5 * SIMILAR else "full_stop",
        "pressures": pressures,
        "mu_changes": mu_changes,
        "what_the_law_allows": "law_cannot" if mu_changes < SIMILAR else "law_can",
        "of_changes": lambda: {
            words: {"low": low, "high": high, "order": "" if low < high else "not "}
            for words, (low, high) in _changed_forces(evidence, *printed).items()
        },
    }


def forces_reflect_friction(evidence: Evidence) -> Numbers:
    sliding = [run for laws in evidence.velocities.values() for run in laws.values()]
    return {
        "range_over_materials": relative_range(numbers(evidence.compounds.values(), _FORCE)),
        "range_over_friction": relative_range(numbers(sliding, _FORCE)),
    }, {}


def label(name: str) -> str:
    return COMPOUND_LOOKS[name].label.replace(", bars", "")


def _moved(evidence: Evidence) -> dict[str, float]:
    return {name: shape.deformation(run) for name, run in evidence.compounds.items()}


def _load(run: Result) -> float:
    return float(run.case.loading.mean_pressure_N_per_mm2 * run.case.block.length_mm)


def _area_follows_deformation(evidence: Evidence) -> float:
    """Rank correlation of A_T with the shape.deformation over the sets [-]."""
    area = numbers(evidence.compounds.values(), "A_T_K_mm")
    return rank_correlation(area, list(_moved(evidence).values()))


def _away_from_the_platen(evidence: Evidence, which: int) -> dict[str, Any]:
    """Where the extreme is, and what the lower half of the block has instead."""
    runs = list(evidence.compounds.values())
    along, up = zip(*(shape.extreme_place(run, which) for run in runs), strict=True)
    lower = [shape.stress_extremes(run, below=0.5)[which] for run in runs]
    return {
        "along": ends(along),
        "up": ends(up),
        "lower": ends(lower),
        "spread": relative_range(lower),
        "follows": rank_correlation(np.abs(lower), list(_moved(evidence).values())),
    }


def _stiffness_ratio(evidence: Evidence, series: int) -> float:
    """Secant shear modulus of van der Waals over that of Yeoh at the Yeoh block's shear [-]."""
    shear = shape.amount_of_shear(evidence.compounds[YEOH[series]])
    waals, yeoh = (evidence.rubbers[names[series]] for names in (VAN_DER_WAALS, YEOH))
    return secant_shear_modulus(waals, shear) / secant_shear_modulus(yeoh, shear)


def _moduli(evidence: Evidence, names: list[str]) -> dict[str, dict[str, float]]:
    """Secant shear modulus at the block's mean shear, and the initial one, by label [N/mm^2]."""
    found = {}
    for name in names:
        shear, model = shape.amount_of_shear(evidence.compounds[name]), evidence.rubbers[name]
        secant = secant_shear_modulus(model, shear)
        found[label(name)] = {"secant": secant, "G": model.initial_shear_modulus}
    return found


def _softness(evidence: Evidence, series: int) -> dict[str, Any]:
    """Moduli of both models of a series, and where van der Waals is the stiffer one."""
    names = [YEOH[series], VAN_DER_WAALS[series]]
    yeoh, waals = _moduli(evidence, names).values()
    higher = rubber_curves.stiffer_ranges(evidence.rubbers[names[1]], evidence.rubbers[names[0]])
    ranges = " and ".join(f"{low:.2f} to {high:.2f}" for low, high in higher)
    return {
        "yeoh": yeoh["secant"],
        "yeoh_G": yeoh["G"],
        "waals": waals["secant"],
        "waals_G": waals["G"],
        "where": f"an amount of shear of {ranges}" if ranges else "no amount of shear",
        "shear": shape.amount_of_shear(evidence.compounds[YEOH[series]]),
    }


def _displacement_ratios(evidence: Evidence) -> dict[str, dict[str, float]]:
    """Displacement of series 2 over series 1, and what the initial moduli alone let expect."""
    moved = _moved(evidence)
    G = {name: model.initial_shear_modulus for name, model in evidence.rubbers.items()}
    return {
        model: {"moved": moved[names[2]] / moved[names[1]], "G": G[names[1]] / G[names[2]]}
        for model, names in _MODELS.items()
    }


def _as_interior_maximum(bars: dict[str, Result]) -> dict[str, Any]:
    """What the claim about peaks would come to if the paper meant the interior maximum."""
    T = {name: number(run, "T_max_C") for name, run in bars.items()}
    (lowest, _), (low, high) = names_at_ends(T), ends(T.values())
    return {
        "verdict": "hold" if lowest == LOAD else "differ",
        "lowest": label(lowest),
        "apart": high - low,
        "able": "less" if high - low < MEASURED_TO_K[0] else "not less",
    }


def _coefficients(evidence: Evidence) -> dict[str, dict[str, float]]:
    """Friction force over load of every set, ours and the printed one."""
    return {
        COMPOUND_LOOKS[name].label: {
            "own": number(run, _FORCE) / _load(run),
            "printed": PAPER_N_PER_MM[name] / _load(run),
        }
        for name, run in evidence.compounds.items()
    }


def _changed_forces(evidence: Evidence, *names: str) -> dict[str, list[float]]:
    """Forces of some sets when contact and friction are changed, by the words for the change."""
    changes = ("local_partition", "even_conductance", "both", "no_shift")
    return {
        CHANGES[change]["words"]: [_changed_force(evidence, name, change) for name in names]
        for change in changes
    }


def _changed_force(evidence: Evidence, name: str, change: str) -> float:
    """Force of a changed run; NaN, of which no comparison is true, if it did not end."""
    of_the_set = {} if name == DEFAULT_COMPOUND else {"rubber.compound": name}
    try:
        return number(evidence.changed({**of_the_set, **case_keys(change)}), _FORCE)
    except UnfinishedError:
        return float("nan")
