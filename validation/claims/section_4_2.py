"""Numbers behind the claims of section 4.2: the introductory example."""

from functools import partial

import numpy as np

from contact import InterfaceState
from fem.results import Result
from materials.units import ABSOLUTE_ZERO_C
from validation.analysis import MEASURED_TO_K, number, shape, warmth
from validation.claims.claim import Numbers
from validation.claims.evidence import Evidence

_PRESSURE, _LENGTH = "mean_contact_pressure_N_per_mm2", "contact_length_mm"


def mean_contact_pressure(evidence: Evidence) -> Numbers:
    run = evidence.introductory
    block = run.case.block.length_mm
    needed = run.case.loading.mean_pressure_N_per_mm2 * block / 0.3
    values = {_PRESSURE: number(run, _PRESSURE), _LENGTH: number(run, _LENGTH)}
    return values, {"block_mm": block, "needed_mm": needed}


def pressure_concentration(evidence: Evidence) -> Numbers:
    run = evidence.introductory
    return {
        "highest_pressure_N_per_mm2": shape.highest_pressure(run),
        "highest_pressure_behind_N_per_mm2": shape.interior_pressure(run),
    }, {}


def edge_is_held_back(evidence: Evidence) -> Numbers:
    run = evidence.introductory
    law, sliding = run.case.friction.plain_law(), abs(run.case.loading.velocity_mm_per_s)
    p = shape.highest_pressure(run)
    edge = float(law.coefficient(p, sliding)) * p
    return {
        "edge_N_per_mm2": edge,
        "behind_N_per_mm2": shape.highest_behind(run, "shear_N_per_mm2"),
    }, {}


def front_edge_curls(evidence: Evidence) -> Numbers:
    return {"rolled_length_mm": shape.rolled_length(evidence.introductory)}, {}


def front_edge_detaches(evidence: Evidence) -> Numbers:
    return {"detached_length_mm": shape.detached_length(evidence.introductory)}, {}


def temperature_peak_at_edge(evidence: Evidence) -> Numbers:
    run = evidence.introductory
    values = {key: number(run, key) for key in ("T_edge_C", "T_max_C")}
    return values, {"edge": partial(_under_the_edge, run)}


def stress_peak_at_edge(evidence: Evidence) -> Numbers:
    run = evidence.introductory
    stress, (along, up) = shape.stress_extremes(run)[0], shape.extreme_place(run, 0)
    values = {"sigma_y_min_N_per_mm2": stress, "place_along": along, "place_up": up}
    return values, {"compression": -stress, "pressure": number(run, _PRESSURE)}


def heated_layer_is_thin(evidence: Evidence) -> Numbers:
    run = evidence.introductory
    return {"heated_depth_mm": warmth.heated_depth(run), "height_mm": run.case.block.height_mm}, {}


def gradients_are_steep(evidence: Evidence) -> Numbers:
    run = evidence.introductory
    gradient = warmth.surface_gradient(run)
    used_up = warmth.rise(run) / gradient if gradient > 0.0 else float("inf")
    values = {"gradient_K_per_mm": gradient, "used_up_within_mm": used_up}
    return values, {"rise_K": warmth.rise(run), "height_mm": run.case.block.height_mm}


def diffusion_sets_the_depth(evidence: Evidence) -> Numbers:
    run = evidence.introductory
    depth, expected = warmth.heated_depth(run), warmth.half_space_depth(run)
    slides = {v: next(iter(laws.values())) for v, laws in evidence.velocities.items()}
    time = [slide.case.loading.distance_mm / v for v, slide in slides.items()]
    depths = [warmth.heated_depth(slide) for slide in slides.values()]
    exponent = float(np.polyfit(np.log(time), np.log(depths), 1)[0])
    values = {"heated_depth_mm": depth, "half_space_mm": expected, "exponent": exponent}
    return values, {"ratio": depth / expected}


def most_rubber_is_cold(evidence: Evidence) -> Numbers:
    rises, area = warmth.cell_rises(evidence.introductory)
    return {"cold_share": float(area[rises < MEASURED_TO_K[1]].sum() / area.sum())}, {}


def constant_parameters_suffice(evidence: Evidence) -> Numbers:
    rises, area = warmth.cell_rises(evidence.introductory)
    absolute = evidence.introductory.case.heat.ambient_C - ABSOLUTE_ZERO_C
    moduli = np.sort([model.initial_shear_modulus for model in evidence.rubbers.values()])
    return {
        "modulus_change": float(np.average(rises, weights=area) / absolute),
        "smallest_difference": float(np.min(moduli[1:] / moduli[:-1])) - 1.0,
    }, {}


def _under_the_edge(run: Result) -> dict[str, float]:
    """Pressure, heat partition and gap conductance where the pressure is highest."""
    p = shape.highest_pressure(run)
    partition = run.case.heat.partition_object()
    governing = float(
        partition.governing(InterfaceState(p=p, mean_pressure=number(run, _PRESSURE)))
    )
    h = float(run.case.heat.conductance_object().conductance(p))
    return {"p": p, "governing": governing, "kappa": float(partition(governing)), "h": h}
