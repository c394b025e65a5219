"""The energy of element corners that have lost most of their area."""

from __future__ import annotations

import numpy as np
import pytest

from fem.mechanics.corners import (
    FIRST,
    SMALLEST,
    CornerBarrier,
    _area_gradients,
    barrier,
    corner_areas,
)

SHEAR_MODULUS = 0.7


def folding_cells() -> tuple[np.ndarray, np.ndarray]:
    """Reference and current corners of cells whose third corner is pushed in, and beyond."""
    cell = 0.3 * np.array([[0.0, 0.0], [1.0, 0.1], [1.1, 1.0], [0.0, 0.9]])
    X = np.repeat(cell[None], 6, axis=0)
    x = X + 0.02 * np.random.default_rng(1).normal(size=X.shape)
    x[:, 2] -= np.linspace(0.1, 0.4, 6)[:, None] * np.array([1.0, 0.9])
    return X, x


def corner_barrier(X: np.ndarray) -> CornerBarrier:
    return CornerBarrier(X, 0.5 * (corner_areas(X)[:, 0] + corner_areas(X)[:, 2]), SHEAR_MODULUS)


def differences(function, x: np.ndarray, h: float = 1e-6) -> np.ndarray:  # type: ignore[no-untyped-def]
    """Central differences along each of the eight degrees of freedom of all cells at once."""
    columns = []
    for k in range(8):
        step = np.zeros((len(x), 8))
        step[:, k] = h
        step = step.reshape(x.shape)
        columns.append((function(x + step) - function(x - step)) / (2.0 * h))
    return np.stack(columns, axis=-1)


def all_forces(resisting: CornerBarrier, x: np.ndarray) -> np.ndarray:
    forces, residual = resisting.forces(x), np.zeros((len(x), 8))
    assert forces is not None
    residual[forces.cells] = forces.residual
    return residual


def test_two_opposite_corners_make_the_area_of_the_element() -> None:
    square = np.array([[[0.0, 0.0], [2.0, 0.0], [2.0, 3.0], [0.0, 3.0]]])
    assert corner_areas(square) == pytest.approx(6.0)
    _, x = folding_cells()
    J = corner_areas(x)
    assert J[:, 0] + J[:, 2] == pytest.approx(J[:, 1] + J[:, 3])


def test_gradients_of_corner_areas_match_central_differences() -> None:
    _, x = folding_cells()
    expected = differences(corner_areas, x).reshape(len(x), 4, 4, 2)
    assert _area_gradients(x) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("j", [FIRST, SMALLEST])
def test_energy_has_two_continuous_derivatives(j: float) -> None:
    below, above = (
        np.array([part[0] for part in barrier(np.array([j + d]))]) for d in (-1e-9, 1e-9)
    )
    assert above == pytest.approx(below, rel=1e-6, abs=1e-6)


def test_corners_that_keep_enough_of_their_area_feel_nothing() -> None:
    X, _ = folding_cells()
    assert corner_barrier(X).forces(X) is None
    assert not np.any(barrier(np.linspace(FIRST, 3.0, 50)))


def test_energy_rises_ever_faster_towards_a_folded_corner_and_beyond() -> None:
    beta, first, second = barrier(np.linspace(-1.0, 0.999 * FIRST, 400))
    assert (np.diff(beta) < 0.0).all()
    assert (first < 0.0).all()
    assert (second > 0.0).all()
    assert np.diff(first).min() > 0.0


def test_forces_of_corners_are_the_gradient_of_their_energy() -> None:
    X, x = folding_cells()
    resisting = corner_barrier(X)
    for cell in range(len(x)):
        alone = corner_barrier(X[cell : cell + 1])
        gradient = differences(
            lambda y, alone=alone: np.array([alone.energy(y)]), x[cell : cell + 1]
        )
        residual = all_forces(resisting, x)[cell]
        assert gradient.ravel() == pytest.approx(residual, rel=1e-6, abs=1e-8)


def test_corner_tangent_matches_central_differences() -> None:
    X, x = folding_cells()
    resisting = corner_barrier(X)
    forces = resisting.forces(x)
    assert forces is not None
    assert (resisting.ratios(x) < 0.0).any()
    K = resisting.tangent(forces).transpose(0, 3, 1, 4, 2).reshape(-1, 8, 8)
    expected = differences(lambda y: all_forces(resisting, y), x)[forces.cells]
    assert np.abs(K - expected).max() < 1e-7 * np.abs(expected).max()


def test_corner_forces_need_no_support() -> None:
    """Neither a resultant nor a moment: the energy does not change with rigid motions."""
    X, x = folding_cells()
    f = all_forces(corner_barrier(X), x).reshape(-1, 4, 2)
    scale = np.abs(f).max()
    assert np.abs(f.sum(axis=1)).max() < 1e-12 * scale
    moment = np.sum(x[..., 0] * f[..., 1] - x[..., 1] * f[..., 0], axis=1)
    assert np.abs(moment).max() < 1e-12 * scale
