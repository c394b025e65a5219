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
    choice = {key: options.pop(key) for key in CHOICES if key in options}
    model = options.pop("model", "yeoh")
    data = select_data(path, **choice)
    result = _with_intervals(fit_hyperelastic(data, model, **options), intervals)
    points = pd.DataFrame(
        {
            "row": data.table.rows,
            "mode": data.mode,
            "stretch": data.stretch,
            "nominal_stress_N_per_mm2": data.stress,
            "fit_N_per_mm2": result.predicted,
            "residual_N_per_mm2": result.predicted - result.observed,
        }
    )
    files = _files(result, points) | {"fit.png": png(plot_hyperelastic(result, data))}
    text = _heading(result, path)
    if compare:
        found = compare_models(data, **_without_fixed(options))
        files["models.csv"] = _csv(found)
        files["models.png"] = png(plot_comparison(found, "rmse_N_per_mm2", "N/mm²"))
        text += _compared("all models", found.drop(columns=["n_data", "values"]))
    return _outcome(result, text, files)


def calibrate_viscoelastic(
    path: str | Path, *, intervals: str = "student", **options: Any
) -> Outcome:
    """Fit branches to the CSV file `path` (options of `fit_viscoelastic`)."""
    fitting = {key: options.pop(key) for key in ("branches", "loss", "noise") if key in options}
    data = read_memory(path, **options)
    if isinstance(data, Moduli):
        result = fit_viscoelastic(data, **fitting)
        points, picture = _moduli_points(result, data), plot_moduli(result, data)
    else:
        result = fit_viscoelastic(data, **fitting, **options)
        points, picture = _history_points(result, data), plot_histories(result, data)
    result = _with_intervals(result, intervals)
    files = _files(result, points) | {"fit.png": png(picture)}
    about = result.metadata
    tried = pd.DataFrame(
        {
            "branches": about["branches_tried"],
            "rmse_N_per_mm2": about["rmse_by_branches"],
            "criterion": about["criterion_by_branches"],
        }
    )
    files["branches.csv"] = _csv(tried)
    return _outcome(result, f"{_heading(result, path)}\n{_shown(tried)}", files)


def calibrate_mullins(
    path: str | Path, *, model: str = "yeoh", intervals: str = "student", **options: Any
) -> Outcome:
    """Fit softening to the CSV file `path` (options of `fit_mullins`)."""
    reading = {key: options.pop(key) for key in ("mode", "from_cycle") if key in options}
    data = read_histories(path, timed=False, **reading)
    result = _with_intervals(fit_mullins(data, model, **options), intervals)
    files = _files(result, _history_points(result, data))
    files["fit.png"] = png(plot_histories(result, data))
    return _outcome(result, _heading(result, path), files)


def _history_points(result: FitResult, data: Histories) -> pd.DataFrame:
    points = data.points
    time = {} if data.time is None else {"time_s": data.time[data.compared]}
    return pd.DataFrame(
        {
            "row": points.table.rows,
            "test": data.names,
            **time,
            "stretch": points.stretch,
            "nominal_stress_N_per_mm2": points.stress,
            "fit_N_per_mm2": result.predicted,
            "residual_N_per_mm2": result.predicted - result.observed,
        }
    )


def _moduli_points(result: FitResult, data: Moduli) -> pd.DataFrame:
    kinds = [name for name in ("storage", "loss") if getattr(data, name) is not None]
    times = len(kinds)
    return pd.DataFrame(
        {
            "row": np.tile(data.rows, times),
            "kind": np.repeat(kinds, data.omega.size),
            "T_C": np.tile(data.dT + data.T_ref_C, times),
            "frequency_Hz": np.tile(data.measured / (2.0 * np.pi), times),
            "modulus_at_T_ref_N_per_mm2": result.observed,
            "fit_N_per_mm2": result.predicted,
            "residual_N_per_mm2": result.predicted - result.observed,
        }
    )


def calibrate_friction(
    path: str | Path, *, compare: bool = True, intervals: str = "student", **options: Any
) -> Outcome:
    """Fit a friction law to the CSV file `path` (options of `fit_friction`)."""
    law = options.pop("law", "huemer")
    data = read_friction(path)
    result = _with_intervals(fit_friction(data, law, **options), intervals)
    points = pd.DataFrame(
        {
            "row": data.table.rows,
            "p_N_per_mm2": data.p,
            "v_mm_per_s": data.v,
            **({} if data.T is None else {"T_C": data.T}),
            "mu": data.mu,
            "fit": result.predicted,
            "residual": result.predicted - result.observed,
        }
    )
    files = _files(result, points) | {"fit.png": png(plot_friction(result, data))}
    text = _heading(result, path)
    if compare:
        found = compare_laws(data, **_without_fixed(options))
        files["laws.csv"] = _csv(found)
        text += _compared("both laws", found.drop(columns="reason"))
        text += "".join(f"\n{reason}" for reason in found["reason"] if reason)
    return _outcome(result, text, files)


