"""Fit of an elastic law with Maxwell branches to stress histories."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from calibration.data import DataError
from calibration.fitting import FitResult, Loss, fit, stage
from calibration.memory.histories import Histories, branch_responses, time_range
from calibration.memory.spectrum import (
    Candidate,
    MemoryCurve,
    branch_names,
    candidates,
    fewest,
    memory_problem,
)
from calibration.rubber import (
    STRESS_MODELS,
    Kinematics,
    StressModel,
    completed_rubber,
    fitted_energy,
)
from fem.files import version_of
from materials.arrays import FloatArray
from materials.prony import Prony
from materials.wlf import WLF

Weighting = Literal["equal", "tests"]

_SMALL = 1e-6  # strain at which the slow shear modulus is read off the stress
_CORRELATED = 0.5  # share of independent points below which it is said
_STARTS = 8  # slow curves that the grid of relaxation times is tried with


@dataclass(frozen=True, kw_only=True)
class HistoryFit:
    """What a fit of histories works on."""

    law: StressModel
    model: str
    data: Histories
    shift: WLF | None
    T_ref_C: float
    weights: Weighting

    @cached_property
    def tau_s(self) -> tuple[float, float]:
        """Relaxation times that the tests can tell [s]."""
        return time_range(self.data)

    @cached_property
    def branch(self) -> Callable[[FloatArray], tuple[FloatArray, FloatArray]]:
        """Responses to branches of modulus 1 (see `branch_responses`)."""
        return branch_responses(self.data, self.tau_s, self.shift, self.T_ref_C)

    def curve(self, held: Mapping[str, float], *, narrow: bool = False) -> MemoryCurve:
        """Slow curve without the parameters that are held, and the branches' responses."""
        law, points = self.law, self.data.points
        kin = points.kinematics
        base = np.array([held.get(name, np.nan) for name in law.names])
        free = np.isnan(base)

        def full(theta: FloatArray) -> FloatArray:
            whole = base.copy()
            whole[free] = theta
            return whole

        small = Kinematics.of(np.array([1.0 - _SMALL, 1.0 + _SMALL]), np.array(2 * ["uniaxial"]))

        def modulus(theta: FloatArray) -> tuple[float, FloatArray]:
            stress, slopes = law.stress(full(theta), small), law.jacobian(full(theta), small)
            scale = 6.0 * _SMALL
            return float(stress[1] - stress[0]) / scale, (slopes[1] - slopes[0])[free] / scale

        lower, upper = law.narrow_bounds(kin) if narrow else law.bounds(kin)
        starts = law.starts(kin, points.stress, _STARTS, np.random.default_rng(0))
        starts = np.clip(starts[np.all(np.isfinite(starts), axis=1)], lower, upper)
        return MemoryCurve(
            names=tuple(name for name in law.names if name not in held),
            slow=lambda theta: law.stress(full(theta), kin),
            slow_slopes=lambda theta: law.jacobian(full(theta), kin)[:, free],
            modulus=modulus,
            branch=self.branch,
            lower=lower[free],
            upper=upper[free],
            starts=starts[:, free],
            moduli=np.array([_is_modulus(name) for name in law.names])[free],
            tau_s=self.tau_s,
            observed=points.stress,
            weights=self._factors(),
        )

    def _factors(self) -> FloatArray | None:
        if self.weights == "equal":
            return None
        _, inverse, counts = np.unique(self.data.names, return_inverse=True, return_counts=True)
        return np.asarray(np.sqrt(inverse.size / (counts.size * counts[inverse])))


def _is_modulus(name: str) -> bool:
    return name in ("G", "C10", "C01", "C20", "C30", "C1") or name.startswith("mu")


def fit_histories(
    data: Histories,
    model: str = "yeoh",
    *,
    branches: int | None = None,
    shift: WLF | None = None,
    T_ref_C: float = 20.0,
    weights: Weighting = "equal",
    fixed: Mapping[str, float] | None = None,
    loss: Loss = "linear",
    noise_N_per_mm2: float = 0.05,
) -> FitResult:
    """Fit an elastic law and branches together to time-stamped tests.

    Relaxation after a step, stepwise relaxation and cycles at several rates are all histories;
    see `calibration.fit_viscoelastic` for the parameters.
    """
    if model not in STRESS_MODELS:
        raise ValueError(f"model is {model!r}; expected one of {', '.join(STRESS_MODELS)}")
    if branches is not None and branches < 1:
        raise ValueError(f"branches is {branches}; expected 1 or more")
    law = STRESS_MODELS[model]
    held = dict(law.held if fixed is None else fixed)
    unknown = sorted(set(held) - set(law.names))
    if unknown:
        raise ValueError(f"fixed holds {unknown[0]}; expected some of {', '.join(law.names)}")
    work = HistoryFit(
        law=law, model=model, data=data, shift=shift, T_ref_C=T_ref_C, weights=weights
    )
    result, found = _searched(work, held, branches, loss, noise_N_per_mm2)
    return _completed(work, result, found)


