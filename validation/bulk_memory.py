"""Whether the memory of the bulk counts in a slide, and over an event (``make memory``).

``python -m validation.bulk_memory SLIDES EVENT -o DIR`` reads the runs of the studies
``memory_slides`` and ``memory_event`` in two folders, writes the committed tables
``validation/memory_slides.csv`` and ``validation/memory_event.csv``, and into DIR
`memory_force.png` (force over motion at each speed) and `memory_event.png` (temperatures and heat
of the bulk over the event). The branches and the softening are made up.
"""

import argparse
from pathlib import Path
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from fem.files import write_table
from fem.results import Result, contacts_table
from validation.analysis import force_at, rounded, runs_in, shape
from validation.drawing import PAGE_WIDTH, new_figure, save, styled

SLIDES = Path(__file__).parent / "memory_slides.csv"
EVENT = SLIDES.with_name("memory_event.csv")
#: Distances slid at which the force is given: in the onset, and at its end [mm].
MOTIONS = (0.5, 1.0, 2.0, 5.0)
ELASTIC, BRANCHES, SOFTENING = "elastic", "branches", "softening"
#: Of the summary of a run.
FOUND = (
    "status",
    "friction_force_N_per_mm",
    "friction_coefficient",
    "contact_length_mm",
    "T_max_C",
    "T_edge_C",
    "A_T_K_mm",
    "rubber_dissipation_share",
    "damage_share",
    "regularisation_share_with_onset",
    "snap_share",
    "energy_error",
    "heat_error",
    "newton_iterations",
)
#: Heat made so far [mJ/mm], by its source.
BULK, FRICTION = "bulk_heat_mJ_per_mm", "frictional_heat_mJ_per_mm"


def rubber_of(result: Result) -> str:
    """What a run's rubber remembers, in a word."""
    rubber = result.case.rubber
    if rubber.viscoelastic is not None:
        return BRANCHES
    return ELASTIC if rubber.mullins is None else SOFTENING


def bulk_share(history: pd.DataFrame) -> float:
    """Heat of the bulk over that of friction [-]."""
    return float(history[BULK].iloc[-1] / history[FRICTION].iloc[-1])


def slides_table(results: list[Result]) -> pd.DataFrame:
    """A row per speed and rubber, four digits."""
    rows = [
        {"velocity_mm_per_s": r.case.loading.velocity_mm_per_s, "rubber": rubber_of(r)}
        | {f"force_at_{motion:g}_mm": force_at(r.history, motion) for motion in MOTIONS}
        | {"displacement_mm": shape.deformation(r), "bulk_heat_share": bulk_share(r.history)}
        | {key: r.summary.get(key) for key in FOUND}
        for r in results
    ]
    return rounded(pd.DataFrame(rows).sort_values("velocity_mm_per_s", kind="stable"), 4)


def event_table(results: list[Result]) -> pd.DataFrame:
    """A row per rubber and contact: its course, and the heat of the bulk in it, four digits."""
    parts = []
    for result in results:
        made = result.history.groupby("contact")[[BULK, FRICTION]].last()
        before = made.shift(fill_value=0.0)
        contacts = contacts_table(result.history, result.case.heat.ambient_C).set_index("contact")
        contacts[BULK] = (made - before)[BULK]
        contacts["bulk_heat_share"] = contacts[BULK] / (made - before)[FRICTION]
        contacts.insert(0, "rubber", rubber_of(result))
        parts.append(contacts.reset_index())
    return rounded(pd.concat(parts, ignore_index=True), 4)


@styled
def draw_forces(results: list[Result]) -> Figure:
    """Draw force over motion, a panel per speed."""
    speeds = sorted({r.case.loading.velocity_mm_per_s for r in results})
    figure = new_figure(PAGE_WIDTH, 34.0 * ((len(speeds) + 1) // 2))
    panels = figure.subplots((len(speeds) + 1) // 2, 2, sharex=True, squeeze=False).ravel()
    for axes, speed in zip(panels, speeds, strict=False):
        for result in (r for r in results if r.case.loading.velocity_mm_per_s == speed):
            slide = result.history[result.history["sliding_distance_mm"] > 0.0]
            motion, force = slide["sliding_distance_mm"], slide["friction_force_N_per_mm"]
            axes.plot(motion, force, **_line(result))
        axes.set_title(f"{speed:g} mm/s", loc="left", fontsize="small")
        axes.set(xlim=(0.0, 15.0), ylabel="force [N/mm]")
    panels[0].legend(fontsize="small")
    for axes in panels[-2:]:
        axes.set_xlabel("platen motion [mm]")
    return figure


@styled
def draw_event(results: list[Result]) -> Figure:
    """Draw the hottest temperature and the heat of the bulk over the time of an event."""
    figure = new_figure(PAGE_WIDTH, 90.0)
    above, below = figure.subplots(2, 1, sharex=True)
    for result in results:
        history, line = result.history, _line(result)
        above.plot(history["time_s"], history["T_max_C"], **line)
        below.plot(history["time_s"], history[BULK], **line)
    above.set_ylabel("T_max [°C]")
    below.set(ylabel="heat of the bulk\n[mJ/mm]", xlabel="time [s]")
    above.legend(fontsize="small")
    return figure


def _line(result: Result) -> dict[str, Any]:
    """Label and dashes: softening nearly hides the elastic line under its own."""
    rubber = rubber_of(result)
    return {"label": rubber, "linestyle": "--" if rubber == SOFTENING else "-"}


def runs_of(directory: Path) -> list[Result]:
    """Runs of a sweep's folder, elastic ones first."""
    order = [ELASTIC, BRANCHES, SOFTENING]
    return sorted(runs_in(directory), key=lambda result: order.index(rubber_of(result)))


def main(arguments: list[str] | None = None) -> None:
    """Write tables and pictures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("slides", type=Path)
    parser.add_argument("event", type=Path)
    parser.add_argument("-o", "--output", type=Path, default=Path("results"))
    given = parser.parse_args(arguments)
    slides, events = runs_of(given.slides), runs_of(given.event)
    for path, table in ((SLIDES, slides_table(slides)), (EVENT, event_table(events))):
        write_table(path, table)
        print(f"{path}\n{table.to_string(index=False)}")
    given.output.mkdir(parents=True, exist_ok=True)
    save(draw_forces(slides), given.output / "memory_force.png")
    save(draw_event(events), given.output / "memory_event.png")


if __name__ == "__main__":
    main()
