"""Figure 4: friction coefficient over sliding velocity and contact pressure, both laws."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure

from contact import FRICTION_LAWS, FrictionLaw, HuemerFriction
from fem.files import write_table
from materials.arrays import FloatArray
from validation.drawing import BLACK, CURVES, GREY, PAGE_WIDTH, STRESS_MAP, new_figure, save, styled

LAWS: dict[str, FrictionLaw] = {
    name: FRICTION_LAWS[name].kind() for name in ("exponential", "huemer")
}
TITLES = {
    name: f"({letter}) {FRICTION_LAWS[name].label}" for letter, name in zip("ab", LAWS, strict=True)
}
VELOCITIES_MM_PER_S = np.geomspace(1.0, 1000.0, 121)
PRESSURES_N_PER_MM2 = np.geomspace(0.05, 1.0, 61)
#: Pressures and velocities of the paper's simulations (Fig. 12).
SHOWN_PRESSURES, SHOWN_VELOCITIES = (0.2, 0.3, 0.4), (7.0, 50.0, 300.0)
LEVELS = np.arange(14, 23) * 0.05


def make(directory: Path) -> Path:
    """Draw figure 4 and write the table of both laws beside it."""
    table = friction_table()
    write_table(directory / "fig4.csv", table, "%.6g")
    return save(draw(table), directory / "fig4.png")


def friction_table() -> pd.DataFrame:
    """Both laws with the parameters of Table 2 on a grid of pressure and velocity."""
    p, v = np.meshgrid(PRESSURES_N_PER_MM2, VELOCITIES_MM_PER_S, indexing="ij")
    columns = {"p_N_per_mm2": p.ravel(), "v_mm_per_s": v.ravel()}
    for name, law in LAWS.items():
        columns[f"mu_{name}"] = law.coefficient(p, v).ravel()
    return pd.DataFrame(columns)


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw a map of each law and, below, both laws over the velocity at three pressures."""
    figure = new_figure(PAGE_WIDTH, 140.0)
    panels = figure.subplot_mosaic([["exponential", "huemer"], ["curves", "pressure"]])
    for name in LAWS:
        field = _draw_map(panels[name], table, name)
    place = panels["huemer"].inset_axes((1.03, 0.0, 0.035, 1.0))
    figure.colorbar(field, cax=place, label=r"$\mu$ [-]")
    _draw_over_velocity(panels["curves"])
    _draw_over_pressure(panels["pressure"])
    return figure


def _draw_map(axes: Axes, table: pd.DataFrame, name: str) -> ScalarMappable:
    mu = table.pivot(index="p_N_per_mm2", columns="v_mm_per_s", values=f"mu_{name}")
    v, p, values = mu.columns.to_numpy(), mu.index.to_numpy(), mu.to_numpy()
    field = axes.contourf(v, p, values, LEVELS, cmap=STRESS_MAP, extend="both")
    lines = axes.contour(v, p, values, LEVELS[::2], colors=BLACK, linewidths=0.6)
    axes.clabel(lines, fmt="%.1f", fontsize=7)
    axes.set(xscale="log", xlabel="sliding velocity $v$ [mm/s]")
    axes.set(ylabel="contact pressure $p$ [N/mm²]", title=TITLES[name])
    return field


def _draw_laws(axes: Axes, X: FloatArray, p: Any, v: Any, *, colour: str, label: str) -> None:
    """Draw both laws over one of pressure and velocity, Huemer's full and the other dashed."""
    for name, dash, said in (("huemer", "-", label), ("exponential", "--", None)):
        axes.plot(X, LAWS[name].coefficient(p, v), color=colour, ls=dash, label=said)


def _draw_over_velocity(axes: Axes) -> None:
    v = VELOCITIES_MM_PER_S
    for p, colour in zip(SHOWN_PRESSURES, CURVES, strict=False):
        _draw_laws(axes, v, p, v, colour=colour, label=f"$p$ = {p:g} N/mm²")
    peak = HuemerFriction().peak_velocity
    axes.axvline(peak, color=GREY, lw=0.7, ls=":")
    said = f"peak of (6): {peak:.1f} mm/s"
    axes.text(peak * 0.93, 1.02, said, ha="right", fontsize=7, color=GREY)
    axes.set(xscale="log", xlim=(v[0], v[-1]), ylim=(0.6, 1.05), title="(c) Over the velocity")
    axes.set(xlabel="sliding velocity $v$ [mm/s]", ylabel=r"$\mu$ [-]")
    axes.legend(loc="lower right", title="full: (6), dashed: (5)")
    axes.grid(True)


def _draw_over_pressure(axes: Axes) -> None:
    p = PRESSURES_N_PER_MM2
    for v, colour in zip(SHOWN_VELOCITIES, CURVES[3:], strict=False):
        _draw_laws(axes, p, p, v, colour=colour, label=f"$v$ = {v:g} mm/s")
    axes.set(xlim=(0.0, p[-1]), title="(d) Over the pressure")
    axes.set(xlabel="contact pressure $p$ [N/mm²]", ylabel=r"$\mu$ [-]")
    axes.legend(loc="upper right", title="full: (6), dashed: (5)")
    axes.grid(True)
