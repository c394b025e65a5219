"""What each kind of calibration prints and writes.

Everything is computed before anything is written, so that bad data leave no trace.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from calibration.conductance import (
    HeatingRig,
    conductance_constant,
    fit_conductance,
    read_contact_surface,
    read_heating_record,
    read_heating_rig,
)
from calibration.fitting import FitResult, parameter_text
from calibration.fitting import progress as fit_progress
from calibration.friction import compare_laws, fit_friction, read_friction
from calibration.memory import (
    Histories,
    Moduli,
    fit_mullins,
    fit_viscoelastic,
    read_histories,
    read_memory,
)
from calibration.partition import SIMULATIONS_FOLDER, PartitionFit, SimulationStore, fit_partition
from calibration.plots import (
    plot_comparison,
    plot_conductance,
    plot_friction,
    plot_histories,
    plot_hyperelastic,
    plot_master_curve,
    plot_moduli,
    plot_partition,
    plot_wlf,
    png,
)
from calibration.rubber import CHOICES, compare_models, fit_hyperelastic, select_data
from calibration.wlf import fit_wlf, read_shift_factors
from fem.case import Case
from fem.files import spreadsheet, staged_directory

PARAMETERS_FILE = "parameters.toml"
_STRESSES = ("fit_N_per_mm2", "residual_N_per_mm2")

#: What the summary repeats of a fit's metadata.
_SAID = (
    "cycle",
    "branch",
    "window",
    "modes",
    "zero",
    "normalisation",
    "T_ref_C",
    "vertical_shift",
    "overlap_error_decades",
    "tests",
    "branches",
    "tau_window_s",
    "rmse_of_largest_stress",
    "relative_rmse",
)


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What a calibration prints and writes.

    Parameters
    ----------
    text : str
        Summary to print.
    files : dict
        Content by file name.
    notes : tuple of str
        How the data were understood, where the file was not plain CSV.
    unusual : tuple of str
        Numbers of the data outside their usual range.
    """

    text: str
    files: Mapping[str, bytes]
    notes: tuple[str, ...] = ()
    unusual: tuple[str, ...] = ()

    def write(self, directory: Path) -> None:
        """Write the files, all of them or none; the parameters arrive last."""
        with staged_directory(directory, last=PARAMETERS_FILE) as stage:
            for name, content in self.files.items():
                (stage / name).write_bytes(content)


def calibrate_hyperelastic(
    path: str | Path, *, compare: bool = True, intervals: str = "student", **options: Any
) -> Outcome:
    """Fit a hyperelastic model to the CSV file `path` (options of `fit_hyperelastic`)."""
    model = options.pop("model", "yeoh")
    data = select_data(path, **_taken(options, CHOICES))
    result = _with_intervals(fit_hyperelastic(data, model, **options), intervals)
    columns = {
        "row": data.table.rows,
        "mode": data.mode,
        "stretch": data.stretch,
        "nominal_stress_N_per_mm2": data.stress,
    }
    text, files = "", dict[str, pd.DataFrame | Figure]()
    if compare:
        found = compare_models(data, **_without_fixed(options))
        files = {
            "models.csv": found,
            "models.png": plot_comparison(found, "rmse_N_per_mm2", "N/mm²"),
        }
        text = _compared("all models", found.drop(columns=["n_data", "values"]))
    points = _points(result, columns, *_STRESSES)
    return _outcome(result, path, points, plot_hyperelastic(result, data), text, files)


def calibrate_viscoelastic(
    path: str | Path, *, intervals: str = "student", **options: Any
) -> Outcome:
    """Fit branches to the CSV file `path` (options of `fit_viscoelastic`)."""
    fitting = _taken(options, ("branches", "loss", "noise"))
    data = read_memory(path, **options)
    if isinstance(data, Moduli):
        result = fit_viscoelastic(data, **fitting)
        points, picture = _moduli_points(result, data), plot_moduli(result, data)
    else:
        result = fit_viscoelastic(data, **fitting, **options)
        points, picture = _history_points(result, data), plot_histories(result, data)
    result = _with_intervals(result, intervals)
    about = result.metadata
    tried = pd.DataFrame(
        {
            "branches": about["branches_tried"],
            "rmse_N_per_mm2": about["rmse_by_branches"],
            "criterion": about["criterion_by_branches"],
        }
    )
    text = f"\n{_shown(tried)}"
    return _outcome(result, path, points, picture, text, {"branches.csv": tried})


def calibrate_mullins(
    path: str | Path, *, model: str = "yeoh", intervals: str = "student", **options: Any
) -> Outcome:
    """Fit softening to the CSV file `path` (options of `fit_mullins`)."""
    data = read_histories(path, timed=False, **_taken(options, ("mode", "from_cycle")))
    result = _with_intervals(fit_mullins(data, model, **options), intervals)
    points = _history_points(result, data)
    return _outcome(result, path, points, plot_histories(result, data))


