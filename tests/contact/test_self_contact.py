"""Contact of a boundary with itself: forces, tangent, friction work."""

from dataclasses import replace

import numpy as np
import pytest

from contact.self_contact import (
    SHEAR_SHARE,
    PairMultipliers,
    Pairs,
    dissipation,
    heat_sources,
    multiplier_step,
    multipliers_after,
    pair_forces,
    pair_mismatch,
    pair_tangents,
    segment_geometry,
)

STIFFNESS, MU = 3.0, 0.7


# --------------------------------------------------------------------------- forces and tangent

FRICTION = {
    "frictionless": {"mu": 0.0, "moved": 0.05, "shear_n": 0.0},
    "stick": {"mu": 1e3, "moved": 0.05, "shear_n": 0.1},
    "slip forwards": {"mu": 1.0, "moved": -100.0, "shear_n": 0.0},
    "slip backwards": {"mu": 1.0, "moved": 100.0, "shear_n": 0.0},
}


def random_pairs(side, orientation, *, mu, moved, shear_n, count=6, seed=1):
    """Pairs at random places, all pressed (side -1) or all open (+1), and their coordinates."""
    rng = np.random.default_rng(seed)
    a = rng.uniform(-1.0, 1.0, (count, 2))
    angle = rng.uniform(0.0, 2.0 * np.pi, count)
    t = np.column_stack([np.cos(angle), np.sin(angle)])
    n = orientation * np.column_stack([t[:, 1], -t[:, 0]])
    L = rng.uniform(0.5, 2.0, count)
    xi, gap = rng.uniform(0.1, 0.9, count), side * rng.uniform(0.1, 0.6, count)
    s = a + (xi * L)[:, None] * t + gap[:, None] * n
    x = np.stack([s, a, a + L[:, None] * t], axis=1).reshape(-1, 2)
    pairs = Pairs(
        place=np.arange(count), nodes=np.arange(3 * count).reshape(count, 3), xi_n=xi + moved,
        L_n=1.1 * L, stiffness=rng.uniform(2.0, 4.0, count), shear_n=np.full(count, shear_n),
        mu=mu, orientation=orientation,
    )  # fmt: skip
    return pairs, x


@pytest.fixture(params=[1, -1], ids=["left", "right"])
def orientation(request):
    return request.param


@pytest.fixture(params=list(FRICTION))
def pressed(request, orientation):
    return random_pairs(-1.0, orientation, **FRICTION[request.param])


def central_differences(function, x, count, step=1e-6):
    """Derivatives of `function` (count, ...) with respect to s, a, b of each pair."""
    columns = []
    for j in range(6):
        d = np.zeros((count, 6))
        d[:, j] = step
        d = d.reshape(-1, 2)
        columns.append((function(x + d) - function(x - d)) / (2.0 * step))
    return np.stack(columns, axis=-1)


def test_the_cases_are_what_their_names_say(orientation):
    slipping = {
        name: pair_forces(*random_pairs(-1.0, orientation, **options))
        for name, options in FRICTION.items()
    }
    assert not slipping["stick"].slipping.any()
    assert np.all(slipping["slip forwards"].shear > 0.0)
    assert np.all(slipping["slip backwards"].shear < 0.0)
    assert np.all(slipping["slip forwards"].slipping & slipping["slip backwards"].slipping)
    assert not slipping["frictionless"].shear.any()


def test_gap_is_open_on_the_side_away_from_the_material():
    s, a, b = np.array([[0.3, -0.2]]), np.array([[0.0, 0.0]]), np.array([[1.0, 0.0]])
    left, right = segment_geometry(s, a, b, 1), segment_geometry(s, a, b, -1)
    assert left.gap == pytest.approx(0.2)
    assert right.gap == pytest.approx(-0.2)
    assert left.xi == pytest.approx(0.3)


def test_tangent_matches_central_differences(pressed):
    pairs, x = pressed
    K = pair_tangents(pairs, pair_forces(pairs, x))
    numerical = central_differences(lambda y: pair_forces(pairs, y).residual, x, len(K))
    np.testing.assert_allclose(K, numerical, atol=1e-7 * np.abs(K).max())


def test_gradients_of_gap_and_slip_match_central_differences(pressed):
    pairs, x = pressed
    forces = pair_forces(pairs, x)
    count = len(forces.slip)
    for gradient, value in (
        (forces.grad_gap, lambda y: pair_forces(pairs, y).geometry.gap),
        (forces.grad_slip, lambda y: pair_forces(pairs, y).slip),
    ):
        numerical = central_differences(value, x, count, step=1e-5)
        np.testing.assert_allclose(gradient, numerical, atol=1e-8 * np.abs(gradient).max())


def test_residual_without_slip_is_the_gradient_of_the_stored_energy(orientation):
    pairs, x = random_pairs(-1.0, orientation, **FRICTION["stick"])

    def energy(y):
        forces = pair_forces(pairs, y)
        stored = forces.normal**2 / pairs.stiffness + forces.shear**2 / pairs.shear_stiffness
        return 0.5 * stored

    residual = pair_forces(pairs, x).residual
    numerical = central_differences(energy, x, len(residual))
    np.testing.assert_allclose(residual, numerical, atol=1e-7 * np.abs(residual).max())


