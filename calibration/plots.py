"""Pictures of fits: data, fitted curve and residuals."""

from io import BytesIO

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from calibration.conductance import HeatingRecord
from calibration.fitting import FitResult, evenly_spread
from calibration.friction import FrictionData
from calibration.memory import Histories, Moduli
from calibration.rubber import StressData
from calibration.shifting import MasterCurve
from materials.arrays import BoolArray, FloatArray, IndexArray

# Okabe and Ito's colours, which readers with any colour vision can tell apart
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
_MOST_DOTS = 5_000  # of one kind in a picture

# Marker and label of the quantities of a master curve
_CURVES = {
    "reduced_modulus_N_per_mm2": ("o", "E'/b_T [N/mm²]"),
    "reduced_loss_modulus_N_per_mm2": ("s", "E''/b_T [N/mm²]"),
    "tan_delta": ("^", "tan δ [-]"),
}
_MODES = {
    "uniaxial": ("o", COLOURS[0]),
    "equibiaxial": ("s", COLOURS[1]),
    "planar": ("^", COLOURS[2]),
}


def png(figure: Figure) -> bytes:
    """PNG of a figure, the same bytes for the same figure."""
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=150, metadata={"Software": None})
    return stream.getvalue()


def plot_hyperelastic(result: FitResult, data: StressData) -> Figure:
    """Stress-stretch points with the fitted curve by mode, and the residuals below."""
    figure, (above, below) = _panels()
    residual = result.predicted - result.observed
    for mode, (low, high) in data.window.items():
        marker, colour = _MODES[mode]
        here = np.flatnonzero(data.mode == mode)
        here = here[_shown(here.size)]
        dots = {"marker": marker, "color": colour, "linestyle": "none", "markersize": 4}
        above.plot(data.stretch[here], data.stress[here], alpha=0.6, label=f"{mode}, data", **dots)
        lam = np.linspace(min(low, 1.0), max(high, 1.0), 300)
        curve = result.model.nominal_stress(lam, mode)
        above.plot(lam, curve, color=colour, label=f"{mode}, fit")
        below.plot(data.stretch[here], residual[here], alpha=0.6, **dots)
    name = result.metadata["model"]
    above.set_title(f"{name}: RMSE {result.rmse:.3g} N/mm², R² {result.r2:.4f}", fontsize=10)
    above.set_ylabel("nominal stress [N/mm²]")
    above.legend(fontsize=8)
    below.set(xlabel="stretch [-]", ylabel="fit - data [N/mm²]")
    return figure


def plot_histories(result: FitResult, data: Histories) -> Figure:
    """Stress over stretch of each test with the fit, and the residuals over the rows below."""
    figure = _figure(6.0)
    above, below = figure.subplots(2, 1, height_ratios=(3, 1))
    points, names = data.points, data.names
    for i, test in enumerate(data.tests):
        here = np.flatnonzero(names == test.name)
        few, colour = here[_shown(here.size)], COLOURS[i % len(COLOURS)]
        dots = {"marker": "o", "color": colour, "linestyle": "none", "markersize": 3, "alpha": 0.4}
        above.plot(points.stretch[few], points.stress[few], **dots)
        above.plot(points.stretch[here], result.predicted[here], color=colour, label=test.name)
        residual = result.predicted[few] - result.observed[few]
        below.plot(points.table.rows[few], residual, color=colour, linewidth=0.8)
    name = f"{result.metadata['kind']}, {result.metadata['model']}"
    above.set_title(f"{name}: RMSE {result.rmse:.3g} N/mm², R² {result.r2:.4f}", fontsize=10)
    above.set(xlabel="stretch [-]", ylabel="nominal stress [N/mm²]")
    above.legend(fontsize=8)
    below.axhline(0.0, color="0.5", linewidth=0.8)
    below.set(xlabel="row", ylabel="fit - data [N/mm²]")
    return figure