def _without_fixed(options: Mapping[str, Any]) -> dict[str, Any]:
    """Options for a comparison: a held parameter belongs to one model only."""
    return {key: value for key, value in options.items() if key != "fixed"}


def _compared(what: str, found: pd.DataFrame) -> str:
    return f"\n{what} on the same data, best AIC first:\n{_shown(found)}"


def calibrate_wlf(path: str | Path, *, T_ref_C: float | None = None, **options: Any) -> Outcome:
    """Fit the WLF constants to the CSV file `path` (options of `read_shift_factors`)."""
    files: dict[str, bytes] = {}
    data = read_shift_factors(path, T_ref_C=T_ref_C, **options)
    result = fit_wlf(data, T_ref_C=T_ref_C)
    if data.master is not None:
        files["shift_factors.csv"] = _csv(data.master.shifts)
        files["master_curve.csv"] = _csv(data.master.curve)
        files["master_curve.png"] = png(plot_master_curve(data.master))
        result = replace(result, warnings=(*data.master.warnings, *result.warnings))
    points = pd.DataFrame(
        {
            **({"row": data.rows} if data.rows.size else {}),
            "T_C": data.T,
            "log10_aT": result.observed,
            "fit": result.predicted,
            "residual": result.predicted - result.observed,
        }
    )
    files |= _files(result, points) | {"fit.png": png(plot_wlf(result, data.T))}
    text = (
        f"{_heading(result, path)}\n  d1 and d2 refer to {result.metadata['T_ref_C']:g} deg C "
        "(wlf_T_ref_C); a case rebases them to T_ref_C, the temperature of its friction law"
    )
    return _outcome(result, text, files)


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
    text = _heading(result, path)
    if rig_file is None:
        text += "\n  dimensions of the rig are the assumed defaults: give yours with --rig"
    if surface is not None:
        constant = conductance_constant(result, surface)
        result = replace(result, metadata={**result.metadata, "C_of_eq_11": constant.value})
        text += f"\n  C of eq. (11): {constant.value:.4g} +- {constant.stderr:.2g}"
    files = _files(result, points) | {"fit.png": png(plot_conductance(result, record))}
    return _outcome(result, text, files)


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
    files = _files(result, _partition_points(found))
    files["kappas.csv"] = _csv(found.discrete)
    files["fit.png"] = png(plot_partition(result, found.discrete))
    made = "none" if not found.simulated else str(found.simulated)
    text = f"{_heading(result, path)}\nconstant kappa at each pressure and velocity:\n"
    text += f"{_shown(found.discrete)}\n{made} of the simulations had to be made"
    return _outcome(result, text, files)


def _partition_points(found: PartitionFit) -> pd.DataFrame:
    conditions, result = found.data.conditions, found.result
    rows = [int(row) for condition in conditions for row in found.data.table.rows[condition.rows]]
    places = [condition.X for condition in conditions if condition.X is not None]
    counts = [condition.observed.size for condition in conditions]
    return pd.DataFrame(
        {
            "row": rows,
            "p_stated_N_per_mm2": np.repeat([c.pressure for c in conditions], counts),
            "v_mm_per_s": np.repeat([c.velocity for c in conditions], counts),
            **({"X_mm": np.concatenate(places)} if places else {}),
            found.data.quantity: result.observed,
            "fit_C": result.predicted,
            "residual_K": result.predicted - result.observed,
        }
    )


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


def _outcome(result: FitResult, text: str, files: Mapping[str, bytes]) -> Outcome:
    said = {key: tuple(result.metadata.get(key, ())) for key in ("reading", "unusual")}
    return Outcome(text=text, files=files, notes=said["reading"], unusual=said["unusual"])


def _files(result: FitResult, points: pd.DataFrame) -> dict[str, bytes]:
    fit_progress.stage("tables and pictures")
    return {PARAMETERS_FILE: parameter_text(result).encode(), "fit.csv": _csv(points)}


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
