"""The pictures of one run: history, bottom surface, onset of sliding, final state."""

from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from fem.results import Result
from validation.drawing.event_panels import draw_event, draw_pyrometer, draw_wear, write_animation
from validation.drawing.history_panels import (
    draw_contact,
    draw_forces,
    draw_friction,
    draw_surface_temperature,
    draw_surface_traction,
    draw_temperature,
)
from validation.drawing.onset_panels import draw_onset
from validation.drawing.state_panels import PANELS, WIDTHS, draw_fields, last_state
from validation.drawing.style import PAGE_WIDTH, new_figure, save, styled


def write_run_figures(directory: str | Path) -> list[Path]:
    """Draw what a run's folder holds into its `figures`: `history`, `surface`, `onset`,
    `final_state`; of an event also `event` and the animation `contact.gif`, of a case with
    a pyrometer `pyrometer`, with a coefficient of wear `wear`.

    Parameters
    ----------
    directory : str or Path
        A folder that `Result.write` made.

    Returns
    -------
    list of Path
        The pictures; none for a run without an accepted step.
    """
    figures = Path(directory) / "figures"
    result = Result.read(directory)
    history, surface, bottom = result.history, result.surface, result.bottom
    contacts = result.contacts
    paths = []
    if len(history) > 1:
        paths.append(save(draw_history(history), figures / "history.png"))
    if len(surface) > 1:
        drawn = draw_surface(surface, result.summary["T_max_C"])
        paths.append(save(drawn, figures / "surface.png"))
    if bottom is not None and history["sliding_distance_mm"].max() > 0.0:
        paths.append(save(draw_onset(history, bottom), figures / "onset.png"))
    if contacts is not None and len(contacts) and result.snapshots:
        paths.append(save(draw_event(result, contacts), figures / "event.png"))
        paths.append(write_animation(result, figures / "contact.gif"))
    if result.pyrometer is not None:
        paths.append(save(draw_pyrometer(result), figures / "pyrometer.png"))
    if "wear_depth_um" in result.boundary and result.summary["wear_volume_mm3_per_mm"]:
        paths.append(save(draw_wear(result), figures / "wear.png"))
    if result.snapshots:
        paths.append(save(draw_final_state(result), figures / "final_state.png"))
    return paths


@styled
def draw_history(history: pd.DataFrame) -> Figure:
    """Draw friction, forces, temperatures and contact over the sliding distance."""
    figure = new_figure(PAGE_WIDTH, 120.0)
    panels = {
        "Friction coefficient": draw_friction,
        "Forces": draw_forces,
        "Temperature of the bottom surface": draw_temperature,
        "Contact": draw_contact,
    }
    for axes, (title, draw) in zip(figure.subplots(2, 2).flat, panels.items(), strict=True):
        draw(axes, history)
        axes.set_title(title)
    return figure


@styled
def draw_surface(surface: pd.DataFrame, T_max: float | None) -> Figure:
    """Draw temperature and contact stresses along the bottom surface at the end."""
    figure = new_figure(PAGE_WIDTH, 70.0)
    left, right = figure.subplots(1, 2)
    draw_surface_temperature(left, surface, T_max)
    left.set_title("Temperature (shaded: in contact)")
    draw_surface_traction(right, surface)
    right.set_title("Contact pressure and shear")
    return figure


@styled
def draw_final_state(result: Result) -> Figure:
    """Draw mesh, temperature and vertical stress at the end, each with the front edge.

    A rigid block has no stress to draw.
    """
    rows = 2 if result.case.block.rigid else len(PANELS)
    figure = new_figure(PAGE_WIDTH, 5.0 + 47.0 * rows)
    draw_fields(figure, figure.subplots(rows, 2, width_ratios=WIDTHS), last_state(result))
    return figure
