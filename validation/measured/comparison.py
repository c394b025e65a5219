"""Measurements against simulations: which belong together, and how far they are apart."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from calibration.data import DataError
from fem.case import Case, CaseError, describe
from fem.results import (
    CASE_FILE,
    OK,
    PYROMETER,
    PYROMETER_FILE,
    SUMMARY_CSV,
    SUMMARY_JSON,
    SURFACE,
    SURFACE_FILE,
    read_summary,
    read_table,
)
from materials.arrays import IndexArray
from validation.analysis import ACCEPTED_K, MEASURED_TO_K
from validation.measured.matching import (
    START_TOLERANCE_K,
    TOLERANCES,
    first_ambiguous,
    matched,
)
from validation.measured.measurements import QUANTITIES, Measurements

_PRESSURE, _VELOCITY, _START = (
    "loading.mean_pressure_N_per_mm2",
    "loading.velocity_mm_per_s",
    "heat.ambient_C",
)
#: Share of the block's length by which a profile may reach beyond its corners, and which it has
#: to cover at least [-].
_OVERHANG, _LEAST_COVERED = 0.05, 0.1
#: Limits of the temperature error that are counted: the accuracy of the measurement (0.5 to 1 K)
#: and what the paper calls sufficient (section 5.2) [K].
LIMITS_K = (*MEASURED_TO_K, ACCEPTED_K)
ALL = "all"
#: What a pyrometer reads of quantities of the surface, in a summary.
_READ = {"T_max_C": "T_max_pyrometer_C", "A_T_K_mm": "A_T_pyrometer_K_mm"}
#: Columns of words that repeat from row to row.
_WORDS = ("case", "variant", "compound", "law")


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """Measured beside simulated.

    Attributes
    ----------
    table : DataFrame
        A row per quantity of each measured test and simulation that belong together.
    statistics : DataFrame
        Bias, RMSE and shares within limits, per variant of the simulation and quantity.
    unmatched : list of str
        Tests without a simulation.
    notes : list of str
        What a reader of the table has to know.
    """

    table: pd.DataFrame
    statistics: pd.DataFrame
    unmatched: list[str]
    notes: list[str]


def simulated_runs(directory: str | Path, *, pyrometer: bool = False) -> pd.DataFrame:
    """Finished runs of a sweep (or of a folder of figures, or a single run), a row each.

    Parameters
    ----------
    directory : str or Path
        Folder of the results.
    pyrometer : bool
        Whether temperatures are those that the pyrometer of the cases reads.

    Returns
    -------
    DataFrame
        `case, folder, variant` (what tells simulations apart beside the conditions),
        `compound, law`, the conditions of `TOLERANCES`, `T_0_C`, `length_mm`, `QUANTITIES`, and
        `pyrometer`.

    Raises
    ------
    CaseError
        If the folder holds no finished run, or one without a pyrometer's reading where that is
        asked for.
    """
    directory = Path(directory)
    rows, cases = [], []
    for folder in _run_folders(directory):
        try:
            case, summary = Case.from_toml(folder / CASE_FILE), read_summary(folder)
        except ValueError:
            continue
        if summary["status"] == OK:
            if pyrometer:
                summary = _as_read(folder, summary)
            cases.append(case)
            rows.append({"case": folder.name, "folder": folder} | _of_run(case, summary))
    if not rows:
        raise CaseError(
            str(directory), "RESULTS_DIR", "no finished run", "the folder of a sweep or of a run"
        )
    return pd.DataFrame(rows).assign(variant=_variants(cases), pyrometer=pyrometer)


def _as_read(folder: Path, summary: dict[str, Any]) -> dict[str, Any]:
    """A summary with the temperatures that its pyrometer reads."""
    if not all(name in summary for name in _READ.values()):
        found = "a run without a pyrometer's reading"
        expected = "[pyrometer] in its case (or no --pyrometer)"
        raise CaseError(str(folder / SUMMARY_JSON), _READ["T_max_C"], found, expected)
    return summary | {name: summary[read] for name, read in _READ.items()}


def _run_folders(directory: Path) -> list[Path]:
    runs = directory / "runs"
    if not runs.is_dir():
        return [directory] if (directory / SUMMARY_JSON).is_file() else []
    table = directory / SUMMARY_CSV
    if table.is_file():
        # Beside the runs of this sweep there may be those of another one.
        try:
            names = pd.read_csv(table, dtype=str, keep_default_na=False)["case"]
            return [runs / _plain_name(table, name) for name in names]
        except KeyError:
            pass
        except (pd.errors.ParserError, pd.errors.EmptyDataError, UnicodeDecodeError) as error:
            found = f"a damaged table ({error})"
            expected = "what a sweep wrote (or no such file)"
            raise CaseError(str(table), "content", found, expected) from None
    return sorted(path for path in runs.iterdir() if (path / SUMMARY_JSON).is_file())


def _plain_name(table: Path, name: str) -> str:
    """Name of a run's folder, which must not lead anywhere else."""
    if name in ("", ".", "..") or Path(name).name != name:
        expected = "the name of a folder in runs"
        raise CaseError(str(table), "case", describe(name), expected)
    return name