def _searched(
    work: HistoryFit, held: dict[str, float], branches: int | None, loss: Loss, noise: float
) -> tuple[FitResult, dict[str, Any]]:
    """The fit with the number of branches that the data support (or that is asked for)."""
    if all(name in held for name in work.law.names):
        raise ValueError("every constant of the elastic law is held; expected at least one to fit")
    for narrow in (False, True):
        curve = work.curve(held, narrow=narrow)
        found, independent = candidates(curve, branches)
        best = chosen(found, branches, work.data.table.file)
        k = len(curve.names)
        whole = np.array([held.get(name, np.nan) for name in work.law.names])
        whole[np.isnan(whole)] = best.theta[:k]
        problem = memory_problem(work.curve({}, narrow=narrow), best.count)
        start = np.concatenate([whole, best.theta[k:]])
        result = fit(problem, start, fixed=held, loss=loss, noise=noise)
        if work.law.admissible(result.values):
            break
    return result, {
        "independent": independent,
        "tau_window_s": list(curve.tau_s),
        **criterion(found, best),
    }


def chosen(found: list[Candidate], branches: int | None, file: str) -> Candidate:
    """The number of branches asked for, or the one the data support; none is refused."""
    best = fewest(found) if branches is None else found[0]
    if branches is not None and best.count < branches:
        raise DataError(
            file=file,
            found=f"data with at most {best.count} relaxation times",
            expected=f"data for {branches}, or fewer --branches",
        )
    if best.count == 0:
        raise DataError(
            file=file,
            found="data that no relaxation explains better than an elastic law alone",
            expected="tests in which the stress depends on time, or calibrate hyperelastic",
        )
    return best


def criterion(found: list[Candidate], best: Candidate) -> dict[str, Any]:
    """What a parameter file tells of the choice among numbers of branches."""
    return {
        "branches": best.count,
        "branches_tried": [one.count for one in found],
        "rmse_by_branches": [one.rmse for one in found],
        "criterion_by_branches": [one.bic for one in found],
    }


def spectrum_of(result: FitResult, count: int) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Moduli over the slow one [-] and relaxation times [s] of a fit."""
    names = branch_names(count)
    values = [result.values[name] for name in names]
    return tuple(values[:count]), tuple(values[count:])


def viscoelastic_keys(prony: Prony) -> dict[str, Any]:
    """Keys of ``[rubber] viscoelastic`` that take a spectrum."""
    keys: dict[str, Any] = {"g": list(prony.g), "tau_s": list(prony.tau_s), "moduli": prony.moduli}
    if prony.shift is not None:
        shift = {"C1": prony.shift.d1, "C2_K": prony.shift.d2_K, "T_ref_C": prony.T_ref_C}
        keys |= shift
    return keys


def correlation_warnings(independent: float) -> tuple[str, ...]:
    """Say that residuals that hang together make standard errors too small."""
    if independent >= _CORRELATED:
        return ()
    factor = independent**-0.5
    return (
        "what is left is of the model and not noise: the true standard errors are about "
        f"{factor:.2g} times as large as stated",
    )


def _completed(work: HistoryFit, result: FitResult, found: dict[str, Any]) -> FitResult:
    data, law = work.data, work.law
    stage("checks of the fit")
    energy = fitted_energy(law, result, work.model, data.table.file)
    g, tau = spectrum_of(result, found["branches"])
    prony = Prony(g=g, tau_s=tau, shift=work.shift, T_ref_C=work.T_ref_C)
    independent = found.pop("independent")
    about = {
        "kind": "viscoelastic",
        "model": work.model,
        **data.about,
        "weights": work.weights,
        "version": version_of(),
        **found,
        "rmse_of_largest_stress": result.rmse / float(np.abs(result.observed).max()),
    }
    about["notes"] = [*about["notes"], *_temperature_notes(work)]
    return completed_rubber(
        result,
        law,
        energy,
        data.points,
        about,
        memory={"viscous": prony},
        keys={"viscoelastic": viscoelastic_keys(prony)},
        warnings=correlation_warnings(independent),
    )


def _temperature_notes(work: HistoryFit) -> list[str]:
    measured = [test.T_C for test in work.data.tests if test.T_C is not None]
    if not measured:
        return []
    low, high = (f(np.concatenate(measured)) for f in (np.min, np.max))
    if work.shift is not None:
        return [f"relaxation times shifted from {low:g} to {high:g} deg C to {work.T_ref_C:g}"]
    return [f"T_C, from {low:g} to {high:g} deg C, shifts nothing: give --C1 and --C2 for that"]
