"""Claims of section 4.2: the introductory example."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq
from scipy.special import erfc

from fem.results.result import Result
from validation.claims import experiments
from validation.claims.claim import Claim, Finding, claim, unchecked
from validation.claims.evidence import Evidence
from validation.claims.paper_numbers import MEASURED_TO_K
from validation.claims.shape import (
    detached_length,
    extreme_place,
    interior_pressure,
    interior_traction,
    rolled_length,
    stress_extremes,
)
from validation.claims.warmth import (
    cell_rises,
    front_edge_temperature,
    heated_depth,
    rise,
    surface_gradient,
)

#: Share of the block's height below which a layer is called thin: an order of magnitude less.
THIN = 0.1


@claim(
    section="4.2",
    says="0.25 N/mm² on top of the block give a mean contact pressure of 0.3 N/mm².",
    computed="contact force over contact length, mean over the sliding",
)
def mean_contact_pressure(evidence: Evidence) -> Finding:
    result = evidence.introductory
    p, length = _pressure(result), float(result.summary["contact_length_mm"])
    holds = _rounds_to_0_3(result)
    pressing = result.case.loading.mean_pressure_N_per_mm2
    needed = pressing * result.case.block.length_mm / 0.3
    return Finding(
        ours=f"{p:.3f} N/mm², contact over {length:.1f} of {result.case.block.length_mm:g} mm",
        values={"mean_contact_pressure_N_per_mm2": p, "contact_length_mm": length},
        criterion="rounds to the printed 0.3: from 0.25 to 0.35 N/mm²",
        holds=holds,
        explanation=""
        if holds
        else f"0.3 N/mm² needs a contact {needed:.1f} mm long. How much of the bottom leaves the "
        "road depends on the height of the block, and the figure with the paper's is lost.",
        experiment=""
        if holds
        else experiments.tried(
            evidence,
            {**experiments.LOWER_BLOCK, **experiments.FREE_TOP, **experiments.CONTACT_PRESSURE},
            _pressure,
            _rounds_to_0_3,
            "N/mm²",
        ),
    )


@claim(
    section="4.2",
    says="The contact pressure is concentrated at the leading edge.",
    computed="highest contact pressure of the block at the end, and highest one of the bottom "
    "behind its leading fifth",
)
def pressure_concentration(evidence: Evidence) -> Finding:
    result = evidence.introductory
    highest = float(result.history["max_contact_pressure_N_per_mm2"].iloc[-1])
    behind = interior_pressure(result)
    return Finding(
        ours=f"{highest:.2f} N/mm² against {behind:.2f} N/mm² behind the front edge",
        values={
            "highest_pressure_N_per_mm2": highest,
            "highest_pressure_behind_N_per_mm2": behind,
        },
        criterion="the highest pressure is not behind the leading fifth",
        holds=highest > behind,
        explanation=""
        if highest > behind
        else "The highest contact pressure is found behind the leading fifth of the bottom.",
    )


@claim(
    section="4.2",
    says="This pressure makes the block tend to stick at its leading edge.",
    computed="friction traction mu p at the highest contact pressure, and highest traction of the "
    "bottom behind its leading fifth",
)
def edge_is_held_back(evidence: Evidence) -> Finding:
    result = evidence.introductory
    law, sliding = result.case.friction.plain_law(), abs(result.case.loading.velocity_mm_per_s)
    p = float(result.history["max_contact_pressure_N_per_mm2"].iloc[-1])
    edge, behind = float(law.coefficient(p, sliding)) * p, interior_traction(result)
    return Finding(
        ours=f"{edge:.2f} N/mm² against {behind:.2f} N/mm²",
        values={"edge_N_per_mm2": edge, "behind_N_per_mm2": behind},
        criterion="the edge is held back more than the rest: the higher traction",
        holds=edge > behind,
        explanation="" if edge > behind else "The traction behind the leading fifth is higher.",
    )


@claim(
    section="4.2",
    says="The front edge curls under the block.",
    computed="part of the leading face that lies on the road at the end",
)
def front_edge_curls(evidence: Evidence) -> Finding:
    length = rolled_length(evidence.introductory)
    return Finding(
        ours=f"{length:.2f} mm of the leading face on the road",
        values={"rolled_length_mm": length},
        criterion="a part of the leading face, which was vertical, lies on the road",
        holds=length > 0.0,
        explanation="" if length > 0.0 else "The leading face stays off the road.",
    )


@claim(
    section="4.2",
    says="Next to the curled edge the bottom surface loses contact with the road.",
    computed="length of the bottom's leading fifth that is off the road at the end",
)
def front_edge_detaches(evidence: Evidence) -> Finding:
    length = detached_length(evidence.introductory)
    return Finding(
        ours=f"{length:.2f} mm off the road",
        values={"detached_length_mm": length},
        criterion="some of the leading fifth is off the road",
        holds=length > 0.0,
        explanation="" if length > 0.0 else "The leading fifth of the bottom is all in contact.",
    )


@claim(
    section="4.2",
    says="Blocks in the tests deform in the same way as the simulated one.",
    computed="-",
)
def deforms_as_photographed(evidence: Evidence) -> Finding:
    return unchecked("The photograph (Fig. 8a) is not in the text, and it has no numbers.")


@claim(
    section="4.2",
    says="The curled front edge gets a high peak of temperature.",
    computed="highest temperature of the front edge (bottom or rolled face) and of the interior "
    "of the bottom, at the end",
)
def temperature_peak_at_edge(evidence: Evidence) -> Finding:
    result = evidence.introductory
    edge, interior = front_edge_temperature(result), float(result.summary["T_max_C"])
    holds = _edge_is_hottest(result)
    return Finding(
        ours=f"{edge:.1f} °C at the edge, {interior:.1f} °C in the interior",
        values={"T_edge_C": edge, "T_max_C": interior},
        criterion="the front edge is hotter than the interior",
        holds=holds,
        explanation="" if holds else _why_the_edge_is_cool(result),
        experiment=""
        if holds
        else experiments.tried(
            evidence,
            experiments.CONTACT_PRESSURE,
            front_edge_temperature,
            _edge_is_hottest,
            "°C at the edge",
        ),
    )


@claim(
    section="4.2",
    says="The curled front edge gets a high peak of stress.",
    computed="highest vertical compression of all elements and where it is",
)
def stress_peak_at_edge(evidence: Evidence) -> Finding:
    result = evidence.introductory
    stress, (along, up) = stress_extremes(result)[0], extreme_place(result, 0)
    holds = along > 0.8 and up < THIN and -stress > _pressure(result)
    return Finding(
        ours=f"{stress:.2f} N/mm² at {100 * along:.0f} % of the length, {100 * up:.1f} % of the "
        f"height; mean contact pressure {_pressure(result):.2f} N/mm²",
        values={"sigma_y_min_N_per_mm2": stress, "place_along": along, "place_up": up},
        criterion="in the leading fifth and the lowest tenth of the block, and more than the mean "
        "contact pressure",
        holds=holds,
        explanation="" if holds else "The highest compression is elsewhere, or it is no peak.",
    )


@claim(
    section="4.2",
    says="Only a thin layer next to the contact is heated.",
    computed="distance from the bottom at which the rise has fallen to 10 % of the surface's",
)
def heated_layer_is_thin(evidence: Evidence) -> Finding:
    result = evidence.introductory
    depth, height = heated_depth(result), result.case.block.height_mm
    holds = depth < THIN * height
    return Finding(
        ours=f"{depth:.2f} mm of {height:g} mm",
        values={"heated_depth_mm": depth, "height_mm": height},
        criterion="an order of magnitude less than the block's height: below a tenth of it",
        holds=holds,
        explanation="" if holds else "The heat reaches further than a tenth of the height.",
    )


@claim(
    section="4.2",
    says="The temperature gradients in this layer are very steep.",
    computed="gradient at the surface above the hottest point, and the depth over which it would "
    "use up the whole rise",
)
def gradients_are_steep(evidence: Evidence) -> Finding:
    result = evidence.introductory
    gradient, height = surface_gradient(result), result.case.block.height_mm
    used_up = rise(result) / gradient if gradient > 0.0 else float("inf")
    holds = used_up < THIN * height
    return Finding(
        ours=f"{gradient:.0f} K/mm, the rise of {rise(result):.1f} K within {used_up:.2f} mm",
        values={"gradient_K_per_mm": gradient, "used_up_within_mm": used_up},
        criterion="the rise would be used up within a tenth of the block's height",
        holds=holds,
        explanation="" if holds else "The temperature falls more gently than that.",
    )


@claim(
    section="4.2",
    says="The layer is thin because rubber conducts badly and a slide is short.",
    computed="the 10 % depth against that of a half-space under constant heat flux for the same "
    "time, and its growth over the three durations of the study of velocities",
)
def diffusion_sets_the_depth(evidence: Evidence) -> Finding:
    result = evidence.introductory
    depth, expected = heated_depth(result), half_space_depth(result)
    exponent = _growth_exponent(evidence)
    holds = 0.5 < depth / expected < 2.0 and 0.25 < exponent < 0.75
    return Finding(
        ours=f"{depth:.2f} mm, half-space {expected:.2f} mm; depth grows as time to the power of "
        f"{exponent:.2f}",
        values={"heated_depth_mm": depth, "half_space_mm": expected, "exponent": exponent},
        criterion="within a factor of 2 of the half-space, and an exponent nearer to diffusion's "
        "1/2 than to 0 or 1",
        holds=holds,
        explanation="" if holds else "Conduction alone does not set this depth.",
    )


@claim(
    section="4.2",
    says="Heat leaves most of the rubber untouched.",
    computed=f"share of the block's area that is less than {MEASURED_TO_K[1]:g} K warmer than "
    "before",
)
def most_rubber_is_cold(evidence: Evidence) -> Finding:
    rises, area = cell_rises(evidence.introductory)
    share = float(area[rises < MEASURED_TO_K[1]].sum() / area.sum())
    return Finding(
        ours=f"{100 * share:.1f} %",
        values={"cold_share": share},
        criterion=f"more than half ({MEASURED_TO_K[1]:g} K is what the paper could measure)",
        holds=share > 0.5,
        explanation="" if share > 0.5 else "The heated part is the larger one.",
    )


@claim(
    section="4.2",
    says="Material parameters need not depend on temperature, since so little rubber is warm.",
    computed="change of the block's mean modulus, were it proportional to absolute temperature "
    "(entropic), and the smallest difference between two shear moduli of Table 1",
)
def constant_parameters_suffice(evidence: Evidence) -> Finding:
    rises, area = cell_rises(evidence.introductory)
    absolute = 273.15 + evidence.introductory.case.heat.ambient_C
    change = float(np.average(rises, weights=area) / absolute)
    moduli = sorted(model.initial_shear_modulus for model in evidence.rubbers.values())
    smallest = float(np.min(np.array(moduli[1:]) / np.array(moduli[:-1])) - 1.0)
    return Finding(
        ours=f"{100 * change:.2f} % against {100 * smallest:.1f} %",
        values={"modulus_change": change, "smallest_difference": smallest},
        criterion="less than the smallest difference between two parameter sets of the same rubber",
        holds=change < smallest,
        explanation="For the elastic part; the softening of its viscous part with temperature is "
        "not in the model."
        if change < smallest
        else "The rubber as a whole gets warm enough to matter.",
    )


def half_space_depth(result: Result, share: float = 0.1) -> float:
    """Depth at which the rise is a share of the surface's under constant flux [mm].

    The rise is proportional to ierfc(z/(2 sqrt(alpha t))) (Carslaw and Jaeger, Conduction of Heat
    in Solids, 1959, section 2.9), with ierfc(x) = exp(-x^2)/sqrt(pi) - x erfc(x).
    """
    thermal = result.case.rubber.thermal
    diffusivity = thermal.conductivity / (thermal.density * thermal.specific_heat)
    sliding = result.case.loading
    time = sliding.distance_mm / abs(sliding.velocity_mm_per_s)
    at = brentq(lambda x: np.exp(-(x**2)) - np.sqrt(np.pi) * x * erfc(x) - share, 0.0, 5.0)
    return float(2.0 * np.sqrt(diffusivity * time) * at)


def _growth_exponent(evidence: Evidence) -> float:
    runs = {v: next(iter(laws.values())) for v, laws in evidence.velocities.items()}
    time = [run.case.loading.distance_mm / v for v, run in runs.items()]
    depth = [heated_depth(run) for run in runs.values()]
    return float(np.polyfit(np.log(time), np.log(depth), 1)[0])


def _pressure(result: Result) -> float:
    return float(result.summary["mean_contact_pressure_N_per_mm2"])


def _rounds_to_0_3(result: Result) -> bool:
    return 0.25 <= _pressure(result) < 0.35


def _edge_is_hottest(result: Result) -> bool:
    return front_edge_temperature(result) > float(result.summary["T_max_C"])


def _why_the_edge_is_cool(result: Result) -> str:
    p = float(result.history["max_contact_pressure_N_per_mm2"].iloc[-1])
    partition = result.case.heat.partition_object()
    governing = float(partition.governing(p, _pressure(result)))
    kappa = float(partition(governing))
    h = float(result.case.heat.conductance_object().conductance(p))
    return (
        f"Under the edge's highest pressure of {p:.1f} N/mm², eq. (14) turns {100 * kappa:.0f} % "
        f"of the friction into heat (at {governing:.2f} N/mm²) and eq. (11) conducts {h:.0f} "
        "W/(m² K) into road that is still cold; both were identified from pressures near 0.3 N/mm²."
    )


CLAIMS: tuple[Claim, ...] = (
    mean_contact_pressure,
    pressure_concentration,
    edge_is_held_back,
    front_edge_curls,
    front_edge_detaches,
    deforms_as_photographed,
    temperature_peak_at_edge,
    stress_peak_at_edge,
    heated_layer_is_thin,
    gradients_are_steep,
    diffusion_sets_the_depth,
    most_rubber_is_cold,
    constant_parameters_suffice,
)
