"""Quantities of a run's last state that say how the block is deformed and stressed."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from fem.results import EDGE_ZONE, Result
from materials.arrays import FloatArray
from validation.analysis.ranges import number
from validation.drawing import BlockState, last_state

#: Height above the road up to which a point of the surface counts as touching it [mm].
TOUCHING_MM = 1e-3


def contour(state: BlockState) -> FloatArray:
    """Deformed free contour, rear face, bottom and front face, (m, 2) [mm]."""
    X, Y = state.geometry.points.T
    rear = np.flatnonzero(np.isclose(X, X.min()))
    bottom = np.flatnonzero(np.isclose(Y, Y.min()))
    front = np.flatnonzero(np.isclose(X, X.max()))
    order = [rear[np.argsort(-Y[rear])], bottom[np.argsort(X[bottom])], front[np.argsort(Y[front])]]
    return np.asarray(state.points[np.concatenate([order[0], order[1][1:-1], order[2]])])


def deformation(result: Result) -> float:
    """Mean displacement of the free contour (rear, bottom, front), by undeformed length [mm]."""
    state = last_state(result)
    nothing = replace(state.snapshot, displacement=0.0 * state.snapshot.displacement)
    before, after = contour(replace(state, snapshot=nothing)), contour(state)
    along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(before, axis=0), axis=1)))
    moved = np.linalg.norm(after - before, axis=1)
    return float(np.trapezoid(moved, along) / along[-1])


def amount_of_shear(result: Result) -> float:
    """Mean horizontal displacement of the bottom against the platen over the height [-]."""
    state = last_state(result)
    X, Y = state.geometry.points.T
    bottom = np.flatnonzero(np.isclose(Y, Y.min()))
    bottom = bottom[np.argsort(X[bottom])]
    u_x = np.abs(state.snapshot.displacement[bottom, 0])
    return float(np.trapezoid(u_x, X[bottom]) / np.ptp(X) / np.ptp(Y))


def rolled_length(result: Result) -> float:
    """Length of the leading face, undeformed, that lies on the road [mm]."""
    state = last_state(result)
    X, Y = state.geometry.points.T
    face = np.isclose(X, X.max() if state.direction > 0 else X.min()) & ~np.isclose(Y, Y.min())
    touching = Y[face & (state.points[:, 1] <= TOUCHING_MM)]
    return float(touching.max() - Y.min()) if touching.size else 0.0


def detached_length(result: Result) -> float:
    """Undeformed length of the bottom's leading fifth that has left the road [mm]."""
    surface = result.surface
    X = surface["X_mm"].to_numpy()
    front = (X.max() - X) <= EDGE_ZONE * np.ptp(X)
    off = np.where(surface["in_contact"].to_numpy(dtype=bool), 0.0, 1.0)
    return float(np.trapezoid(off[front], X[front]))


def highest_pressure(result: Result) -> float:
    """Highest contact pressure of the block at the end [N/mm^2]."""
    return float(result.history["max_contact_pressure_N_per_mm2"].iloc[-1])


def interior_pressure(result: Result) -> float:
    """Highest contact pressure of the bottom surface behind its leading fifth [N/mm^2]."""
    return highest_behind(result, "pressure_N_per_mm2")


def highest_behind(result: Result, column: str) -> float:
    """Highest value of a column of the bottom surface behind its leading fifth, by its size."""
    X = result.surface["X_mm"].to_numpy()
    behind = (X.max() - X) > EDGE_ZONE * np.ptp(X)
    return float(np.abs(result.surface[column].to_numpy()[behind]).max())


def stress_extremes(result: Result, below: float = 1.0) -> tuple[float, float]:
    """Smallest and largest vertical stress of all elements up to a share of the height [N/mm^2]."""
    sigma_y = last_state(result).snapshot.cauchy_stress[:, 1]
    chosen = sigma_y[_places(result)[:, 1] <= below]
    return float(chosen.min()), float(chosen.max())


def extreme_place(result: Result, which: int) -> tuple[float, float]:
    """Where the smallest (0) or largest (1) vertical stress is, shares of length and height."""
    sigma_y = last_state(result).snapshot.cauchy_stress[:, 1]
    along, up = _places(result)[int(np.argmax(sigma_y) if which else np.argmin(sigma_y))]
    return float(along), float(up)


def _places(result: Result) -> FloatArray:
    """Undeformed centres of the elements: share of the length, from the rear, and of the height."""
    state = last_state(result)
    corner, size = state.geometry.points.min(axis=0), np.ptp(state.geometry.points, axis=0)
    place = (state.geometry.points[state.geometry.cells].mean(axis=1) - corner) / size
    if state.direction < 0:
        place[:, 0] = 1.0 - place[:, 0]
    return np.asarray(place)


#: What of a block a change may move, by the words for it.
BEARING: dict[str, Callable[[Result], float]] = {
    "friction force": lambda result: number(result, "friction_force_N_per_mm"),
    "contact length": lambda result: number(result, "contact_length_mm"),
    "displacement": deformation,
}


def largest_stretch(result: Result) -> float:
    """Largest principal stretch of all elements [-]."""
    return float(last_state(result).snapshot.stretch.max())