def _history_points(result: FitResult, data: Histories) -> pd.DataFrame:
    points = data.points
    columns = {
        "row": points.table.rows,
        "test": data.names,
        "time_s": None if data.time is None else data.time[data.compared],
        "stretch": points.stretch,
        "nominal_stress_N_per_mm2": points.stress,
    }
    return _points(result, columns, *_STRESSES)


def _moduli_points(result: FitResult, data: Moduli) -> pd.DataFrame:
    kinds = [name for name in ("storage", "loss") if getattr(data, name) is not None]
    times = len(kinds)
    columns = {
        "row": np.tile(data.rows, times),
        "kind": np.repeat(kinds, data.omega.size),
        "T_C": np.tile(data.dT + data.T_ref_C, times),
        "frequency_Hz": np.tile(data.measured / (2.0 * np.pi), times),
        "modulus_at_T_ref_N_per_mm2": result.observed,
    }
    return _points(result, columns, *_STRESSES)


def calibrate_friction(
    path: str | Path, *, compare: bool = True, intervals: str = "student", **options: Any
) -> Outcome:
    """Fit a friction law to the CSV file `path` (options of `fit_friction`)."""
    law = options.pop("law", "huemer")
    data = read_friction(path)
    result = _with_intervals(fit_friction(data, law, **options), intervals)
    columns = {
        "row": data.table.rows,
        "p_N_per_mm2": data.p,
        "v_mm_per_s": data.v,
        "T_C": data.T,
        "mu": data.mu,
    }
    text, files = "", dict[str, pd.DataFrame | Figure]()
    if compare:
        found = compare_laws(data, **_without_fixed(options))
        files = {"laws.csv": found}
        text = _compared("the laws", found.drop(columns="reason"))
        text += "".join(f"\n{reason}" for reason in found["reason"] if reason)
    points = _points(result, columns)
    return _outcome(result, path, points, plot_friction(result, data), text, files)


def calibrate_wlf(path: str | Path, *, T_ref_C: float | None = None, **options: Any) -> Outcome:
    """Fit the WLF constants to the CSV file `path` (options of `read_shift_factors`)."""
    data = read_shift_factors(path, T_ref_C=T_ref_C, **options)
    result = fit_wlf(data, T_ref_C=T_ref_C)
    files: dict[str, pd.DataFrame | Figure] = {}
    if data.master is not None:
        files = {
            "shift_factors.csv": data.master.shifts,
            "master_curve.csv": data.master.curve,
            "master_curve.png": plot_master_curve(data.master),
        }
        result = replace(result, warnings=(*data.master.warnings, *result.warnings))
    columns = {
        "row": data.rows if data.rows.size else None,
        "T_C": data.T,
        "log10_aT": result.observed,
    }
    text = (
        f"\n  d1 and d2 refer to {result.metadata['T_ref_C']:g} deg C "
        "(wlf_T_ref_C); a case rebases them to T_ref_C, the temperature of its friction law"
    )
    points = _points(result, columns)
    return _outcome(result, path, points, plot_wlf(result, data.T), text, files)


def calibrate_conductance(
    path: str | Path, *, rig_file: str | Path | None = None, also: Sequence[str] = ()
) -> Outcome:
    """Identify the gap conductance from a heating test in the CSV file `path`.

    The rig file (TOML) gives dimensions, materials and thermocouples, and with a table
    ``[surface]`` what the constant C of eq. (11) needs.
    """
    rig = HeatingRig() if rig_file is None else read_heating_rig(rig_file)
    surface = None if rig_file is None else read_contact_surface(rig_file)
    record = read_heating_record(path, rig)
    result = fit_conductance(path, rig, also=also)
    names = [f"{name}_C" for name in record.names]
    fitted = pd.DataFrame(result.predicted.reshape(record.readings.shape), columns=names)
    points = pd.concat(
        [
            pd.DataFrame({"row": record.table.rows, "time_s": record.time}),
            pd.DataFrame(record.readings, columns=names),
            fitted.add_prefix("fit_"),
        ],
        axis=1,
    )
    text = ""
    if rig_file is None:
        text += "\n  dimensions of the rig are the assumed defaults: give yours with --rig"
    if surface is not None:
        constant = conductance_constant(result, surface)
        result = replace(result, metadata={**result.metadata, "C_of_eq_11": constant.value})
        text += f"\n  C of eq. (11): {constant.value:.4g} +- {constant.stderr:.2g}"
    return _outcome(result, path, points, plot_conductance(result, record), text)


