"""Figure 12: T_max and A_T over contact pressure, velocity, friction law and compound."""

from pathlib import Path

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fem.files import write_table
from fem.sweeps import StudyRun
from validation.drawing import BLACK, COMPOUND_LOOKS, PAGE_WIDTH, new_figure, save, styled
from validation.measured import MEASURED_MARK, Measurements, draw_measured_points
from validation.paper.fig11 import LAW_LABELS, LAW_LOOKS
from validation.studies import runs_of

#: Columns of the table and the case keys or summary keys they come from.
KEYS = {
    "compound": "rubber.compound",
    "law": "friction.law",
    "velocity_mm_per_s": "loading.velocity_mm_per_s",
    "mean_pressure_N_per_mm2": "loading.mean_pressure_N_per_mm2",
}
RESULTS = (
    "status",
    "T_max_C",
    "A_T_K_mm",
    "friction_coefficient",
    "mean_contact_pressure_N_per_mm2",
)
#: Axes span at least this, so that differences nobody could measure do not look large: the paper's
#: bound of 2 K on the error of T_max, and a tenth of A_T.
SPAN_K, SPAN_SHARE = 2.0, 0.1
QUANTITIES = {"T_max_C": r"$T_{max}$ [°C]", "A_T_K_mm": "$A_T$ [K mm]"}


def make(directory: Path, measured: Measurements | None = None) -> Path:
    """Draw figure 12 from the study of pressures and write the points beside it.

    Measured points are drawn into the panel of their velocity.
    """
    table = point_table(runs_of("pressures", directory))
    write_table(directory / "fig12.csv", table)
    return save(draw(table, measured), directory / "fig12.png")


def point_table(runs: list[StudyRun]) -> pd.DataFrame:
    """One row per run: compound, law, velocity, pressure, T_max, A_T."""
    return pd.DataFrame(
        [
            {column: run[key] for column, key in KEYS.items()}
            | {key: run.result.summary[key] for key in RESULTS}
            for run in runs
        ]
    )


@styled
def draw(table: pd.DataFrame, measured: Measurements | None = None) -> Figure:
    """Draw T_max in the upper and A_T in the lower row, a column per velocity.

    Measured points are black and filled, their marker says the compound where it is stated.
    Runs that did not get to their end are in the table only.
    """
    table = table[table["status"] == "ok"]
    velocities = sorted(table["velocity_mm_per_s"].unique())
    figure = new_figure(PAGE_WIDTH, 125.0)
    panels = figure.subplots(2, len(velocities), sharex=True, squeeze=False)
    for row, (quantity, label) in zip(panels, QUANTITIES.items(), strict=True):
        for axes, velocity in zip(row, velocities, strict=True):
            _draw_points(axes, table[table["velocity_mm_per_s"] == velocity], quantity)
            draw_measured_points(axes, measured, velocity, quantity)
            low, high = axes.get_ylim()
            short = (SPAN_K if quantity == "T_max_C" else SPAN_SHARE * high) - (high - low)
            if short > 0.0:
                axes.set_ylim(low - 0.5 * short, high + 0.5 * short)
            axes.grid(True)
        row[0].set_ylabel(label)
    for axes, velocity in zip(panels[0], velocities, strict=True):
        axes.set_title(f"$v$ = {velocity:g} mm/s")
    for axes in panels[1]:
        axes.set_xlabel("mean contact pressure [N/mm²]")
    marks = [] if measured is None else [MEASURED_MARK]
    figure.legend(handles=[*_legend(table), *marks], loc="outside lower center", ncols=2)
    return figure


def _draw_points(axes: Axes, table: pd.DataFrame, quantity: str) -> None:
    for (compound, law), points in table.groupby(["compound", "law"]):
        line = points.sort_values("mean_contact_pressure_N_per_mm2")
        (colour, dash), marker = LAW_LOOKS[str(law)], COMPOUND_LOOKS[str(compound)].marker
        look = {"color": colour, "ls": dash, "lw": 0.9, "marker": marker, "mfc": "white"}
        axes.plot(line["mean_contact_pressure_N_per_mm2"], line[quantity], **look)


def _legend(table: pd.DataFrame) -> list[Line2D]:
    laws = [
        Line2D([], [], color=colour, ls=dash, label=LAW_LABELS[law])
        for law, (colour, dash) in LAW_LOOKS.items()
        if law in set(table["law"])
    ]
    compounds = [
        Line2D([], [], color=BLACK, ls="", mfc="white", marker=look.marker, label=look.label)
        for name, look in COMPOUND_LOOKS.items()
        if name in set(table["compound"])
    ]
    return [*laws, *compounds]
