"""Fit of hyperelastic energies to stress-stretch tests.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", section 2.2.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from calibration.cycles import BRANCHES, Branch, in_last_full_cycle, label_cycles
from calibration.errors import DataError
from calibration.fit_core import FitResult, Loss, Problem, fit
from calibration.provenance import version
from calibration.stability import Stability, check_stability
from calibration.stress_models import STRESS_MODELS, Kinematics, StressModel
from calibration.tables import Table, read_table
from materials.hyperelastic import MODES

Array = NDArray[np.float64]
Weighting = Literal["equal", "modes", "relative"]

COLUMNS = ("stretch", "nominal_stress_N_per_mm2", "mode")
LARGEST_STRETCH = 20.0  # no rubber gets there; percent do


@dataclass(frozen=True, kw_only=True)
class StressData:
    """The points a hyperelastic fit is made to, and how they were chosen.

    Parameters
    ----------
    stretch, stress : ndarray, shape (n,)
        Stretch [-] and nominal stress [N/mm^2].
    mode : ndarray of str, shape (n,)
    table : Table
        The rows behind the points.
    selection : dict
        Cycle, branch, window and modes, for the parameter file.
    """

    stretch: Array
    stress: Array
    mode: NDArray[np.str_]
    table: Table
    selection: dict[str, Any]

    @property
    def kinematics(self) -> Kinematics:
        return Kinematics.of(self.stretch, self.mode)

    @property
    def window(self) -> dict[str, tuple[float, float]]:
        """Lowest and highest stretch by mode."""
        return {
            str(name): (
                float(self.stretch[self.mode == name].min()),
                float(self.stretch[self.mode == name].max()),
            )
            for name in np.unique(self.mode)
        }


def fit_hyperelastic(
    table: pd.DataFrame | str | Path | StressData,
    model: str = "yeoh",
    *,
    cycle: int | Literal["last-full", "all"] | None = None,
    branch: Branch = "both",
    window: tuple[float, float] | None = None,
    modes: Sequence[str] | None = None,
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
        cycles, else all rows.
    branch : {"both", "load", "unload"}
    window : tuple of float, optional
        Lowest and highest stretch used. A window that begins at 1 or above asks for tension only:
        rows in compression are then refused rather than left out.
    modes : sequence of str, optional
        Kinds of test used.
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
    """
    if model not in STRESS_MODELS:
        raise ValueError(f"model is {model!r}; expected one of {', '.join(STRESS_MODELS)}")
    law = STRESS_MODELS[model]
    if isinstance(table, StressData):
        data = table
    else:
        data = select_data(table, cycle=cycle, branch=branch, window=window, modes=modes)
    held = dict(law.held if fixed is None else fixed)
    _require_points(data, law, model, held)
    kin = data.kinematics
    problem = stress_problem(law, data, kin, weights)
    begin = law.starts(kin, data.stress, starts, np.random.default_rng(seed))
    result = fit(problem, begin, fixed=held, loss=loss, noise=noise_N_per_mm2)
    if not law.admissible(result.values):
        result = _narrowed(result, law, problem, kin, begin, held, loss, noise_N_per_mm2)
    return _completed(result, model, law, data, weights)


def _narrowed(
    first: FitResult,
    law: StressModel,
    problem: Problem,
    kin: Kinematics,
    begin: Array,
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

    def subset(rows: NDArray[np.intp]) -> Problem:
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
        choice = {k: options.pop(k) for k in ("cycle", "branch", "window", "modes") if k in options}
        table = select_data(table, **choice)
    rows = [_compared(table, model, options) for model in models]
    return pd.DataFrame(rows).sort_values("aic", na_position="last").reset_index(drop=True)


def _compared(data: StressData, model: str, options: dict[str, Any]) -> dict[str, Any]:
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
        "stability": "; ".join(stability.warnings) or "stable over the data",
        "values": ", ".join(f"{name}={value:.6g}" for name, value in result.values.items()),
    }


