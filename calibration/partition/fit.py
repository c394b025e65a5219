"""Identification of the heat partition kappa by resimulating sliding blocks.

As in section 3.4 of the paper, in three steps. A *rigid block*, which takes about a second, gives
a first kappa for every condition (pressure and velocity). The *discrete* estimates are the
constant kappas with which the simulated block, on the case's mesh and with all its couplings,
shows the measured temperatures. The *power law* of eq. (14), at the mean contact pressure or at
whatever `heat.partition.pressure` of the case says, is fitted to the temperatures themselves: the
block is simulated with the law, and the law corrected, until the correction changes no temperature
by more than `TOLERANCE_K`.

Few simulations do, because each of them predicts its neighbours well. The heat that a slide
leaves in the rubber reaches 0.1-0.3 mm deep while pressure and temperature vary over millimetres,
so every point of the surface heats up by the kappa it has: multiplying it by r multiplies the rise
by r^m, with m slightly below one since friction falls with temperature. The rigid block gives m.
A prediction only steers and weighs; what counts is compared with a simulation.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", section 3.4 and eq. (14).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from calibration.fitting import FitResult, Problem, fit
from calibration.partition.data import Condition, PartitionData, ProfileUse, read_partition_data
from calibration.partition.loading import refuse_event
from calibration.partition.simulation_store import SimulationStore
from calibration.partition.slides import (
    CONTACT_SHARE,
    SMALLEST,
    Conditioned,
    PartitionModel,
    RigidEstimate,
    Simulated,
    Trial,
    constant,
    partition_table,
    power,
)
from contact.partition import HeatPartition
from fem.case import Case, CaseError
from fem.files import program_version, version_of
from materials.arrays import FloatArray

NAMES = ("prefactor", "exponent")
LOWER, UPPER = np.array([1e-4, -3.0]), np.array([10.0, 3.0])
#: Simulations per condition at most, and how many of them may go into a discrete estimate.
MOST_SIMULATIONS = 6
MOST_DISCRETE = 3
#: Largest change of a temperature that a correction may still make [K].
TOLERANCE_K = 0.03
#: For the discrete estimates, which only have to lead to the law.
DISCRETE_TOLERANCE_K = 0.2
#: Relative error of the mean contact pressure that is let pass.
PRESSURE_TOLERANCE = 0.005
#: A last correction beyond this, when no simulation is left to confirm it, is warned of [K].
UNCONFIRMED_K = 0.3
#: Reference start of the law where the discrete estimates give none: eq. (14).
PAPER = (0.3146, -0.6833)


@dataclass(frozen=True, kw_only=True)
class PartitionFit:
    """The fitted law with the estimates it came from.

    Attributes
    ----------
    result : FitResult
        Prefactor and exponent; `.model` is the `HeatPartition`.
    data : PartitionData
    discrete : DataFrame
        A row per condition: pressures, velocity, kappa with standard error, kappa of the law at
        the mean contact pressure, simulations.
    simulated : int
        Simulations that were made, not read from the folder.
    """

    result: FitResult
    data: PartitionData
    discrete: pd.DataFrame
    simulated: int


def fit_partition(
    source: str | Path | pd.DataFrame,
    case: Case,
    store: SimulationStore,
    *,
    profile: ProfileUse = "whole",
    simulations: int = MOST_SIMULATIONS,
) -> PartitionFit:
    """Identify the heat partition from surface temperatures of sliding blocks.

    Parameters
    ----------
    source : path or DataFrame
        See `read_partition_data`.
    case : Case
        The block that slid. Its pressure, velocity and partition law are replaced; the cap and all
        the rest count. Of an event the end of the last contact is what was measured.
    store : SimulationStore
        Where simulations are kept.
    profile : {"whole", "peak"}
        What of measured profiles is compared.
    simulations : int
        Simulations per condition at most, not counting rigid blocks; at least 3.

    Returns
    -------
    PartitionFit

    Raises
    ------
    DataError
        For a table that cannot be used.
    SimulationStoppedError
        For a simulation that does not reach its end.
    """
    if simulations < 3:
        raise ValueError(f"{simulations} simulations per condition; expected at least 3")
    _check_case(case)
    data = read_partition_data(source, case, profile=profile)
    model = PartitionModel(case, store)
    most = min(MOST_DISCRETE, simulations - 1)
    # The first condition tells the others, which go side by side, how far off a rigid block is.
    found = _discrete(model, data.conditions[:1], None, most)
    found += _discrete(model, data.conditions[1:], found[0], most)
    result, slides, correction = _law(model, data, found, simulations)
    result = _completed(result, data, case, slides, correction)
    result = replace(result, warnings=(*result.warnings, *_too_hot(found)))
    return PartitionFit(
        result=result,
        data=data,
        discrete=_table(found, slides, result),
        simulated=store.simulated,
    )


def _check_case(case: Case) -> None:
    """Refuse a case whose block cannot warm up, or whose event no measured slide stands for."""
    refuse_event(case)
    if case.heat.partition.cap < SMALLEST:
        expected = f"at least {SMALLEST:g}, a share of the friction power to identify"
        found = f"{case.heat.partition.cap:g}"
        raise CaseError(case.source, "heat.partition.cap", found, expected)
    if not isinstance(case.heat.partition.pressure, str):
        expected = '"mean" or "local": with one fixed pressure the law has no exponent to fit'
        found = f"{case.heat.partition.pressure:g}"
        raise CaseError(case.source, "heat.partition.pressure", found, expected)
    if case.friction.law == "coulomb" and case.friction.constants.get("mu") == 0.0:
        raise CaseError(case.source, "friction.mu", "0", "friction, which makes heat")


# -- discrete estimates ------------------------------------------------------------------------


def _discrete(
    model: PartitionModel, conditions: Sequence[Condition], like: Simulated | None, most: int
) -> list[Simulated]:
    """Constant kappas of some conditions, side by side; `like` is one that is done already."""
    ratio = 1.0 if like is None else like.kappa / like.rigid_kappa
    # Before anything is known: pressure on the top over mean contact pressure.
    first = 1.0 if model.case.block.rigid else CONTACT_SHARE
    share = first if like is None else like.slide.share
    rigids = model.rigid_estimates(conditions)
    trials = [
        Trial(
            condition,
            constant(model.clipped(rigid.kappa * ratio), model.like),
            condition.pressure * (share if condition.of_contact else 1.0),
            rigid.m,
        )
        for condition, rigid in zip(conditions, rigids, strict=True)
    ]
    found: dict[int, Simulated] = {}
    going = list(range(len(trials)))
    for _ in range(most):
        slides = model.simulated([trials[k] for k in going])
        for k, slide in zip(going, slides, strict=True):
            found[k] = _corrected(model, slide, rigids[k])
            law = constant(found[k].kappa, model.like)
            trials[k] = trials[k]._replace(law=law, platen=found[k].platen)
        going = [k for k in going if not found[k].confirmed]
    return [found[k] for k in range(len(trials))]


def _corrected(model: PartitionModel, slide: Conditioned, rigid: RigidEstimate) -> Simulated:
    """What a simulation with a constant kappa says of the kappa that fits."""
    kappa = model.clipped(slide.law.prefactor * slide.misfit_ratio())
    change = slide.largest_change(constant(kappa, model.like))
    pressed = abs(slide.pressure_scale - 1.0) <= PRESSURE_TOLERANCE
    return Simulated(
        slide=slide,
        kappa=kappa,
        rigid_kappa=rigid.kappa,
        m=rigid.m,
        platen=slide.next_platen,
        confirmed=change <= DISCRETE_TOLERANCE_K and pressed,
    )


# -- power law ---------------------------------------------------------------------------------


def _law(
    model: PartitionModel, data: PartitionData, found: Sequence[Simulated], simulations: int
) -> tuple[FitResult, list[Conditioned], float]:
    """Power law whose simulations fit the measurements best.

    Returns the fit, the last simulations, and the largest change [K] that the last correction of
    the law makes to their temperatures.
    """
    rounds = [[estimate.slide for estimate in found]]
    platens = [estimate.platen for estimate in found]
    result = _fit_law(data, rounds, _start(found))
    rounds.clear()
    while True:
        law = power(result.theta, model.like)
        slides = model.simulated(
            [
                Trial(estimate.slide.condition, law, platen, estimate.m)
                for estimate, platen in zip(found, platens, strict=True)
            ]
        )
        rounds.append(slides)
        result = _fit_law(data, rounds, result.theta)
        law = power(result.theta, model.like)
        change = max(slide.largest_change(law) for slide in slides)
        pressed = all(abs(s.pressure_scale - 1.0) <= PRESSURE_TOLERANCE for s in slides)
        if (change <= TOLERANCE_K and pressed) or max(s.number for s in slides) >= simulations:
            return result, slides, change
        platens = [slide.next_platen for slide in slides]


def _start(found: Sequence[Simulated]) -> FloatArray:
    """Line through the discrete estimates over the pressure, both logarithmic [1]_."""
    p = np.log([estimate.slide.contact_pressure for estimate in found])
    kappa = np.log([estimate.kappa for estimate in found])
    if np.ptp(p) < 1e-3:
        return np.array(PAPER)
    exponent, height = np.polyfit(p, kappa, 1)
    return np.clip([np.exp(height), exponent], 2.0 * LOWER.clip(min=-1.0), 0.5 * UPPER)


def _fit_law(
    data: PartitionData, rounds: Sequence[Sequence[Conditioned]], start: FloatArray
) -> FitResult:
    """Fit the law to the measurements through what the slides predict for other laws."""
    like = rounds[0][0].law

    def predict(theta: FloatArray) -> FloatArray:
        law = power(theta, like)
        shares = _nearness(theta, rounds)
        return sum(
            share * np.concatenate([slide.predicted(law) for slide in slides])
            for share, slides in zip(shares, rounds, strict=True)
        )

    problem = Problem(
        names=NAMES,
        predict=predict,
        observed=np.concatenate([condition.observed for condition in data.conditions]),
        weights=np.concatenate([c.weights for c in data.conditions]) if data.has_sigma else None,
        absolute=data.has_sigma,
        lower=LOWER,
        upper=UPPER,
    )
    starts = [start, *(_parameters(slides) for slides in rounds if slides[0].law.exponent != 0.0)]
    return fit(problem, np.array(starts))


def _parameters(slides: Sequence[Conditioned]) -> FloatArray:
    return np.array([slides[0].law.prefactor, slides[0].law.exponent])


def _nearness(theta: FloatArray, rounds: Sequence[Sequence[Conditioned]]) -> FloatArray:
    """Shares of the rounds of simulations in a prediction, by the distance of their laws.

    The distance is the largest difference of ln kappa over the pressures. The prediction is then
    exact at every law that was simulated, and between two of them it learns from both, which
    ends the swings that a cap on part of the contact can cause.
    """
    if len(rounds) == 1:
        return np.ones(1)
    ln_p = np.log([slide.contact_pressure for slide in rounds[-1]])
    height, slope = np.log(theta[0]), theta[1]
    laws = [_parameters(slides) for slides in rounds]
    distance = [np.abs(height - np.log(A) + (slope - n) * ln_p).max() for A, n in laws]
    weights = 1.0 / np.maximum(distance, 1e-6) ** 4
    return np.asarray(weights / weights.sum())


# -- result ------------------------------------------------------------------------------------


def _completed(
    result: FitResult,
    data: PartitionData,
    case: Case,
    slides: Sequence[Conditioned],
    correction: float,
) -> FitResult:
    law = power(result.theta, slides[0].law)
    kind = "surface temperatures" if data.quantity == "T_C" else "highest temperatures"
    metadata: dict[str, Any] = {
        "kind": "partition",
        "model": "kappa = prefactor p^exponent (p in N/mm^2), eq. (14)",
        "fitted_to": kind,
        **data.table.origin,
        "case_sha256": case.hash(),
        "distance_mm": case.loading.distance_mm,
        "pressures_N_per_mm2": sorted({c.pressure for c in data.conditions}),
        "velocities_mm_per_s": sorted({c.velocity for c in data.conditions}),
        "standard_errors_from": "sigma of the data" if data.has_sigma else "scatter about the fit",
        "last_correction_K": correction,
        "version": version_of(),
        "simulated_by": program_version(),
    }
    p = [slide.contact_pressure for slide in slides]
    v = [condition.velocity for condition in data.conditions]
    window = {"p_N_per_mm2": [min(p), max(p)], "v_mm_per_s": [min(v), max(v)]}
    warnings = (*result.warnings, *_warnings(slides, law, correction))
    return replace(
        result,
        model=law,
        metadata=metadata,
        warnings=warnings,
        section={"heat": {"partition": partition_table(law), "window": window}},
    )


def _warnings(slides: Sequence[Conditioned], law: HeatPartition, correction: float) -> list[str]:
    warnings = []
    if correction > UNCONFIRMED_K:
        warnings.append(
            f"the last correction of the law changes temperatures by {correction:.2g} K and no "
            "simulation confirms it: allow more with --simulations"
        )
    capped = [s for s in slides if s.capped_share(law) > 0.5]
    warnings += [
        f"{s.condition.name}: the law is capped at {s.cap:g} on most of the contact, these "
        "temperatures hardly determine it"
        for s in capped
    ]
    missed = [s for s in slides if abs(s.pressure_scale - 1.0) > 4.0 * PRESSURE_TOLERANCE]
    warnings += [
        f"{s.condition.name}: simulated at {s.contact_pressure:.4g} N/mm^2 mean contact pressure"
        for s in missed
    ]
    return warnings


def _too_hot(found: Sequence[Simulated]) -> list[str]:
    """Say which temperatures need all the heat that the cap allows, or more."""
    below = {s.slide.condition.pressure for s in found if s.kappa < s.slide.cap}
    warnings = [
        f"{len(below)} pressure{'' if len(below) == 1 else 's'} with a kappa below the cap: these "
        "data do not determine the law, its standard errors do not hold"
    ]
    return (warnings if len(below) < 2 else []) + [
        f"{estimate.slide.condition.name}: measured warmer than kappa = {estimate.slide.cap:g} "
        "makes the block; check ambient, distance and units"
        for estimate in found
        if estimate.kappa >= estimate.slide.cap and estimate.slide.misfit_ratio() > 1.02
    ]


def _table(
    found: Sequence[Simulated], slides: Sequence[Conditioned], result: FitResult
) -> pd.DataFrame:
    """Discrete estimates with what the law says at the same mean contact pressure."""
    law = result.model
    rows = []
    for estimate, slide in zip(found, slides, strict=True):
        condition, p = slide.condition, slide.contact_pressure
        noise = None if condition.sigma is not None else result.rmse
        rows.append(
            {
                "mean_pressure_N_per_mm2": slide.platen,
                "p_N_per_mm2": p,
                "v_mm_per_s": condition.velocity,
                "kappa": estimate.kappa,
                "kappa_stderr": estimate.slide.kappa_error(estimate.kappa, noise),
                "kappa_rigid_block": estimate.rigid_kappa,
                "kappa_of_law": float(law(p)),
                "measured_C": float(condition.observed.mean()),
                "fit_C": float(slide.predicted(law).mean()),
                "simulations": slide.number,
            }
        )
    return pd.DataFrame(rows)
