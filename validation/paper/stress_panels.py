"""Panels of stress-strain tests: the cycles, the one that is used, and the parameter sets."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from calibration.rubber import last_full_cycle
from materials.compounds import compound
from validation.drawing import BLACK, COMPOUND_LOOKS, GREY

MARKED = "synthetic, last full cycle"
SYNTHETIC_NOTE = "synthetic test: made from the paper's parameters, not measured"


def chosen_cycle(test: pd.DataFrame) -> int:
    """The last full cycle at the highest strain level (section 2.2 of the paper)."""
    number = last_full_cycle(
        test["stretch"].to_numpy(),
        test["cycle"].to_numpy(),
        test["branch"].to_numpy().astype(str),
    )
    if number is None:
        raise ValueError("the test has no full cycle of loading and unloading")
    return number


def draw_test(axes: Axes, test: pd.DataFrame) -> None:
    """Draw all cycles thin and grey, the chosen one black, the path to failure dashed."""
    chosen, last = chosen_cycle(test), int(test["cycle"].max())
    labels = {"other": "other cycles", "chosen": "last full cycle, used", "last": "to failure"}
    for number, path in test.groupby("cycle"):
        kind = "chosen" if number == chosen else "last" if number == last else "other"
        axes.plot(
            100.0 * (path["stretch"] - 1.0),
            path["nominal_stress_N_per_mm2"],
            color=BLACK if kind == "chosen" else GREY,
            ls="--" if kind == "last" else "-",
            lw=1.6 if kind == "chosen" else 0.6,
            label=labels.pop(kind, None),
            zorder=3 if kind == "chosen" else 1,
        )


def draw_sets(axes: Axes, test: pd.DataFrame, strain_percent: tuple[float, float]) -> None:
    """Draw the parameter sets of Table 1, and mark every third point of the chosen cycle."""
    shown = test[test["cycle"] == chosen_cycle(test)].iloc[::3]
    strain, stress = 100.0 * (shown["stretch"] - 1.0), shown["nominal_stress_N_per_mm2"]
    axes.plot(strain, stress, "o", mfc="none", color=GREY, ms=3.0, label=MARKED)
    table = set_table(strain_percent)
    for name, look in COMPOUND_LOOKS.items():
        style = {"color": look.colour, "ls": look.dash, "lw": 1.1, "zorder": 2}
        axes.plot(100.0 * (table["stretch"] - 1.0), table[name], label=look.label, **style)


def set_table(strain_percent: tuple[float, float], points: int = 201) -> pd.DataFrame:
    """Uniaxial nominal stress [N/mm^2] of the parameter sets; NaN beyond a locking stretch."""
    stretch = 1.0 + np.linspace(*strain_percent, points) / 100.0
    columns = {"stretch": stretch}
    with np.errstate(invalid="ignore", divide="ignore"):
        for name in COMPOUND_LOOKS:
            stress = np.asarray(compound(name).nominal_stress(stretch, "uniaxial"), dtype=float)
            columns[name] = np.where(np.isfinite(stress), stress, np.nan)
    return pd.DataFrame(columns)


def draw_row(
    row: Sequence[Axes],
    test: pd.DataFrame,
    strain: tuple[float, float],
    stress: tuple[float, float],
    titles: tuple[str, str],
) -> None:
    """Draw the cycles on the left and the parameter sets over the chosen one on the right."""
    cycles, sets = row
    draw_test(cycles, test)
    cycles.legend(loc="upper left")
    draw_sets(sets, test, strain)
    for axes, title in zip(row, titles, strict=True):
        axes.set(title=title, xlim=strain, ylim=stress)
        axes.set(xlabel="nominal strain [%]", ylabel="nominal stress [N/mm²]")
        axes.axhline(0.0, color=GREY, lw=0.5)
        axes.axvline(0.0, color=GREY, lw=0.5)
        axes.grid(True)


def marked(test: pd.DataFrame) -> pd.DataFrame:
    """The test with a column that says which rows are used."""
    return test.assign(used=test["cycle"] == chosen_cycle(test))
