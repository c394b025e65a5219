"""Blocks side by side: plain, chamfered, siped, two in a row (``make blocks`` runs the study).

``python -m validation.tread_blocks DIR`` reads the runs of the study in DIR and writes
`blocks.csv`, `blocks.png` (vertical stress and surface temperature at the end) and
`blocks_curves.png` (force over motion, contact pressure along the road) beside them.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fem import Case
from fem.files import write_table
from fem.results import Result
from validation.analysis import force_at, runs_in
from validation.drawing import (
    PAGE_WIDTH,
    colour_bar,
    draw_panel,
    last_state,
    new_figure,
    save,
    stress_panel,
    styled,
)

#: Columns of the table, from the summaries of the runs.
COLUMNS = (
    "status",
    "friction_force_N_per_mm",
    "friction_coefficient",
    "T_max_C",
    "T_edge_C",
    "A_T_K_mm",
    "contact_length_mm",
    "mean_contact_pressure_N_per_mm2",
    "energy_error",
    "largest_self_penetration",
    "elements",
    "newton_iterations",
)


def described(case: Case) -> str:
    """What the outline of a block is, in words."""
    block = case.block
    parts = [f"{len(block.sipes)} sipe{'s' * (len(block.sipes) > 1)}"] if block.sipes else []
    if block.chamfer_leading_mm or block.chamfer_trailing_mm:
        parts.append("chamfered")
    if block.blocks > 1:
        parts.append(f"{block.blocks} blocks")
    return ", ".join(parts) or "plain"


def blocks_table(results: dict[str, Result]) -> pd.DataFrame:
    """A row per run; forces and friction work of several blocks per block."""
    rows = []
    for name, result in results.items():
        work = float(result.history["friction_dissipation_mJ_per_mm"].iloc[-1])
        force = result.summary["friction_force_N_per_mm"]
        wear = result.boundary.get("wear_depth_um")
        rows.append(
            {"block": name}
            | {key: result.summary.get(key) for key in COLUMNS}
            | {
                "friction_force_per_block_N_per_mm": force / result.case.block.blocks,
                "friction_work_mJ_per_mm": work,
                "deepest_wear_um": float(wear.max()) if wear is not None else None,
                "onset_stiffness_N_per_mm2": onset_stiffness(result.history),
            }
        )
    return pd.DataFrame(rows)


def onset_stiffness(history: pd.DataFrame, motion: float = 0.5) -> float:
    """Friction force over the platen's motion at half a millimetre, a secant [N/mm per mm]."""
    return force_at(history, motion) / motion


@styled
def draw_states(results: dict[str, Result]) -> Figure:
    """Draw vertical stress and surface temperature at the end of each run."""
    figure = new_figure(PAGE_WIDTH * 1.2, 30.0 * len(results))
    grid = figure.subplots(len(results), 2, squeeze=False, width_ratios=(1.5, 1.0))
    for (left, right), (name, result) in zip(grid, results.items(), strict=True):
        state = last_state(result)
        field = draw_panel(left, stress_panel, state, state.whole, title=name)
        assert field is not None
        colour_bar(figure, left, field, "σ$_y$ [N/mm²]", extend="both")
        for _, chain in result.boundary.groupby(["block", "chain"], sort=False):
            if str(chain["chain"].iloc[0]).startswith("bottom"):
                right.plot(chain["X_mm"], chain["T_C"], color="C3")
        right.set_ylabel("T [°C]")
    grid[-1, 1].set_xlabel("X from the trailing corner [mm]")
    return figure


@styled
def draw_curves(results: dict[str, Result]) -> Figure:
    """Draw force per block over motion, and contact pressure along the road at the end."""
    figure = new_figure(PAGE_WIDTH, 55.0 + 22.0 * len(results))
    heights = [2.4, *[1.0] * len(results)]
    force, *pressures = figure.subplots(1 + len(results), 1, height_ratios=heights)
    for number, (axes, (name, result)) in enumerate(zip(pressures, results.items(), strict=True)):
        history, colour = result.history, f"C{number}"
        slide = history[history["sliding_distance_mm"] > 0.0]
        per_block = slide["friction_force_N_per_mm"] / result.case.block.blocks
        force.plot(slide["sliding_distance_mm"], per_block, color=colour, label=name)
        _draw_pressure(axes, result.boundary, name, colour)
    force.set(xlabel="platen motion [mm]", ylabel="force per block\n[N/mm]")
    force.legend(ncols=2, fontsize="small")
    pressures[-1].set_xlabel("place in the platen's frame [mm]")
    return figure


def _draw_pressure(axes: Axes, boundary: pd.DataFrame, name: str, colour: str) -> None:
    """Contact pressure of all nodes on the road, each chain a line of its own."""
    on = boundary[boundary["status"] != "open"]
    for _, chain in on.groupby(["block", "chain"], sort=False):
        axes.plot(chain["x_mm"], chain["pressure_N_per_mm2"], ".-", color=colour, ms=2.0, lw=0.8)
    axes.set_title(name, loc="left", fontsize="small")
    axes.set(ylabel="p [N/mm²]", yscale="log", ylim=(0.02, 20.0))


def main(directory: str) -> None:
    """Write table and pictures of the runs of a study."""

    def features(result: Result) -> tuple[int, int, float]:
        block = result.case.block
        return block.blocks, len(block.sipes), block.chamfer_leading_mm

    folder = Path(directory)
    found = sorted(runs_in(folder), key=features)
    results = {described(result.case): result for result in found}
    table = blocks_table(results)
    write_table(folder / "blocks.csv", table)
    save(draw_states(results), folder / "blocks.png")
    save(draw_curves(results), folder / "blocks_curves.png")
    print(table.to_string(index=False))


if __name__ == "__main__":
    main(sys.argv[1])
