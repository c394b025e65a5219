"""Steps of the block's mechanics: contact tangent, contact conditions, balance, invariance."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from contact.active_set import OPEN, SLIP, STICK, ContactStatus
from fem.mechanics import Iterate, platen_displacement
from fem.mesh.block import block_mesh
from fem.mesh.grading import Grading
from tests.fem.contact_steps import (
    OPTIONS,
    YEOH,
    load_of,
    pressed,
    reactions,
    slid,
    small_block,
    solved,
)
from tests.fem.small_blocks import consistent_pressure, leading_face, trailing_face, uniform_block
from tests.materials.models import MODELS

FORCE = 1.2
DYNAMIC = {"density": 1e-6}


def mixed_mu(system):
    """Low friction on one half of the bottom, high on the other: slip here, stick there."""
    x = system.mesh.points[system.candidates, 0]
    return np.where(x < 0.5 * system.mesh.length, 0.05, 1.0)


def mixed_step(system, sense=1.0, dt=0.02):
    """Converged step with open, sticking and slipping nodes."""
    state = pressed(system, FORCE, mu=mixed_mu(system), dt=dt)
    for _ in range(4):
        load = load_of(system, force=FORCE, mu=mixed_mu(system), sweep=0.05 * sense, dt=dt)
        problem, result, after = solved(system, state, load)
        before, state = state, after
    assert before is problem.state
    return problem, result, after


# ------------------------------------------------------------------------------- tangent


def evaluated(problem, u, status):
    """Evaluation with the element pressures that belong to the displacement."""
    p = consistent_pressure(problem.system.elements, u)
    return problem.evaluate(Iterate(u=u, p=p, status=status))


def assert_tangent_matches(problem, u, status, h=1e-7):
    """Compare all columns of the tangent with central differences at constant status."""
    system = problem.system
    base = evaluated(problem, u, status)
    tangent = problem.tangent(base).toarray()
    differences = np.empty_like(tangent)
    for column in range(system.pattern.size):
        unit = np.zeros(system.pattern.size)
        unit[column] = h
        du = system.scatter(unit)
        up, down = (evaluated(problem, u + s * du, status) for s in (1, -1))
        assert up.status.same_as(base.status), "the step of the differences crosses a switch"
        assert down.status.same_as(base.status), "the step of the differences crosses a switch"
        differences[:, column] = (up.residual - down.residual) / (2.0 * h)
    scale = np.abs(tangent).max()
    np.testing.assert_allclose(tangent, differences, rtol=0.0, atol=1e-7 * scale)
    return base.status


def noise(system, size):
    values = np.random.default_rng(1).uniform(-size, size, system.pattern.size)
    return system.scatter(values)


@pytest.mark.parametrize("top", ["platen", "pressure"])
@pytest.mark.parametrize("dynamic", [{}, DYNAMIC], ids=["static", "dynamic"])
def test_contact_tangent_matches_central_differences_in_stick_slip_and_open(top, dynamic):
    system = small_block(top=top, **dynamic)
    problem, result, after = mixed_step(system)
    status = assert_tangent_matches(problem, after.u + noise(system, 1e-6), result.x.status)
    assert status.sticking.any()
    assert status.slipping.any()
    assert (~status.active).any()


@pytest.mark.parametrize("name", MODELS)
def test_contact_tangent_matches_central_differences_for_all_compounds(name):
    system = small_block(model=MODELS[name], **DYNAMIC)
    problem, result, after = mixed_step(system)
    assert_tangent_matches(problem, after.u + noise(system, 1e-6), result.x.status)


def test_contact_tangent_matches_when_sliding_to_the_left():
    system = small_block(**DYNAMIC)
    problem, result, after = mixed_step(system, sense=-1.0)
    status = assert_tangent_matches(problem, after.u + noise(system, 1e-6), result.x.status)
    assert (status.sense[status.slipping] == -1.0).any()


def test_tangent_is_right_in_the_undeformed_state():
    """First iteration of a run: nothing is strained, the bottom rests on the road."""
    system = small_block(model=MODELS["van-der-waals-bars-series-1"], **DYNAMIC)
    state = system.initial_state()
    problem = system.step(state, load_of(system, force=FORCE, mu=0.5, dt=0.02))
    evaluation = problem.evaluate(problem.start())
    assert np.isfinite(problem.tangent(evaluation).data).all()
    u = state.u + np.array([0.0, -1e-9]) * (state.u[:, 1:] == 0.0)
    status = ContactStatus(kind=np.full_like(state.status.kind, SLIP), sense=state.status.sense)
    assert np.isfinite(evaluated(problem, u, status).residual).all()


@pytest.mark.parametrize("side", [1.0, -1.0], ids=["above", "below"])
def test_tangent_holds_on_both_sides_of_closing(side):
    """A node 1e-6 mm above or below the road; the status on each side has its own equations."""
    system = small_block(**DYNAMIC)
    problem, result, after = mixed_step(system)
    kind = result.x.status.kind.copy()
    node = int(np.flatnonzero(kind == SLIP)[2])
    kind[node] = OPEN
    u = after.u.copy()
    u[system.candidates[node], 1] += side * 1e-6 - system.gap(u)[node]
    status = assert_tangent_matches(problem, u, replace(result.x.status, kind=kind))
    assert status.active[node] == (side < 0.0)


@pytest.mark.parametrize("side", [1.0, -1.0], ids=["below the limit", "above the limit"])
def test_tangent_holds_on_both_sides_of_the_friction_limit(side):
    system = small_block(**DYNAMIC)
    problem, result, after = mixed_step(system)
    normal, tangential = reactions(system, result)
    node = int(np.flatnonzero(result.x.status.sticking)[1])
    limit = abs(tangential[node]) / normal[node]
    mu = problem.load.mu.copy()
    mu[node] = limit * (1.0 + side * 1e-3)
    near = system.step(problem.state, replace(problem.load, mu=mu))
    status = assert_tangent_matches(near, after.u, result.x.status)
    assert status.kind[node] == (STICK if side > 0.0 else SLIP)


@pytest.mark.parametrize("side", [1.0, -1.0], ids=["onwards", "backwards"])
def test_tangent_holds_on_both_sides_of_a_return_to_stick(side):
    system = small_block(**DYNAMIC)
    problem, result, after = mixed_step(system)
    node = int(np.flatnonzero(result.x.status.slipping)[2])
    u = after.u.copy()
    u[system.candidates[node], 0] += side * 1e-6 - problem.slip(u)[node]
    status = assert_tangent_matches(problem, u, result.x.status)
    assert status.kind[node] == (SLIP if side > 0.0 else STICK)


@pytest.mark.parametrize("side", [1.0, -1.0], ids=["pushing", "pulling"])
def test_tangent_holds_on_both_sides_of_opening(side):
    """The node above a contact node is moved until the reaction is 1e-4 N/mm."""
    system = small_block(**DYNAMIC)
    problem, result, after = mixed_step(system)
    node = int(np.flatnonzero(result.x.status.slipping)[2])
    above = system.candidates[node] + 1

    def moved(t):
        u = after.u.copy()
        u[above, 1] += t
        return u

    def reaction(t):
        evaluation = evaluated(problem, moved(t), result.x.status)
        return evaluation.nodal[system.candidates[node], 1] - side * 1e-4

    u = moved(brentq(reaction, 0.0, 0.3, xtol=1e-14))
    status = assert_tangent_matches(problem, u, result.x.status)
    assert status.active[node] == (side > 0.0)


# --------------------------------------------------------------------- contact conditions


@pytest.mark.parametrize("dynamic", [{}, DYNAMIC], ids=["static", "dynamic"])
def test_gaps_and_reactions_are_complementary_after_convergence(dynamic):
    system = small_block(**dynamic)
    _, result, after = mixed_step(system)
    normal, tangential = reactions(system, result)
    gap = system.gap(after.u)
    active = result.x.status.active
    assert gap.min() > -1e-12
    assert (normal[active] > -1e-9).all()
    assert (gap[~active] > 0.0).all()
    np.testing.assert_allclose(gap[active], 0.0, atol=1e-12)
    np.testing.assert_allclose(normal[~active], 0.0, atol=1e-8)
    np.testing.assert_allclose(tangential[~active], 0.0, atol=1e-8)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_coulombs_law_holds_at_every_node(sense):
    system = small_block()
    problem, result, after = mixed_step(system, sense=sense)
    normal, tangential = reactions(system, result)
    status, mu, slip = result.x.status, problem.load.mu, problem.slip(after.u)
    stuck, sliding = status.sticking, status.slipping
    np.testing.assert_allclose(slip[stuck], 0.0, atol=1e-12)
    assert (np.abs(tangential[stuck]) <= mu[stuck] * normal[stuck] + 1e-9).all()
    np.testing.assert_allclose(
        np.abs(tangential[sliding]), mu[sliding] * normal[sliding], atol=1e-8
    )
    assert (tangential[sliding] * slip[sliding] <= 1e-12).all()


def test_a_small_sweep_sticks_and_a_large_one_slips():
    system = small_block()
    state = pressed(system, FORCE, mu=0.5)
    for sweep, friction in ((1e-5, STICK), (3.0, SLIP)):
        after, steps = state, 1 if friction == STICK else 30
        for _ in range(steps):
            load = load_of(system, force=FORCE, mu=0.3 if steps > 1 else 0.9, sweep=sweep / steps)
            _, result, after = solved(system, after, load)
        active = result.x.status.active
        assert (result.x.status.kind[active] == friction).all()


def test_friction_in_full_slip_is_the_sum_of_mu_times_the_reactions():
    system = small_block()
    state = pressed(system, FORCE, mu=0.3)
    mu = 0.2 + 0.02 * np.sin(np.arange(system.candidates.size))
    for _ in range(25):
        load = load_of(system, force=FORCE, mu=mu, sweep=0.1)
        _, result, state = solved(system, state, load)
    normal, tangential = reactions(system, result)
    assert result.x.status.slipping.sum() == result.x.status.active.sum()
    assert -tangential.sum() == pytest.approx(np.sum(mu * normal), rel=1e-6)
    top = result.evaluation.nodal[system.mesh.top, 0].sum()
    assert top == pytest.approx(-tangential.sum(), rel=1e-6)


@pytest.mark.parametrize("top", ["platen", "pressure"])
@pytest.mark.parametrize("dynamic", [{}, DYNAMIC], ids=["static", "dynamic"])
def test_the_road_carries_the_force_on_the_platen(top, dynamic):
    system = small_block(top=top, **dynamic)
    state = pressed(system, FORCE, mu=0.4, dt=1.0)
    _, result, _ = solved(system, state, load_of(system, force=FORCE, mu=0.4, dt=1e3))
    normal, _ = reactions(system, result)
    assert normal.sum() == pytest.approx(FORCE, rel=1e-6)


def test_the_platen_stays_level_and_goes_down():
    system = small_block()
    state = pressed(system, FORCE, mu=0.4)
    lowered = -state.u[system.mesh.top, 1]
    np.testing.assert_allclose(lowered, lowered[0], rtol=0.0, atol=1e-15)
    assert platen_displacement(system.mesh, state.u) == pytest.approx(lowered[0])
    assert lowered[0] > 0.05
    np.testing.assert_array_equal(state.u[system.mesh.top, 0], 0.0)


def test_the_front_face_rolls_onto_the_road():
    """Every free boundary node is a candidate, not only those of the bottom."""
    system = small_block(uniform_block(6.0, 4.0, 12, 10), **DYNAMIC)
    state = pressed(system, 2.0, mu=0.5, dt=0.02)
    state = slid(system, state, distance=2.0, speed=5.0, force=2.0, mu=0.5)
    on_road = system.candidates[state.status.active]
    assert np.isin(on_road, leading_face(system.mesh)[1:]).any()
    assert not np.isin(on_road, trailing_face(system.mesh)[1:]).any()


def test_a_pulled_block_opens_all_nodes():
    system = small_block(**DYNAMIC)
    state = pressed(system, FORCE, mu=0.4, dt=0.02)
    for _ in range(8):
        _, result, state = solved(system, state, load_of(system, force=-2.0, mu=0.4, dt=0.02))
    assert not result.x.status.active.any()
    assert (system.gap(state.u) > 0.0).all()


def test_a_node_exactly_at_the_friction_limit_does_not_toggle():
    """The limit is set to the ratio of forces of a sticking node in the solution itself."""
    system = small_block()
    problem, result, _ = mixed_step(system)
    normal, tangential = reactions(system, result)
    node = int(np.flatnonzero(result.x.status.sticking)[1])
    mu = problem.load.mu.copy()
    mu[node] = abs(tangential[node]) / normal[node]
    _, again, _ = solved(system, problem.state, replace(problem.load, mu=mu))
    assert again.iterations <= result.iterations + 3
    np.testing.assert_allclose(again.x.u, result.x.u, atol=1e-7)


# ------------------------------------------------------------------------------- dynamics


def test_a_free_block_accelerates_as_force_over_mass():
    mesh = uniform_block(6.0, 4.0, 4, 3)
    system = small_block(replace(mesh, points=mesh.points + np.array([0.0, 5.0])), **DYNAMIC)
    assert system.mass.sum() == pytest.approx(1e-6 * 24.0)
    _, result, state = solved(system, system.initial_state(), load_of(system, force=0.4, dt=1e-3))
    momentum = np.sum(system.mass * state.velocity[:, 1])
    assert momentum == pytest.approx(-0.4 * 1e-3, rel=1e-6)
    assert not result.x.status.active.any()


def test_the_road_moves_in_the_platens_frame():
    """Velocities are absolute: a block at rest in the platen's frame moves with the platen."""
    system = small_block(**DYNAMIC)
    problem = system.step(system.initial_state(), load_of(system, force=0.0, sweep=0.6, dt=0.02))
    np.testing.assert_allclose(problem.velocity(system.initial_state().u), [[30.0, 0.0]] * 60)


