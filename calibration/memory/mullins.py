"""Fit of an elastic law with softening to first and later cycles."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from calibration.fitting import FitResult, Loss, Problem, fit, minimise, stage
from calibration.memory.histories import Histories, read_histories
from calibration.rubber import (
    STRESS_MODELS,
    Kinematics,
    StressModel,
    completed_rubber,
    fitted_energy,
)
from fem.files import version_of
from materials.arrays import BoolArray, FloatArray
from materials.hyperelastic_base import Mode
from materials.softening import OgdenRoxburgh

NAMES = ("r", "m", "beta")
_BACK = 1e-3  # of the largest strain: a row that much below an earlier one is on a way back
_LEAST_ROWS = 4
_FURTHER_LEVEL = 1.05  # strain over an earlier turning point's that makes another level


def fit_mullins(
    table: pd.DataFrame | str | Path | Histories,
    model: str = "yeoh",
    *,
    mode: Mode = "uniaxial",
    from_cycle: int | None = None,
    fixed: Mapping[str, float] | None = None,
    loss: Loss = "linear",
    noise_N_per_mm2: float = 0.05,
) -> FitResult:
    """Fit an elastic law and the softening of Ogden and Roxburgh to cyclic tests.

    Parameters
    ----------
    table : DataFrame or path of a CSV file
        Columns ``stretch`` and ``nominal_stress_N_per_mm2`` in the order of recording, from the
        virgin state on; optional ``mode``, ``test`` (a name for each virgin specimen), ``time_s``
        and ``cycle``.
    model : str
        Elastic law (see `calibration.fit_hyperelastic`).
    mode : str
        Mode of tests without a column for it.
    from_cycle : int, optional
        Rows of earlier cycles soften the rubber and are not compared.
    fixed : mapping, optional
        Parameters to hold, those of the elastic law or ``r, m, beta``.
    loss, noise_N_per_mm2
        Robust loss and the residual where it begins to act [N/mm^2].

    Returns
    -------
    FitResult
        ``values`` of the elastic law and ``r``, ``m`` [N/mm^2], ``beta``; ``model`` is the rubber.

    Raises
    ------
    DataError
        Without rows below an earlier, larger load: nothing shows the softening then.
    """
    if model not in STRESS_MODELS:
        raise ValueError(f"model is {model!r}; expected one of {', '.join(STRESS_MODELS)}")
    law, data = STRESS_MODELS[model], table
    if not isinstance(data, Histories):
        data = read_histories(data, timed=False, mode=mode, from_cycle=from_cycle)
    held = dict(law.held if fixed is None else fixed)
    _require_way_back(data)
    problem = softening_problem(law, data)
    result = fit(problem, _starts(law, data, held), fixed=held, loss=loss, noise=noise_N_per_mm2)
    return _completed(law, model, data, result)


def softening_problem(law: StressModel, data: Histories) -> Problem:
    """Least-squares problem of the elastic constants and r, m, beta."""
    points = data.points
    lower, upper = law.bounds(points.kinematics)
    k = len(law.names)
    every = [
        Kinematics.of(test.stretch, np.full(test.stretch.size, test.mode)) for test in data.tests
    ]

    def predict(theta: FloatArray) -> FloatArray:
        stress = np.full(len(data.table), np.nan)
        try:
            energy = law.build(dict(zip(law.names, map(float, theta[:k]), strict=True)))
            softening = OgdenRoxburgh(**dict(zip(NAMES, map(float, theta[k:]), strict=True)))
        except ValueError:
            return stress[data.compared]
        for test, kin in zip(data.tests, every, strict=True):
            W = energy.strain_energy(test.stretch, test.mode)
            eta = softening.factor(W, np.maximum.accumulate(W))[0]
            stress[test.here] = eta * law.stress(theta[:k], kin)
        return stress[data.compared]

    return Problem(
        names=(*law.names, *NAMES),
        predict=predict,
        observed=points.stress,
        lower=np.concatenate([lower, [1.0, 1e-9, 0.0]]),
        upper=np.concatenate([upper, [1e3, 1e6, 1e3]]),
    )


def _starts(law: StressModel, data: Histories, held: Mapping[str, float]) -> FloatArray:
    """Elastic laws of the virgin rows with softening from weak to strong."""
    points = data.points
    virgin = ~_on_the_way_back(data)[data.compared]
    if np.count_nonzero(virgin) < 2 * len(law.names):
        virgin = np.ones_like(virgin)
    kin = Kinematics.of(points.stretch[virgin], points.mode[virgin])
    rng = np.random.default_rng(0)
    few = law.starts(kin, points.stress[virgin], 20, rng)
    lower, upper = law.bounds(points.kinematics)
    few = np.clip(few[np.all(np.isfinite(few), axis=1)], lower, upper)
    elastic = Problem(
        names=law.names,
        observed=points.stress[virgin],
        lower=lower,
        upper=upper,
        predict=lambda theta: law.stress(theta, kin),
        jacobian=lambda theta: law.jacobian(theta, kin),
        linear=law.linear,
    ).fixed({name: value for name, value in held.items() if name in law.names})
    free = [name not in held for name in law.names]
    best = np.array([held.get(name, np.nan) for name in law.names])
    if any(free):
        best[free] = minimise(elastic, few[:, free]).x
    energy = law.build(dict(zip(law.names, map(float, best), strict=True)))
    largest = max(float(energy.strain_energy(t.stretch, t.mode).max()) for t in data.tests)
    softening = [
        (r, share * largest, beta)
        for r in (1.3, 2.0, 4.0)
        for share in (0.03, 0.2, 1.0)
        for beta in (0.02, 0.3)
    ]
    return np.array([[*best, *one] for one in softening])


def _on_the_way_back(data: Histories) -> BoolArray:
    """Rows below the largest strain so far of their test, in tension or compression."""
    back = np.zeros(len(data.table), dtype=bool)
    for test in data.tests:
        strain = np.abs(np.log(test.stretch))
        largest = np.maximum.accumulate(strain)
        back[test.here] = strain < largest - _BACK * strain.max()
    return back


def _require_way_back(data: Histories) -> None:
    back = _on_the_way_back(data) & data.compared
    if np.count_nonzero(back) >= _LEAST_ROWS:
        return
    data.table.refuse_at(
        -1,
        "stretch",
        f"{np.count_nonzero(back)} rows below an earlier, larger strain",
        f"at least {_LEAST_ROWS}: unloading and later cycles, in the order of recording",
    )


def _levels(data: Histories) -> int:
    """Number of different largest strains that the tests come back from."""
    levels: list[float] = []
    for test in data.tests:
        strain = np.abs(np.log(test.stretch))
        largest = np.maximum.accumulate(strain)
        back = strain < largest - _BACK * strain.max()
        levels += np.unique(largest[back].round(6)).tolist()
    count, last = 0, 0.0
    for level in sorted(levels):
        if level > _FURTHER_LEVEL * last:
            count, last = count + 1, level
    return count


def _completed(law: StressModel, model: str, data: Histories, result: FitResult) -> FitResult:
    stage("checks of the fit")
    energy = fitted_energy(law, result, model, data.table.file)
    softening = OgdenRoxburgh(**{name: result.values[name] for name in NAMES})
    levels = _levels(data)
    more: tuple[str, ...] = ()
    if levels < 2 and "beta" in result.names:
        more = ("one level of strain: m and beta act alike there, hold beta (--fix beta=0)",)
    about = {
        "kind": "mullins",
        "model": model,
        **data.about,
        "levels": levels,
        "rmse_of_largest_stress": result.rmse / float(np.abs(result.observed).max()),
        "version": version_of(),
    }
    keys = {"r": softening.r, "m_N_per_mm2": softening.m, "beta": softening.beta}
    return completed_rubber(
        result,
        law,
        energy,
        data.points,
        about,
        memory={"damage": softening},
        keys={"mullins": keys},
        warnings=more,
    )
