"""A made-up, smooth result for tests of writing, reading and drawing. Nothing in it is computed."""

from __future__ import annotations

import numpy as np
import pandas as pd

from fem.case.case import Case
from fem.files.version import program_version
from fem.mesh.block import BlockMesh, block_mesh
from fem.mesh.grading import Grading
from fem.results.bottom_history import BottomHistory
from fem.results.boundary import BoundaryContact, boundary_table
from fem.results.columns import HISTORY
from fem.results.result import Result
from fem.results.snapshot import BlockGeometry, Snapshot

LENGTH, HEIGHT = 20.0, 8.0


def made_up_case(**loading: float) -> Case:
    """The introductory loading, other keys at their defaults."""
    values = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 120.0}
    return Case.from_dict({"loading": values | loading})


def made_up_snapshot(mesh: BlockMesh, distance: float = 120.0) -> Snapshot:
    """A sheared and bulging block, warm at the bottom, hottest at the leading corner."""
    X, Y = mesh.points.T
    depth = 1.0 - Y / HEIGHT
    front = np.exp(-((LENGTH - X) ** 2 + 4.0 * Y**2) / 6.0)
    u = np.column_stack([-3.0 * depth**1.5 - 1.5 * front, -0.05 * Y * (1 + depth) + 1.2 * front])
    u[:, 1] += 0.4 * np.exp(-X / 2.0) * depth
    heated = 22.0 * (1.0 - np.exp(-X / 3.0)) * np.exp(-Y / 0.2)
    T = 20.0 + (heated + 60.0 * front**3) * min(distance / 120.0, 1.0)
    centre = mesh.points[mesh.cells].mean(axis=1)
    x, y = centre.T
    sigma_y = -0.25 - 0.15 * np.sin(np.pi * x / LENGTH) - 1.5 * np.exp(-((17 - x) ** 2) - y**2)
    stress = np.column_stack([0.3 * sigma_y, sigma_y, 0.5 * sigma_y, 0.1 + 0.0 * x])
    road_x, road_y = np.linspace(-20.0, 24.0, 89), -np.geomspace(0.02, 3.0, 15) + 0.02
    rx, ry = np.meshgrid(road_x, road_y, indexing="ij")
    node = np.arange(rx.size).reshape(rx.shape)
    road_cells = np.stack([node[:-1, 1:], node[1:, 1:], node[1:, :-1], node[:-1, :-1]], axis=-1)
    return Snapshot(
        time_s=distance / 300.0,
        sliding_distance_mm=distance,
        displacement=u,
        temperature=T,
        cauchy_stress=stress,
        stretch=1.0 + 0.3 * np.exp(-y),
        pressure=sigma_y / 3.0,
        road_points=np.column_stack([rx.ravel(), ry.ravel()]),
        road_cells=road_cells.reshape(-1, 4),
        road_temperature=20.0 + 8.0 * (np.exp(ry / 0.2) * (rx < 17)).ravel(),
    )


def made_up_history(rows: int = 60) -> pd.DataFrame:
    """A force that builds up and settles, a temperature that rises with the square root of time."""
    distance = np.linspace(0.0, 120.0, rows)
    table = {name: np.zeros(rows) for name in HISTORY}
    build_up = 1.0 - np.exp(-distance / 2.0)
    table |= {
        "time_s": distance / 300.0,
        "sliding_distance_mm": distance,
        "velocity_mm_per_s": np.full(rows, 300.0),
        "normal_force_N_per_mm": np.full(rows, 5.0),
        "friction_coefficient": 0.9 * build_up,
        "friction_force_N_per_mm": 4.5 * build_up,
        "contact_length_mm": 17.0 - 2.0 * build_up,
        "mean_contact_pressure_N_per_mm2": 5.0 / (17.0 - 2.0 * build_up),
        "max_contact_pressure_N_per_mm2": 1.0 + build_up,
        "T_max_C": 20.0 + 25.0 * np.sqrt(distance / 120.0),
        "T_edge_C": 20.0 + 60.0 * np.sqrt(distance / 120.0),
        "A_T_K_mm": 300.0 * np.sqrt(distance / 120.0),
        "newton_iterations": np.full(rows, 4),
    }
    return pd.DataFrame(table)


def made_up_boundary(mesh: BlockMesh, snapshot: Snapshot) -> pd.DataFrame:
    """Free boundary of a snapshot, its bottom in contact between 3 and 17 mm."""
    nodes = mesh.candidates
    X, Y = mesh.points[nodes].T
    inside = (Y == 0.0) & (X > 3.0) & (X < 17.0)
    pressure = np.where(inside, 0.3 + 0.4 * np.exp(-((X - 16.0) ** 2)), 0.0)
    u = snapshot.displacement.copy()
    current = np.where(inside, 0.0, np.abs(Y + u[nodes, 1]))
    u[nodes, 1] = current - Y
    contact = BoundaryContact(
        kind=np.where(inside, 2, 0), pressure=pressure, shear=0.9 * pressure,
        slip_velocity=np.where(inside, 300.0, 0.0),
    )  # fmt: skip
    return boundary_table(mesh, u, snapshot.temperature, contact)


def made_up_bottom(mesh: BlockMesh, rows: int = 60) -> BottomHistory:
    """A bottom that sticks at first and slips from the rear on."""
    X, k = mesh.from_trailing(mesh.bottom), np.arange(rows)[:, None]
    inside = (X > 3.0) & (X < 17.0)
    kind = np.where(inside, np.where(k > X, 2, 1), 0).astype(np.int8)
    pressure = np.where(inside, 0.3 + 0.01 * k, 0.0).astype(np.float32)
    return BottomHistory(X_mm=X, kind=kind, pressure=pressure)


def made_up_summary() -> dict[str, object]:
    """Numbers that fit the other tables."""
    return {
        "status": "ok",
        "T_max_C": 45.0,
        "T_edge_C": 80.0,
        "A_T_K_mm": 300.0,
        "friction_force_N_per_mm": 4.5,
        "friction_coefficient": 0.9,
        "contact_length_mm": 15.0,
        "mean_contact_pressure_N_per_mm2": 0.333,
        "elements": 960,
        "dofs": 2058,
        "steps": 60,
        "newton_iterations": 240,
        "wall_s": 1.5,
        "energy_error": 0.004,
        "heat_error": 1e-12,
        "regularisation_share": 0.01,
        "capped_heat_share": 0.1,
        "warnings": [],
        "program_version": program_version(),
    }


def made_up_result(grading: Grading | None = None, snapshots: int = 2, **loading: float) -> Result:
    """A whole result with the given number of snapshots."""
    mesh = block_mesh(
        LENGTH, HEIGHT, grading or Grading(cells_x=48, cells_y=20, smallest_x=0.2, smallest_y=0.08)
    )
    series = [made_up_snapshot(mesh, d) for d in np.linspace(0.0, 120.0, snapshots)]
    return Result.from_rows(
        made_up_case(**loading),
        BlockGeometry(points=mesh.points, cells=mesh.cells),
        made_up_history().to_dict("records"),
        made_up_boundary(mesh, series[-1]),
        made_up_summary(),
        series,
        log=("treadfem, made-up result",),
        bottom=made_up_bottom(mesh),
    )
