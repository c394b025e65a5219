"""The studies to the limit in Markdown, from their committed tables."""

import itertools

import numpy as np
import pandas as pd

from fem.results import LIMITS
from validation.analysis import markdown_table
from validation.convergence.onset import ONSET_MM
from validation.convergence.table import DAMPING_FORCES, FORCES, PLATEN

#: Share of the work that damping outside of snaps should stay below [-].
DAMPED = 0.01
#: How far the onset may be off its limit, of the force of full slip and of the platen [%].
ONSET_PERCENT = 2.0
_DEFAULT = {"damping": 1.0, "steps_scale": 1.0, "memory_mm": 0.3}
_QUANTITIES = {
    "T_max_C": ("T_max", ".2f", "°C"),
    "A_T_K_mm": ("A_T", ".1f", "K mm"),
    "contact_length_mm": ("contact length", ".2f", "mm"),
    "friction_force_N_per_mm": ("friction force", ".3f", "N/mm"),
}
_HEADS = [f"{name} [{unit}]" for name, _, unit in _QUANTITIES.values()]
_CASE = ("compound", "law", "mu", "height_mm", "velocity_mm_per_s")


# -- the introductory example ----------------------------------------------------------------------


def convergence_text(table: pd.DataFrame) -> str:
    """Table of each mesh at its default, its limit and in short steps, and what scatters."""
    least, shortest = table["damping"].min(), table["steps_scale"].min()
    others = sorted(set(table["memory_mm"]) - {_DEFAULT["memory_mm"]})
    shown = {
        "default": {},
        f"damping {_factor(least)}": {"damping": least},
        f"steps {_factor(shortest)}": {"steps_scale": shortest},
        **{f"memory {m:g} mm": {"memory_mm": m} for m in others},
    }
    rows = [
        [mesh, name, *_cells(_varied(table, mesh, **change))]
        for mesh in table["mesh"].unique()
        for name, change in shown.items()
    ]
    columns = [
        "mesh",
        "run",
        f"force at {', '.join(f'{mm:g}' for mm in ONSET_MM)} mm [N/mm]",
        "platen [mm]",
        *_HEADS,
        "regularisation, snaps [%]",
        "iterations (rejected steps)",
    ]
    return "\n\n".join([markdown_table(columns, rows), *_differences(table), *_scatter(table)])


def _cells(run: pd.Series) -> list[str]:
    return [
        ", ".join(f"{run[force]:.3f}" for force in FORCES),
        f"{run[PLATEN]:.4f}",
        *(f"{run[key]:{form}}" for key, (_, form, _) in _QUANTITIES.items()),
        f"{100 * run['regularisation_share_with_onset']:.2f}, {100 * run['snap_share']:.2f}",
        f"{run['newton_iterations']} ({run['rejected_steps']})"
        + ("" if run["status"] == "ok" else f", {run['status']}"),
    ]


def _differences(table: pd.DataFrame) -> list[str]:
    """What meshes and damping change, each from one run to another."""
    meshes, least = list(table["mesh"].unique()), table["damping"].min()
    near = [d for d in sorted(table["damping"].unique()) if 0.2 < d < 5.0 and d != 1.0]
    pairs = [(f"{m}: damping {_factor(least)}", m, {"damping": least}, m) for m in meshes]
    pairs += [(f"{m}: damping {_factor(d)}", m, {"damping": d}, m) for m in meshes for d in near]
    pairs += [
        (f"{before} to {after} mesh", after, {}, before)
        for before, after in itertools.pairwise(meshes)
    ]
    rows = []
    for name, mesh, change, base in pairs:
        run, default = _varied(table, mesh, **change), _varied(table, base)
        if run["status"] == default["status"] == "ok":
            rows.append([name, *(_difference(key, run[key], default[key]) for key in _QUANTITIES)])
    heads = [name for name, _, _ in _QUANTITIES.values()]
    return ["From the defaults to", markdown_table(["change", *heads], rows)]