def select_data(
    table: pd.DataFrame | str | Path,
    *,
    cycle: int | Literal["last-full", "all"] | None = None,
    branch: Branch = "both",
    window: tuple[float, float] | None = None,
    modes: Sequence[str] | None = None,
) -> StressData:
    """Read, check and choose the points of a fit (see `fit_hyperelastic`)."""
    source = read_table(table, COLUMNS)
    stretch = source.numbers("stretch")
    stress = source.numbers("nominal_stress_N_per_mm2")
    mode = source.words("mode", MODES)
    _check_stretch(source, stretch, stress)
    keep = np.ones(stretch.size, dtype=bool)
    if modes is not None:
        unknown = [name for name in modes if name not in MODES]
        if unknown:
            raise ValueError(f"modes holds {unknown[0]!r}; expected some of {', '.join(MODES)}")
        keep &= np.isin(mode, list(modes))
    chosen, branches, cycle_label = _chosen_cycle(source, stretch, mode, cycle, branch)
    keep &= chosen
    if branch != "both":
        if branches is None:
            source.refuse(found="no column branch", expected=f"one to choose the {branch} path by")
        else:
            keep &= branches == branch
    if window is not None:
        keep &= _in_window(source, stretch, keep, window)
    used = source.select(keep)
    if not len(used):
        source.refuse(found="no row that the selection keeps", expected="some data to fit to")
    if not np.any(stress[keep]):
        used.refuse_at(
            0, "nominal_stress_N_per_mm2", "zero in every row", "stresses in N/mm^2, not all zero"
        )
    _check_sign(used, stretch[keep], stress[keep])
    selection = {
        "cycle": cycle_label,
        "branch": branch,
        "window": list(window) if window is not None else "all",
        "modes": sorted({str(name) for name in mode[keep]}),
    }
    return StressData(
        stretch=stretch[keep], stress=stress[keep], mode=mode[keep], table=used, selection=selection
    )


def _check_stretch(source: Table, stretch: Array, stress: Array) -> None:
    source.require_all(
        "stretch",
        stretch > 0.0,
        "a stretch above zero (1 = undeformed; strain and percent are not stretch)",
    )
    source.require_all(
        "stretch",
        stretch < LARGEST_STRETCH,
        f"a stretch below {LARGEST_STRETCH:g} (1 = undeformed; 150 % strain is the stretch 2.5)",
    )
    small = stretch < 0.95
    pulled = small & (stress > 0.0)
    if np.count_nonzero(pulled) > 0.5 * np.count_nonzero(small):
        i = int(np.flatnonzero(pulled)[0])
        found = f"{stretch[i]:g} with the tensile stress {stress[i]:g} N/mm^2"
        source.refuse_at(i, "stretch", found, "a stretch (1 = undeformed); these look like strains")


def _check_sign(used: Table, stretch: Array, stress: Array) -> None:
    """Refuse data whose stress mostly points against the stretch."""
    against = (stretch - 1.0) * stress < 0.0
    if np.count_nonzero(against) > 0.5 * stretch.size:
        i = int(np.flatnonzero(against)[0])
        kind, sign = ("tensile", "positive") if stretch[i] > 1.0 else ("compressive", "negative")
        found = f"{stress[i]:g} at the {kind} stretch {stretch[i]:g}, and mostly so"
        used.refuse_at(i, "nominal_stress_N_per_mm2", found, f"a {sign} stress there")


def _chosen_cycle(
    source: Table,
    stretch: Array,
    mode: NDArray[np.str_],
    wanted: int | str | None,
    branch: Branch,
) -> tuple[NDArray[np.bool_], NDArray[np.str_] | None, str]:
    """Mask of the chosen cycle, the branches, and a label of the choice."""
    branches = source.words("branch", BRANCHES) if source.has("branch") else None
    everything = np.ones(stretch.size, dtype=bool)
    if source.has("cycle"):
        cycles = source.numbers("cycle")
        source.require_all("cycle", cycles == np.round(cycles), "a whole number")
        number = cycles.astype(np.int64)
        if branches is None:
            branches = _branches_within(stretch, mode, number)
    elif wanted not in (None, "all") or (branch != "both" and branches is None):
        number, branches = _labelled(stretch, mode)
    else:
        return everything, branches, "all"
    if wanted == "all" or (wanted is None and not source.has("cycle")):
        return everything, branches, "all"
    if isinstance(wanted, int):
        if wanted not in number:
            found = f"the cycles {', '.join(map(str, np.unique(number)))}"
            source.refuse(column="cycle", found=found, expected=f"the cycle {wanted}")
        return number == wanted, branches, str(wanted)
    keep, by_mode = in_last_full_cycle(stretch, mode, number, branches)
    if not keep.any():
        found = "no cycle with both a load and an unload branch"
        source.refuse(column="cycle", found=found, expected="a full cycle, or cycle = all")
    label = ", ".join(f"{name} {cycle}" for name, cycle in by_mode.items())
    return keep, branches, f"last full cycle at the highest strain ({label})"