def plot_moduli(result: FitResult, data: Moduli) -> Figure:
    """Storage and loss modulus over reduced frequency with the fit, branches as ticks."""
    figure, (above, below) = _panels()
    size, frequency = data.omega.size, data.omega / (2.0 * np.pi)
    kinds = [name for name in ("storage", "loss") if getattr(data, name) is not None]
    for i, name in enumerate(kinds):
        part, colour = slice(i * size, (i + 1) * size), COLOURS[i]
        dots = {"marker": "o", "color": colour, "linestyle": "none", "markersize": 3, "alpha": 0.5}
        observed, fitted = result.observed[part], result.predicted[part]
        above.plot(frequency, observed, label=f"{name} modulus, data", **dots)
        above.plot(frequency, fitted, color=colour, label="fit")
        below.plot(frequency, 100.0 * (fitted / observed - 1.0), **dots)
    for tau in result.model.tau_s:
        above.axvline(1.0 / (2.0 * np.pi * tau), color="0.8", linewidth=0.8, zorder=0)
    above.set(xscale="log", yscale="log")
    above.set_title(f"{len(result.model.tau_s)} branches at {data.T_ref_C:g} °C", fontsize=10)
    above.set_ylabel("modulus [N/mm²]")
    above.legend(fontsize=8)
    below.set(xlabel=f"reduced frequency at {data.T_ref_C:g} °C [Hz]", ylabel="fit/data - 1 [%]")
    return figure


def plot_friction(result: FitResult, data: FrictionData) -> Figure:
    """Friction coefficient over the equivalent speed, by pressure, and the residuals below."""
    figure, (above, below) = _panels()
    law, residual = result.model, result.predicted - result.observed
    speed = data.v
    if law.wlf is not None and data.T is not None:
        speed = law.wlf.equivalent_velocity(data.v, data.T, law.T_ref_C)
    v = np.geomspace(speed.min(), speed.max(), 300)
    for i, pressure in enumerate(_groups(data.p)):
        colour = COLOURS[i % len(COLOURS)]
        few = np.unique(data.p).size <= 7
        here = np.flatnonzero(np.isclose(data.p, pressure) if few else _nearest(data.p, i))
        here = here[_shown(here.size)]
        dots = {"marker": "o", "color": colour, "linestyle": "none", "markersize": 3, "alpha": 0.5}
        above.plot(speed[here], data.mu[here], **dots)
        curve = law.law.coefficient(pressure, v)
        above.plot(v, curve, color=colour, label=f"p = {pressure:.3g} N/mm²")
        below.plot(speed[here], residual[here], **dots)
    above.set_xscale("log")
    title = f"{result.metadata['model']} law: RMSE {result.rmse:.3g}, R² {result.r2:.4f}"
    above.set_title(title, fontsize=10)
    above.set_ylabel("friction coefficient μ [-]")
    above.legend(fontsize=8)
    shifted = law.wlf is not None
    below.set_xlabel(
        f"equivalent speed at {law.T_ref_C:g} °C [mm/s]" if shifted else "sliding speed [mm/s]"
    )
    below.set_ylabel("fit - data [-]")
    return figure


def _shown(count: int) -> IndexArray:
    """Which of so many points are drawn: all, or some evenly spread; more cannot be told apart."""
    return evenly_spread(count, _MOST_DOTS)


def _groups(p: FloatArray) -> FloatArray:
    """The pressures themselves when they are few, else five that stand for them."""
    levels = np.unique(p)
    return levels if levels.size <= 7 else np.quantile(p, [0.1, 0.3, 0.5, 0.7, 0.9])


def _nearest(p: FloatArray, i: int) -> BoolArray:
    """Points that belong to the i-th of the five representative pressures."""
    return np.asarray(np.argmin(np.abs(p[:, None] - _groups(p)), axis=1) == i)


def plot_wlf(result: FitResult, temperatures: FloatArray) -> Figure:
    """Shift factors over temperature with the WLF curve, and the residuals below."""
    figure, (above, below) = _panels()
    shown = _shown(temperatures.size)
    T = temperatures[shown]
    dots = {"marker": "o", "color": COLOURS[0], "linestyle": "none", "markersize": 4}
    offset = result.values["offset"]
    above.plot(T, (result.observed - offset)[shown], label="data", **dots)
    fine = np.linspace(min(T), max(T), 300)
    reference = result.metadata["T_ref_C"]
    curve = result.model.log10_shift_factor(fine, reference)
    d1, d2 = result.values["d1"], result.values["d2_K"]
    label = f"$d_1$ = {d1:.4g}, $d_2$ = {d2:.4g} K, $T_{{ref}}$ = {reference:g} °C"
    above.plot(fine, curve, color=COLOURS[1], label=label)
    below.plot(T, (result.predicted - result.observed)[shown], **dots)
    above.set_ylabel(r"$\log_{10} a_T$ [-]")
    above.legend(fontsize=8)
    below.set(xlabel="temperature [°C]", ylabel="fit - data [-]")
    return figure


