"""Order of nested dissection: a permutation, less fill than minimum degree, growth of the fill."""

import numpy as np
import pytest
from scipy.sparse import diags, kron
from scipy.sparse.linalg import splu

from fem.solvers.direct import SYMMETRIC
from fem.solvers.ordering import nested_dissection


def nine_point_matrix(nx, ny):
    """Matrix of a grid of quadrilaterals, one unknown per node."""

    def line(n):
        return diags([1.0, 4.0, 1.0], [-1, 0, 1], shape=(n, n))

    return kron(line(nx), line(ny)).tocsc()


def fill(matrix, order):
    permuted = matrix[order][:, order].tocsc()
    return splu(permuted, permc_spec="NATURAL", **SYMMETRIC).nnz


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (7, 3), (3, 7), (20, 33)])
def test_each_node_comes_once(shape):
    grid = np.random.default_rng(1).permutation(np.prod(shape)).reshape(shape)
    assert sorted(nested_dissection(grid)) == list(range(grid.size))


def test_the_last_nodes_separate_the_mesh_in_two():
    order = nested_dissection(np.arange(21 * 9).reshape(21, 9))
    np.testing.assert_array_equal(np.sort(order[-9:]), np.arange(90, 99))
    first, second = order[:90], order[90:-9]
    assert first.max() < 90
    assert second.min() > 98


def test_there_is_no_more_fill_than_with_minimum_degree():
    nx, ny = 120, 60
    matrix = nine_point_matrix(nx, ny)
    order = nested_dissection(np.arange(nx * ny).reshape(nx, ny))
    minimum_degree = splu(matrix, permc_spec="MMD_AT_PLUS_A", **SYMMETRIC).nnz
    assert fill(matrix, order) < minimum_degree


def test_fill_grows_with_n_log_n():
    """Each doubling of both sides adds about the same number of entries per node."""
    sizes = (20, 40, 80, 160)
    per_node = []
    for n in sizes:
        order = nested_dissection(np.arange(n * n).reshape(n, n))
        per_node.append(fill(nine_point_matrix(n, n), order) / n**2)
    added = np.diff(per_node)
    assert added.max() < 1.25 * added.min()