def _branches_within(
    stretch: Array, mode: NDArray[np.str_], number: NDArray[np.int64]
) -> NDArray[np.str_]:
    """Branches from the course of the stretch in every cycle of every mode."""
    branches = np.empty(stretch.size, dtype="<U6")
    for name in np.unique(mode):
        for cycle in np.unique(number[mode == name]):
            here = (mode == name) & (number == cycle)
            branches[here] = label_cycles(stretch[here])[1]
    return branches


def _labelled(stretch: Array, mode: NDArray[np.str_]) -> tuple[NDArray[np.int64], NDArray[np.str_]]:
    number = np.empty(stretch.size, dtype=np.int64)
    branches = np.empty(stretch.size, dtype="<U6")
    for name in np.unique(mode):
        here = mode == name
        number[here], branches[here] = label_cycles(stretch[here])
    return number, branches


def _in_window(
    source: Table, stretch: Array, keep: NDArray[np.bool_], window: tuple[float, float]
) -> NDArray[np.bool_]:
    low, high = window
    if not 0.0 < low < high:
        raise ValueError(f"window is {low:g} to {high:g}; expected two rising stretches above 0")
    if low >= 1.0:
        compressed = keep & (stretch < 1.0 - 1e-9)
        expected = f"tension only (1 or more), as the window {low:g} to {high:g} asks for"
        source.require_all("stretch", ~compressed, expected)
    return np.asarray((stretch >= low) & (stretch <= high))


def _require_points(
    data: StressData, law: StressModel, model: str, held: Mapping[str, float]
) -> None:
    free = sum(name not in held for name in law.names)
    points = np.unique(np.stack([data.stretch, np.searchsorted(MODES, data.mode)]), axis=1)
    telling = int(np.count_nonzero(points[0] != 1.0))  # the undeformed state tells nothing
    if telling < free:
        raise DataError(
            file=data.table.file,
            row=int(data.table.rows[-1]),
            column="stretch",
            found=f"{telling} different point{'' if telling == 1 else 's'}",
            expected=f"at least {free} for the {free} parameters of {model}",
        )


def _weights(data: StressData, kind: Weighting) -> Array | None:
    if kind == "equal":
        return None
    if kind == "modes":
        _, inverse, counts = np.unique(data.mode, return_inverse=True, return_counts=True)
        return np.sqrt(data.stress.size / (counts.size * counts[inverse]))
    if kind == "relative":
        size = np.abs(data.stress)
        return size.max() / np.maximum(size, 0.05 * size.max())
    raise ValueError(f"weights is {kind!r}; expected equal, modes or relative")


def _completed(
    result: FitResult, model: str, law: StressModel, data: StressData, weights: Weighting
) -> FitResult:
    values = result.values
    try:
        energy = law.build(values)
    except ValueError as error:
        raise DataError(
            file=data.table.file,
            found=f"data whose best {model} fit is no admissible energy ({error})",
            expected="tests of a rubber, or another model",
        ) from None
    stability = check_stability(energy, data.window)
    metadata = {
        "kind": "hyperelastic",
        "model": model,
        **data.table.origin,
        **data.selection,
        "weights": weights,
        "version": version(),
        "stability": stability,
    }
    return replace(
        result,
        model=energy,
        metadata=metadata,
        section={"rubber": law.section(model, values)},
        warnings=(*result.warnings, *stability.warnings),
    )
