"""The `calibrate` command: reads a table, fits, writes a folder with the parameter file.

Everything is computed before anything is written, so that bad data leave no trace.
"""

import argparse
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from calibration.conductance import (
    ALSO,
    conductance_constant,
    fit_conductance,
    read_heating_record,
)
from calibration.errors import DataError
from calibration.fit_core import FitResult
from calibration.friction import LAWS, compare_laws, fit_friction, read_friction
from calibration.heating_rig import HeatingRig
from calibration.hyperelastic import compare_models, fit_hyperelastic, select_data
from calibration.parameter_file import parameter_text
from calibration.partition import MOST_SIMULATIONS, PartitionFit, fit_partition
from calibration.plots import (
    plot_comparison,
    plot_conductance,
    plot_friction,
    plot_hyperelastic,
    plot_master_curve,
    plot_partition,
    plot_wlf,
    png,
)
from calibration.rig_file import read_contact_surface, read_heating_rig
from calibration.simulation_progress import SimulationProgress
from calibration.simulation_store import SimulationStoppedError, SimulationStore
from calibration.stress_models import STRESS_MODELS
from calibration.tables import read_table
from calibration.wlf import fit_wlf, shift_sweeps
from fem.case import Case
from fem.case_errors import CaseError
from fem.case_reading import parse_override
from materials.hyperelastic import MODES
from materials.wlf import WLF

