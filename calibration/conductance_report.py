"""What the identification of a gap conductance prints and writes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from calibration.conductance import (
    CONDUCTANCE,
    HeatingRecord,
    conductance_constant,
    fit_conductance,
    read_heating_record,
)
from calibration.fit_core import FitResult, Loss
from calibration.heating_rig import HeatingRig
from calibration.parameter_file import parameter_text
from calibration.plots import COLOURS, png
from calibration.rig_file import read_contact_surface, read_heating_rig


def conductance_report(
    path: str | Path,
    *,
    rig_file: str | Path | None = None,
    also: Sequence[str] = (),
    loss: Loss = "linear",
) -> tuple[str, dict[str, bytes]]:
    """Fit the conductance to a heating test: text to print, and files by name.

    Parameters
    ----------
    path : path
        CSV file of the record, see `read_heating_record`.
    rig_file : path, optional
        TOML file of the rig, see `read_heating_rig`; its table ``[surface]``, if there is one,
        gives the constant C of eq. (11).
    also, loss
        See `fit_conductance`.
    """
    rig = HeatingRig() if rig_file is None else read_heating_rig(rig_file)
    surface = None if rig_file is None else read_contact_surface(rig_file)
    record = read_heating_record(path, rig)
    result = fit_conductance(path, rig, also=also, loss=loss)
    lines = [f"conductance fit of the heating rig to {path}", result.summary(), _interval(result)]
    if rig_file is None:
        lines.append("  the rig has the default dimensions: give yours in a file (--rig)")
    if surface is not None:
        constant = conductance_constant(result, surface)
        lines.append(f"  C of eq. (11): {constant.value:.5g} +- {constant.stderr:.2g}")
    files = {
        "parameters.toml": parameter_text(result).encode(),
        "fit.csv": readings_table(result, record).to_csv(index=False).encode(),
        "fit.png": png(plot_readings(result, record)),
    }
    return "\n".join(lines), files


def _interval(result: FitResult) -> str:
    low, high = result.interval()[CONDUCTANCE]
    change = result.metadata["reading_change_for_5_percent_K"]
    return (
        f"  95 % interval of h: {low:.5g} to {high:.5g} W/(m^2 K); 5 % of h change no reading by "
        f"more than {change:.2g} K"
    )


def readings_table(result: FitResult, record: HeatingRecord) -> pd.DataFrame:
    """Measured and fitted reading of every thermocouple, a row per time."""
    fitted = result.predicted.reshape(record.readings.shape)
    columns: dict[str, object] = {"time_s": record.time}
    for k, name in enumerate(record.names):
        columns[f"{name}_C"] = record.readings[:, k]
        columns[f"{name}_fit_C"] = fitted[:, k]
    return pd.DataFrame(columns)


def plot_readings(result: FitResult, record: HeatingRecord) -> Figure:
    """Temperatures over time with the fitted curves, and the residuals below."""
    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    FigureCanvasAgg(figure)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    fitted = result.predicted.reshape(record.readings.shape)
    minutes = record.time / 60.0
    shown = slice(None, None, max(1, len(minutes) // 150))
    for k, name in enumerate(record.names):
        dots = {
            "marker": "o",
            "linestyle": "none",
            "markersize": 2.5,
            "alpha": 0.4,
            "color": COLOURS[k % len(COLOURS)],
        }
        above.plot(minutes[shown], record.readings[shown, k], **dots)
        above.plot(minutes, fitted[:, k], color=COLOURS[k % len(COLOURS)], label=name)
        below.plot(minutes[shown], (fitted - record.readings)[shown, k], **dots)
    h, error = result.values[CONDUCTANCE], result.stderr[CONDUCTANCE]
    error_text = f" ± {error:.2g}" if np.isfinite(error) else ""
    above.set_title(f"h = {h:.4g}{error_text} W/(m² K), RMSE {result.rmse:.2g} K", fontsize=10)
    above.set_ylabel("temperature [°C]")
    above.legend(fontsize=8, title="dots: measured, lines: fit", title_fontsize=8)
    below.axhline(0.0, color="0.6", linewidth=0.8)
    below.set_ylabel("fit - data [K]")
    below.set_xlabel("time [min]")
    return figure
