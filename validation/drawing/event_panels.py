"""Pictures of an event of several contacts: temperatures, friction, depth, a contact in motion."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from fem.files import replacing
from fem.results import Result
from validation.drawing.block_drawing import draw_outline, draw_road, draw_smooth, set_window
from validation.drawing.style import (
    BLUE,
    GREY,
    PAGE_WIDTH,
    TEMPERATURE_MAP,
    VERMILLION,
    new_figure,
    styled,
)

#: Depth that is drawn [mm]: what some contacts heat.
DEPTH = 2.0


@styled
def draw_event(result: Result, contacts: pd.DataFrame) -> Figure:
    """Draw surface temperature over the event, friction per contact, temperature over depth."""
    figure = new_figure(PAGE_WIDTH, 125.0)
    above, below = figure.subplots(2, 1, height_ratios=(1.2, 1.0))
    _draw_temperatures(above, result.history)
    grid = below.get_subplotspec()
    below.remove()
    left, right = grid.subgridspec(1, 2).subplots()
    _draw_friction(left, contacts)
    _draw_depth(right, result)
    return figure


def _draw_temperatures(axes: Axes, history: pd.DataFrame) -> None:
    time = history["time_s"]
    axes.plot(time, history["T_edge_C"], color=GREY, linewidth=0.7, label="front edge")
    axes.plot(time, history["T_max_C"], color=VERMILLION, label="bottom, without the edge")
    axes.set(xlabel="time [s]", ylabel="highest temperature [°C]", title="Surface of the block")
    axes.set_xlim(0.0, time.iloc[-1])
    axes.legend(loc="upper left")


def _draw_friction(axes: Axes, contacts: pd.DataFrame) -> None:
    axes.plot(contacts["contact"], contacts["friction_coefficient"], "o-", color=BLUE)
    axes.set(xlabel="contact [-]", ylabel="friction coefficient [-]", title="Grip")
    axes.xaxis.get_major_locator().set_params(integer=True)


def _draw_depth(axes: Axes, result: Result) -> None:
    """Temperature below the middle of the bottom, in the snapshots of the last contact."""
    points = result.geometry.points
    middle = 0.5 * (points[:, 0].min() + points[:, 0].max())
    x = points[np.argmin(np.abs(points[:, 0] - middle)), 0]
    line = np.flatnonzero((np.abs(points[:, 0] - x) < 1e-9) & (points[:, 1] <= DEPTH))
    line = line[np.argsort(points[line, 1])]
    taken = result.snapshots
    shown = sorted({0, len(taken) // 3, max(len(taken) - 2, 0), len(taken) - 1})
    for share, number in zip(np.linspace(0.0, 1.0, len(shown)), shown, strict=True):
        label = f"{1e3 * (taken[number].time_s - taken[0].time_s):.3g} ms"
        T, colour = taken[number].temperature[line], (share, 0.2, 1.0 - share)
        axes.plot(T, points[line, 1], color=colour, label=label)
    axes.invert_yaxis()
    axes.set(xlabel="temperature [°C]", ylabel="depth [mm]", title="Below the middle, last contact")
    axes.legend(title="since first picture")


@styled
def draw_wear(result: Result) -> Figure:
    """Draw what wore off along the bottom, and off the leading face, which rolls under."""
    figure = new_figure(PAGE_WIDTH, 65.0)
    bottom, face = figure.subplots(1, 2, sharey=True, width_ratios=(2.0, 1.0))
    chains = result.boundary.groupby(["block", "chain"], sort=False)
    for (_, name), chain in chains:
        if str(name).startswith("bottom"):
            bottom.plot(chain["X_mm"], chain["wear_depth_um"], color=VERMILLION)
        elif name == "leading face":
            face.plot(chain["s_mm"], chain["wear_depth_um"], color=VERMILLION)
    share = result.summary["wear_front_share"]
    bottom.set(
        xlabel="$X$ from the trailing to the leading corner [mm]",
        ylabel="wear [µm]",
        title=f"Bottom; {share:.0%} of the volume at the front edge",
    )
    face.set(xlabel="up the face from the corner [mm]", title="Leading face")
    for axes in (bottom, face):
        axes.grid(True)
        axes.set_ylim(bottom=0.0)
    return figure


@styled
def draw_pyrometer(result: Result) -> Figure:
    """Draw what the pyrometer reads along the bottom beside the profile at the end of contact."""
    table, given = result.pyrometer, result.case.pyrometer
    assert table is not None
    assert given is not None
    figure = new_figure(120.0, 70.0)
    axes = figure.subplots()
    axes.plot(table["X_mm"], table["T_C"], color=VERMILLION, label="end of contact")
    whole = table["spot_covered"] > 1.0 - 1e-9
    axes.plot(table["X_mm"], table["T_pyrometer_C"], color=BLUE, ls=":", label="spot over a corner")
    read = table["T_pyrometer_C"].where(whole)
    axes.plot(table["X_mm"], read, color=BLUE, label="pyrometer")
    speed = result.summary["pyrometer_speed_mm_per_s"]
    axes.set(
        xlabel="$X$ from the trailing to the leading corner [mm]",
        ylabel="$T$ [°C]",
        title=f"Spot of {given.spot_mm:g} mm, {given.gap_mm:g} mm behind the road's end, "
        f"{speed:.4g} mm/s",
    )
    axes.legend(loc="best")
    axes.grid(True)
    return figure


def write_animation(result: Result, path: Path) -> Path:
    """Write the snapshots of the last contact as an animated GIF, the block at 1:1 on its road."""
    snapshots, rest = result.snapshots, result.geometry
    places = [rest.points + snapshot.displacement for snapshot in snapshots]
    (x_min, y_min), (x_max, y_max) = np.min(places, axis=(0, 1)), np.max(places, axis=(0, 1))
    # With a strip of road below.
    window = (x_min - 1.0, x_max + 1.0, min(y_min, 0.0) - 1.0, y_max + 0.5)
    temperatures = np.concatenate([snapshot.temperature for snapshot in snapshots])
    norm = Normalize(temperatures.min(), temperatures.max())
    figure = new_figure(PAGE_WIDTH, 85.0)
    axes = figure.subplots()
    colours = ScalarMappable(norm=norm, cmap=TEMPERATURE_MAP)
    figure.colorbar(colours, ax=axes, label="temperature [°C]", pad=0.01)

    def draw(number: int) -> list[Axes]:
        axes.clear()
        points, snapshot = places[number], snapshots[number]
        draw_road(axes, window)
        draw_smooth(axes, points, rest.cells, snapshot.temperature, norm, TEMPERATURE_MAP)
        draw_outline(axes, points, rest.cells)
        set_window(axes, window)
        axes.set(xlabel="$x$ in the platen's frame [mm]", ylabel="$y$ [mm]")
        axes.set_title(f"{1e3 * snapshot.time_s:.2f} ms, {snapshot.sliding_distance_mm:.2f} mm")
        return [axes]

    film = FuncAnimation(figure, draw, frames=len(snapshots))
    with replacing(path) as temporary:
        film.save(temporary, writer=PillowWriter(fps=5), dpi=90)
    return path
