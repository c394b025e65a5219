"""The stated errors of grid and steps, against backward Euler and grids that are computed."""

import numpy as np
import pytest
from scipy.linalg import solveh_banded

from fem import Case, simulate
from fem.heat.layer_resolution import grid_error, layer_error, step_error

ALPHA, TIME = 0.16, 0.02


def surface_rise(cell, steps, cells=400):
    """Surface of a half-space of equal cells under unit flux, k = 1, by backward Euler."""
    capacity = np.full(cells, cell / ALPHA)
    capacity[0] *= 0.5
    dt = TIME / steps
    bands = np.zeros((2, cells))
    bands[0, 1:] = -dt / cell
    bands[1] = capacity + 2.0 * dt / cell
    bands[1, 0] = capacity[0] + dt / cell
    T = np.zeros(cells)
    for _ in range(steps):
        T = solveh_banded(bands, capacity * T + dt * np.eye(1, cells)[0])
    return T[0]


EXACT = 2.0 * np.sqrt(ALPHA * TIME / np.pi)


@pytest.mark.parametrize("cell", [0.2, 0.1, 0.05, 0.02])
def test_the_grid_error_is_that_of_lumped_cells(cell):
    found = 1.0 - surface_rise(cell, 4000) / EXACT
    assert grid_error(cell, ALPHA, TIME) == pytest.approx(found, abs=1e-4)


@pytest.mark.parametrize("steps", [1, 2, 5, 20])
def test_the_step_error_is_that_of_backward_euler(steps):
    found = 1.0 - surface_rise(0.0015, steps) / EXACT
    assert step_error(steps) == pytest.approx(found, abs=2e-4)


def test_both_vanish_with_second_and_first_order():
    assert grid_error(1e-3, ALPHA, TIME) == pytest.approx(1e-6 / (16.0 * ALPHA * TIME), rel=1e-3)
    assert step_error(1e4) == pytest.approx(1.0 / 8e4, rel=1e-3)
    assert grid_error(1e-9, ALPHA, TIME) < 1e-9


def test_without_heating_nothing_is_missed():
    assert layer_error(0.1, ALPHA, 0.0, 1) == 0.0


@pytest.mark.parametrize(("mesh", "velocity"), [("coarse", 3e4), ("default", 3e4), ("coarse", 3e3)])
def test_a_rigid_block_misses_the_stated_share_of_its_rise(mesh, velocity):
    """Constant flux into the block alone: no conductance, no radiation, Coulomb friction."""
    case = Case.from_dict(
        {
            "loading": {
                "mean_pressure_N_per_mm2": 0.3,
                "velocity_mm_per_s": velocity,
                "distance_mm": 60.0,
            },
            "block": {"rigid": True, "mesh": mesh},
            "friction": {"law": "coulomb", "mu": 0.5, "wlf": False},
            "heat": {"conductance_W_per_m2K": 0.0, "emissivity": 0.0},
            "output": {"snapshots": 1},
        }
    )
    summary, rubber = simulate(case).summary, case.rubber.thermal
    q = 0.5 * 0.3 * velocity * float(case.heat.partition_object()(0.3))
    effusivity = np.sqrt(rubber.conductivity * rubber.heat_capacity)
    exact = 2.0 * q * np.sqrt(60.0 / velocity / np.pi) / effusivity
    missed = 1.0 - (summary["T_max_C"] - case.heat.ambient_C) / exact
    assert missed == pytest.approx(summary["heat_layer_error"], abs=0.02)
    assert missed > 0.02
