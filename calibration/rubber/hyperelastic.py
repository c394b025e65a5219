"""Fit of hyperelastic energies to stress-stretch tests.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", section 2.2.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pandas as pd

from calibration.fitting import FitResult, Loss, Problem, Stability, check_stability, fit, stage
from calibration.rubber.cycles import Branch
from calibration.rubber.stress_checks import check_modulus, fitted_energy
from calibration.rubber.stress_data import Cycle, StressData, select_data
from calibration.rubber.stress_models import STRESS_MODELS, Kinematics, StressModel
from calibration.rubber.stress_zero import Zero
from fem.files import version_of
from materials.arrays import FloatArray, IndexArray
from materials.hyperelastic_base import Hyperelastic
from materials.rubber import Rubber

Weighting = Literal["equal", "modes", "relative"]

#: Options that choose the points of a fit.
CHOICES = ("cycle", "branch", "window", "modes", "zero")


def fit_hyperelastic(
    table: pd.DataFrame | str | Path | StressData,
    model: str = "yeoh",
    *,
    cycle: Cycle = None,
    branch: Branch = "both",
    window: tuple[float, float] | None = None,
    modes: Sequence[str] | None = None,
    zero: Zero = "none",
    weights: Weighting = "equal",
    fixed: Mapping[str, float] | None = None,
    starts: int = 20,
    seed: int = 0,
    loss: Loss = "linear",
    noise_N_per_mm2: float = 0.05,
) -> FitResult:
    """Fit a hyperelastic model to homogeneous tests, all modes at once.

    Parameters
    ----------
    table : DataFrame, path of a CSV file, or StressData
        Columns ``stretch``, ``nominal_stress_N_per_mm2``, ``mode`` and optionally ``cycle`` and
        ``branch`` ("load" or "unload").
    model : str
        One of "neo-hooke", "mooney-rivlin", "yeoh", "van-der-waals", "arruda-boyce", "ogden-2",
        "ogden-3".
    cycle : int, "last-full", "all" or None
        Cycle to fit to; None takes the last full one at the highest strain where the table has
        cycles, else all rows. Modes without a full cycle keep all their rows.
    branch : {"both", "load", "unload"}
    window : tuple of float, optional
        Lowest and highest stretch used. A window that begins at 1 or above asks for tension only:
        rows in compression are then refused rather than left out.
    modes : sequence of str, optional
        Kinds of test used.
    zero : {"none", "first", "loop"}
        Subtract the stress of each mode's first row, or refer stretch and stress to the length and
        section at which the loop comes back to zero stress (permanent set).
    weights : {"equal", "modes", "relative"}
        Every point alike, every mode alike, or relative to the stress (at least 5 % of the
        largest).
    fixed : mapping, optional
        Parameters to hold. The van der Waals beta is held at 0 as in [1]_ unless a mapping
        without it is given.
    starts, seed : int
        Number of starting points, and the seed of those drawn at random.
    loss, noise_N_per_mm2
        Robust loss and the residual where it begins to act [N/mm^2].

    Returns
    -------
    FitResult
        With ``values`` in N/mm^2 (C10, G, ...) and dimensionless numbers, ``model`` ready for use
        and ``metadata["stability"]``.

    Examples
    --------
    >>> from calibration.synthetic import synthetic_stress
    >>> fit = fit_hyperelastic(synthetic_stress("yeoh-bars-series-2"), model="yeoh")
    >>> round(fit.values["C10"], 1)  # 0.32 in Table 1
    0.3
    """
    if model not in STRESS_MODELS:
        raise ValueError(f"model is {model!r}; expected one of {', '.join(STRESS_MODELS)}")
    law = STRESS_MODELS[model]
    if isinstance(table, StressData):
        data = table
    else:
        data = select_data(table, cycle=cycle, branch=branch, window=window, modes=modes, zero=zero)
    held = dict(law.held if fixed is None else fixed)
    _require_points(data, law, model, held)
    kin = data.kinematics
    problem = stress_problem(law, data, kin, weights)
    begin = law.starts(kin, data.stress, starts, np.random.default_rng(seed))
    result = fit(problem, begin, fixed=held, loss=loss, noise=noise_N_per_mm2)
    if not law.admissible(result.values):
        result = _narrowed(result, law, problem, kin, begin, held, loss, noise_N_per_mm2)
    energy = fitted_energy(law, result, model, data.table.file)
    about = {
        "kind": "hyperelastic",
        "model": model,
        **data.selection,
        "weights": weights,
        "version": version_of(),
    }
    return completed_rubber(result, law, energy, data, about)


def _narrowed(
    first: FitResult,
    law: StressModel,
    problem: Problem,
    kin: Kinematics,
    begin: FloatArray,
    held: Mapping[str, float],
    loss: Loss,
    noise: float,
) -> FitResult:
    """Fit again between bounds that leave only admissible energies."""
    lower, upper = law.narrow_bounds(kin)
    result = fit(
        replace(problem, lower=lower, upper=upper), begin, fixed=held, loss=loss, noise=noise
    )
    constants = ", ".join(f"{name} = {value:.4g}" for name, value in first.values.items())
    warning = f"the best fit, {constants}, is no admissible energy: its constants were bounded by 0"
    return replace(result, warnings=(*result.warnings, warning))


def stress_problem(
    law: StressModel, data: StressData, kin: Kinematics, weights: Weighting = "equal"
) -> Problem:
    """Least-squares problem of a stress model on the data."""
    lower, upper = law.bounds(kin)
    factors = _weights(data, weights)

    def subset(rows: IndexArray) -> Problem:
        fewer = kin.at(rows)
        return Problem(
            names=law.names,
            predict=lambda theta: law.stress(theta, fewer),
            jacobian=lambda theta: law.jacobian(theta, fewer),
            observed=data.stress[rows],
            weights=None if factors is None else factors[rows],
            lower=lower,
            upper=upper,
            linear=law.linear,
            canonical=law.ordered,
        )

    return replace(subset(np.arange(data.stress.size)), subset=subset)


def compare_models(
    table: pd.DataFrame | str | Path | StressData,
    models: Sequence[str] = tuple(STRESS_MODELS),
    **options: Any,
) -> pd.DataFrame:
    """Fit several models to the same data.

    Returns
    -------
    DataFrame
        A row per model, best AIC first: ``model, parameters, n_data, rmse_N_per_mm2, r2, aic,
        stable, stability, values``. A model the data cannot carry has NaN and the reason.
    """
    if not isinstance(table, StressData):
        choice = {key: options.pop(key) for key in CHOICES if key in options}
        table = select_data(table, **choice)
    rows = [_compared(table, model, options) for model in models]
    return pd.DataFrame(rows).sort_values("aic", na_position="last").reset_index(drop=True)


def _compared(data: StressData, model: str, options: dict[str, Any]) -> dict[str, Any]:
    stage(f"comparing with {model}")
    try:
        result = fit_hyperelastic(data, model, **options)
    except ValueError as error:
        nothing = dict.fromkeys(("rmse_N_per_mm2", "r2", "aic"), np.nan)
        row = {"model": model, "parameters": len(STRESS_MODELS[model].names), "n_data": 0}
        return {**row, **nothing, "stable": False, "stability": str(error), "values": ""}
    stability: Stability = result.metadata["stability"]
    return {
        "model": model,
        "parameters": len(result.names),
        "n_data": result.n_data,
        "rmse_N_per_mm2": result.rmse,
        "r2": result.r2,
        "aic": result.aic,
        "stable": stability.stable,
        "stability": stability.text,
        "values": ", ".join(f"{name}={value:.6g}" for name, value in result.values.items()),
    }


def _require_points(
    data: StressData, law: StressModel, model: str, held: Mapping[str, float]
) -> None:
    free = sum(name not in held for name in law.names)
    telling = 0
    for name in np.unique(data.mode):
        points = np.unique(data.stretch[data.mode == name])
        telling += int(np.count_nonzero(points != 1.0))  # the undeformed state tells nothing
    if telling < free:
        data.table.refuse_at(
            -1,
            "stretch",
            f"{telling} different point{'' if telling == 1 else 's'}",
            f"at least {free} for the {free} parameters of {model}",
        )


def _weights(data: StressData, kind: Weighting) -> FloatArray | None:
    if kind == "equal":
        return None
    if kind == "modes":
        _, inverse, counts = np.unique(data.mode, return_inverse=True, return_counts=True)
        return np.sqrt(data.stress.size / (counts.size * counts[inverse]))
    if kind == "relative":
        size = np.abs(data.stress)
        return size.max() / np.maximum(size, 0.05 * size.max())
    raise ValueError(f"weights is {kind!r}; expected equal, modes or relative")


def completed_rubber(
    result: FitResult,
    law: StressModel,
    energy: Hyperelastic,
    data: StressData,
    about: Mapping[str, Any],
    *,
    memory: Mapping[str, Any] | None = None,
    keys: Mapping[str, Any] | None = None,
    warnings: Sequence[str] = (),
) -> FitResult:
    """The result of a fit of a rubber with its law, section and origin, and what to know of it.

    Parameters
    ----------
    about : mapping
        Kind, model and the rest of the metadata; the origin of the data follows the model.
    memory, keys : mapping, optional
        Branches or damage of the rubber, and the keys of its section that take them.
    warnings : sequence of str
        Told between those of the fit and those of the energy.
    """
    modulus = check_modulus(data.table, energy)
    stability = check_stability(energy, data.window)
    first = {key: about[key] for key in ("kind", "model")}
    section = {
        **law.section(about["model"], result.values),
        **(keys or {}),
        "window": {"largest_stretch": data.largest_stretch},
    }
    return replace(
        result,
        model=Rubber(elastic=energy, **memory) if memory else energy,
        metadata={**first, **data.table.origin, **about, "stability": stability},
        section={"rubber": section},
        warnings=(
            *result.warnings,
            *warnings,
            *modulus,
            *stability.warnings,
            *stability.elsewhere,
        ),
    )