BAD_INPUT, NOT_CONVERGED = 2, 3
CONSTANTS = WLF()


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What a calibration prints and writes.

    Parameters
    ----------
    text : str
        Summary to print.
    files : dict
        Content by file name.
    """

    text: str
    files: Mapping[str, bytes]

    def write(self, directory: Path) -> None:
        """Write the files, each of them whole or not at all."""
        directory.mkdir(parents=True, exist_ok=True)
        for name, content in self.files.items():
            temporary = directory / f".{name}.{os.getpid()}"
            try:
                temporary.write_bytes(content)
                os.replace(temporary, directory / name)
            finally:
                temporary.unlink(missing_ok=True)


def calibrate_hyperelastic(
    path: str | Path, *, compare: bool = True, intervals: str = "student", **options: Any
) -> Outcome:
    """Fit a hyperelastic model to the CSV file `path` (options of `fit_hyperelastic`)."""
    choice = {k: options.pop(k) for k in ("cycle", "branch", "window", "modes") if k in options}
    model = options.pop("model", "yeoh")
    data = select_data(path, **choice)
    result = fit_hyperelastic(data, model, **options)
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
    result = _with_intervals(result, intervals)
    files = _files(result, points) | {"fit.png": png(plot_hyperelastic(result, data))}
    text = _heading(result, path)
    if compare:
        same = {k: v for k, v in options.items() if k != "fixed"}
        found = compare_models(data, **same)
        files["models.csv"] = _csv(found)
        files["models.png"] = png(plot_comparison(found, "rmse_N_per_mm2", "N/mm²"))
        text += "\nall models on the same data, best AIC first:\n" + _shown(
            found.drop(columns=["n_data", "values"])
        )
    return Outcome(text=text, files=files)


def calibrate_friction(
    path: str | Path, *, compare: bool = True, intervals: str = "student", **options: Any
) -> Outcome:
    """Fit a friction law to the CSV file `path` (options of `fit_friction`)."""
    law = options.pop("law", "huemer")
    data = read_friction(path)
    result = fit_friction(data, law, **options)
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
    result = _with_intervals(result, intervals)
    files = _files(result, points) | {"fit.png": png(plot_friction(result, data))}
    text = _heading(result, path)
    if compare:
        same = {k: v for k, v in options.items() if k != "fixed"}
        found = compare_laws(data, **same)
        files["laws.csv"] = _csv(found)
        text += "\nboth laws on the same data, best AIC first:\n" + _shown(found)
    return Outcome(text=text, files=files)


def calibrate_wlf(path: str | Path, *, T_ref_C: float | None = None) -> Outcome:
    """Fit the WLF constants to shift factors or frequency sweeps in the CSV file `path`."""
    files: dict[str, bytes] = {}
    extra = ""
    if read_table(path, ("T_C",)).has("frequency_Hz"):
        master = shift_sweeps(path, T_ref_C)
        files["shift_factors.csv"] = _csv(master.shifts)
        files["master_curve.csv"] = _csv(master.curve)
        files["master_curve.png"] = png(plot_master_curve(master))
        extra = f"\n  overlap error {master.overlap_error:.3g} decades" + "".join(
            f"\n  warning: {warning}" for warning in master.warnings
        )
    result = fit_wlf(path, T_ref_C=T_ref_C)
    points = pd.DataFrame(
        {
            "T_C": result.metadata["T_C"],
            "log10_aT": result.observed,
            "fit": result.predicted,
            "residual": result.predicted - result.observed,
        }
    )
    files |= _files(result, points) | {"fit.png": png(plot_wlf(result))}
    return Outcome(text=_heading(result, path) + extra, files=files)


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
    return Outcome(text=text, files=files)


def calibrate_partition(
    path: str | Path,
    case: Case,
    directory: Path,
    *,
    intervals: str = "student",
    quiet: bool = False,
    **options: Any,
) -> Outcome:
    """Identify the heat partition from surface temperatures in the CSV file `path`.

    The simulations are kept in `directory` as they finish (options of `fit_partition`).
    """
    with SimulationProgress(quiet=quiet) as progress:
        store = SimulationStore(directory / "simulations", progress)
        found = fit_partition(path, case, store, **options)
    result = _with_intervals(found.result, intervals)
    result = replace(result, metadata={**result.metadata, "case_file": Path(case.source).name})
    files = _files(result, _partition_points(found))
    files["kappas.csv"] = _csv(found.discrete)
    files["fit.png"] = png(plot_partition(result, found.discrete))
    made = "none" if not found.simulated else str(found.simulated)
    text = f"{_heading(result, path)}\nconstant kappa at each pressure and velocity:\n"
    text += f"{_shown(found.discrete)}\n{made} of the simulations had to be made"
    return Outcome(text=text, files=files)


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
    found = {
        "student": lambda: result.interval(),
        "profile": lambda: {name: result.profile(name) for name in result.names},
        "bootstrap": lambda: result.bootstrap(),
    }[kind]()
    limits = {name: [float(low), float(high)] for name, (low, high) in found.items()}
    return replace(result, metadata={**result.metadata, "interval_95": {"kind": kind, **limits}})


def _files(result: FitResult, points: pd.DataFrame) -> dict[str, bytes]:
    return {"parameters.toml": parameter_text(result).encode(), "fit.csv": _csv(points)}


def _csv(table: pd.DataFrame) -> bytes:
    return table.to_csv(index=False).encode()


def _shown(table: pd.DataFrame) -> str:
    return table.to_string(index=False, float_format=lambda value: f"{value:.5g}")


def _heading(result: FitResult, path: str | Path) -> str:
    about = [f"{result.metadata['kind']} fit of {result.metadata['model']} to {path}"]
    about += [
        f"  {key}: {result.metadata[key]}"
        for key in ("cycle", "branch", "window", "modes", "normalisation", "T_ref_C")
        if key in result.metadata
    ]
    limits = {k: v for k, v in result.metadata.get("interval_95", {}).items() if k != "kind"}
    lines = [f"    {name}: {low:.6g} to {high:.6g}" for name, (low, high) in limits.items()]
    if lines:
        lines.insert(0, f"  95 % intervals ({result.metadata['interval_95']['kind']}):")
    return "\n".join([*about, result.summary(), *lines])


# -- command line --------------------------------------------------------------------------------


def add_arguments(commands: Any) -> None:
    """Add `calibrate` with its kinds of data to the sub-commands of a parser."""
    parser = commands.add_parser(
        "calibrate",
        help="fit parameters to measurements",
        description="Fit parameters to measurements and write a parameter file for a case.",
    )
    kinds = parser.add_subparsers(metavar="KIND", required=True, dest="kind")
    for name, (add, description) in KINDS.items():
        kind = kinds.add_parser(name, help=description, description=f"Fit {description}.")
        kind.add_argument("data", metavar="DATA.csv", help="measurements")
        kind.add_argument("-o", "--output", metavar="DIR", help="folder of the results")
        kind.add_argument("--quiet", action="store_true", help="print nothing but errors")
        add(kind)
        kind.set_defaults(command=run)


def run(arguments: argparse.Namespace) -> int:
    """Run one calibration; bad data end with one line and exit code 2."""
    directory = _folder(arguments)
    try:
        outcome: Outcome = arguments.calibrate(arguments)
        _require_folder(directory)
    except ValueError as error:
        # DataError and CaseError say the file; other messages are about the options
        place = "" if isinstance(error, DataError | CaseError) else f"{arguments.data}: "
        print(f"treadfem: {place}{error}", file=sys.stderr)
        return BAD_INPUT
    except SimulationStoppedError as error:
        print(f"treadfem: {error} (finished simulations stay in {directory})", file=sys.stderr)
        return NOT_CONVERGED
    outcome.write(directory)
    if not arguments.quiet:
        print(outcome.text)
        print(f"results in {directory}")
    return 0


def _folder(arguments: argparse.Namespace) -> Path:
    return Path(arguments.output or Path("results") / "calibration" / arguments.kind)


def _require_folder(directory: Path) -> None:
    existing = directory.absolute()
    while not existing.exists() and existing != existing.parent:
        existing = existing.parent
    if not (existing.is_dir() and os.access(existing, os.W_OK | os.X_OK)):
        raise DataError(file=str(directory), found=f"{existing}", expected="a writable folder")


def _add_hyperelastic(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--model", choices=STRESS_MODELS, default="yeoh")
    parser.add_argument("--cycle", type=_cycle, help='"last-full", "all" or a number')
    parser.add_argument("--branch", choices=("both", "load", "unload"), default="both")
    parser.add_argument(
        "--window", nargs=2, type=float, metavar=("LOW", "HIGH"), help="stretches used"
    )
    parser.add_argument("--mode", choices=MODES, action="append", help="may be repeated")
    parser.add_argument("--weights", choices=("equal", "modes", "relative"), default="equal")
    _add_common(parser, "N/mm^2")

    def calibrate(arguments: argparse.Namespace) -> Outcome:
        return calibrate_hyperelastic(
            arguments.data,
            model=arguments.model,
            cycle=arguments.cycle,
            branch=arguments.branch,
            window=None if arguments.window is None else tuple(arguments.window),
            modes=arguments.mode,
            weights=arguments.weights,
            noise_N_per_mm2=0.05 if arguments.noise is None else arguments.noise,
            **_common(arguments),
        )

    parser.set_defaults(calibrate=calibrate)


def _add_friction(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--law", choices=LAWS, default="huemer")
    parser.add_argument(
        "--wlf", choices=("none", "given", "fit"), default="none",
        help="shift of the speed by T_C: none, with --d1 and --d2, or fitted together",
    )  # fmt: skip
    parser.add_argument("--d1", type=float, default=CONSTANTS.d1)
    parser.add_argument("--d2", type=float, default=CONSTANTS.d2_K, metavar="K")
    parser.add_argument("--T-ref", type=float, default=20.0, metavar="C", dest="T_ref_C")
    _add_common(parser, "of mu")

    def calibrate(arguments: argparse.Namespace) -> Outcome:
        shift = {"none": lambda: None, "given": lambda: _wlf(arguments), "fit": lambda: "fit"}
        return calibrate_friction(
            arguments.data,
            law=arguments.law,
            wlf=shift[arguments.wlf](),
            T_ref_C=arguments.T_ref_C,
            noise=0.05 if arguments.noise is None else arguments.noise,
            **_common(arguments),
        )

    parser.set_defaults(calibrate=calibrate)


def _wlf(arguments: argparse.Namespace) -> WLF:
    return WLF(d1=arguments.d1, d2_K=arguments.d2)


def _add_wlf(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--T-ref", type=float, metavar="C", dest="T_ref_C")
    parser.set_defaults(
        calibrate=lambda arguments: calibrate_wlf(arguments.data, T_ref_C=arguments.T_ref_C)
    )


def _add_conductance(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--rig", metavar="RIG.toml", help="dimensions of the rig and its parts")
    parser.add_argument(
        "--also", choices=ALSO, action="append", default=[], help="heat losses to fit as well"
    )
    parser.set_defaults(
        calibrate=lambda arguments: calibrate_conductance(
            arguments.data, rig_file=arguments.rig, also=arguments.also
        )
    )


def _add_partition(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--case", metavar="CASE.toml", required=True,
        help="the block that slid; pressure and velocity come from the data",
    )  # fmt: skip
    parser.add_argument(
        "--set", metavar="section.key=value", action="append", default=[], dest="overrides",
        help="set a key of the case; may be repeated",
    )  # fmt: skip
    parser.add_argument(
        "--profile", choices=("whole", "peak"), default="whole",
        help="compare whole temperature profiles (where the data hold some) or their peaks",
    )  # fmt: skip
    parser.add_argument(
        "--simulations", type=_count, default=MOST_SIMULATIONS, metavar="N",
        help="at most that many per pressure and velocity (default %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--intervals", choices=("student", "profile"), default="student",
        help="95 %% intervals from the covariance or the profile of the sum of squares",
    )  # fmt: skip

    def calibrate(arguments: argparse.Namespace) -> Outcome:
        case = Case.from_toml(arguments.case, dict(map(parse_override, arguments.overrides)))
        directory = _folder(arguments)
        _require_folder(directory)
        return calibrate_partition(
            arguments.data,
            case,
            directory,
            profile=arguments.profile,
            simulations=arguments.simulations,
            intervals=arguments.intervals,
            quiet=arguments.quiet,
        )

    parser.set_defaults(calibrate=calibrate)


def _add_common(parser: argparse.ArgumentParser, unit: str) -> None:
    parser.add_argument(
        "--fix", metavar="NAME=VALUE", type=_fixed, action="append", help="hold a parameter"
    )
    parser.add_argument("--starts", type=_count, default=20, help="starting points")
    parser.add_argument(
        "--loss", choices=("linear", "soft_l1", "huber", "cauchy"), default="linear",
        help="a robust loss bounds the pull of outliers",
    )  # fmt: skip
    parser.add_argument("--noise", type=float, help=f"residual where that begins [{unit}]")
    parser.add_argument(
        "--intervals", choices=("student", "profile", "bootstrap"), default="student",
        help="95 %% intervals from the covariance, the profile or resampling",
    )  # fmt: skip
    parser.add_argument("--no-compare", action="store_true", help="leave out the other models")


def _common(arguments: argparse.Namespace) -> dict[str, Any]:
    fixed = None if arguments.fix is None else dict(arguments.fix)
    return {
        "fixed": fixed,
        "starts": arguments.starts,
        "loss": arguments.loss,
        "compare": not arguments.no_compare,
        "intervals": arguments.intervals,
    }


def _cycle(text: str) -> str | int:
    return text if text in ("last-full", "all") else int(text)


def _count(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text} starts; expected 1 or more")
    return number


def _fixed(text: str) -> tuple[str, float]:
    name, _, value = text.partition("=")
    return name.strip(), float(value)


KINDS: dict[str, tuple[Callable[[argparse.ArgumentParser], None], str]] = {
    "hyperelastic": (_add_hyperelastic, "a hyperelastic model to stress-stretch tests"),
    "friction": (_add_friction, "a friction law to friction coefficients"),
    "partition": (_add_partition, "the heat partition to surface temperatures of sliding blocks"),
    "conductance": (_add_conductance, "the gap conductance to a static heating test"),
    "wlf": (_add_wlf, "the WLF shift to shift factors or frequency sweeps"),
}