def calibrate_partition(
    path: str | Path,
    case: Case,
    directory: Path,
    *,
    intervals: str = "student",
    workers: int | None = None,
    quiet: bool = False,
    **options: Any,
) -> Outcome:
    """Identify the heat partition from surface temperatures in the CSV file `path`.

    The simulations are kept in `directory` as they finish (options of `fit_partition`).
    """
    say = None if quiet else partial(print, flush=True)
    store = SimulationStore(directory / SIMULATIONS_FOLDER, workers, say)
    found = fit_partition(path, case, store, **options)
    result = _with_intervals(found.result, intervals)
    result = replace(result, metadata={**result.metadata, "case_file": Path(case.source).name})
    made = "none" if not found.simulated else str(found.simulated)
    text = f"\nconstant kappa at each pressure and velocity:\n{_shown(found.discrete)}"
    text += f"\n{made} of the simulations had to be made"
    picture, points = plot_partition(result, found.discrete), _partition_points(found)
    return _outcome(result, path, points, picture, text, {"kappas.csv": found.discrete})


def _partition_points(found: PartitionFit) -> pd.DataFrame:
    conditions, result = found.data.conditions, found.result
    rows = [int(row) for condition in conditions for row in found.data.table.rows[condition.rows]]
    places = [condition.X for condition in conditions if condition.X is not None]
    counts = [condition.observed.size for condition in conditions]
    columns = {
        "row": rows,
        "p_stated_N_per_mm2": np.repeat([c.pressure for c in conditions], counts),
        "v_mm_per_s": np.repeat([c.velocity for c in conditions], counts),
        "X_mm": np.concatenate(places) if places else None,
        found.data.quantity: result.observed,
    }
    return _points(result, columns, "fit_C", "residual_K")


def _taken(options: dict[str, Any], keys: Sequence[str]) -> dict[str, Any]:
    """Some of the options, which are no longer there afterwards."""
    return {key: options.pop(key) for key in keys if key in options}


def _without_fixed(options: Mapping[str, Any]) -> dict[str, Any]:
    """Options for a comparison: a held parameter belongs to one model only."""
    return {key: value for key, value in options.items() if key != "fixed"}


def _compared(what: str, found: pd.DataFrame) -> str:
    return f"\n{what} on the same data, best AIC first:\n{_shown(found)}"


def _points(
    result: FitResult, columns: Mapping[str, Any], fit: str = "fit", residual: str = "residual"
) -> pd.DataFrame:
    """The columns there are with the fitted values and the residuals."""
    known = {name: values for name, values in columns.items() if values is not None}
    differences = result.predicted - result.observed
    return pd.DataFrame({**known, fit: result.predicted, residual: differences})


def _with_intervals(result: FitResult, kind: str) -> FitResult:
    """The result with its 95 % intervals in the metadata, which the parameter file repeats."""
    fit_progress.stage(f"{kind} intervals")
    found = {
        "student": lambda: result.interval(),
        "profile": lambda: {name: result.profile(name) for name in result.names},
        "bootstrap": lambda: result.bootstrap(),
    }[kind]()
    limits = {name: [float(low), float(high)] for name, (low, high) in found.items()}
    return replace(result, metadata={**result.metadata, "interval_95": {"kind": kind, **limits}})


def _outcome(
    result: FitResult,
    path: str | Path,
    points: pd.DataFrame,
    picture: Figure,
    text: str = "",
    more: Mapping[str, pd.DataFrame | Figure] | None = None,
) -> Outcome:
    """What every calibration prints and writes, with a text and files (by name) of its own."""
    fit_progress.stage("tables and pictures")
    shown_by_name = {"fit.csv": points, "fit.png": picture, **(more or {})}
    files = {
        name: png(shown) if isinstance(shown, Figure) else _csv(shown)
        for name, shown in shown_by_name.items()
    }
    return Outcome(
        text=_heading(result, path) + text,
        files={PARAMETERS_FILE: parameter_text(result).encode(), **files},
        notes=tuple(result.metadata.get("reading", ())),
        unusual=tuple(result.metadata.get("unusual", ())),
    )


def _csv(table: pd.DataFrame) -> bytes:
    return spreadsheet.csv_text(table).encode()


def _shown(table: pd.DataFrame) -> str:
    return table.to_string(index=False, float_format=lambda value: f"{value:.5g}")


def _heading(result: FitResult, path: str | Path) -> str:
    about = [f"{result.metadata['kind']} fit of {result.metadata['model']} to {path}"]
    about += [f"  {key}: {result.metadata[key]}" for key in _SAID if key in result.metadata]
    about += [f"  rows used: {result.metadata.get('rows_used', result.n_data)}"]
    about += [f"  left out: {entry}" for entry in result.metadata.get("rows_left_out", ())]
    about += [f"  {entry}" for entry in result.metadata.get("notes", ())]
    limits = {k: v for k, v in result.metadata.get("interval_95", {}).items() if k != "kind"}
    lines = [f"    {name}: {low:.6g} to {high:.6g}" for name, (low, high) in limits.items()]
    if lines:
        lines.insert(0, f"  95 % intervals ({result.metadata['interval_95']['kind']}):")
    return "\n".join([*about, result.summary(), *lines])
