"""Figure 9: vertical normal stress on the deformed block for the six parameter sets."""

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fem.files import write_table
from fem.sweeps import StudyRun
from validation.analysis import contour
from validation.drawing import (
    BLACK,
    COMPOUND_LOOKS,
    PAGE_WIDTH,
    BlockState,
    Window,
    draw_road,
    draw_stress,
    last_state,
    new_figure,
    reached,
    save,
    set_window,
    stress_scale,
    styled,
)
from validation.studies import runs_of

COMPOUND = "rubber.compound"
#: Rows of panels above the contours.
PANEL_ROWS = 3


def make(directory: Path) -> Path:
    """Draw figure 9 from the study of compounds and write extremes and contours beside it."""
    runs = runs_of("compounds", directory)
    states = by_compound(runs)
    write_table(directory / "fig9.csv", extremes_table(states))
    write_table(directory / "fig9_contours.csv", contour_table(states))
    return save(draw(states, stopped(runs)), directory / "fig9.png")


def by_compound(runs: list[StudyRun]) -> dict[str, BlockState]:
    """The last states by compound, in the paper's order."""
    found = {run[COMPOUND]: last_state(run.result) for run in runs}
    return {name: found[name] for name in COMPOUND_LOOKS if name in found}


def stopped(runs: list[StudyRun]) -> dict[str, str]:
    """What to say of runs that did not get to their end, by compound."""
    return {run[COMPOUND]: reached(run.result) for run in runs}


def extremes_table(states: dict[str, BlockState]) -> pd.DataFrame:
    """Smallest and largest vertical stress of all elements, a row per compound."""
    rows = []
    for name, state in states.items():
        sigma_y = state.snapshot.cauchy_stress[:, 1]
        moved = np.linalg.norm(state.snapshot.displacement, axis=1)
        rows.append(
            {
                "compound": name,
                "sigma_y_min_N_per_mm2": sigma_y.min(),
                "sigma_y_max_N_per_mm2": sigma_y.max(),
                "largest_displacement_mm": moved.max(),
            }
        )
    return pd.DataFrame(rows)


def contour_table(states: dict[str, BlockState]) -> pd.DataFrame:
    """Deformed contours: the boundary nodes of every compound, in the order of the boundary."""
    columns = ["x_mm", "y_mm"]
    parts = {name: pd.DataFrame(contour(state), columns=columns) for name, state in states.items()}
    return pd.concat(parts, names=["compound"]).reset_index("compound").reset_index(drop=True)


@styled
def draw(states: dict[str, BlockState], notes: dict[str, str] | None = None) -> Figure:
    """Draw a panel per compound on one scale, and all contours over each other."""
    figure = new_figure(PAGE_WIDTH, 205.0)
    grid = figure.add_gridspec(PANEL_ROWS + 1, 2, height_ratios=[1.0] * PANEL_ROWS + [1.75])
    x_min, _, y_min, _ = np.min([state.whole for state in states.values()], axis=0).tolist()
    _, x_max, _, y_max = np.max([state.whole for state in states.values()], axis=0).tolist()
    window = (x_min, x_max, y_min, y_max)
    scales = [stress_scale(state, state.whole) for state in states.values()]
    norm = Normalize(min(scale.vmin for scale in scales), max(scale.vmax for scale in scales))
    panels = []
    for (name, state), place in zip(states.items(), list(grid)[: 2 * PANEL_ROWS], strict=False):
        panels.append(figure.add_subplot(place))
        note = (notes or {}).get(name, "")
        field = _draw_compound(panels[-1], name, state, window, norm, note)
    bar = {"label": r"$\sigma_y$ [N/mm²]", "extend": "both", "aspect": 40, "pad": 0.01}
    figure.colorbar(field, ax=panels, **bar)
    _draw_contours(figure.add_subplot(grid[PANEL_ROWS, :]), states, window)
    return figure


def _draw_compound(
    axes: Axes, name: str, state: BlockState, window: Window, norm: Normalize, note: str
) -> object:
    field = draw_stress(axes, state, window, norm)
    set_window(axes, window)
    sigma_y = state.snapshot.cauchy_stress[:, 1]
    axes.set_title(
        f"{COMPOUND_LOOKS[name].label}\n"
        rf"min {sigma_y.min():.2f}, max {sigma_y.max():.2f} N/mm²{note}",
        fontsize=7.5,
    )
    axes.tick_params(labelsize=6.5)
    place = axes.get_subplotspec()
    axes.set_ylabel("$y$ [mm]" if place.is_first_col() else "", fontsize=6.5)
    axes.set_xlabel("$x$ [mm]" if place.rowspan.start == PANEL_ROWS - 1 else "", fontsize=6.5)
    return field


def _draw_contours(axes: Axes, states: dict[str, BlockState], window: Window) -> None:
    draw_road(axes, window)
    handles = []
    for name, state in states.items():
        look = COMPOUND_LOOKS[name]
        style = {"color": look.colour, "ls": look.dash, "label": look.label}
        axes.plot(*contour(state).T, **style, lw=1.0)
        handles.append(Line2D([], [], **style, lw=1.2))
    X, Y = next(iter(states.values())).geometry.points.T
    box = [(X.min(), Y.max()), (X.min(), 0.0), (X.max(), 0.0), (X.max(), Y.max())]
    axes.plot(*zip(*box, strict=True), color=BLACK, lw=0.5, ls=":")
    set_window(axes, window)
    axes.legend(handles=handles, loc="center", bbox_to_anchor=(0.45, 0.5), fontsize=6.5)
    axes.set(xlabel="$x$ in the platen's frame [mm]", ylabel="$y$ [mm]")
    axes.set_title("Deformed contours (dotted: undeformed)")
