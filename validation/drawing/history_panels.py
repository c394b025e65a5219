"""Panels over the sliding distance and along the bottom surface, drawn from result tables."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from materials.arrays import FloatArray
from validation.drawing.style import BLUE, GREEN, GREY, ORANGE, SKY, VERMILLION


def draw_friction(axes: Axes, history: pd.DataFrame) -> None:
    """Draw friction force over normal force against the sliding distance."""
    axes.plot(_distance(history), history["friction_coefficient"].abs(), color=BLUE)
    _finish(axes, history, r"$F_T / F_N$ [-]", from_zero=True)


def draw_temperature(axes: Axes, history: pd.DataFrame, *, edge: bool = True) -> None:
    """Draw the interior maximum and the front edge's temperature against the sliding distance."""
    distance = _distance(history)
    axes.plot(distance, history["T_max_C"], color=VERMILLION, label=r"$T_{max}$, interior")
    if edge:
        axes.plot(distance, history["T_edge_C"], color=ORANGE, ls="--", label="front edge")
        axes.legend(loc="best")
    _finish(axes, history, "$T$ [°C]")


def draw_forces(axes: Axes, history: pd.DataFrame) -> None:
    """Draw the normal and the friction force."""
    distance = _distance(history)
    axes.plot(distance, history["normal_force_N_per_mm"], color=GREY, label="$F_N$")
    axes.plot(distance, history["friction_force_N_per_mm"].abs(), color=BLUE, label="$F_T$")
    axes.legend(loc="best", ncols=2)
    _finish(axes, history, "force per depth [N/mm]", from_zero=True)


def draw_contact(axes: Axes, history: pd.DataFrame) -> None:
    """Draw the mean contact pressure and, on the right, the contact length."""
    distance = _distance(history)
    axes.plot(distance, history["mean_contact_pressure_N_per_mm2"], color=BLUE)
    _finish(axes, history, "mean contact pressure [N/mm²]", from_zero=True)
    axes.yaxis.label.set_color(BLUE)
    twin = axes.twinx()
    twin.plot(distance, history["contact_length_mm"], color=GREEN, ls="--")
    twin.set_ylabel("contact length [mm]", color=GREEN)
    twin.spines["right"].set_visible(True)
    twin.set_ylim(bottom=0.0)


def draw_surface_temperature(axes: Axes, surface: pd.DataFrame, T_max: float | None) -> None:
    """Draw the temperature along the bottom surface; regions in contact are shaded."""
    shade_contact(axes, surface)
    axes.plot(surface["X_mm"], surface["T_C"], color=VERMILLION)
    if T_max is not None:
        axes.axhline(T_max, color=GREY, lw=0.7, ls=":")
        text, place = rf"$T_{{max}}$ = {T_max:.1f} °C", (float(surface["X_mm"].min()), T_max)
        axes.annotate(text, place, xytext=(4, 3), textcoords="offset points", fontsize=7.5)
    _along_bottom(axes, surface, "$T$ [°C]")


def draw_surface_traction(axes: Axes, surface: pd.DataFrame) -> None:
    """Draw contact pressure and frictional shear along the bottom surface."""
    shade_contact(axes, surface)
    axes.plot(surface["X_mm"], surface["pressure_N_per_mm2"], color=BLUE, label="$p$")
    shear = surface["shear_N_per_mm2"].abs()
    axes.plot(surface["X_mm"], shear, color=ORANGE, ls="--", label="shear")
    axes.legend(loc="best", ncols=2)
    _along_bottom(axes, surface, "contact stress [N/mm²]")
    axes.set_ylim(bottom=0.0)


def shade_contact(axes: Axes, surface: pd.DataFrame) -> None:
    """Shade the stretches of the bottom surface that touch the road."""
    touching = surface["in_contact"].astype(bool).to_numpy()
    edges = edges_of(surface["X_mm"].to_numpy())
    change = np.diff(np.concatenate([[0], touching.astype(int), [0]]))
    for start, end in zip(np.flatnonzero(change > 0), np.flatnonzero(change < 0), strict=True):
        axes.axvspan(edges[start], edges[end], color=SKY, alpha=0.18, lw=0.0)


def edges_of(X: FloatArray) -> FloatArray:
    """Ends of the pieces of a line that belong to its nodes, (n + 1,) [mm]."""
    return np.concatenate([X[:1], 0.5 * (X[1:] + X[:-1]), X[-1:]])


def _distance(history: pd.DataFrame) -> pd.Series:
    return history["sliding_distance_mm"].abs()


def _finish(axes: Axes, history: pd.DataFrame, label: str, *, from_zero: bool = False) -> None:
    axes.set(xlabel="sliding distance $g_T$ [mm]", ylabel=label)
    axes.set_xlim(0.0, max(float(_distance(history).max()), 1e-9))
    axes.grid(True)
    if from_zero:
        axes.set_ylim(bottom=0.0)


def _along_bottom(axes: Axes, surface: pd.DataFrame, label: str) -> None:
    axes.set(xlabel="$X$ from the trailing to the leading corner [mm]", ylabel=label)
    axes.set_xlim(float(surface["X_mm"].min()), float(surface["X_mm"].max()))
    axes.grid(True)