def _difference(key: str, value: float, base: float) -> str:
    """Temperatures in K, the rest in per cent."""
    return f"{value - base:+.2f} K" if key.endswith("_C") else f"{100 * (value / base - 1):+.1f} %"


def _scatter(table: pd.DataFrame) -> list[str]:
    """What the results of each mesh scatter by, between step histories and over all damping."""
    reached = table[(table["status"] == "ok") & (table["sliding_regime"] == "steady")]
    plain = reached[reached["memory_mm"] == _DEFAULT["memory_mm"]]
    histories = plain[plain["damping"] == _DEFAULT["damping"]]
    steps = ", ".join(_factor(s) for s in sorted(plain["steps_scale"].unique(), reverse=True))
    damping = ", ".join(_factor(d) for d in sorted(plain["damping"].unique(), reverse=True))
    return [
        f"Between step histories that are equally good (steps {steps}) the results lie in",
        _ranges(histories),
        f"and with these and damping {damping} in",
        _ranges(plain),
        _exceptions(table),
    ]


def _ranges(runs: pd.DataFrame) -> str:
    rows = []
    for mesh, of_mesh in runs.groupby("mesh", sort=False):
        cells = [str(mesh), str(len(of_mesh))]
        for key, (_, form, _) in _QUANTITIES.items():
            low, high = of_mesh[key].min(), of_mesh[key].max()
            half = "" if key.endswith("_C") else f" (±{100 * (high - low) / (high + low):.1f} %)"
            cells.append(f"{low:{form}} to {high:{form}}{half}")
        rows.append(cells)
    return markdown_table(["mesh", "runs", *_HEADS], rows)


def _exceptions(table: pd.DataFrame) -> str:
    """How many runs slid steadily to the end, and which did not."""
    others = table[(table["status"] != "ok") | (table["sliding_regime"] != "steady")]
    words = f"{len(table) - len(others)} of {len(table)} runs slide steadily to the end."
    if others.empty:
        return words
    named = [
        f"{run['mesh']} mesh, damping {_factor(run['damping'])}, steps "
        f"{_factor(run['steps_scale'])}, memory {run['memory_mm']:g} mm: "
        f"{run['sliding_regime'] if run['status'] == 'ok' else run['reason']}"
        for _, run in others.iterrows()
    ]
    return f"{words} The others are left out of the ranges: {'; '.join(named)}."


def _varied(table: pd.DataFrame, mesh: str, **change: float) -> pd.Series:
    """The run of a mesh that differs from the defaults in this only."""
    wanted = {"mesh": mesh, **_DEFAULT, **change}
    chosen = table[np.logical_and.reduce([table[key] == value for key, value in wanted.items()])]
    if len(chosen) != 1:
        raise ValueError(f"{len(chosen)} runs with {wanted}; expected one")
    return chosen.iloc[0]


# -- the onset of other cases ----------------------------------------------------------------------


def onset_text(table: pd.DataFrame) -> str:
    """Largest difference of each case's onset from its limit, and which are too large."""
    found = onset_differences(table)
    rows = []
    for _, run in found.iterrows():
        looks = [
            f"{run[key]:.1f} % at {run[f'{key}_at_mm']:g} mm ({run[f'{key}_damping']:.1f} %)"
            for key in _LOOKS
        ]
        rows.append([run["case"], *looks, f"{run['platen']:.2f} %"])
    short = f"steps of at most {sorted(table['step_mm_max'].unique())[1]:g} mm"
    columns = ["case", "default", short, "the limit in these steps", "platen"]
    return "\n\n".join([markdown_table(columns, rows), _verdict(found)])


_LOOKS = ("default", "short_steps", "limit")


