"""Order of nested dissection: a permutation, less fill than minimum degree, growth of the fill."""

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from fem.mesh.block import block_mesh
from fem.mesh.grading import NAMED_GRADINGS
from fem.solvers.direct import SYMMETRIC
from fem.solvers.ordering import PIECE, nested_dissection


def grid_mesh(nx, ny):
    """Points and cells of a grid of nx by ny nodes, numbered by column and row."""
    x, y = np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij")
    node = np.arange(nx * ny).reshape(nx, ny)
    cells = [node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]]
    points = np.column_stack([x.ravel(), y.ravel()]).astype(float)
    return points, np.column_stack([corner.ravel() for corner in cells])


def matrix_of(points, cells):
    """Matrix with an entry for each two nodes of a cell, diagonally dominant."""
    rows, columns = np.repeat(cells, 4, axis=1).ravel(), np.tile(cells, (1, 4)).ravel()
    n = len(points)
    return (
        coo_matrix((np.ones(rows.size), (rows, columns)), shape=(n, n))
        + coo_matrix((np.full(n, 40.0), (np.arange(n), np.arange(n))), shape=(n, n))
    ).tocsc()


def fill(matrix, order):
    permuted = matrix[order][:, order].tocsc()
    return splu(permuted, permc_spec="NATURAL", **SYMMETRIC).nnz


def by_rows_and_columns(grid):
    """The order of a grid of node numbers, halved along its longer side again and again."""
    if grid.size <= PIECE:
        return [grid.ravel()]
    if grid.shape[0] < grid.shape[1]:
        grid = grid.T
    half = grid.shape[0] // 2
    return [*by_rows_and_columns(grid[:half]), *by_rows_and_columns(grid[half + 1 :]), grid[half]]


@pytest.mark.parametrize("name", list(NAMED_GRADINGS))
def test_a_rectangle_is_halved_along_its_rows_and_columns(name):
    grading = NAMED_GRADINGS[name]
    mesh = block_mesh(20.0, 8.0, grading)
    grid = np.arange(len(mesh.points)).reshape(grading.cells_x + 1, grading.cells_y + 1)
    expected = np.concatenate(by_rows_and_columns(grid))
    np.testing.assert_array_equal(nested_dissection(mesh.points, mesh.cells), expected)


@pytest.mark.parametrize("shape", [(2, 2), (2, 9), (7, 3), (3, 7), (20, 33)])
def test_each_node_comes_once_however_the_nodes_are_numbered(shape):
    points, cells = grid_mesh(*shape)
    numbers = np.random.default_rng(1).permutation(len(points))
    scattered = np.empty_like(points)
    scattered[numbers] = points
    order = nested_dissection(scattered, numbers[cells])
    assert sorted(order) == list(range(len(points)))
    np.testing.assert_array_equal(order, numbers[nested_dissection(points, cells)])


def test_the_last_nodes_separate_the_mesh_in_two():
    order = nested_dissection(*grid_mesh(21, 9))
    np.testing.assert_array_equal(np.sort(order[-9:]), np.arange(90, 99))
    first, second = order[:90], order[90:-9]
    assert first.max() < 90
    assert second.min() > 98


def test_there_is_no_more_fill_than_with_minimum_degree():
    points, cells = grid_mesh(120, 60)
    matrix = matrix_of(points, cells)
    order = nested_dissection(points, cells)
    minimum_degree = splu(matrix, permc_spec="MMD_AT_PLUS_A", **SYMMETRIC).nnz
    assert fill(matrix, order) < minimum_degree


def test_fill_grows_with_n_log_n():
    """Each doubling of both sides adds about the same number of entries per node."""
    sizes = (20, 40, 80, 160)
    per_node = []
    for n in sizes:
        points, cells = grid_mesh(n, n)
        order = nested_dissection(points, cells)
        per_node.append(fill(matrix_of(points, cells), order) / n**2)
    added = np.diff(per_node)
    assert added.max() < 1.25 * added.min()
