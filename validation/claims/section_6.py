"""Numbers behind the claims of section 6: the paper's conclusions."""

from validation.analysis import (
    BAR_STRAIN,
    DUMBBELL_STRAIN,
    ends,
    number,
    numbers,
    relative_range,
    shape,
    warmth,
)
from validation.claims.claim import Numbers
from validation.claims.evidence import (
    EXPONENTIAL,
    HUEMER,
    LOAD,
    MOONEY_RIVLIN,
    VAN_DER_WAALS,
    YEOH,
    Evidence,
)
from validation.claims.statements import case_keys
from validation.drawing import COMPOUND_LOOKS


def coupling_matters(evidence: Evidence) -> Numbers:
    runs = (evidence.introductory, evidence.changed(case_keys("no_shift")))
    coupled, not_coupled = numbers(runs, "T_max_C")
    values = {"T_max_coupled_C": coupled, "T_max_uncoupled_C": not_coupled}
    return values, {"change_K": abs(not_coupled - coupled)}


def material_decides_deformation(evidence: Evidence) -> Numbers:
    runs = list(evidence.compounds.values())
    return {
        "range_of_displacement": relative_range(map(shape.deformation, runs)),
        "range_of_friction_force": relative_range(numbers(runs, "friction_force_N_per_mm")),
        "range_of_rise": relative_range(map(warmth.rise, runs)),
    }, {}


def lack_of_stiffening_is_the_reason(evidence: Evidence) -> Numbers:
    load, mooney = (shape.deformation(evidence.compounds[name]) for name in (LOAD, MOONEY_RIVLIN))
    without = shape.deformation(evidence.changed(case_keys("neo_hooke")))
    G = {name: evidence.rubbers[name].initial_shear_modulus for name in (LOAD, MOONEY_RIVLIN)}
    return {"load_mm": load, "mooney_rivlin_mm": mooney, "neo_hooke_mm": without}, {
        "share": (without - load) / (mooney - load),
        "times_as_stiff": G[MOONEY_RIVLIN] / G[LOAD],
        "load_G": G[LOAD],
        "mooney_rivlin_G": G[MOONEY_RIVLIN],
        "neo_hooke_off": abs(without / load - 1.0),
        "mooney_rivlin_off": abs(mooney / load - 1.0),
    }


def material_affects_stability(evidence: Evidence) -> Numbers:
    runs = evidence.compounds.values()
    iterations = numbers(runs, "newton_iterations")
    fewest, most = ends(iterations)
    rejected = [int(run.summary.get("rejected_steps") or 0) for run in runs]
    values = {"fewest": fewest, "most": most, "relative_range": relative_range(iterations)}
    return values, {"fewest_rejected": min(rejected), "most_rejected": max(rejected)}


def test_data_matter(evidence: Evidence) -> Numbers:
    yeoh, waals = (
        {n: shape.deformation(evidence.compounds[name]) for n, name in names.items()}
        for names in (YEOH, VAN_DER_WAALS)
    )
    return {
        "between_data_mm": max(abs(moved[1] - moved[2]) for moved in (yeoh, waals)),
        "between_models_mm": max(abs(yeoh[n] - waals[n]) for n in (1, 2)),
    }, {}


def tests_must_cover_the_strain(evidence: Evidence) -> Numbers:
    strain = {name: shape.largest_stretch(run) - 1.0 for name, run in evidence.compounds.items()}
    beyond = [name for name in strain if strain[name] > _tested_strain(name)]
    return {f"largest_strain_{name}": value for name, value in strain.items()}, {
        "sets_beyond": len(beyond),
        "beyond": ", ".join(COMPOUND_LOOKS[name].label for name in beyond),
        "strains": {
            COMPOUND_LOOKS[name].label: {
                "strain": 100.0 * value,
                "tested": 100.0 * _tested_strain(name),
            }
            for name, value in strain.items()
        },
    }


def law_leaves_heat(evidence: Evidence) -> Numbers:
    pairs = [(laws[HUEMER], laws[EXPONENTIAL]) for laws in evidence.pressures.values()]
    T = max(abs(number(a, "T_max_C") - number(b, "T_max_C")) for a, b in pairs)
    area = max(abs(number(a, "A_T_K_mm") / number(b, "A_T_K_mm") - 1.0) for a, b in pairs)
    return {"T_max_K": T, "A_T": area}, {"T_max": T}


def law_leaves_mechanics(evidence: Evidence) -> Numbers:
    pairs = [(laws[HUEMER], laws[EXPONENTIAL]) for laws in evidence.velocities.values()]
    off = {
        name: max(abs(of(a) / of(b) - 1.0) for a, b in pairs) for name, of in shape.BEARING.items()
    }
    return {name.replace(" ", "_"): value for name, value in off.items()}, off


def _tested_strain(name: str) -> float:
    if name == MOONEY_RIVLIN:
        return DUMBBELL_STRAIN
    return BAR_STRAIN[2] if "series-2" in name else BAR_STRAIN[1]
