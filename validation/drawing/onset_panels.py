"""The onset of sliding: force, stick and slip, and pressure over the platen's motion."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from fem.results import BottomHistory
from materials.arrays import FloatArray, IndexArray
from validation.drawing.history_panels import edges_of
from validation.drawing.style import BLUE, GREY, ORANGE, PAGE_WIDTH, STRESS_MAP, new_figure, styled

#: Share of the steady friction force at which the block slides in full, and how far behind it the
#: picture goes: the leading edge goes on rolling under.
FULL_SLIP, BEYOND = 0.95, 3.0
#: Colours of open, stick and slip.
STATUS_COLOURS = {"open": "#FFFFFF", "stick": BLUE, "slip": ORANGE}


def onset_end(history: pd.DataFrame) -> float:
    """Platen motion up to which the onset is drawn [mm]."""
    motion, force = history["sliding_distance_mm"], history["friction_force_N_per_mm"].abs()
    slid = motion.iloc[-1]
    steady = force[motion >= 0.5 * slid].mean()
    reached = motion[(motion > 0.0) & (force >= FULL_SLIP * steady)]
    return float(min(BEYOND * reached.iloc[0], slid)) if len(reached) else float(slid)


@styled
def draw_onset(history: pd.DataFrame, bottom: BottomHistory) -> Figure:
    """Draw friction force, status and contact pressure of the bottom over the platen's motion."""
    figure = new_figure(PAGE_WIDTH, 150.0)
    above, middle, below = figure.subplots(3, 1, sharex=True, height_ratios=(1.0, 1.2, 1.2))
    steps = _shown_steps(history)
    _draw_force(above, history, steps)
    # From rest on: a step is drawn in the state it ended with.
    motion = np.append(0.0, history["sliding_distance_mm"].to_numpy()[steps])
    _draw_status(middle, motion, bottom, steps)
    mesh = _draw_pressure(below, motion, bottom, steps)
    bar = figure.colorbar(mesh, ax=below, extend="max", pad=0.01, aspect=15)
    bar.set_label("pressure [N/mm²]")
    below.set(xlabel="platen motion [mm]", xlim=(0.0, onset_end(history)))
    return figure


def _shown_steps(history: pd.DataFrame) -> IndexArray:
    """Sliding steps up to the end of the onset, and the one that reaches over it."""
    motion = history["sliding_distance_mm"].to_numpy()
    before = np.concatenate([[0.0], motion[:-1]])
    return np.flatnonzero((motion > 0.0) & (before < onset_end(history)))


def _draw_force(axes: Axes, history: pd.DataFrame, steps: IndexArray) -> None:
    motion, force = (
        history[name].abs().to_numpy()[np.concatenate([steps[:1] - 1, steps]).clip(min=0)]
        for name in ("sliding_distance_mm", "friction_force_N_per_mm")
    )
    axes.plot(motion, force, color=BLUE, marker="o", markersize=2.5)
    axes.set(ylabel="friction force [N/mm]", title="Friction force (a dot per accepted step)")
    axes.set_ylim(bottom=0.0)
    axes.grid(axis="y")


def _draw_status(axes: Axes, motion: FloatArray, bottom: BottomHistory, steps: IndexArray) -> None:
    colours = ListedColormap(list(STATUS_COLOURS.values()))
    X, kind = edges_of(bottom.X_mm), bottom.kind[steps].T
    axes.pcolormesh(motion, X, kind, cmap=colours, vmin=-0.5, vmax=2.5)
    axes.set(ylabel="$X$ [mm]", title="Status along the bottom (0: trailing corner)")
    handles = [
        Patch(facecolor=colour, edgecolor=GREY, lw=0.5, label=name)
        for name, colour in STATUS_COLOURS.items()
    ]
    place = {"loc": "lower right", "bbox_to_anchor": (1.0, 0.98), "borderaxespad": 0.0}
    axes.legend(handles=handles, ncols=3, **place)


def _draw_pressure(axes: Axes, motion: FloatArray, bottom: BottomHistory, steps: IndexArray) -> Any:
    pressure = bottom.pressure[steps]
    # The corner carries many times the mean: the scale ends where all but it is told apart.
    pressed = pressure[pressure > 0.0]
    largest = 3.0 * float(np.median(pressed)) if pressed.size else 1.0
    shown = np.ma.masked_where(bottom.kind[steps] == 0, pressure)
    X = edges_of(bottom.X_mm)
    mesh = axes.pcolormesh(motion, X, shown.T, cmap=STRESS_MAP, vmin=0.0, vmax=largest)
    axes.set(ylabel="$X$ [mm]", title="Contact pressure (white: open)")
    return mesh
