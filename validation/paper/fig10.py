"""Figure 10: temperature of the bottom surface for the six parameter sets."""

from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from fem.files import write_table
from fem.sweeps import StudyRun
from validation.drawing import COMPOUND_LOOKS, PAGE_WIDTH, new_figure, reached, save, styled
from validation.paper.fig9 import COMPOUND
from validation.studies import runs_of


def make(directory: Path) -> Path:
    """Draw figure 10 from the study of compounds and write the curves beside it."""
    runs = runs_of("compounds", directory)
    write_table(directory / "fig10.csv", profile_table(runs, {"compound": COMPOUND}))
    return save(draw(runs), directory / "fig10.png")


def profile_table(runs: list[StudyRun], columns: dict[str, str]) -> pd.DataFrame:
    """Temperature profiles of all runs below each other, told apart by columns of case keys."""
    parts = [
        run.result.surface.assign(**{column: run[key] for column, key in columns.items()})
        for run in runs
    ]
    return pd.concat(parts, ignore_index=True)[[*columns, "X_mm", "T_C"]]


@styled
def draw(runs: list[StudyRun]) -> Figure:
    """Draw one curve per compound with its interior maximum in the legend."""
    figure = new_figure(PAGE_WIDTH, 100.0)
    axes = figure.subplots()
    by_name = {run[COMPOUND]: run.result for run in runs}
    for name, look in COMPOUND_LOOKS.items():
        if name in by_name:
            surface, T_max = by_name[name].surface, by_name[name].summary["T_max_C"]
            degrees = "-" if T_max is None else f"{T_max:.1f} °C"
            label = f"{look.label}: {degrees}{reached(by_name[name])}"
            axes.plot(surface["X_mm"], surface["T_C"], color=look.colour, ls=look.dash, label=label)
    axes.set_xlabel("$X$ from the trailing to the leading corner [mm]")
    axes.set_ylabel("$T$ at the bottom surface [°C]")
    axes.set_xlim(0.0, max(float(run.result.surface["X_mm"].max()) for run in runs))
    handles, labels = axes.get_legend_handles_labels()
    title = "with the interior maximum $T_{max}$"
    figure.legend(handles, labels, loc="outside lower center", ncols=2, title=title)
    axes.grid(True)
    return figure
