"""Pictures of a comparison: measured against simulated values, and the temperature profiles."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.drawing import BLACK, CURVES, DASHES, GREY, MARKERS, PAGE_WIDTH, new_figure, styled
from validation.measured.comparison import LIMITS_K, Comparison
from validation.measured.matching import matched
from validation.measured.measurements import QUANTITIES, Measurements, Profile
from validation.measured.simulated import surface_of

_LABELS = {
    "T_max_C": "$T_{max}$ [°C]",
    "A_T_K_mm": "$A_T$ [K mm]",
    "friction_coefficient": "friction coefficient [-]",
}
_COLUMNS = 3
#: More profiles than these make no readable picture; their numbers are in the table.
MOST_PROFILES = 9
#: More points than these make no better picture.
MOST_POINTS = 20_000


@styled
def draw_comparison(comparison: Comparison) -> Figure:
    """Draw simulated over measured values, a panel per quantity; the band is 2 K wide."""
    table = comparison.table
    quantities = [quantity for quantity in QUANTITIES if (table["quantity"] == quantity).any()]
    variants = list(dict.fromkeys(table["variant"]))
    figure = new_figure(PAGE_WIDTH, 70.0 + 5.0 * ((len(variants) + 1) // 2))
    panels = figure.subplots(1, _COLUMNS, squeeze=False)[0]
    for axes in panels[len(quantities) :]:
        axes.remove()
    for axes, quantity in zip(panels, quantities, strict=False):
        own = table[table["quantity"] == quantity]
        _draw_agreement(axes, own, quantity)
        for i, variant in enumerate(variants):
            part = own[own["variant"] == variant]
            look = {"marker": MARKERS[i % len(MARKERS)], "color": CURVES[i % len(CURVES)]}
            every = -(-len(part) // MOST_POINTS) or 1
            label = variant if every == 1 else f"{variant} (1 in {every})"
            shown = part.iloc[::every]
            axes.plot(shown["measured"], shown["simulated"], ls="", mfc="none", label=label, **look)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2)
    return figure


def _draw_agreement(axes: Axes, table: pd.DataFrame, quantity: str) -> None:
    values = table[["measured", "simulated"]].to_numpy()
    margin = 0.08 * float(np.ptp(values)) or 0.05 * abs(float(values.max())) or 1.0
    ends = np.array([values.min() - margin, values.max() + margin])
    if quantity == "T_max_C":
        width = LIMITS_K[-1]
        axes.fill_between(ends, ends - width, ends + width, color="0.92", label=f"± {width:g} K")
    axes.plot(ends, ends, color=GREY, lw=0.8)
    axes.set(xlim=ends, ylim=ends, aspect="equal")
    axes.set(xlabel=f"measured {_LABELS[quantity]}", ylabel=f"simulated {_LABELS[quantity]}")
    axes.locator_params(nbins=5)
    axes.grid(True)


@styled
def draw_profiles(measurements: Measurements, runs: pd.DataFrame) -> Figure:
    """Draw measured profiles (points) and those of their simulations (lines), a panel per test."""
    tests, numbers = matched(measurements.points, runs)
    shown = [
        (measurements.profiles[test], runs.iloc[numbers[tests == test]])
        for test in np.unique(tests)[:MOST_PROFILES]
    ]
    lines = -(-len(shown) // _COLUMNS)
    figure = new_figure(PAGE_WIDTH, 22.0 + 52.0 * lines)
    panels = figure.subplots(lines, _COLUMNS, squeeze=False)
    for axes in panels.flat[len(shown) :]:
        axes.remove()
    variants = list(dict.fromkeys(runs["variant"]))
    legend: dict[str, Any] = {}
    for axes, (profile, found) in zip(panels.flat, shown, strict=False):
        for run in found.to_dict("records"):
            number, surface = variants.index(run["variant"]), surface_of(run)
            colour, dash = CURVES[number % len(CURVES)], DASHES[number % len(DASHES)]
            look = {"color": colour, "ls": dash, "label": str(run["variant"])}
            axes.plot(surface["X_mm"], surface["T_C"], **look)
        draw_measured_profile(axes, profile)
        axes.set(title=profile.run, xlabel="$X$ [mm]")
        axes.set_ylabel("$T$ [°C]" if axes in panels[:, 0] else "")
        axes.grid(True)
        legend |= dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
    place = {"loc": "outside lower center", "ncols": min(2, len(legend))}
    figure.legend(list(legend.values()), list(legend), **place)
    return figure


def draw_measured_profile(axes: Axes, profile: Profile) -> None:
    """Draw a measured profile as points, in its own coordinate from the trailing corner."""
    X = profile.X_mm - profile.X_mm[0]
    axes.plot(X, profile.T_C, ls="", marker=".", ms=3.0, color=BLACK, label="measured")