def test_tangent_is_symmetric_unless_it_slips(orientation):
    for name in ("frictionless", "stick"):
        pairs, x = random_pairs(-1.0, orientation, **FRICTION[name])
        K = pair_tangents(pairs, pair_forces(pairs, x))
        np.testing.assert_allclose(K, K.transpose(0, 2, 1), atol=1e-12 * np.abs(K).max())


def test_multipliers_are_the_linearised_forces_of_the_gaps(pressed):
    """After a full step the forces differ from those of the gaps by second order only."""
    pairs, x = pressed
    forces = pair_forces(pairs, x)
    differences = []
    for size in (1e-3, 5e-4):
        du = size * np.random.default_rng(5).normal(size=x.shape)
        after = multipliers_after(forces, multiplier_step(pairs, forces, du), 1.0)
        moved = pair_forces(pairs, x + du, after)
        assert moved.settled
        differences.append(pair_mismatch(pairs, moved))
    assert differences[0] == pytest.approx(4.0 * differences[1], rel=0.05)


def multipliers(normal, *, pressed=True, shear=0.0, sense=0.0):
    """Multipliers of pairs with normal forces (k,)."""
    same = np.ones(normal.size)
    return PairMultipliers(
        normal=normal, shear=shear * same, pressed=pressed * same > 0.0, sense=sense * same
    )


def test_pairs_open_by_the_sign_of_their_force_and_close_by_their_gap(pressed):
    """Not by gaps that the linear system closed but for an error of second order."""
    pairs, x = pressed
    forces = pair_forces(pairs, x)
    normal = np.where(np.arange(forces.normal.size) % 2, 1.0, -1.0)
    held = multipliers(normal)
    np.testing.assert_array_equal(pair_forces(pairs, x, held).pressed, normal > 0.0)
    assert not pair_forces(pairs, x, held).settled
    apart = multipliers(0.0 * normal, pressed=False)
    assert pair_forces(pairs, x, apart).pressed.all()
    assert not pair_forces(pairs, x, apart).normal.any()


@pytest.mark.parametrize(
    "sense, shear, moved, asked",
    [
        (0.0, 0.5, 100.0, 0.0),  # held by less than the limit, wherever the iterate is
        (0.0, 1.5, -100.0, 1.0),  # held by more: slips along its force
        (0.0, -1.5, 100.0, -1.0),
        (1.0, 1.0, -100.0, 1.0),  # slips on
        (1.0, 1.0, 100.0, 0.0),  # has slipped back: sticks before it slips the other way
        (-1.0, -1.0, -100.0, 0.0),
    ],
)
def test_a_pair_that_slips_back_sticks_first(sense, shear, moved, asked):
    """`moved` shifts the start of the slip, so that its trial force has the other sign."""
    pairs, x = random_pairs(-1.0, 1, mu=1.0, moved=moved, shear_n=0.0)
    held = multipliers(np.ones(6), shear=shear, sense=sense)
    forces = pair_forces(pairs, x, held)
    np.testing.assert_array_equal(forces.sense, asked)
    np.testing.assert_array_equal(forces.sticks, asked == 0.0)
    assert forces.settled == (asked == sense)
    assert np.all(np.abs(forces.shear) <= forces.normal)


def test_forces_are_carried_to_the_pairs_that_stay():
    pairs, x = random_pairs(-1.0, 1, mu=MU, moved=0.05, shear_n=0.0)
    forces = pair_forces(pairs, x)
    kept = PairMultipliers(
        normal=forces.normal, shear=forces.shear, pressed=forces.pressed, sense=forces.sense
    )
    new = replace(pairs, nodes=np.vstack([pairs.nodes[3:], [[90, 91, 92]]]))
    carried = kept.carried(pairs, new)
    for name, nothing in {"normal": 0.0, "shear": 0.0, "pressed": False, "sense": 0.0}.items():
        wanted = [*getattr(forces, name)[3:], nothing]
        np.testing.assert_array_equal(getattr(carried, name), wanted)


def test_open_pairs_have_neither_force_nor_tangent(orientation):
    for options in FRICTION.values():
        pairs, x = random_pairs(1.0, orientation, **options)
        forces = pair_forces(pairs, x)
        assert np.all(forces.geometry.gap > 0.0)
        for value in (forces.normal, forces.shear, forces.residual):
            assert not value.any()
        assert not pair_tangents(pairs, forces).any()


def test_forces_and_moments_of_each_pair_are_in_balance(pressed):
    pairs, x = pressed
    forces = pair_forces(pairs, x).residual.reshape(-1, 3, 2)
    at, size = x[pairs.nodes], np.abs(forces).max()
    moments = at[..., 0] * forces[..., 1] - at[..., 1] * forces[..., 0]
    np.testing.assert_allclose(forces.sum(axis=1), 0.0, atol=1e-13 * size)
    np.testing.assert_allclose(moments.sum(axis=1), 0.0, atol=1e-13 * size)


