"""Transfer of heat between the moving contact surface and the road."""

import numpy as np
import pytest

from fem.heat.exchange import passage, solve_exchange


def numerical_shares(start, end, piece, first, dx, count, samples=1200):
    """Averages of the hats by midpoint sums over positions and over the piece."""
    u = (np.arange(samples) + 0.5) / samples
    where = start + u * (end - start)
    local = piece[0] + u * (piece[1] - piece[0])
    x = (where[:, None] + local[None, :]).ravel() / dx - first
    return np.array([np.maximum(1.0 - np.abs(x - j), 0.0).mean() for j in range(count)])


@pytest.mark.parametrize(
    ("start", "end", "piece"),
    [
        (3.1, 4.7, (-0.1, 0.2)),
        (4.7, 3.1, (-0.1, 0.2)),
        (3.1, 3.1, (-0.6, 0.3)),
        (3.1, 3.3, (0.0, 0.0)),
        (3.0, 3.0, (0.0, 0.0)),
        (3.05, 3.06, (-0.7, 0.0)),
        (3.0, 3.3, (-0.15, 0.15)),
    ],
)
def test_shares_are_the_exact_averages_of_the_hats(start, end, piece):
    way = passage(np.array([start]), np.array([end]), np.array([piece]), first=5, dx=0.3, count=20)
    expected = numerical_shares(start, end, piece, 5, 0.3, 20)
    np.testing.assert_allclose(way.distributed(np.ones(1)), expected, atol=2e-6)


def test_shares_stay_exact_for_tiny_movements():
    for tiny in (1e-3, 1e-5, 1e-7, 1e-12):
        way = passage(
            np.array([3.13]),
            np.array([3.13 + tiny]),
            np.array([[-0.1, 0.1]]),
            first=0,
            dx=0.3,
            count=20,
        )
        still = passage(
            np.array([3.13]), np.array([3.13]), np.array([[-0.1, 0.1]]), first=0, dx=0.3, count=20
        )
        difference = way.distributed(np.ones(1)) - still.distributed(np.ones(1))
        assert np.abs(difference).max() < 2.0 * tiny + 1e-8


def test_a_uniform_flux_arrives_uniform():
    """Unequal nodes that cover an interval heat the road evenly while they move."""
    rng = np.random.default_rng(3)
    ends = np.concatenate([[1.0], np.sort(rng.uniform(1.0, 9.0, 29)), [9.0]])
    nodes = 0.5 * (ends[:-1] + ends[1:])
    piece = np.column_stack([ends[:-1] - nodes, ends[1:] - nodes])
    way = passage(nodes, nodes + 0.37, piece, first=0, dx=0.2, count=60)
    density = way.distributed(np.diff(ends)) / 0.2
    x = 0.2 * np.arange(60)
    inside = (x > 1.6) & (x < 8.7)
    np.testing.assert_allclose(density[inside], 1.0, rtol=1e-12)


def test_what_is_seen_and_what_is_given_are_transposes_and_sum_to_one():
    rng = np.random.default_rng(4)
    start = rng.uniform(2.0, 8.0, 25)
    way = passage(
        start,
        start + rng.uniform(-0.5, 0.5, 25),
        np.array([-0.1, 0.1]) * rng.uniform(0.0, 1.0, (25, 2)),
        first=0,
        dx=0.2,
        count=60,
    )
    heat, surface = rng.normal(size=25), rng.normal(size=60)
    assert way.distributed(heat).sum() == pytest.approx(heat.sum(), rel=1e-12)
    assert way.seen(surface) @ heat == pytest.approx(surface @ way.distributed(heat), rel=1e-11)
    np.testing.assert_allclose(way.seen(np.ones(60)), 1.0, rtol=1e-14)


def test_contact_outside_the_window_is_an_error():
    with pytest.raises(ValueError, match="leaves the road window"):
        passage(np.array([9.9]), np.array([10.4]), np.zeros((1, 2)), first=0, dx=0.2, count=50)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_exchange_solves_the_interface_system(scale):
    """Also where h sqrt(dt)/e is far above one and a fixed-point iteration diverges."""
    rng = np.random.default_rng(5)
    m, n = 12, 30
    A = rng.normal(size=(n, n))
    response = A @ A.T * scale
    B = rng.normal(size=(m, m))
    road = B @ B.T * scale
    G = rng.uniform(0.5, 2.0, m)
    G[3] = 0.0
    difference = rng.normal(size=m) * 30.0
    guess = rng.normal(size=m)
    guess[3] = 0.0
    result = solve_exchange(
        guess,
        G,
        difference,
        lambda q: response[:, :m] @ q,
        lambda q, drop: drop[:m] + road @ q,
        tolerance_K=1e-9,
    )
    S = response[:m, :m] + road
    active = G > 0.0
    system = np.diag(1.0 / G[active]) + S[np.ix_(active, active)]
    expected = np.linalg.solve(system, (difference + S @ guess)[active])
    np.testing.assert_allclose(result.flow[active], expected, rtol=1e-6, atol=1e-9)
    assert result.flow[3] == 0.0
    np.testing.assert_allclose(
        result.block_change, -response[:, :m] @ (result.flow - guess), rtol=1e-8, atol=1e-6
    )