def plot_master_curve(master: MasterCurve) -> Figure:
    """Modulus over reduced frequency, a colour per temperature."""
    figure = _figure(5.0)
    axes = figure.add_subplot()
    temperatures = master.shifts["T_C"].to_numpy()
    span = max(float(np.ptp(temperatures)), 1e-9)
    shown = [name for name in _CURVES if name in master.curve]
    for T, sweep in master.curve.groupby("T_C"):
        shade = (float(str(T)) - temperatures.min()) / span
        colour = (0.85 * shade + 0.05, 0.25, 0.9 - 0.8 * shade)
        for i, name in enumerate(shown):
            label = f"{T:g} °C" if i == 0 else None
            marks = {"marker": _CURVES[name][0], "markersize": 3, "linewidth": 0.8}
            ordered = sweep.sort_values("reduced_frequency_Hz")
            x, y = ordered["reduced_frequency_Hz"], ordered[name]
            axes.plot(x, y, color=colour, label=label, **marks)
    axes.set(xscale="log", yscale="log", xlabel=f"reduced frequency at {master.T_ref_C:g} °C [Hz]")
    axes.set_ylabel(", ".join(f"{_CURVES[name][1]} ({_CURVES[name][0]})" for name in shown))
    axes.set_title(f"overlap error {master.overlap_error:.2g} decades", fontsize=10)
    axes.legend(fontsize=7, ncols=2)
    return figure


def plot_conductance(result: FitResult, record: HeatingRecord) -> Figure:
    """Thermocouple readings over time with those of the fitted rig, and the residuals below."""
    figure, (above, below) = _panels()
    fitted = result.predicted.reshape(record.readings.shape)
    every = max(1, len(record.time) // 150)
    minutes = record.time / 60.0
    for i, name in enumerate(record.names):
        colour = COLOURS[i % len(COLOURS)]
        dots = {"marker": "o", "color": colour, "linestyle": "none", "markersize": 3, "alpha": 0.5}
        above.plot(minutes[::every], record.readings[::every, i], **dots)
        above.plot(minutes, fitted[:, i], color=colour, label=name)
        below.plot(minutes[::every], (fitted - record.readings)[::every, i], **dots)
    h, error = result.values["h_W_per_m2K"], result.stderr["h_W_per_m2K"]
    pressure = result.metadata["pressure_N_per_mm2"]
    above.set_title(f"h = {h:.4g} ± {error:.2g} W/(m² K) at {pressure:g} N/mm²", fontsize=10)
    above.set_ylabel("temperature [°C]")
    above.legend(fontsize=8, ncols=2)
    below.set(xlabel="time [min]", ylabel="fit - data [K]")
    return figure


def plot_partition(result: FitResult, discrete: pd.DataFrame) -> Figure:
    """Heat partition over the mean contact pressure with the fitted law, and the residuals."""
    figure, (above, below) = _panels()
    p = discrete["p_N_per_mm2"].to_numpy()
    dots = {"color": COLOURS[0], "linestyle": "none", "markersize": 5}
    error = np.nan_to_num(discrete["kappa_stderr"].to_numpy())
    label = "constant κ, measured temperatures"
    above.errorbar(p, discrete["kappa"], yerr=error, marker="o", capsize=3, label=label, **dots)
    fine = np.geomspace(0.8 * p.min(), 1.2 * p.max(), 200)
    prefactor, exponent = result.theta
    label = f"κ = {prefactor:.4g} $p^{{{exponent:.4g}}}$, {result.model.pressure} p"
    above.plot(fine, result.model(fine), color=COLOURS[1], label=label)
    below.plot(p, discrete["fit_C"] - discrete["measured_C"], marker="o", **dots)
    above.set_title(f"heat partition: RMSE {result.rmse:.3g} K", fontsize=10)
    above.set_ylabel("heat partition κ [-]")
    above.legend(fontsize=8)
    below.set(xlabel="mean contact pressure [N/mm²]", ylabel="fit - data [K]")
    return figure


def plot_comparison(table: pd.DataFrame, value: str, unit: str) -> Figure:
    """Bars of a measure of misfit by model."""
    figure = _figure(3.5)
    axes = figure.add_subplot()
    ordered = table.dropna(subset=[value]).iloc[::-1]
    axes.barh(ordered.iloc[:, 0].astype(str), ordered[value], color=COLOURS[0])
    axes.set_xlabel(f"RMSE [{unit}]")
    return figure


def _panels() -> tuple[Figure, tuple[Axes, Axes]]:
    figure = _figure(6.0)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    below.axhline(0.0, color="0.5", linewidth=0.8)
    for axes in (above, below):
        axes.grid(True, color="0.9")
    return figure, (above, below)


def _figure(height: float) -> Figure:
    figure = Figure(figsize=(6.4, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure
