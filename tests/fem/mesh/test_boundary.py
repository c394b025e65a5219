"""Curves and chains of the free boundary: of one piece, of two, of a comb, and what is refused."""

import numpy as np
import pytest

from fem.mesh.block import BlockMesh
from fem.mesh.boundary import free_curves


def cut_grid(nx, ny, removed, direction=1, breaks=()):
    """Unit cells (i, j) without the removed ones, scattered numbers, held where y is largest."""
    kept = [(i, j) for i in range(nx) for j in range(ny) if (i, j) not in removed]
    corners = np.array([[(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)] for i, j in kept])
    points, cells = np.unique(corners.reshape(-1, 2), axis=0, return_inverse=True)
    numbers = np.random.default_rng(2).permutation(len(points))
    scattered = np.empty(points.shape)
    scattered[numbers] = points
    top = numbers[np.flatnonzero(points[:, 1] == ny)]
    if direction < 0:
        top = top[::-1]
    return BlockMesh(
        points=scattered, cells=numbers[cells.reshape(-1, 4)], top=top, direction=direction,
        breaks=breaks,
    )  # fmt: skip


def summary(mesh):
    return [(chain.name, chain.block, chain.kind, len(chain.nodes)) for chain in mesh.chains]


SIPED = [
    ("trailing face", 1, "trailing", 2),
    ("bottom 1", 1, "bottom", 3),
    ("sipe 1 rear", 1, "leading", 2),
    ("sipe 1 front", 1, "trailing", 2),
    ("bottom 2", 1, "bottom", 4),
    ("leading face", 1, "leading", 2),
]


def test_a_sipe_has_a_rear_wall_that_leads_a_lamella_and_a_front_wall_that_trails_one():
    mesh = cut_grid(6, 3, {(2, 0), (2, 1)})
    assert summary(mesh) == SIPED
    places = mesh.points[mesh.chains[2].nodes]
    np.testing.assert_array_equal(places, [[2.0, 1.0], [2.0, 2.0]])
    np.testing.assert_array_equal(mesh.chains[2].s, [1.0, 2.0])
    np.testing.assert_array_equal(mesh.points[mesh.leading_corners], [[2.0, 0.0], [6.0, 0.0]])


def test_the_mirror_image_has_the_same_chains():
    assert summary(cut_grid(6, 3, {(3, 0), (3, 1)}, direction=-1)) == SIPED


def test_chains_are_the_candidates_one_after_another():
    mesh = cut_grid(9, 3, {(2, 0), (2, 1), (5, 0), (5, 1), (5, 2)})
    np.testing.assert_array_equal(
        np.concatenate([chain.nodes for chain in mesh.chains]), mesh.candidates
    )
    assert len(mesh.curves) == 2
    assert np.count_nonzero(~mesh.joined) == 1
    lengths = np.linalg.norm(np.diff(mesh.points[mesh.boundary_edges], axis=1)[:, 0], axis=1)
    np.testing.assert_array_equal(lengths, 1.0)


def test_a_groove_parts_blocks_and_a_full_sipe_lamellae():
    groove = {(3, j) for j in range(3)}
    two = cut_grid(7, 3, groove, breaks=(3.5,))
    one = cut_grid(7, 3, groove)
    assert [chain.name for chain in two.chains] == 2 * ["trailing face", "bottom", "leading face"]
    assert [chain.block for chain in two.chains] == [1, 1, 1, 2, 2, 2]
    assert [chain.name for chain in one.chains][2:4] == ["sipe 1 rear", "sipe 1 front"]


def test_the_top_has_the_length_of_its_pieces():
    mesh = cut_grid(7, 3, {(3, j) for j in range(3)})
    assert mesh.top_length == 6.0
    assert mesh.length == 7.0
    np.testing.assert_allclose(mesh.top_shares * 6.0, [0.5, 1, 1, 0.5, 0.5, 1, 1, 0.5])


@pytest.mark.parametrize(
    ("removed", "found"),
    [({(2, 1)}, "a hole"), ({(2, 1), (3, 0), (2, 0), (3, 2)}, "meet in the point")],
)
def test_holes_and_cells_that_touch_in_a_point_are_refused(removed, found):
    mesh = cut_grid(6, 3, removed)
    with pytest.raises(ValueError, match=found):
        free_curves(mesh.points, mesh.cells, mesh.top, 1)