def _of_run(case: Case, summary: Mapping[str, Any]) -> dict[str, Any]:
    contact_pressure = summary["mean_contact_pressure_N_per_mm2"]
    return {
        "compound": case.rubber.compound or "",
        "law": case.friction.law,
        "p_N_per_mm2": np.nan if contact_pressure is None else contact_pressure,
        "mean_pressure_N_per_mm2": case.loading.mean_pressure_N_per_mm2,
        "v_mm_per_s": abs(case.loading.velocity_mm_per_s),
        "T_0_C": case.heat.ambient_C,
        "length_mm": case.block.length_mm,
        **{key: np.nan if summary[key] is None else summary[key] for key in QUANTITIES},
    }


def _variants(cases: list[Case]) -> list[str]:
    """What differs between the cases beside the conditions and the output, in words."""
    flat = [_flat(case.to_dict()) for case in cases]
    shared = [key for key in flat[0] if all(key in other for other in flat)]
    told_apart = [
        key
        for key in shared
        if key != _START
        and not _is_condition(key)
        and not key.startswith("output.")
        and any(other[key] != flat[0][key] for other in flat)
    ]
    return [
        ", ".join(f"{key.split('.')[-1]} {other[key]}" for key in told_apart) or "one variant"
        for other in flat
    ]


def _is_condition(key: str) -> bool:
    """Whether a key is the pressure or the velocity, of the slide or of a phase."""
    section, *_, last = key.split(".")
    return section == "loading" and f"{section}.{last}" in (_PRESSURE, _VELOCITY)


def _flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, tuple) and value and isinstance(value[0], Mapping):
            value = dict(enumerate(value))
        if isinstance(value, Mapping):
            flat |= _flat(value, f"{prefix}{key}.")
        else:
            flat[f"{prefix}{key}"] = value
    return flat


def compare(measurements: Measurements, runs: pd.DataFrame) -> Comparison:
    """Put measured and simulated values beside each other.

    Parameters
    ----------
    measurements : Measurements
        What was measured.
    runs : DataFrame
        What `simulated_runs` gives.

    Raises
    ------
    DataError
        If nothing belongs together, or a test fits several conditions it does not state.
    """
    points = measurements.points
    tests, numbers = matched(points, runs)
    found = runs.iloc[numbers]
    _check_unique(measurements, tests, found)
    _check_places(measurements, tests, found)
    table = _table(points.iloc[tests], found)
    if table.empty:
        raise DataError(
            file=measurements.file, found="no test that was simulated", expected=_offer(runs)
        )
    apart = float(np.max(np.abs(table["T_0_measured_C"] - table["T_0_simulated_C"])))
    notes = []
    if apart > 0.0:
        notes.append(
            f"simulations start up to {apart:.3g} K from the T_0_C of the tests: the errors of "
            "T_max_C are those of its rise"
        )
    alone = np.ones(len(points), dtype=bool)
    alone[tests] = False
    unmatched = points["run"].to_numpy()[alone]
    return Comparison(
        table=table, statistics=statistics(table), unmatched=unmatched.tolist(), notes=notes
    )


def _check_unique(measurements: Measurements, tests: IndexArray, found: pd.DataFrame) -> None:
    """Refuse a test that leaves open which of several velocities or pressures it had."""
    at = first_ambiguous(measurements.points, tests, found)
    if at is None:
        return
    point, own = measurements.points.iloc[at], found[tests == at]
    doubled = own[own["variant"].duplicated(keep=False)]
    velocity = doubled.groupby("variant")["v_mm_per_s"].nunique().max() > 1
    column = "v_mm_per_s" if velocity else "p_N_per_mm2"
    values = ", ".join(f"{value:.4g}" for value in sorted(set(doubled[column])))
    raise DataError(
        file=measurements.file,
        row=int(point["row"]),
        column=column,
        found=f"test {point['run']} that fits several simulations",
        expected=f"one of {values}",
    )


def _check_places(measurements: Measurements, tests: IndexArray, found: pd.DataFrame) -> None:
    """Refuse a profile that does not lie on the bottom of the block that was simulated."""
    if not measurements.profiles:
        return
    for at, length in dict(zip(tests.tolist(), found["length_mm"], strict=True)).items():
        X = measurements.profiles[at].X_mm
        beyond = (-_OVERHANG * length > X) | ((1.0 + _OVERHANG) * length < X)
        if not beyond.any() and np.ptp(X) >= _LEAST_COVERED * length:
            continue
        i = int(np.argmax(beyond)) if beyond.any() else len(X) - 1
        likely = " (looks like metres)" if 0.5 < 1e3 * np.ptp(X) / length < 2.0 else ""
        raise DataError(
            file=measurements.file,
            row=int(measurements.profiles[at].rows[i]),
            column="x_mm",
            found=f"{X[i]:g} in a profile from {X[0]:g} to {X[-1]:g}{likely}",
            expected=f"a profile along the bottom of the block, 0 to {length:g} mm",
        )