def test_evaluation_changes_nothing():
    system = small_block(**DYNAMIC)
    problem, result, after = mixed_step(system)
    before = after.u.copy(), after.p.copy(), result.x.status.kind.copy()
    first = problem.evaluate(result.x)
    problem.tangent(first)
    second = problem.evaluate(result.x)
    np.testing.assert_array_equal(first.residual, second.residual)
    for one, other in zip(before, (after.u, after.p, result.x.status.kind), strict=True):
        np.testing.assert_array_equal(one, other)


def test_an_inverted_block_is_not_admissible():
    system = small_block()
    state = system.initial_state()
    problem = system.step(state, load_of(system, force=FORCE))
    u = np.zeros_like(state.u)
    u[system.mesh.bottom, 1] = 3.0
    assert evaluated(problem, u, state.status).merit == np.inf


def test_scatter_and_gather_are_adjoint():
    system = small_block()
    rng = np.random.default_rng(3)
    x, f = rng.normal(size=system.pattern.size), rng.normal(size=(60, 2))
    assert np.sum(system.scatter(x) * f) == pytest.approx(np.dot(x, system.gather(f)))


def test_contact_lengths_are_half_the_closed_edges_and_never_vanish():
    system = small_block()
    u = np.zeros_like(system.mesh.points)
    on_road = system.mesh.points[system.candidates, 1] == 0.0
    lengths = system.contact_lengths(u, on_road)
    assert lengths[on_road].sum() == pytest.approx(6.0)
    lone = np.zeros_like(on_road)
    lone[np.flatnonzero(on_road)[3]] = True
    assert system.contact_lengths(u, lone)[lone][0] == pytest.approx(6.0 / 9.0)
    assert (lengths > 0.0).all()


