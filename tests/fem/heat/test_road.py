"""Conduction in the road columns: solver, closed forms, moving window."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.sparse import diags, kron
from scipy.sparse.linalg import spsolve

from fem.heat.exchange import passage
from fem.heat.road import RoadConduction, RoadGrid, RoadState
from materials.thermal import ASPHALT
from tests.reference_solutions.conduction import constant_flux, moving_band_surface

SMALL = RoadGrid(column=0.25, surface_layer=0.05, growth=1.3, depth=2.0)


def second_difference(sizes):
    """Stiffness matrix of linear elements of the given sizes."""
    inverse = 1.0 / sizes
    main = np.append(inverse, 0.0) + np.append(0.0, inverse)
    return diags([-inverse, main, -inverse], [-1, 0, 1])


def test_fast_diagonalisation_solves_the_assembled_system():
    road = RoadConduction(ASPHALT, SMALL, 5.0)
    columns, dt = 31, 0.07
    width, weight = road.column_widths(columns), road.layer_weight
    K_x = second_difference(np.full(columns - 1, road.dx))
    K_y = second_difference(np.diff(road.depths))
    M = kron(diags(width), diags(weight))
    K = kron(K_x, diags(weight)) + kron(diags(width), K_y)
    A = ASPHALT.heat_capacity * M + dt * ASPHALT.conductivity * K
    rng = np.random.default_rng(1)
    excess = rng.normal(size=(columns, len(weight)))
    heat = rng.normal(size=columns)
    load = np.zeros_like(excess)
    load[:, 0] = heat
    exact = spsolve(A.tocsc(), ASPHALT.heat_capacity * (M @ excess.ravel()) + load.ravel())
    np.testing.assert_allclose(
        road.step(excess, heat, dt).ravel(), exact, atol=1e-12 * np.abs(exact).max()
    )


def test_surface_response_is_the_surface_of_the_full_solution():
    road = RoadConduction(ASPHALT, SMALL, 5.0)
    rng = np.random.default_rng(2)
    excess, heat = rng.normal(size=(31, len(road.depths))), rng.normal(size=31)
    step = road.begin_step(excess, 0.01)
    surface = step.cold_surface + step.surface_change(heat)
    np.testing.assert_allclose(surface, step.finish(heat)[:, 0], rtol=1e-12, atol=1e-12)


def test_a_step_conserves_heat_to_rounding():
    road = RoadConduction(ASPHALT, RoadGrid(), 20.0)
    state = road.initial_state()
    heat = np.zeros(len(state.excess))
    heat[40:90] = 3.0
    after = road.step(state.excess, heat, 0.3)
    assert road.heat_content(after) == pytest.approx(150.0, rel=1e-13)
    assert after.min() > -1e-13 * after.max()


def flux_error(refinement):
    grid = RoadGrid(column=0.5, surface_layer=0.1 / refinement, growth=1.0, depth=4.0)
    road = RoadConduction(ASPHALT, grid, 5.0)
    t, flux, steps = 0.5, 0.04, 10 * refinement**2
    excess = np.zeros((5, len(road.depths)))
    heat = flux * road.column_widths(5) * t / steps
    for _ in range(steps):
        excess = road.step(excess, heat, t / steps)
    exact = constant_flux(
        road.depths, t, flux=flux, k=ASPHALT.conductivity, rho_c=ASPHALT.heat_capacity
    )
    return np.abs(excess - exact).max() / exact.max()


def test_constant_flux_on_a_half_space_converges_with_order_two_in_depth():
    errors = [flux_error(n) for n in (1, 2, 4)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all((orders > 1.8) & (orders < 2.2)), orders
    assert errors[-1] < 2e-3


def band_error(refinement, velocity=4.0, half_width=1.0):
    """Relative error of the surface temperature under a moving band at a low Peclet number."""
    grid = RoadGrid(column=0.2 / refinement, surface_layer=0.05 / refinement, growth=1.1, depth=6.0)
    road = RoadConduction(ASPHALT, grid, 12.0)
    sweep = 0.2 / refinement**2
    steps = round(6.0 / sweep)
    flux, dt = 0.02, sweep / velocity
    state = road.initial_state()
    x = np.linspace(-half_width, half_width, 21)
    length = np.full(21, 0.1)
    length[[0, -1]] = 0.05
    piece = np.column_stack([np.full(21, -0.05), np.full(21, 0.05)])
    piece[0, 0] = piece[-1, 1] = 0.0
    position = 2.0 + sweep * np.arange(steps + 1)
    excess = state.excess
    for start, end in pairwise(position):
        way = passage(x + start, x + end, piece, first=state.first, dx=road.dx, count=len(excess))
        excess = road.step(excess, dt * flux * way.distributed(length), dt)
    road_x = (state.first + np.arange(len(excess))) * road.dx - position[-1]
    inside = np.abs(road_x) < 0.8 * half_width
    exact = moving_band_surface(
        road_x[inside],
        flux=flux,
        half_width=half_width,
        velocity=velocity,
        k=ASPHALT.conductivity,
        rho_c=ASPHALT.heat_capacity,
    )
    return np.abs(excess[inside, 0] - exact).max() / exact.max()


def test_moving_band_source_converges_to_jaegers_solution():
    """Peclet number v b/(2 alpha) = 5; first order, as time step and moving edges are."""
    errors = [band_error(n) for n in (1, 2)]
    assert errors[1] < 0.6 * errors[0]
    assert errors[1] < 0.02


def fast_band(sweep):
    """Error below a 20 mm band at 300 mm/s, and surface temperature ahead of it, both relative."""
    road = RoadConduction(ASPHALT, RoadGrid(surface_layer=0.005, growth=1.08), 20.0)
    v, flux = 300.0, 0.1
    nodes = np.linspace(0.0, 20.0, 81)
    length = np.full(81, 0.25)
    length[[0, -1]] = 0.125
    piece = np.outer(np.ones(81), [-0.125, 0.125])
    state = road.initial_state()
    position = 0.0
    for _ in range(round(30.0 / sweep)):
        state = road.cover(state, position - 10.0, position + 31.0)
        way = passage(
            nodes + position,
            nodes + position + sweep,
            piece,
            first=state.first,
            dx=road.dx,
            count=len(state.excess),
        )
        heat = sweep / v * flux * way.distributed(length)
        state = RoadState(first=state.first, excess=road.step(state.excess, heat, sweep / v))
        position += sweep
    s = position + 20.0 - (state.first + np.arange(len(state.excess))) * road.dx
    below = (s > 2.0) & (s < 19.0)
    exact = 2.0 * flux * np.sqrt(s[below] / v) / (ASPHALT.effusivity * np.sqrt(np.pi))
    ahead = np.abs(state.surface[s < -0.5]).max() / exact.max()
    return np.abs(state.surface[below] / exact - 1.0).max(), ahead


def test_heat_of_the_sliding_block_is_not_smeared_at_high_peclet_numbers():
    """v L/alpha = 1.6e4: the surface below the block follows 2 q sqrt(s/v)/(e sqrt(pi)).

    The error is largest near the leading edge and falls with the sub-steps; no heat runs ahead.
    """
    (coarse, ahead), (fine, _) = fast_band(0.2), fast_band(0.1)
    assert ahead < 1e-3
    assert fine < 0.7 * coarse
    assert fine < 0.01


def test_window_keeps_material_points_and_books_what_it_drops():
    road = RoadConduction(ASPHALT, RoadGrid(behind=0.5), 20.0)
    state = road.initial_state()
    excess = state.excess.copy()
    x = (state.first + np.arange(len(excess))) * road.dx
    excess[:, 0] = np.exp(-((x - 5.0) ** 2))
    state = RoadState(first=state.first, excess=excess)
    moved = road.cover(road.drop_behind(state, 20.0, 1.0), 10.0, 51.0)
    x_new = (moved.first + np.arange(len(moved.excess))) * road.dx
    assert x_new[0] <= 0.0
    assert x_new[-1] >= 51.0
    np.testing.assert_allclose(
        moved.surface[x_new <= 29.0], np.exp(-((x_new[x_new <= 29.0] - 5.0) ** 2)), atol=1e-15
    )
    later = road.drop_behind(moved, 60.0, 1.0)
    assert road.heat_content(later.excess) < 1e-6 * road.heat_content(moved.excess)


def test_cells_are_counter_clockwise_and_fill_the_window():
    road = RoadConduction(ASPHALT, SMALL, 5.0)
    state = road.initial_state()
    corners = road.points(state, 3.0)[road.cells(state)]
    x, y = corners[..., 0], corners[..., 1]
    area = 0.5 * np.sum(x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1), axis=1)
    assert area.min() > 0.0
    assert area.sum() == pytest.approx((len(state.excess) - 1) * road.dx * 2.0, rel=1e-12)


@pytest.mark.parametrize("key", ["column", "surface_layer", "depth"])
def test_sizes_that_are_not_positive_are_refused(key):
    with pytest.raises(ValueError, match=key):
        RoadGrid(**{key: 0.0})
