"""Panels over the sliding distance and along the bottom surface, drawn from result tables."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from validation.drawing.style import BLUE, GREEN, GREY, ORANGE, SKY, VERMILLION

DISTANCE_LABEL = "sliding distance $g_T$ [mm]"


def draw_friction(axes: Axes, history: pd.DataFrame) -> None:
    """Draw friction force over normal force against the sliding distance."""
    axes.plot(_distance(history), history["friction_coefficient"].abs(), color=BLUE)
    axes.set_ylabel(r"$F_T / F_N$ [-]")
    _finish(axes, history)
    axes.set_ylim(bottom=0.0)


def draw_temperature(axes: Axes, history: pd.DataFrame, *, edge: bool = True) -> None:
    """Draw the interior maximum and the front edge's temperature against the sliding distance."""
    distance = _distance(history)
    axes.plot(distance, history["T_max_C"], color=VERMILLION, label=r"$T_{max}$, interior")
    if edge:
        axes.plot(distance, history["T_edge_C"], color=ORANGE, ls="--", label="front edge")
        axes.legend(loc="best")
    axes.set_ylabel("$T$ [°C]")
    _finish(axes, history)


def draw_forces(axes: Axes, history: pd.DataFrame) -> None:
    """Draw the normal and the friction force."""
    distance = _distance(history)
    axes.plot(distance, history["normal_force_N_per_mm"], color=GREY, label="$F_N$")
    axes.plot(distance, history["friction_force_N_per_mm"].abs(), color=BLUE, label="$F_T$")
    axes.set_ylabel("force per depth [N/mm]")
    axes.legend(loc="best", ncols=2)
    _finish(axes, history)
    axes.set_ylim(bottom=0.0)


def draw_contact(axes: Axes, history: pd.DataFrame) -> None:
    """Draw the mean contact pressure and, on the right, the contact length."""
    distance = _distance(history)
    axes.plot(distance, history["mean_contact_pressure_N_per_mm2"], color=BLUE)
    axes.set_ylabel("mean contact pressure [N/mm²]", color=BLUE)
    _finish(axes, history)
    axes.set_ylim(bottom=0.0)
    twin = axes.twinx()
    twin.plot(distance, history["contact_length_mm"], color=GREEN, ls="--")
    twin.set_ylabel("contact length [mm]", color=GREEN)
    twin.spines["right"].set_visible(True)
    twin.set_ylim(bottom=0.0)


def draw_surface_temperature(
    axes: Axes, surface: pd.DataFrame, summary_T_max: float | None
) -> None:
    """Draw the temperature along the bottom surface; regions in contact are shaded."""
    shade_contact(axes, surface)
    axes.plot(surface["X_mm"], surface["T_C"], color=VERMILLION)
    if summary_T_max is not None:
        axes.axhline(summary_T_max, color=GREY, lw=0.7, ls=":")
        axes.annotate(
            rf"$T_{{max}}$ = {summary_T_max:.1f} °C",
            (float(surface["X_mm"].min()), summary_T_max),
            xytext=(4, 3),
            textcoords="offset points",
            fontsize=7.5,
        )
    axes.set_ylabel("$T$ [°C]")
    _along_bottom(axes, surface)


def draw_surface_traction(axes: Axes, surface: pd.DataFrame) -> None:
    """Draw contact pressure and frictional shear along the bottom surface."""
    shade_contact(axes, surface)
    axes.plot(surface["X_mm"], surface["pressure_N_per_mm2"], color=BLUE, label="$p$")
    axes.plot(
        surface["X_mm"], surface["shear_N_per_mm2"].abs(), color=ORANGE, ls="--", label="shear"
    )
    axes.set_ylabel("contact stress [N/mm²]")
    axes.legend(loc="best", ncols=2)
    _along_bottom(axes, surface)
    axes.set_ylim(bottom=0.0)


def shade_contact(axes: Axes, surface: pd.DataFrame) -> None:
    """Shade the stretches of the bottom surface that touch the road."""
    touching = surface["in_contact"].astype(bool).to_numpy()
    X = surface["X_mm"].to_numpy()
    between = 0.5 * (X[1:] + X[:-1])
    edges = np.concatenate([X[:1], between, X[-1:]])
    change = np.diff(np.concatenate([[0], touching.astype(int), [0]]))
    for start, end in zip(np.flatnonzero(change > 0), np.flatnonzero(change < 0), strict=True):
        axes.axvspan(edges[start], edges[end], color=SKY, alpha=0.18, lw=0.0)


def _distance(history: pd.DataFrame) -> pd.Series:
    return history["sliding_distance_mm"].abs()


def _finish(axes: Axes, history: pd.DataFrame) -> None:
    axes.set_xlabel(DISTANCE_LABEL)
    axes.set_xlim(0.0, max(float(_distance(history).max()), 1e-9))
    axes.grid(True)


def _along_bottom(axes: Axes, surface: pd.DataFrame) -> None:
    axes.set_xlabel("$X$ from the trailing to the leading corner [mm]")
    axes.set_xlim(float(surface["X_mm"].min()), float(surface["X_mm"].max()))
    axes.grid(True)
