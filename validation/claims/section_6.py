"""Claims of section 6: the paper's conclusions."""

from __future__ import annotations

import numpy as np

from validation.claims import experiments
from validation.claims.claim import Claim, Finding, claim, unchecked
from validation.claims.evidence import EXPONENTIAL, HUEMER, Evidence
from validation.claims.paper_numbers import (
    ACCEPTED_K,
    MEASURED_TO_K,
    SIMILAR,
    SIMILAR_WORDS,
    relative_range,
)
from validation.claims.section_5_1 import LOAD, MOONEY_RIVLIN, VAN_DER_WAALS, YEOH
from validation.claims.shape import deformation, largest_stretch
from validation.claims.warmth import rise
from validation.drawing.compound_names import COMPOUND_LOOKS

#: Largest strain of the paper's tests (section 2.2): dumbbells and both series of bars [-].
DUMBBELL_STRAIN, BAR_STRAIN = 0.40, {1: 1.5, 2: 3.0}


@claim(
    section="6",
    says="Frictional heating cannot be studied with mechanics and heat treated apart.",
    computed="T_max of the introductory example with and without the effect of temperature on "
    "friction, the only way in which heat acts on the mechanics",
)
def coupling_matters(evidence: Evidence) -> Finding:
    (overrides,) = experiments.NO_SHIFT.values()
    T = [float(r.summary["T_max_C"]) for r in (evidence.introductory, evidence.changed(overrides))]
    change, limit = abs(T[1] - T[0]), MEASURED_TO_K[1]
    return Finding(
        ours=f"{T[0]:.2f} °C coupled, {T[1]:.2f} °C not",
        values={"T_max_coupled_C": T[0], "T_max_uncoupled_C": T[1]},
        criterion=f"a difference above {limit:g} K, which the paper could measure",
        holds=change > limit,
        explanation=""
        if change > limit
        else "Without the coupling, T_max would be the same as far as one can measure.",
    )


@claim(
    section="6",
    says="The procedure reproduces the tests for a wide range of blocks, compounds, pressures and "
    "velocities.",
    computed="-",
)
def reproduces_the_tests(evidence: Evidence) -> Finding:
    return unchecked("The tests are drawn in figures that are not in the text.")


@claim(
    section="6",
    says="The material model decides how realistically the block deforms.",
    computed="range over the six sets, relative to the mean, of the displacement of the free "
    "contour, the friction force and the rise to T_max",
)
def material_decides_deformation(evidence: Evidence) -> Finding:
    runs = list(evidence.compounds.values())
    ranges = {
        "displacement": relative_range([deformation(run) for run in runs]),
        "friction force": relative_range(
            [float(run.summary["friction_force_N_per_mm"]) for run in runs]
        ),
        "rise": relative_range([rise(run) for run in runs]),
    }
    holds = ranges["displacement"] == max(ranges.values())
    return Finding(
        ours=", ".join(f"{name} {100 * value:.1f} %" for name, value in ranges.items()),
        values={f"range_of_{name.replace(' ', '_')}": v for name, v in ranges.items()},
        criterion="largest for the displacement",
        holds=holds,
        explanation="" if holds else "Another quantity depends on the material more strongly.",
    )


