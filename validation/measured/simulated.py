"""Finished runs as tests of their own: conditions and results, a row per run and block."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

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
    excess_area,
    interior_peak,
    read_summary,
    read_table,
)
from validation.measured.measurements import ALL_BLOCKS, QUANTITIES

#: Keys of a case that are conditions of a test, beside the same of a phase.
_CONDITIONS = ("mean_pressure_N_per_mm2", "velocity_mm_per_s")
_START = "heat.ambient_C"
#: What a pyrometer reads of quantities of the surface, in a summary.
_READ = {"T_max_C": "T_max_pyrometer_C", "A_T_K_mm": "A_T_pyrometer_K_mm"}


def simulated_runs(directory: str | Path, *, pyrometer: bool = False) -> pd.DataFrame:
    """Finished runs of a sweep (or of a folder of figures, or a single run), a row each.

    A run with several blocks has a row for all of them and one for each.

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
        `compound, law`, the conditions of `TOLERANCES`, `T_0_C`, `QUANTITIES`, `pyrometer`;
        `block` (NaN for a block alone), and where its bottom lies: `begin_mm, length_mm`.

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
            whole = _of_run(case, folder, summary)
            own = [whole, *_of_blocks(case, whole, summary, pyrometer)]
            cases += [case] * len(own)
            rows += own
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


def _of_run(case: Case, folder: Path, summary: Mapping[str, Any]) -> dict[str, Any]:
    begin, length = 0.0, case.block.length_mm
    if case.block.file is not None:
        # Where the bottom of a mesh file lies stands in its results only.
        X = _surface(folder, pyrometer=False)["X_mm"]
        begin, length = X.iloc[0], X.iloc[-1] - X.iloc[0]
    return {
        "case": folder.name,
        "folder": folder,
        "compound": case.rubber.compound or "",
        "law": case.friction.law,
        "block": ALL_BLOCKS if "blocks" in summary else np.nan,
        "mean_pressure_N_per_mm2": case.loading.mean_pressure_N_per_mm2,
        "v_mm_per_s": abs(case.loading.velocity_mm_per_s),
        "T_0_C": case.heat.ambient_C,
        "begin_mm": begin,
        "length_mm": length,
        **_results(summary),
    }


def _results(summary: Mapping[str, Any]) -> dict[str, float]:
    pressure = summary["mean_contact_pressure_N_per_mm2"]
    values = {"p_N_per_mm2": pressure} | {key: summary[key] for key in QUANTITIES}
    return {key: np.nan if value is None else value for key, value in values.items()}


def _of_blocks(
    case: Case, whole: dict[str, Any], summary: Mapping[str, Any], pyrometer: bool
) -> list[dict[str, Any]]:
    """Rows of the blocks of a run with several; what its pyrometer reads is told apart by place."""
    rows, pitch = [], case.block.length_mm + case.block.groove_mm
    for block in summary.get("blocks", []):
        place = {"block": block["block"], "begin_mm": (block["block"] - 1) * pitch}
        row = whole | place | _results(block)
        if pyrometer:
            X, T = surface_of(row | {"pyrometer": True}).to_numpy().T
            peak, area = interior_peak(X, T).T_max_C, excess_area(X, T, row["T_0_C"])
            row |= {"T_max_C": peak, "A_T_K_mm": area}
        rows.append(row)
    return rows


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
    return section == "loading" and last in _CONDITIONS


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


def surface_of(run: Mapping[Any, Any]) -> pd.DataFrame:
    """Temperature profile of a simulated run or of its pyrometer, `X_mm` and `T_C`.

    Of one block of several it is the part under that block, counted from its trailing corner.
    """
    surface = _surface(Path(run["folder"]), pyrometer=run["pyrometer"])
    X, slack = surface["X_mm"] - run["begin_mm"], 1e-9 * run["length_mm"]
    return surface.assign(X_mm=X)[X.between(-slack, run["length_mm"] + slack)]


def _surface(folder: Path, *, pyrometer: bool) -> pd.DataFrame:
    if pyrometer:
        table = read_table(folder / PYROMETER_FILE, PYROMETER)
        return table[["X_mm", "T_pyrometer_C"]].rename(columns={"T_pyrometer_C": "T_C"})
    return read_table(folder / SURFACE_FILE, SURFACE)[["X_mm", "T_C"]]