def onset_differences(table: pd.DataFrame) -> pd.DataFrame:
    """How far each case is off its limit, in per cent of full slip (the platen: of itself).

    Parameters
    ----------
    table : DataFrame
        The committed table of the onset. The limit is the run with the least damping and, of these,
        the shortest steps.

    Returns
    -------
    DataFrame
        A row per case: ``case``; for ``default``, ``short_steps`` (those of the limit, or twice
        these, with default damping) and ``limit`` (the least damping in twice the shortest steps)
        the largest difference, with ``_at_mm`` where it is, and with ``_damping`` the force of the
        damping there; ``platen``.
    """
    rows = []
    for case, runs in table.groupby(list(_CASE), sort=False, dropna=False):
        order = runs.sort_values(["damping", "step_mm_max"])
        limit, coarser, short, default = (order.iloc[k] for k in range(4))
        row: dict[str, object] = {"case": _named(dict(zip(_CASE, case, strict=True)), table)}
        for look, run in zip(_LOOKS, (default, short, coarser), strict=True):
            off = 100 * np.abs([run[f] - limit[f] for f in FORCES]) / run["full_slip_N_per_mm"]
            worst = int(off.argmax())
            row |= {look: off[worst], f"{look}_at_mm": ONSET_MM[worst]}
            row[f"{look}_damping"] = 100 * run[DAMPING_FORCES[worst]] / run["full_slip_N_per_mm"]
        row["platen"] = 100 * abs(default[PLATEN] / limit[PLATEN] - 1.0)
        rows.append(row)
    return pd.DataFrame(rows)


def _named(case: dict[str, object], table: pd.DataFrame) -> str:
    """What sets a case apart from the first one of the table."""
    words = {
        "compound": str(case["compound"]),
        "law": f"{str(case['law']).capitalize()}, {case['mu']:g}",
        "height_mm": f"{case['height_mm']:g} mm high",
        "velocity_mm_per_s": f"{case['velocity_mm_per_s']:g} mm/s",
    }
    apart = [said for key, said in words.items() if case[key] != table.iloc[0][key]]
    return ", ".join(apart) or "introductory example"


def _verdict(found: pd.DataFrame) -> str:
    default, short, platen = (
        f"{(found[key] <= ONSET_PERCENT).sum()} of {len(found)}"
        for key in ("default", "short_steps", "platen")
    )
    parts = [
        f"Within {ONSET_PERCENT:g} % of full slip: {default} with the defaults, "
        f"{short} in short steps; the platen {platen}."
    ]
    beyond = found[found["default"] > ONSET_PERCENT]
    if len(beyond):
        parts.append(f"Beyond: {'; '.join(beyond['case'])}.")
    vague = found[found["limit"] > ONSET_PERCENT / 2]
    if len(vague):
        parts.append(
            f"Between its two step lengths the limit itself differs by more than "
            f"{ONSET_PERCENT / 2:g} % for: {'; '.join(vague['case'])}."
        )
    return " ".join(parts)


# -- large snaps -----------------------------------------------------------------------------------

_SNAPPING = ["compound", "mean_pressure_N_per_mm2", "law", "mu"]
_MANY_EQUILIBRIA = (
    "The share itself changes: the folded edge has many equilibria, and damping, steps, or the "
    "last\ndigit of another processor, choose. The summary warns of it."
)


def snaps_text(table: pd.DataFrame) -> str:
    """Table of what large snaps release and what comes of it, and from where on it matters."""
    columns = {
        **{f"damping {_factor(d)}": (d, 1.0) for d in sorted(table["damping"].unique())},
        **{f"steps {_factor(s)}": (1.0, s) for s in sorted(set(table["steps_scale"]) - {1.0})},
    }
    rows, moved = [], []
    for _, runs in table.groupby(_SNAPPING, sort=False, dropna=False):
        case = runs.iloc[0]
        friction = case["law"] if np.isnan(case["mu"]) else f"{case['law']} {case['mu']:g}"
        name = f"{case['compound']}, {case['mean_pressure_N_per_mm2']:g} N/mm², {friction}"
        by = runs.set_index(["damping", "steps_scale"])
        rows.append([name, *(_outcome(by.loc[key]) for key in columns.values())])
        moved.append(_moved(by))
    heads = ["case", *(f"{column}: snaps, T_max, force" for column in columns)]
    return f"{markdown_table(heads, rows)}\n\n{_where_snaps_matter(pd.DataFrame(moved))}"