@claim(
    section="6",
    says="Mooney-Rivlin deforms badly because it lacks the stiffening at large strain.",
    computed='mean displacement with "Yeoh, series 1, load", with Mooney-Rivlin, and with a '
    "neo-Hookean rubber, which never stiffens either, as stiff at first as the Yeoh set",
)
def lack_of_stiffening_is_the_reason(evidence: Evidence) -> Finding:
    load, mooney = (deformation(evidence.compounds[name]) for name in (LOAD, MOONEY_RIVLIN))
    without = deformation(evidence.changed(experiments.NEO_HOOKE))
    share = (without - load) / (mooney - load)
    holds = share > 0.5
    moduli = [evidence.rubbers[name].initial_shear_modulus for name in (MOONEY_RIVLIN, LOAD)]
    return Finding(
        ours=f"{load:.3f} mm, {mooney:.3f} mm and {without:.3f} mm: {100 * share:.0f} % of the way",
        values={"load_mm": load, "mooney_rivlin_mm": mooney, "neo_hooke_mm": without},
        criterion="without stiffening, more than half of the way to Mooney-Rivlin",
        holds=holds,
        explanation=""
        if holds
        else f"Mooney-Rivlin's set starts {moduli[0] / moduli[1]:.1f} times as stiff (dumbbells at "
        "small strain), and that is what changes the deformation.",
        experiment=""
        if holds
        else f"A neo-Hookean rubber with G = {moduli[1]:.3f} N/mm²: {without:.3f} mm, "
        f"{abs(without / load - 1):.1%} from the Yeoh set, against {abs(mooney / load - 1):.1%} "
        f"for Mooney-Rivlin with G = {moduli[0]:.3f} N/mm².",
    )


@claim(
    section="6",
    says="The material model affects the numerical stability.",
    computed="Newton iterations and rejected steps of the six runs",
)
def material_affects_stability(evidence: Evidence) -> Finding:
    runs = evidence.compounds
    iterations = [float(run.summary["newton_iterations"]) for run in runs.values()]
    rejected = [int(run.summary.get("rejected_steps") or 0) for run in runs.values()]
    spread = relative_range(iterations)
    holds = spread > SIMILAR
    return Finding(
        ours=f"{min(iterations):.0f} to {max(iterations):.0f} iterations ({100 * spread:.0f} %), "
        f"{min(rejected)} to {max(rejected)} rejected steps",
        values={"fewest": min(iterations), "most": max(iterations), "relative_range": spread},
        criterion=f"iterations vary by more than {SIMILAR_WORDS}",
        holds=holds,
        explanation="" if holds else "This solver takes all six sets with about the same effort.",
    )


@claim(
    section="6",
    says="The test data behind the parameters matter very much for what the model does.",
    computed="mean displacement of the free contour: largest difference between two sets of one "
    "model, and between the two models for one series",
)
def test_data_matter(evidence: Evidence) -> Finding:
    moved = {name: deformation(run) for name, run in evidence.compounds.items()}
    of_data = max(abs(names[1] - names[2]) for names in _by_series(moved))
    yeoh, waals = _by_series(moved)
    of_model = max(abs(yeoh[series] - waals[series]) for series in (1, 2))
    holds = of_data > of_model
    return Finding(
        ours=f"{of_data:.3f} mm between data, {of_model:.3f} mm between models",
        values={"between_data_mm": of_data, "between_models_mm": of_model},
        criterion="larger between the data than between Yeoh and van der Waals",
        holds=holds,
        explanation="" if holds else "The choice of the model matters more than that of the data.",
    )


@claim(
    section="6",
    says="Parameters must come from a test cycle in which the rubber has become stable.",
    computed="-",
)
def stable_cycle_is_needed(evidence: Evidence) -> Finding:
    return unchecked("The test cycles are drawn in Figs. 2 and 3 only, which are not in the text.")


@claim(
    section="6",
    says="The tests must cover the strains of the simulation.",
    computed="largest principal strain in each run, and the largest strain of the tests its "
    "parameters come from",
)
def tests_must_cover_the_strain(evidence: Evidence) -> Finding:
    strain = {name: largest_stretch(run) - 1.0 for name, run in evidence.compounds.items()}
    tested = {name: _tested_strain(name) for name in strain}
    beyond = [name for name in strain if strain[name] > tested[name]]
    holds = bool(beyond)
    return Finding(
        ours=", ".join(
            f"{COMPOUND_LOOKS[n].label} {100 * strain[n]:.0f} % (tested {100 * tested[n]:.0f} %)"
            for n in strain
        ),
        values={f"largest_strain_{name}": value for name, value in strain.items()},
        criterion="at least one set is used beyond the strain of its tests",
        holds=holds,
        explanation=f"Beyond: {', '.join(COMPOUND_LOOKS[name].label for name in beyond)}."
        if holds
        else "All strains lie within the range of the tests.",
    )