def test_the_node_is_pushed_out_and_held_back(orientation):
    """The residual is an internal force: the pair acts on the node with its negative."""
    pairs, x = random_pairs(-1.0, orientation, **FRICTION["slip forwards"])
    forces = pair_forces(pairs, x)
    on_node = -forces.residual[:, :2]
    outwards = np.einsum("ki,ki->k", on_node, forces.geometry.n)
    assert np.all(outwards > 0.0)
    frictionless = pair_forces(replace(pairs, mu=0.0), x)
    drag = np.einsum("ki,ki->k", on_node + frictionless.residual[:, :2], forces.geometry.t)
    assert np.all(drag * forces.slip < 0.0)


def test_friction_never_exceeds_its_limit():
    for seed in range(20):
        pairs, x = random_pairs(-1.0, 1, mu=MU, moved=0.2, shear_n=0.3, seed=seed)
        forces = pair_forces(pairs, x)
        assert np.all(np.abs(forces.shear) <= MU * forces.normal * (1.0 + 1e-14))


# --------------------------------------------------------------------------------- dissipation


def one_pair(xi_n=0.5, shear_n=0.0, mu=MU):
    """A node above a segment of length 2 along x (material below), stiffness 3."""
    return Pairs(
        place=np.array([0]), nodes=np.array([[0, 1, 2]]), xi_n=np.array([xi_n]),
        L_n=np.array([2.0]), stiffness=np.array([STIFFNESS]), shear_n=np.array([shear_n]),
        mu=mu, orientation=1,
    )  # fmt: skip


def node_at(x, depth):
    """Coordinates of that node, pressed in by `depth`; the material is below the segment."""
    return np.array([[x, -depth], [1.0, 0.0], [-1.0, 0.0]])


def followed_path(positions, depths, mu=MU):
    """Friction work of each step along a path of the node, and the work of its tangential force."""
    heat, work, shear, x_n = [], [], 0.0, positions[0]
    for x, depth in zip(positions[1:], depths[1:], strict=True):
        pairs = one_pair(xi_n=0.5 * (1.0 - x_n), shear_n=shear, mu=mu)
        forces = pair_forces(pairs, node_at(x, depth))
        heat.append(dissipation(pairs, forces)[0])
        work.append(0.5 * (forces.shear[0] + shear) * forces.slip[0])
        shear, x_n = forces.shear[0], x
    return np.array(heat), np.array(work), shear


def test_stick_cycles_dissipate_nothing():
    x = 0.1 * np.sin(np.linspace(0.0, 6.0 * np.pi, 61))
    heat, work, _ = followed_path(x, np.full(x.size, 0.5 * SHEAR_SHARE), mu=10.0)
    assert np.abs(work).max() > 1e-4 * SHEAR_SHARE
    assert not heat.any()


def test_steady_slip_dissipates_force_times_distance():
    x = np.linspace(0.0, 0.9, 31)
    depth = 0.1 * SHEAR_SHARE
    heat, _, shear = followed_path(x, np.full(x.size, depth))
    limit = MU * STIFFNESS * depth
    assert abs(shear) == pytest.approx(limit)
    np.testing.assert_allclose(heat[-10:], limit * np.diff(x)[-10:], rtol=1e-12)


def test_in_slip_cycles_work_is_heat_plus_stored_energy():
    x = 0.4 * np.sin(np.linspace(0.0, 6.0 * np.pi, 400))
    heat, work, shear = followed_path(x, np.full(x.size, 0.1 * SHEAR_SHARE))
    assert heat.sum() > 0.1 * SHEAR_SHARE
    stored = shear**2 / (2.0 * SHEAR_SHARE * STIFFNESS)
    assert work.sum() == pytest.approx(heat.sum() + stored, rel=1e-10)


def test_dissipation_is_never_negative():
    rng = np.random.default_rng(3)
    heat, _, _ = followed_path(rng.uniform(-0.5, 0.5, 2000), rng.uniform(-0.1, 0.3, 2000))
    assert heat.min() >= 0.0
    assert heat.max() > 0.0


def test_heat_is_conserved_and_half_of_it_goes_to_each_side(pressed):
    pairs, x = pressed
    forces = pair_forces(pairs, x)
    heat = np.random.default_rng(4).uniform(0.0, 1.0, len(forces.slip))
    nodes, shares = heat_sources(pairs, forces, heat)
    assert np.array_equal(nodes, pairs.nodes.ravel())
    assert shares.min() >= 0.0
    np.testing.assert_allclose(shares.reshape(-1, 3).sum(axis=1), heat, rtol=1e-14)
    np.testing.assert_allclose(shares.reshape(-1, 3)[:, 0], 0.5 * heat, rtol=1e-14)


def test_heat_of_a_projection_off_the_segment_stays_positive_and_conserved():
    pairs = one_pair()
    forces = pair_forces(pairs, node_at(1.1, 0.1))
    _, shares = heat_sources(pairs, forces, np.array([2.0]))
    np.testing.assert_allclose(shares, [1.0, 1.0, 0.0])