def _outcome(run: pd.Series) -> str:
    if run["status"] != "ok":
        return str(run["status"])
    return (
        f"{100 * run['snap_share']:.1f} %, {run['T_max_C']:.1f} °C, "
        f"{run['friction_force_N_per_mm']:.2f} N/mm"
    )


def _moved(runs: pd.DataFrame) -> dict[str, float]:
    """Largest snap share of a case's runs in usual steps, and what moves its T_max by how much."""
    ended = runs[["snap_share", "T_max_C"]].where(runs["status"] == "ok")
    share, T_max = ended["snap_share"], ended["T_max_C"]
    usual = T_max[:, 1.0]
    return {
        "share": share[:, 1.0].max(),
        "damping": usual.max() - usual.min(),
        "short steps": (T_max[1.0].drop(1.0) - T_max[1.0, 1.0]).abs().max(),
    }


def _where_snaps_matter(moved: pd.DataFrame) -> str:
    """What damping and steps move T_max by below and above the limit of the trust figure."""
    (limit,) = (limit.largest for limit in LIMITS if limit.key == "snap_share")
    large = moved["share"] > limit
    said = {f"Up to a snap share of {100 * limit:g} %": moved[~large], "Beyond it": moved[large]}
    lines = [
        f"{where} damping moves T_max by up to {cases['damping'].max():.1f} K, shorter steps by up "
        f"to {cases['short steps'].max():.1f} K."
        for where, cases in said.items()
        if len(cases)
    ]
    return "\n".join([*lines, _MANY_EQUILIBRIA])


# -- robustness ------------------------------------------------------------------------------------


def robustness_text(table: pd.DataFrame) -> str:
    """How many cases of the robustness study went through, and how well."""
    ok = table[table["status"] == "ok"]
    damped = ok["regularisation_share_with_onset"]
    few = damped >= DAMPED
    text = (
        f"{len(ok)} of {len(table)} cases slide to their end: coefficients of "
        f"{_listed(table['mu'])}, pressures of {_listed(table['mean_pressure_N_per_mm2'])} N/mm². "
        f"Energy closes to {100 * ok['energy_error'].max():.2f} %, heat to "
        f"{ok['heat_error'].max():.0e}; the block penetrates itself by at most "
        f"{100 * ok['largest_self_penetration'].max():.2f} % of an element. Damping outside of "
        f"snaps takes less than {100 * DAMPED:g} % of the work in {(~few).sum()} of them"
    )
    if not few.any():
        return f"{text}.{_failures(table)}"
    return (
        f"{text}, up to {100 * damped.max():.1f} % in the others, whose leading edge still rolls "
        f"under in snaps at the end: {_at_most(ok, few, 'mu')} of them have the highest "
        f"coefficient, {_at_most(ok, few, 'mean_pressure_N_per_mm2')} the highest pressure."
        f"{_failures(table)}"
    )


def _failures(table: pd.DataFrame) -> str:
    """The cases that did not end, each with its reason."""
    failed = table[table["status"] != "ok"]
    with_mu = failed["law"] + failed["mu"].map(lambda mu: "" if pd.isna(mu) else f" {mu:g}")
    rows = failed.assign(friction=with_mu).to_dict("records")
    return "".join(
        f" Not {row['compound']} with {row['friction']} at {row['mean_pressure_N_per_mm2']:g} "
        f"N/mm²: {row['reason']}."
        for row in rows
    )


def _listed(column: pd.Series) -> str:
    return ", ".join(f"{value:g}" for value in sorted(column.dropna().unique()))


def _at_most(table: pd.DataFrame, rows: pd.Series, column: str) -> int:
    """How many of some rows have the highest value of a column."""
    return int((table.loc[rows, column] == table[column].max()).sum())


# -- Markdown --------------------------------------------------------------------------------------


def _factor(factor: float) -> str:
    """E.g. ``× 3``, ``/ 100``; the default is ``× 1``."""
    return f"× {factor:g}" if factor >= 1.0 else f"/ {1.0 / factor:.3g}"
