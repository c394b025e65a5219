"""Graded block mesh: sizes, orientation, node sets, mirror image."""

import warnings

import numpy as np
import pytest

from fem.mesh.block import block_mesh, graded_coordinates
from fem.mesh.grading import NAMED_GRADINGS, Grading
from tests.fem.small_blocks import leading_face, trailing_face


@pytest.mark.parametrize(
    ("length", "cells", "smallest"), [(8.0, 36, 0.04), (20.0, 300, 0.03), (8.0, 1000, 1e-3)]
)
def test_graded_cells_start_at_the_smallest_and_grow_by_one_ratio(length, cells, smallest):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        x = graded_coordinates(length, cells, smallest)
    sizes = np.diff(x)
    assert x[0] == 0.0
    assert x[-1] == pytest.approx(length, rel=1e-14)
    assert sizes[0] == pytest.approx(smallest, rel=1e-9)
    np.testing.assert_allclose(sizes[1:] / sizes[:-1], sizes[1] / sizes[0], rtol=1e-8)


def test_a_smallest_cell_above_the_mean_gives_a_uniform_division():
    np.testing.assert_allclose(np.diff(graded_coordinates(8.0, 4, 3.0)), 2.0)


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("name", list(NAMED_GRADINGS))
def test_cells_are_counter_clockwise_and_fill_the_block(name, direction):
    mesh = block_mesh(20.0, 8.0, NAMED_GRADINGS[name], direction)
    x, y = mesh.points[mesh.cells].transpose(2, 0, 1)
    area = 0.5 * np.sum(x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y, axis=1)
    assert (area > 0.0).all()
    assert area.sum() == pytest.approx(160.0)
    assert mesh.size.min() == pytest.approx(NAMED_GRADINGS[name].smallest_y)


@pytest.mark.parametrize("direction", [1, -1])
def test_node_sets_lie_where_their_names_say(direction):
    grading = Grading(cells_x=7, cells_y=3, smallest_x=1.0, smallest_y=1.0)
    mesh = block_mesh(20.0, 8.0, grading, direction)
    front, rear = (20.0, 0.0) if direction > 0 else (0.0, 20.0)
    assert (mesh.points[mesh.bottom, 1] == 0.0).all()
    assert (mesh.points[mesh.top, 1] == 8.0).all()
    np.testing.assert_allclose(mesh.points[leading_face(mesh), 0], front)
    np.testing.assert_allclose(mesh.points[trailing_face(mesh), 0], rear)
    assert mesh.bottom[0] == trailing_face(mesh)[0]
    assert mesh.bottom[-1] == leading_face(mesh)[0] == mesh.leading_corners[0]
    assert (np.diff(mesh.from_trailing(mesh.bottom)) > 0.0).all()
    assert [chain.name for chain in mesh.chains] == ["trailing face", "bottom", "leading face"]
    np.testing.assert_array_equal(
        np.concatenate([chain.nodes for chain in mesh.chains]), mesh.candidates
    )
    assert np.unique(mesh.boundary).size == mesh.boundary.size == 2 * 4 + 8 - 2
    assert mesh.boundary_edges.shape == (mesh.boundary.size - 1, 2)


def test_the_mesh_of_a_slide_to_the_left_is_the_mirror_image():
    right = block_mesh(20.0, 8.0, NAMED_GRADINGS["coarse"], 1)
    left = block_mesh(20.0, 8.0, NAMED_GRADINGS["coarse"], -1)
    np.testing.assert_allclose(left.points[:, 0], 20.0 - right.points[:, 0])
    np.testing.assert_array_equal(left.points[:, 1], right.points[:, 1])
    np.testing.assert_array_equal(left.boundary, right.boundary)


def test_scikit_fem_sees_the_same_nodes_and_cells():
    mesh = block_mesh(20.0, 8.0, NAMED_GRADINGS["coarse"])
    np.testing.assert_array_equal(mesh.mesh.p.T, mesh.points)
    np.testing.assert_array_equal(mesh.mesh.t.T, mesh.cells)
