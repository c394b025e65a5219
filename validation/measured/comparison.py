"""Measurements against simulations: which belong together, and how far they are apart."""

from dataclasses import dataclass

import numpy as np
import pandas as pd

from calibration.data import DataError
from materials.arrays import IndexArray
from validation.analysis import ACCEPTED_K, MEASURED_TO_K
from validation.measured.matching import START_TOLERANCE_K, TOLERANCES, matched
from validation.measured.measurements import ALL_BLOCKS, QUANTITIES, Measurements, Profile

#: Share of the block's length by which a profile may reach beyond its corners, and which it has
#: to cover at least [-].
_OVERHANG, _LEAST_COVERED = 0.05, 0.1
#: Limits of the temperature error that are counted: the accuracy of the measurement (0.5 to 1 K)
#: and what the paper calls sufficient (section 5.2) [K].
LIMITS_K = (*MEASURED_TO_K, ACCEPTED_K)
ALL = "all"
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


def compare(measurements: Measurements, runs: pd.DataFrame) -> Comparison:
    """Put measured values and those of `simulated_runs` beside each other.

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
    note = (
        f"simulations start up to {apart:.3g} K from the T_0_C of the tests: the errors of "
        "T_max_C are those of its rise"
    )
    return Comparison(
        table=table,
        statistics=statistics(table),
        unmatched=np.delete(points["run"].to_numpy(), tests).tolist(),
        notes=[note] if apart > 0.0 else [],
    )


def _check_unique(measurements: Measurements, tests: IndexArray, found: pd.DataFrame) -> None:
    """Refuse a test that leaves open which of several velocities or pressures it had."""
    repeated = pd.DataFrame({"test": tests, "variant": found["variant"].to_numpy()}).duplicated()
    if not repeated.any():
        return
    at = int(tests[np.argmax(repeated.to_numpy())])
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
    places = zip(found["block"], found["length_mm"], strict=True)
    for at, (block, length) in dict(zip(tests.tolist(), places, strict=True)).items():
        profile = measurements.profiles[at]
        if block == ALL_BLOCKS:
            raise DataError(
                file=measurements.file,
                row=int(profile.rows[0]),
                column="block",
                found=f"nothing, and several blocks in {found['case'].iloc[0]}",
                expected="the block that the profile is of, counted from the trailing one",
            )
        _check_place(measurements.file, profile, length)


def _check_place(file: str, profile: Profile, length: float) -> None:
    X = profile.X_mm
    beyond = (-_OVERHANG * length > X) | ((1.0 + _OVERHANG) * length < X)
    if not beyond.any() and np.ptp(X) >= _LEAST_COVERED * length:
        return
    i = int(np.argmax(beyond)) if beyond.any() else len(X) - 1
    likely = " (looks like metres)" if 0.5 < 1e3 * np.ptp(X) / length < 2.0 else ""
    raise DataError(
        file=file,
        row=int(profile.rows[i]),
        column="x_mm",
        found=f"{X[i]:g} in a profile from {X[0]:g} to {X[-1]:g}{likely}",
        expected=f"a profile along the bottom of the block, 0 to {length:g} mm",
    )


def _offer(runs: pd.DataFrame) -> str:
    compounds = ", ".join(sorted(set(runs["compound"]) - {""})) or "(constants)"
    velocities = ", ".join(f"{v:g}" for v in sorted(set(runs["v_mm_per_s"])))
    pressures = ", ".join(f"{p:.3g}" for p in sorted(set(runs["p_N_per_mm2"].round(3))))
    starts = ", ".join(f"{T:g}" for T in sorted(set(runs["T_0_C"])))
    blocks = ", ".join(f"{block:g}" for block in sorted(set(runs["block"].dropna()) - {ALL_BLOCKS}))
    return (
        f"one of the compounds {compounds}, v_mm_per_s {velocities}, p_N_per_mm2 {pressures} "
        f"(within {TOLERANCES['p_N_per_mm2']:.0%}), T_0_C {starts} (within {START_TOLERANCE_K:g} K)"
        + (f", block {blocks} or nothing" if blocks else "")
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
            **{name: run[name] for name in (*_WORDS, "block", "v_mm_per_s")},
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
    """Bias, RMSE, largest error and shares of temperatures within limits, of `Comparison.table`.

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
    shares = np.mean(np.abs(error) <= np.array(LIMITS_K)[:, None], axis=1).tolist()
    within = {f"share_within_{limit:g}_K": s for limit, s in zip(LIMITS_K, shares, strict=True)}
    return {
        "n": len(error),
        "bias": float(error.mean()),
        "rmse": float(np.sqrt(np.mean(error**2))),
        "largest_error": float(error[np.argmax(np.abs(error))]),
        "relative_bias": float(relative.mean()),
        "relative_rmse": float(np.sqrt(np.mean(relative**2))),
        **(within if quantity == "T_max_C" else dict.fromkeys(within, np.nan)),
    }
