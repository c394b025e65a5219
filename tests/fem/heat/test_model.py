"""Heat of block and road together: conservation, symmetry, independence of steps, closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from fem.heat.model import HeatModel
from fem.heat.road import RoadGrid
from fem.heat.state import HeatLoad, HeatState
from fem.mesh.block import block_mesh
from fem.mesh.grading import Grading
from fem.stepping.summary import heat_error
from materials.thermal import ASPHALT, RUBBER
from materials.units import STEFAN_BOLTZMANN
from tests.fem.small_blocks import leading_face
from tests.reference_solutions.conduction import (
    contact_of_two_half_spaces,
    cooling_by_radiation,
)

COARSE = Grading(cells_x=24, cells_y=14, smallest_x=0.5, smallest_y=0.05)


def a_model(direction=1, **options):
    return HeatModel(block_mesh(20.0, 8.0, COARSE, direction), RUBBER, ASPHALT, **options)


def sheared(mesh, amount):
    """A block that lags behind the platen and bulges, with its rear lifted a little."""
    X, Y = mesh.points.T
    sign = mesh.direction
    lag = (1.0 - Y / 8.0) ** 2
    s = X if sign > 0 else 20.0 - X
    return amount * np.column_stack([-sign * 3.0 * lag, 0.4 * lag * np.sin(0.3 * s)])


def sliding_load(model, amount=1.0, dt=0.005, sweep=1.3, power=4.0):
    mesh = model.mesh
    contact = mesh.bottom[4:]
    return HeatLoad(
        dt=dt,
        sweep=mesh.direction * sweep,
        displacement=sheared(mesh, amount),
        contact_nodes=contact,
        power=np.linspace(0.5, 1.0, len(contact)) * power,
        conductance=np.linspace(1.0, 1.5, len(contact)) * 1e-3,
        surface_nodes=leading_face(mesh)[2:5],
        surface_power=np.array([0.3, 0.2, 0.1]),
    )


def slide(model, steps, sweep=1.3, dt=0.005, start: HeatState | None = None):
    state, position = start or model.initial_state(), 0.0
    for step in range(1, steps + 1):
        load = sliding_load(model, amount=min(1.0, step / 10), dt=dt, sweep=sweep)
        state = model.advance(state, load, position)
        position += load.sweep
    return state


def test_heat_is_conserved_to_rounding():
    """Over 78 mm: deformation, lifted rear, self-contact heat, radiation, road left behind."""
    state = slide(a_model(), 60)
    assert state.generated > 0.0
    assert min(state.in_block, state.in_road, state.radiated, state.left) > 0.0
    assert heat_error(state) < 1e-12


def test_heat_is_conserved_however_badly_the_interface_is_solved():
    state = slide(a_model(exchange_tolerance_K=10.0), 20)
    assert state.exchange_iterations == 0
    assert heat_error(state) < 1e-12


def test_sliding_to_the_left_is_the_mirror_image():
    right, left = a_model(1), a_model(-1)
    one, other = slide(right, 40), slide(left, 40)
    np.testing.assert_allclose(one.T, other.T, rtol=0.0, atol=1e-10)
    assert one.left == pytest.approx(other.left, rel=1e-9)
    x_one = right.road_field(one, 52.0)
    x_other = left.road_field(other, -52.0)
    order = np.lexsort(np.round(x_one.points, 6).T)
    mirrored = x_other.points * [-1.0, 1.0] + [20.0, 0.0]
    order_other = np.lexsort(np.round(mirrored, 6).T)
    np.testing.assert_allclose(x_one.points[order], mirrored[order_other], atol=1e-9)
    np.testing.assert_allclose(
        x_one.temperature[order], x_other.temperature[order_other], rtol=0.0, atol=1e-10
    )


def test_advance_changes_nothing_and_repeats_itself():
    model = a_model()
    state = slide(model, 5)
    T, excess = state.T.copy(), state.road.excess.copy()
    load = sliding_load(model)
    first = model.advance(state, load, 6.5)
    slide(model, 12)  # other factors come and go
    second = model.advance(state, load, 6.5)
    np.testing.assert_array_equal(first.T, second.T)
    np.testing.assert_array_equal(first.road.excess, second.road.excess)
    np.testing.assert_array_equal(state.T, T)
    np.testing.assert_array_equal(state.road.excess, excess)


def test_temperature_converges_with_the_heat_step_at_first_order():
    finest = slide(a_model(heat_step_mm=0.02), 20)
    errors = [
        np.abs(slide(a_model(heat_step_mm=step), 20).T - finest.T).max()
        for step in (0.65, 0.325, 0.1625)
    ]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all((orders > 0.85) & (orders < 1.35)), orders
    assert errors[0] < 0.03 * (finest.T.max() - 20.0)


def test_dividing_the_mechanics_step_changes_little():
    """The same slide in steps of 1.3 and of 0.65 mm, with the same heat sub-steps."""
    model = a_model(heat_step_mm=0.325)
    ready = slide(model, 10)
    load = sliding_load(model)
    whole = model.advance(ready, load, 13.0)
    half = replace(load, dt=load.dt / 2, sweep=load.sweep / 2)
    middle = model.advance(ready, half, 13.0)
    parts = model.advance(middle, half, 13.65)
    np.testing.assert_allclose(parts.T, whole.T, rtol=0.0, atol=1e-5)


def test_keeping_an_earlier_conduction_matrix_does_not_show_in_the_result():
    """A block that shivers by 0.5 % of its shear: fewer factorisations, T within 0.01 K."""

    def shivering(model):
        state = model.initial_state()
        for step in range(40):
            load = sliding_load(model, amount=1.0 + 0.005 * np.sin(step))
            state = model.advance(state, load, 1.3 * step)
        return state

    keeping, renewing = a_model(), a_model(reuse_tolerance=0.0)
    one, other = shivering(keeping), shivering(renewing)
    assert keeping.factorisations <= 3
    assert renewing.factorisations >= 40
    assert np.abs(one.T - other.T).max() < 0.01
    assert other.T.max() > 25.0
    assert heat_error(one) < 1e-12


def test_nothing_gets_colder_than_the_surroundings_when_contact_sets_in():
    """Cold road runs below a hot block, contact changes from node to node, no deformation."""
    model = a_model()
    state = model.initial_state()
    state = replace(state, T=np.full_like(state.T, 60.0))
    for step in range(12):
        contact = model.mesh.bottom[: 25 - 2 * (step % 5)]
        load = HeatLoad(
            dt=0.002,
            sweep=0.6,
            displacement=state.displacement,
            contact_nodes=contact,
            power=np.zeros(len(contact)),
            conductance=np.full(len(contact), 1.0),
        )
        state = model.advance(state, load, 0.6 * step)
    assert state.T.max() <= 60.0 + 1e-9
    assert state.T.min() >= 20.0
    assert state.road.excess.min() > -1e-9
    assert state.road.excess.max() > 1.0


def contact_error(refinement):
    """Surface temperatures of a hot block at rest on a cold road after 0.4 s, at mid-length."""
    grading = Grading(cells_x=8, cells_y=60 * refinement, smallest_x=9.0, smallest_y=9.0)
    grid = RoadGrid(column=2.5, surface_layer=0.08 / refinement, growth=1.0, depth=5.0)
    mesh = block_mesh(20.0, 4.0, grading)
    model = HeatModel(mesh, RUBBER, ASPHALT, emissivity=0.0, road_grid=grid)
    state = model.initial_state()
    state = replace(state, T=np.full_like(state.T, 80.0))
    t, h, steps = 0.4, 1.6, 10 * refinement**2
    length = np.full(9, 2.5)
    length[[0, -1]] = 1.25
    load = HeatLoad(
        dt=t / steps,
        sweep=0.0,
        displacement=state.displacement,
        contact_nodes=mesh.bottom,
        power=np.zeros(9),
        conductance=h * length,
    )
    for _ in range(steps):
        state = model.advance(state, load, 0.0)
    T_block, T_road, flux = contact_of_two_half_spaces(
        t,
        T_1=80.0,
        T_2=20.0,
        h=h,
        effusivity_1=RUBBER.effusivity,
        effusivity_2=ASPHALT.effusivity,
    )
    x = model.road.points(state.road, 0.0)[:: len(model.road.depths), 0]
    road = 20.0 + np.interp(10.0, x, state.road.surface)
    middle = mesh.bottom[4]
    return max(
        abs(state.T[middle] - T_block), abs(road - T_road), abs(state.flow[middle] / 2.5 - flux)
    )


def test_two_half_spaces_with_conductance_converge_with_order_two_in_space():
    errors = [contact_error(n) for n in (1, 2, 4)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all((orders > 1.7) & (orders < 2.3)), orders
    assert errors[-1] < 1e-3 * (80.0 - 20.0)


def radiation_error(steps):
    """A well conducting block off the road loses heat through three of its sides."""
    conductor = replace(RUBBER, conductivity=1e3)
    mesh = block_mesh(20.0, 8.0, Grading(cells_x=4, cells_y=4, smallest_x=9.0, smallest_y=9.0))
    model = HeatModel(mesh, conductor, ASPHALT)
    state = model.initial_state()
    state = replace(state, T=np.full_like(state.T, 200.0))
    before = model.block.heat_content(state.T, 20.0)
    t = 4000.0
    load = HeatLoad(
        dt=t / steps,
        sweep=0.0,
        displacement=state.displacement,
        contact_nodes=np.empty(0, dtype=np.int64),
        power=np.empty(0),
        conductance=np.empty(0),
    )
    for _ in range(steps):
        state = model.advance(state, load, 0.0)
    assert state.in_block + state.radiated == pytest.approx(before, rel=1e-9)
    exact = cooling_by_radiation(
        t,
        T_start_C=200.0,
        ambient_C=20.0,
        emissivity=0.9,
        sigma=STEFAN_BOLTZMANN,
        surface_per_capacity=36.0 / model.block.capacity.sum(),
    )
    return abs(state.T.mean() - exact)


def test_radiation_converges_to_the_cooling_law_at_first_order():
    errors = [radiation_error(n) for n in (20, 40, 80)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all((orders > 0.9) & (orders < 1.1)), orders
    assert errors[-1] < 0.5


def test_surface_in_contact_does_not_radiate():
    """Block and road at ambient temperature except the contact: only free surfaces lose heat."""
    model = a_model()
    state = model.initial_state()
    T = state.T.copy()
    T[model.mesh.bottom[3:-3]] = 80.0
    state = replace(state, T=T)
    contact = model.mesh.bottom[3:-3]
    load = HeatLoad(
        dt=1e-4,
        sweep=0.0,
        displacement=state.displacement,
        contact_nodes=contact,
        power=np.zeros(len(contact)),
        conductance=np.zeros(len(contact)),
    )
    assert model.advance(state, load, 0.0).radiated == 0.0
    free = replace(load, contact_nodes=contact[:0], power=np.empty(0), conductance=np.empty(0))
    assert model.advance(state, free, 0.0).radiated > 0.0


def test_cost_does_not_grow_with_the_distance():
    model = a_model()
    columns = []
    state = model.initial_state()
    for step in range(150):
        state = model.advance(state, sliding_load(model), 1.3 * step)
        columns.append(len(state.road.excess))
    assert max(columns) == max(columns[:50])
    assert max(columns) * model.road.dx < 4.0 * 20.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"dt": 0.0}, "dt = 0.0 s, expected above 0"),
        ({"power": np.zeros(3)}, "21 contact nodes with 3 powers"),
        ({"surface_power": np.zeros(1)}, "3 surface nodes with 1 powers"),
    ],
)
def test_loads_that_do_not_fit_are_refused(change, message):
    load = sliding_load(a_model())
    with pytest.raises(ValueError, match=message):
        replace(load, **change)
