"""Measured points and profiles in the figures of the paper."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from validation.drawing import BLACK, COMPOUND_LOOKS
from validation.measured.matching import TOLERANCES
from validation.measured.measurements import Measurements, Profile

_PRESSURE = "p_N_per_mm2"
_UNKNOWN = "*"
MEASURED_MARK = Line2D([], [], color=BLACK, ls="", marker=_UNKNOWN, label="measured (filled)")


def measured_profiles(measured: Measurements | None, velocity_mm_per_s: float) -> list[Profile]:
    """Measured profiles at a velocity."""
    if measured is None or not measured.profiles:
        return []
    here = _at(measured, velocity_mm_per_s)
    return [profile for profile, fits in zip(measured.profiles, here, strict=True) if fits]


def draw_measured_points(
    axes: Axes, measured: Measurements | None, velocity_mm_per_s: float, quantity: str
) -> None:
    """Draw the measured values of a quantity at a velocity over the contact pressure, filled."""
    if measured is None:
        return
    points = measured.points[_at(measured, velocity_mm_per_s)]
    for compound, own in points.groupby("compound"):
        look = COMPOUND_LOOKS.get(str(compound))
        marker = look.marker if look else _UNKNOWN
        axes.plot(own[_PRESSURE], own[quantity], ls="", color=BLACK, marker=marker, zorder=3.0)


def shared_legend(panels: Iterable[Axes]) -> dict[str, list[Any]]:
    """Handles and labels of all panels, each label once."""
    entries: dict[str, Any] = {}
    for axes in panels:
        handles, labels = axes.get_legend_handles_labels()
        entries = dict(zip(labels, handles, strict=True)) | entries
    return {"handles": list(entries.values()), "labels": list(entries)}


def _at(measured: Measurements, velocity_mm_per_s: float) -> np.ndarray[Any, np.dtype[np.bool_]]:
    velocity = measured.points["v_mm_per_s"].to_numpy()
    # A test that does not state its velocity (NaN) belongs to no panel.
    return np.asarray(np.abs(velocity / velocity_mm_per_s - 1.0) <= TOLERANCES["v_mm_per_s"])
