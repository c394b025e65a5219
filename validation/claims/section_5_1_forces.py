"""Claims of section 5.1 on the friction force: Table 4."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fem.case.rubber import DEFAULT_COMPOUND
from fem.results.result import Result
from validation.claims import experiments
from validation.claims.claim import Claim, Finding, claim
from validation.claims.evidence import HUEMER, Evidence, UnfinishedError
from validation.claims.paper_numbers import SIMILAR, SIMILAR_WORDS, relative_range
from validation.drawing.compound_names import COMPOUND_LOOKS
from validation.paper.table4 import PAPER_N_PER_MM

#: Changes that were run for the two sets at the ends of Table 4.
_CHANGES = {**experiments.CONTACT_PRESSURE, **experiments.NO_SHIFT}


def _force_claim(name: str) -> Claim:
    printed, label = PAPER_N_PER_MM[name], COMPOUND_LOOKS[name].label

    def find(evidence: Evidence) -> Finding:
        return _compare(evidence, name, printed)

    return Claim(
        key=f"force_{name}",
        section="5.1",
        says=f"Table 4: the friction force of {label} is {printed:.2f} kN (1 m deep: N per mm).",
        computed="friction force, mean over the sliding phase",
        find=find,
    )


def _compare(evidence: Evidence, name: str, printed: float) -> Finding:
    result = evidence.compounds[name]
    force = _force(result)
    off = force / printed - 1.0
    holds = abs(off) <= 0.5 * SIMILAR
    return Finding(
        ours=f"{force:.2f} N/mm ({100 * off:+.1f} %)",
        values={"friction_force_N_per_mm": force, "printed_N_per_mm": printed},
        criterion=f"within {50 * SIMILAR:.1f} %, half the range of Table 4, whose forces the paper "
        "calls similar",
        holds=holds,
        explanation="" if holds else _needed_coefficient(evidence, result, printed),
        experiment="" if holds else f"{_force_tried(evidence, name)}{_all_coefficients(evidence)}",
    )


@claim(
    section="5.1",
    says="The friction forces of all sets are similar.",
    computed="range of the six forces over their mean",
)
def forces_are_similar(evidence: Evidence) -> Finding:
    forces = [_force(run) for run in evidence.compounds.values()]
    spread = relative_range(forces)
    return Finding(
        ours=f"{min(forces):.2f} to {max(forces):.2f} N/mm ({100 * spread:.1f} %)",
        values={"relative_range": spread},
        criterion=f"at most {SIMILAR_WORDS}",
        holds=spread <= SIMILAR,
        explanation="" if spread <= SIMILAR else "Our forces differ more than the printed ones.",
    )


@claim(
    section="5.1",
    says='"Yeoh, series 1, load" has the highest friction force and van der Waals, series 2 the '
    "lowest.",
    computed="sets with the highest and the lowest force, and the range of the six",
)
def order_of_forces(evidence: Evidence) -> Finding:
    forces = {name: _force(run) for name, run in evidence.compounds.items()}
    ends, printed = _ends(forces), _ends(PAPER_N_PER_MM)
    holds = ends == printed
    spread, theirs = relative_range(list(forces.values())), SIMILAR
    return Finding(
        ours=f"highest {COMPOUND_LOOKS[ends[1]].label} ({forces[ends[1]]:.3f} N/mm), lowest "
        f"{COMPOUND_LOOKS[ends[0]].label} ({forces[ends[0]]:.3f} N/mm)",
        values={f"friction_force_{name}_N_per_mm": force for name, force in forces.items()},
        criterion="the same two sets",
        holds=holds,
        explanation=""
        if holds
        else f"Our forces differ by {100 * spread:.1f} %, the printed ones by {100 * theirs:.1f} %"
        + (": their order is that of small differences." if spread < 0.5 * theirs else "."),
        experiment="" if holds else f"{_what_the_law_allows(evidence)} {_order_tried(evidence)}",
    )


@claim(
    section="5.1",
    says="The friction forces say more about friction than about the material.",
    computed="range of the force over the six materials, and over two laws at three velocities",
)
def forces_reflect_friction(evidence: Evidence) -> Finding:
    of_materials = relative_range([_force(run) for run in evidence.compounds.values()])
    of_friction = relative_range(
        [_force(run) for laws in evidence.velocities.values() for run in laws.values()]
    )
    holds = of_materials < of_friction
    return Finding(
        ours=f"{100 * of_materials:.1f} % over materials, {100 * of_friction:.1f} % over friction",
        values={"range_over_materials": of_materials, "range_over_friction": of_friction},
        criterion="smaller over the materials",
        holds=holds,
        explanation="" if holds else "The material changes the force more than friction does.",
    )


def _force(result: Result) -> float:
    return float(result.summary["friction_force_N_per_mm"])


def _load(result: Result) -> float:
    return float(result.case.loading.mean_pressure_N_per_mm2 * result.case.block.length_mm)


def _ends(forces: dict[str, float]) -> tuple[str, str]:
    return min(forces, key=forces.__getitem__), max(forces, key=forces.__getitem__)


def _needed_coefficient(evidence: Evidence, result: Result, printed: float) -> str:
    """What friction coefficient the printed force means, and what the law can give."""
    law, load = evidence.friction_laws[1], _load(result)
    p = float(result.summary["mean_contact_pressure_N_per_mm2"])
    peak, needed = float(law.coefficient(p, law.peak_velocity)), printed / load
    words = (
        f"Under {load:.1f} N/mm (20 mm of block, inferred from the middle of this table) the "
        f"printed force means a coefficient of {needed:.3f}; ours is {_force(result) / load:.3f}."
    )
    if needed > peak:
        # p mu(p) is concave, so an uneven pressure gives less than its mean.
        words += (
            f" The law's peak over speed and temperature is {peak:.3f} at our mean contact "
            "pressure: it cannot give the printed force with this load."
        )
    return words


def _all_coefficients(evidence: Evidence) -> str:
    loads = {name: _load(run) for name, run in evidence.compounds.items()}
    parts = [
        f"{COMPOUND_LOOKS[name].label}: {_force(run) / loads[name]:.3f} (printed "
        f"{PAPER_N_PER_MM[name] / loads[name]:.3f})"
        for name, run in evidence.compounds.items()
    ]
    return "Mean coefficients, friction force over load: " + "; ".join(parts) + "."


def _what_the_law_allows(evidence: Evidence) -> str:
    """How much of the printed range the law can give through pressure alone."""
    p = [float(r.summary["mean_contact_pressure_N_per_mm2"]) for r in evidence.compounds.values()]
    v = next(iter(evidence.compounds.values())).case.loading.velocity_mm_per_s
    law = evidence.friction_laws[1]
    mu = [float(law.coefficient(value, v)) for value in (min(p), max(p))]
    return (
        f"The six runs share load, speed and the {HUEMER} law. Their mean contact pressures, "
        f"{min(p):.3f} to {max(p):.3f} N/mm², change its coefficient by "
        f"{100 * abs(mu[0] / mu[1] - 1.0):.1f} %; a range of {100 * SIMILAR:.0f} % at one load "
        "does not come from this law by way of pressure."
        if abs(mu[0] / mu[1] - 1.0) < SIMILAR
        else f"Mean contact pressures from {min(p):.3f} to {max(p):.3f} N/mm² change the "
        f"coefficient of the {HUEMER} law by {100 * abs(mu[0] / mu[1] - 1.0):.1f} %."
    )


def _order_tried(evidence: Evidence) -> str:
    """Force of the two sets at the ends of Table 4 when contact and friction are changed."""
    low, high = _ends(PAPER_N_PER_MM)
    parts = []
    for words, overrides in _CHANGES.items():
        softer, stiffer = (_changed_force(evidence, name, overrides) for name in (low, high))
        order = "the printed order" if softer < stiffer else "not the printed order"
        parts.append(f"{words}: {softer:.3f} and {stiffer:.3f} N/mm, {order}")
    labels = f"{COMPOUND_LOOKS[low].label} and {COMPOUND_LOOKS[high].label}"
    return f"{labels} with {'; '.join(parts)}."


def _force_tried(evidence: Evidence, name: str) -> str:
    """Force of a set at an end of Table 4 when contact and friction are changed."""
    if name not in _ends(PAPER_N_PER_MM):
        return ""
    parts = []
    for words, overrides in _CHANGES.items():
        force = _changed_force(evidence, name, overrides)
        parts.append(f"{words} {force:.2f} N/mm ({force / PAPER_N_PER_MM[name] - 1:+.1%})")
    return f"With {', '.join(parts)}. "


def _changed_force(evidence: Evidence, name: str, overrides: Mapping[str, Any]) -> float:
    """Force with changed keys; NaN, of which no comparison is true, if the run did not end."""
    of_the_set = {} if name == DEFAULT_COMPOUND else {"rubber.compound": name}
    try:
        return _force(evidence.changed({**of_the_set, **overrides}))
    except UnfinishedError:
        return float("nan")


CLAIMS: tuple[Claim, ...] = (
    *(_force_claim(name) for name in PAPER_N_PER_MM),
    forces_are_similar,
    order_of_forces,
    forces_reflect_friction,
)