@claim(
    section="6",
    says="The friction law has no significant effect on the thermal results.",
    computed="largest difference of T_max and of A_T between the laws over two compounds, three "
    "pressures and three velocities",
)
def law_leaves_heat(evidence: Evidence) -> Finding:
    pairs = [
        (laws[HUEMER].summary, laws[EXPONENTIAL].summary) for laws in evidence.pressures.values()
    ]
    T = max(abs(float(a["T_max_C"]) - float(b["T_max_C"])) for a, b in pairs)
    area = max(abs(float(a["A_T_K_mm"]) / float(b["A_T_K_mm"]) - 1.0) for a, b in pairs)
    holds = T <= ACCEPTED_K and area <= SIMILAR
    return Finding(
        ours=f"{T:.2f} K in T_max, {100 * area:.1f} % in A_T",
        values={"T_max_K": T, "A_T": area},
        criterion=f"T_max: {ACCEPTED_K:g} K, the deviation the paper accepts; A_T: {SIMILAR_WORDS}",
        holds=holds,
        explanation=""
        if holds
        else _what_differs({"T_max": T > ACCEPTED_K, "A_T": area > SIMILAR}),
    )


@claim(
    section="6",
    says="The friction law has no significant effect on the mechanical results.",
    computed="largest difference of friction force, contact length and mean displacement between "
    "the laws at the three velocities",
)
def law_leaves_mechanics(evidence: Evidence) -> Finding:
    pairs = [(laws[HUEMER], laws[EXPONENTIAL]) for laws in evidence.velocities.values()]
    found = {
        "friction force": [
            run.summary["friction_force_N_per_mm"] for pair in pairs for run in pair
        ],
        "contact length": [run.summary["contact_length_mm"] for pair in pairs for run in pair],
        "displacement": [deformation(run) for pair in pairs for run in pair],
    }
    off = {
        name: float(np.abs(np.array(values[::2]) / np.array(values[1::2]) - 1.0).max())
        for name, values in found.items()
    }
    holds = max(off.values()) <= SIMILAR
    return Finding(
        ours=", ".join(f"{name} {100 * value:.1f} %" for name, value in off.items()),
        values={name.replace(" ", "_"): value for name, value in off.items()},
        criterion=f"each at most {SIMILAR_WORDS}",
        holds=holds,
        explanation=""
        if holds
        else _what_differs({name: value > SIMILAR for name, value in off.items()}),
    )


@claim(
    section="6",
    says="A viscoelastic, damaging material would improve the results, most of all where strains "
    "are high.",
    computed="-",
)
def viscoelasticity_would_help(evidence: Evidence) -> Finding:
    return unchecked("No relaxation data are printed, nor measurements to see an improvement by.")


def _by_series(moved: dict[str, float]) -> tuple[dict[int, float], dict[int, float]]:
    yeoh, waals = (
        {series: moved[name] for series, name in names.items()} for names in (YEOH, VAN_DER_WAALS)
    )
    return yeoh, waals


def _tested_strain(name: str) -> float:
    if name == MOONEY_RIVLIN:
        return DUMBBELL_STRAIN
    return BAR_STRAIN[2] if "series-2" in name else BAR_STRAIN[1]


def _what_differs(beyond: dict[str, bool]) -> str:
    return f"Beyond the threshold: {', '.join(name for name, is_so in beyond.items() if is_so)}."


CLAIMS: tuple[Claim, ...] = (
    coupling_matters,
    reproduces_the_tests,
    material_decides_deformation,
    lack_of_stiffening_is_the_reason,
    material_affects_stability,
    test_data_matter,
    stable_cycle_is_needed,
    tests_must_cover_the_strain,
    law_leaves_heat,
    law_leaves_mechanics,
    viscoelasticity_would_help,
)
