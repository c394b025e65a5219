"""Figure 11: temperature of the bottom surface at three velocities, both friction laws."""

from pathlib import Path

from matplotlib.figure import Figure

from fem.files import write_table
from fem.sweeps import StudyRun
from validation.drawing import BLUE, PAGE_WIDTH, VERMILLION, new_figure, reached, save, styled
from validation.measured import (
    Measurements,
    draw_measured_profile,
    measured_profiles,
    shared_legend,
)
from validation.paper.fig10 import profile_table
from validation.studies import runs_of

VELOCITY, LAW = "loading.velocity_mm_per_s", "friction.law"
LAW_LOOKS = {"exponential": (VERMILLION, "--"), "huemer": (BLUE, "-")}
LAW_LABELS = {"exponential": "exponential law (5)", "huemer": "law by Huemer (6)"}


def make(directory: Path, measured: Measurements | None = None) -> Path:
    """Draw figure 11 from the study of velocities and write the curves beside it.

    Measured profiles are drawn into the panel of their velocity.
    """
    runs = runs_of("velocities", directory)
    table = profile_table(runs, {"velocity_mm_per_s": VELOCITY, "law": LAW})
    write_table(directory / "fig11.csv", table)
    return save(draw(runs, measured), directory / "fig11.png")


@styled
def draw(runs: list[StudyRun], measured: Measurements | None = None) -> Figure:
    """Draw a panel per velocity, a curve per friction law, measured profiles as points."""
    velocities = sorted({run[VELOCITY] for run in runs})
    figure = new_figure(PAGE_WIDTH, 75.0)
    panels = figure.subplots(1, len(velocities), squeeze=False)[0]
    for axes, velocity in zip(panels, velocities, strict=True):
        own = [run for run in runs if run[VELOCITY] == velocity]
        for run in own:
            (colour, dash), surface = LAW_LOOKS[run[LAW]], run.result.surface
            label = LAW_LABELS[run[LAW]]
            axes.plot(surface["X_mm"], surface["T_C"], color=colour, ls=dash, label=label)
        for profile in measured_profiles(measured, velocity):
            draw_measured_profile(axes, profile)
        stopped = max(reached(run.result) for run in own)
        axes.set(title=f"$v$ = {velocity:g} mm/s{stopped}", xlabel="$X$ [mm]")
        axes.set_ylabel("$T$ at the bottom surface [°C]" if axes is panels[0] else "")
        axes.set_xlim(0.0, float(surface["X_mm"].max()))
        axes.grid(True)
    figure.legend(**shared_legend(panels), loc="outside lower center", ncols=3)
    return figure
