"""Slip of a braked wheel: contacts at 5, 10 and 20 % slip, and a wheel that is locked.

``python -m validation.braking DIR`` (``make slip``) reads the runs of the study `braking` in DIR
and writes `slip.csv` and `slip.png` there.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from fem.files import write_table
from fem.results import Result
from validation.analysis import rounded, runs_in
from validation.drawing import CURVES, PAGE_WIDTH, new_figure, save, styled

#: 50 km/h [mm/s], and the time of a contact [s].
VEHICLE, CONTACT_S = 13_900.0, 7.9e-3
#: What of a summary stands in the table.
FOUND = (
    "status",
    "energy_error",
    "heat_error",
    "heat_layer_error",
    "steps",
    "newton_iterations",
    "program_version",
)


def contacts_of(result: Result) -> pd.DataFrame:
    """A row per contact: a locked wheel's slide is cut into pieces as long as a contact.

    Returns
    -------
    DataFrame
        `contact, slid_mm, T_max_C` (at the end), `friction_coefficient` (mean over the way), and
        `friction_work_mJ_per_mm`.
    """
    contacts = result.contacts
    assert contacts is not None
    names = ["contact", "slid_mm", "T_max_C", "friction_coefficient", "friction_work_mJ_per_mm"]
    if len(contacts) > 1:
        return contacts[names]
    history = result.history
    press = float(result.case.loading.phases[0].duration)
    pieces = round((float(history["time_s"].iloc[-1]) - press) / CONTACT_S)
    ends = press + CONTACT_S * np.arange(pieces + 1)
    way, work, T = (
        np.interp(ends, history["time_s"], history[name])
        for name in ("sliding_distance_mm", "friction_dissipation_mJ_per_mm", "T_max_C")
    )
    force = history["friction_force_N_per_mm"] / history["normal_force_N_per_mm"]
    path = history["sliding_distance_mm"].to_numpy()
    sums = np.concatenate([[0.0], np.cumsum(force.to_numpy()[1:] * np.diff(path))])
    mu = np.diff(np.interp(ends, history["time_s"], sums)) / np.diff(way)
    columns = (np.arange(1, pieces + 1), np.diff(way), T[1:], mu, np.diff(work))
    return pd.DataFrame(dict(zip(names, columns, strict=True)))


def wear_depth_um(result: Result) -> float:
    """Mean depth that wore off the bottom [um]."""
    volume = float(result.summary["wear_volume_mm3_per_mm"])
    return 1e3 * volume / result.case.block.length_mm


def slip_table(results: list[Result]) -> pd.DataFrame:
    """A row per slip: the first and the last contact, and what wore off in all."""
    rows = []
    for result in results:
        contacts, summary = contacts_of(result), result.summary
        first, last = contacts.iloc[0], contacts.iloc[-1]
        velocity = result.case.loading.velocity_mm_per_s
        rows.append(
            {
                "slip_percent": 100.0 * velocity / VEHICLE,
                "velocity_mm_per_s": velocity,
                "repeat": result.case.loading.repeat,
                "slid_mm": last["slid_mm"],
                "T_max_first_C": first["T_max_C"],
                "T_max_last_C": last["T_max_C"],
                "T_edge_highest_C": float(result.history["T_edge_C"].max()),
                "friction_coefficient_first": first["friction_coefficient"],
                "friction_coefficient_last": last["friction_coefficient"],
                "friction_work_mJ_per_mm": contacts["friction_work_mJ_per_mm"].sum(),
                "wear_depth_um": wear_depth_um(result),
                "wear_front_share": summary["wear_front_share"],
                **{name: summary[name] for name in FOUND},
            }
        )
    return rounded(pd.DataFrame(rows), 5)


@styled
def draw_slips(results: list[Result]) -> Figure:
    """Draw temperature, grip and friction work over the contacts, and the profile of wear."""
    figure = new_figure(PAGE_WIDTH, 125.0)
    (heat, grip), (work, wear) = figure.subplots(2, 2)
    labels = [
        f"{row['slip_percent']:.3g} %{', locked' if row['repeat'] == 1 else ''}"
        for row in slip_table(results).to_dict("records")
    ]
    for result, label, colour in zip(results, labels, CURVES, strict=False):
        contacts = contacts_of(result)
        look = {"color": colour, "marker": "o", "ms": 3.0, "label": label}
        heat.plot(contacts["contact"], contacts["T_max_C"], **look)
        grip.plot(contacts["contact"], contacts["friction_coefficient"], **look)
        work.plot(contacts["contact"], contacts["friction_work_mJ_per_mm"], **look)
        bottom = result.boundary[result.boundary["chain"] == "bottom"]
        depth = bottom["wear_depth_um"] / wear_depth_um(result)
        wear.plot(bottom["X_mm"], depth, color=colour, label=label)
    for axes, title, unit in (
        (heat, "Bottom at the end of a contact", "highest temperature [°C]"),
        (grip, "Grip", "friction coefficient [-]"),
        (work, "Friction work of a contact", "work per depth [mJ/mm]"),
    ):
        axes.set(xlabel="contact, or 7.9 ms of the locked wheel [-]", ylabel=unit, title=title)
        axes.xaxis.get_major_locator().set_params(integer=True)
    work.set_yscale("log")
    wear.set(
        xlabel="$X$ from the trailing to the leading corner [mm]",
        ylabel="depth over its mean [-]",
        xlim=(0.0, max(result.case.block.length_mm for result in results)),
        ylim=(0.0, 2.0),
        title="Wear of the bottom after all of it",
    )
    wear.legend(title="slip", loc="lower center")
    for axes in (heat, grip, work, wear):
        axes.grid(True)
    return figure


def main(directory: str) -> None:
    """Write table and picture of the runs of the study."""
    folder = Path(directory)
    found = sorted(runs_in(folder), key=lambda result: result.case.loading.velocity_mm_per_s)
    table = slip_table(found)
    write_table(folder / "slip.csv", table)
    save(draw_slips(found), folder / "slip.png")
    print(table.to_string(index=False))


if __name__ == "__main__":
    main(sys.argv[1])