# ----------------------------------------------------------------------------- invariance


def slide(system, sense=1.0, steps=6):
    state = pressed(system, FORCE, mu=0.4, dt=0.02)
    for _ in range(steps):
        load = load_of(system, force=FORCE, mu=0.4, sweep=sense * 0.1, dt=0.02)
        _, _, state = solved(system, state, load)
    return state


def test_a_rigid_shift_of_the_mesh_changes_nothing():
    mesh = uniform_block(6.0, 4.0, 9, 5)
    shifted = replace(mesh, points=mesh.points + np.array([777.0, 0.0]))
    one, other = (slide(small_block(m, **DYNAMIC)) for m in (mesh, shifted))
    np.testing.assert_allclose(one.u, other.u, rtol=0.0, atol=1e-10)
    assert one.status.same_as(other.status)


def test_sliding_to_the_left_is_the_mirror_image():
    system = small_block(**DYNAMIC)
    right, left = slide(system), slide(system, sense=-1.0)
    X = system.mesh.points
    mirror = np.lexsort((X[:, 1], np.round(6.0 - X[:, 0], 9)))
    straight = np.lexsort((X[:, 1], np.round(X[:, 0], 9)))
    np.testing.assert_allclose(left.u[mirror] * [-1.0, 1.0], right.u[straight], rtol=0.0, atol=1e-8)


def test_a_step_of_no_load_from_rest_costs_no_iteration_beyond_the_first():
    system = small_block()
    _, result, state = solved(system, system.initial_state(), load_of(system, force=0.0))
    assert result.iterations <= 1
    assert np.abs(state.u).max() < 1e-12
    assert OPTIONS.iterations_max > 1
    assert YEOH.initial_shear_modulus > 0.0


def test_a_block_is_pressed_without_friction_in_one_large_step():
    grading = Grading(cells_x=12, cells_y=6, smallest_x=1.6, smallest_y=1.3)
    system = small_block(block_mesh(20.0, 8.0, grading))
    _, result, _ = solved(system, system.initial_state(), load_of(system, force=5.0))
    assert result.iterations <= 8
