"""Boundaries that cut themselves are found, with their depth; others are not."""

import numpy as np
import pytest

from contact.overlap import crossing_depth, crossing_segments


def hook(depth):
    """A chain whose end turns back and pricks its straight beginning by `depth`."""
    straight = np.column_stack([np.arange(5.0), np.zeros(5)])
    return np.vstack([straight, [[4.0, 1.0], [2.5, 1.0], [2.5, -depth], [2.4, 1.0]]])


def test_open_chain_does_not_cross_itself():
    first, second = crossing_segments(hook(-0.1))
    assert first.size == second.size == 0
    assert crossing_depth(hook(-0.1), np.ones(9)) == 0.0


def test_segments_that_share_a_point_do_not_cross():
    zigzag = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 0.1], [1.0, 0.2]])
    assert crossing_segments(zigzag)[0].size == 0


@pytest.mark.parametrize("depth", [1e-6, 1e-3, 0.05])
def test_depth_is_that_of_the_tip_over_the_local_size(depth):
    chain = hook(depth)
    assert crossing_depth(chain, np.full(len(chain), 0.5)) == pytest.approx(depth / 0.5, rel=1e-3)


def test_crossings_do_not_depend_on_position_orientation_or_direction():
    chain = hook(0.01)
    size = np.full(len(chain), 0.2)
    expected = crossing_depth(chain, size)
    c, s = np.cos(0.7), np.sin(0.7)
    turned = chain @ np.array([[c, s], [-s, c]]) + [30.0, -7.0]
    assert crossing_depth(turned, size) == pytest.approx(expected, rel=1e-9)
    assert crossing_depth(chain[::-1], size) == pytest.approx(expected, rel=1e-12)


def test_all_pairs_are_found_among_random_chains():
    """Against every pair of segments, by the parameters of their intersection."""
    random = np.random.default_rng(3)
    for _ in range(20):
        chain = np.cumsum(random.normal(size=(30, 2)), axis=0)
        expected = set()
        for i in range(29):
            for j in range(i + 2, 29):
                a, b = chain[i + 1] - chain[i], chain[j + 1] - chain[j]
                s, t = np.linalg.solve(np.column_stack([a, -b]), chain[j] - chain[i])
                if 0.0 < s < 1.0 and 0.0 < t < 1.0:
                    expected.add((i, j))
        found = {tuple(sorted(pair)) for pair in zip(*crossing_segments(chain), strict=True)}
        assert found == expected
        assert found


def test_crossings_between_two_curves_are_found_and_the_gap_between_them_is_no_segment():
    """The end of one curve and the start of the next lie on either side of both."""
    curve = np.column_stack([np.linspace(0.0, 4.0, 5), np.zeros(5)])
    other = np.array([[3.5, 2.0], [2.5, 2.0], [2.5, -0.03], [2.4, 2.0]])
    chain, joined = np.vstack([curve, other]), np.arange(8) != 4
    first, second = crossing_segments(chain, joined)
    assert set(zip(first.tolist(), second.tolist(), strict=True)) == {(2, 6), (2, 7)}
    assert crossing_depth(chain, np.ones(9), joined) == pytest.approx(0.03, rel=1e-2)
    above = np.vstack([curve, other + np.array([0.0, 0.1])])
    assert crossing_depth(above, np.ones(9), joined) == 0.0