def _offer(runs: pd.DataFrame) -> str:
    compounds = ", ".join(sorted(set(runs["compound"]) - {""})) or "(constants)"
    velocities = ", ".join(f"{v:g}" for v in sorted(set(runs["v_mm_per_s"])))
    pressures = ", ".join(f"{p:.3g}" for p in sorted(set(runs["p_N_per_mm2"].round(3))))
    starts = ", ".join(f"{T:g}" for T in sorted(set(runs["T_0_C"])))
    return (
        f"one of the compounds {compounds}, v_mm_per_s {velocities}, p_N_per_mm2 {pressures} "
        f"(within {TOLERANCES['p_N_per_mm2']:.0%}), T_0_C {starts} (within {START_TOLERANCE_K:g} K)"
    )


def _table(points: pd.DataFrame, runs: pd.DataFrame) -> pd.DataFrame:
    """The rows of a comparison for tests and simulations that belong together, pair by pair."""
    measured, simulated = (part[list(QUANTITIES)].to_numpy(dtype=float) for part in (points, runs))
    at, quantity = np.nonzero(np.isfinite(measured) & np.isfinite(simulated))
    measured, simulated = measured[at, quantity], simulated[at, quantity]
    own = points.iloc[at].reset_index(drop=True)
    run = runs.iloc[at].reset_index(drop=True).astype(dict.fromkeys(_WORDS, "category"))
    # A temperature has no natural zero: what is compared, and related to, is the rise.
    is_T = quantity == list(QUANTITIES).index("T_max_C")
    reference = measured - np.where(is_T, own["T_0_C"], 0.0)
    error = simulated - np.where(is_T, run["T_0_C"], 0.0) - reference
    return pd.DataFrame(
        {
            "run": own["run"],
            "case": run["case"],
            "variant": run["variant"],
            "compound": run["compound"],
            "law": run["law"],
            "v_mm_per_s": run["v_mm_per_s"],
            "p_measured_N_per_mm2": own["p_N_per_mm2"],
            "p_simulated_N_per_mm2": run["p_N_per_mm2"],
            "T_0_measured_C": own["T_0_C"],
            "T_0_simulated_C": run["T_0_C"],
            "quantity": pd.Categorical(np.array(list(QUANTITIES))[quantity]),
            "unit": pd.Categorical(np.array(list(QUANTITIES.values()))[quantity]),
            "measured": measured,
            "simulated": simulated,
            "error": error,
            "relative_error": np.divide(
                error, reference, out=np.full(error.size, np.nan), where=reference != 0.0
            ),
        }
    )


def statistics(table: pd.DataFrame) -> pd.DataFrame:
    """Bias, RMSE, largest error and shares of temperatures within limits.

    Parameters
    ----------
    table : DataFrame
        `Comparison.table`.

    Returns
    -------
    DataFrame
        A row per variant and quantity, and over all variants if there are several. The errors are
        simulated minus measured, in the unit of the quantity; shares and relative errors in 1.
    """
    by_variant = table.groupby("variant", sort=False, observed=True)
    groups = [(str(variant), part) for variant, part in by_variant]
    if len(groups) > 1:
        groups.append((ALL, table))
    return pd.DataFrame(
        [
            {"variant": variant, "quantity": quantity, "unit": unit} | _moments(own, quantity)
            for variant, part in groups
            for quantity, unit in QUANTITIES.items()
            if len(own := part[part["quantity"] == quantity])
        ]
    )


def _moments(part: pd.DataFrame, quantity: str) -> dict[str, float]:
    error, relative = part["error"].to_numpy(), part["relative_error"].to_numpy()
    is_temperature = quantity == "T_max_C"
    shares = {
        f"share_within_{limit:g}_K": float(np.mean(np.abs(error) <= limit))
        if is_temperature
        else np.nan
        for limit in LIMITS_K
    }
    return {
        "n": len(error),
        "bias": float(error.mean()),
        "rmse": float(np.sqrt(np.mean(error**2))),
        "largest_error": float(error[np.argmax(np.abs(error))]),
        "relative_bias": float(relative.mean()),
        "relative_rmse": float(np.sqrt(np.mean(relative**2))),
        **shares,
    }


def surface_of(run: Mapping[Any, Any]) -> pd.DataFrame:
    """Temperature profile of a simulated run or of its pyrometer, `X_mm` and `T_C`."""
    if run["pyrometer"]:
        table = read_table(Path(run["folder"]) / PYROMETER_FILE, PYROMETER)
        return table[["X_mm", "T_pyrometer_C"]].rename(columns={"T_pyrometer_C": "T_C"})
    return read_table(Path(run["folder"]) / SURFACE_FILE, SURFACE)[["X_mm", "T_C"]]
