"""Figure 6: rig of the static conductance test and its thermocouple curves."""

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from calibration.conductance import (
    CONDUCTANCE,
    HeatingRig,
    RigModel,
    RigPrediction,
    fit_conductance,
    read_heating_record,
    synthetic_heating_record,
)
from calibration.fitting import FitResult
from fem.files import write_table
from validation.drawing import (
    BLACK,
    CURVES,
    GREY,
    MARKERS,
    PAGE_WIDTH,
    RUBBER_GREY,
    new_figure,
    save,
    styled,
)

#: Conductance the synthetic record is made with: the paper's result at 0.3 N/mm^2 [W/(m^2 K)].
MADE_WITH = 1600.0
#: Every so many rows of the record are drawn.
_SHOWN = 45
_COPPER, _HEATER, _ASPHALT = "#E2B07A", "#C65D3B", "#CFCBC4"


def make(directory: Path) -> Path:
    """Draw figure 6 and write the synthetic record and the fitted curves beside it."""
    rig = HeatingRig(ambient_C=20.0)
    record = synthetic_heating_record(rig, h_W_per_m2K=MADE_WITH)
    found = fit_conductance(record, rig)
    curves = fitted_curves(rig, record, found)
    write_table(directory / "fig6_synthetic_record.csv", record, "%.4f")
    write_table(directory / "fig6.csv", curves, "%.4f")
    return save(draw(rig, record, curves, found), directory / "fig6.png")


def fitted_curves(rig: HeatingRig, record: pd.DataFrame, found: FitResult) -> pd.DataFrame:
    """Readings of the model with the fitted conductance, same columns as the record."""
    data = read_heating_record(record, rig)
    model = RigModel(rig, data.heater)
    predict = RigPrediction(rig=rig, model=model, record=data, names=(CONDUCTANCE,))
    readings = predict(np.array([found.values[CONDUCTANCE]])).reshape(len(data.time), -1)
    columns = {f"{name}_C": readings[:, i] for i, name in enumerate(data.names)}
    return pd.DataFrame({"time_s": data.time, **columns})


@styled
def draw(rig: HeatingRig, record: pd.DataFrame, curves: pd.DataFrame, found: FitResult) -> Figure:
    """Draw the cross-section of the rig on the left and the curves on the right."""
    figure = new_figure(PAGE_WIDTH, 88.0)
    section, time = figure.subplots(1, 2, width_ratios=[1.0, 1.15])
    looks = zip((*CURVES, BLACK), MARKERS * 2, strict=False)
    by_name = dict(zip(rig.thermocouples, looks, strict=False))
    _draw_section(section, rig, by_name)
    _draw_curves(time, record, curves, by_name)
    h, error = found.values[CONDUCTANCE], found.stderr[CONDUCTANCE]
    time.set_title(f"Fitted: h = {h:.0f} ± {error:.0f} W/(m² K)")
    note = (
        f"Dimensions are assumptions. Points: synthetic record made with h = {MADE_WITH:g} "
        "W/(m² K), not measured; lines: model with the fitted h"
    )
    figure.suptitle(note, fontsize=7.0, color=GREY)
    return figure


def _draw_section(axes: Axes, rig: HeatingRig, looks: dict[str, tuple[str, str]]) -> None:
    L, H, width = rig.block_length_mm, rig.block_height_mm, rig.asphalt_length_mm
    top = H + rig.copper_height_mm
    bodies = (
        ("asphalt", -width / 2, -rig.asphalt_height_mm, width, rig.asphalt_height_mm, _ASPHALT),
        ("rubber", -L / 2, 0.0, L, H, RUBBER_GREY),
        ("copper", -L / 2, H, L, rig.copper_height_mm, _COPPER),
        ("heater", -L / 2, top, L, 0.25 * rig.copper_height_mm, _HEATER),
    )
    for name, x, y, w, h, colour in bodies:
        axes.add_patch(Rectangle((x, y), w, h, facecolor=colour, edgecolor=BLACK, lw=0.6))
        if name == "asphalt":
            size = f"asphalt\n{width:g} x {rig.asphalt_height_mm:g} mm"
            axes.text(-1.28 * L, -1.0, size, va="top")
        else:
            axes.text(L / 2 + 3.0, y + h / 2, name, va="center")
    for name, place in rig.thermocouples.items():
        colour, marker = looks[name]
        axes.plot(place.x_mm, place.y_mm, marker=marker, color=colour, ms=4.0, mew=0.4, mec="w")
        beside = {"xytext": (5 if place.x_mm > 0.0 else -17, 0), "textcoords": "offset points"}
        axes.annotate(name, (place.x_mm, place.y_mm), **beside, va="center", fontsize=6.0)
    axes.set_aspect("equal")
    # Only the part with the thermocouples; the asphalt goes on beyond the frame.
    depth = 1.4 * max(-place.y_mm for place in rig.thermocouples.values())
    axes.set(xlim=(-1.35 * L, 1.65 * L), ylim=(-depth, top + 0.4 * rig.copper_height_mm))
    axes.set(xlabel="$x$ [mm]", ylabel="height above the contact [mm]")
    axes.set_title(f"Rig, $p$ = {rig.pressure_N_per_mm2:g} N/mm²")


def _draw_curves(
    axes: Axes, record: pd.DataFrame, curves: pd.DataFrame, looks: dict[str, tuple[str, str]]
) -> None:
    minutes, shown = curves["time_s"] / 60.0, record.iloc[::_SHOWN]
    for name, (colour, marker) in looks.items():
        look = {"ls": "", "marker": marker, "ms": 2.8, "color": colour, "label": name}
        axes.plot(minutes, curves[f"{name}_C"], color=colour, lw=0.9)
        axes.plot(shown["time_s"] / 60.0, shown[f"{name}_C"], **look)
    axes.set(xlabel="time [min]", ylabel="temperature [°C]", xlim=(0.0, minutes.max()))
    axes.legend(loc="upper right", ncols=2)
    axes.grid(True)
