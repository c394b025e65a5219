"""The fixed pattern against scipy's coordinate format."""

import numpy as np
import pytest
from scipy.sparse import coo_matrix

from fem.solvers.sparse_pattern import SparsePattern
from tests.fem.small_blocks import uniform_block


@pytest.fixture(scope="module")
def numbering():
    """Equation numbers of a block with some prescribed dofs and a shared one, in random order."""
    mesh = uniform_block(3.0, 2.0, 5, 4)
    dof = np.zeros((len(mesh.points), 2), dtype=np.int64)
    dof[mesh.bottom] = -1
    dof[mesh.top[1:], 1] = -1
    free = dof >= 0
    dof[free] = np.random.default_rng(3).permutation(int(free.sum()))
    dof[mesh.top[1:], 1] = dof[mesh.top[0], 1]
    return dof[mesh.cells].reshape(-1, 8), int(free.sum())


def random_matrices(count):
    return np.random.default_rng(4).normal(size=(count, 8, 8))


def entries(equations):
    """Row and column numbers of the entries of element matrices, (ne k k) each."""
    k = equations.shape[1]
    return np.repeat(equations, k, axis=1).ravel(), np.tile(equations, (1, k)).ravel()


def coordinate_sum(equations, K, size):
    rows, columns = entries(equations)
    kept = (rows >= 0) & (columns >= 0)
    return coo_matrix((K.ravel()[kept], (rows[kept], columns[kept])), shape=(size, size)).toarray()


def test_sum_equals_scipys_coordinate_format(numbering):
    equations, size = numbering
    pattern = SparsePattern.from_entries(*entries(equations), size)
    K = random_matrices(len(equations))
    ours = pattern.matrix(pattern.sum(K)).toarray()
    np.testing.assert_allclose(ours, coordinate_sum(equations, K, size), rtol=0.0, atol=1e-13)


def test_rows_are_sorted_and_unique_within_each_column(numbering):
    equations, size = numbering
    pattern = SparsePattern.from_entries(*entries(equations), size)
    for column in range(size):
        rows = pattern.indices[pattern.indptr[column] : pattern.indptr[column + 1]]
        assert (np.diff(rows) > 0).all()
    assert pattern.indptr[-1] == pattern.nnz


def test_diagonal_slots_address_the_diagonal(numbering):
    equations, size = numbering
    pattern = SparsePattern.from_entries(*entries(equations), size)
    data = np.zeros(pattern.nnz)
    data[pattern.diagonal_slots()] = np.arange(1.0, size + 1.0)
    np.testing.assert_array_equal(
        pattern.matrix(data).toarray(), np.diag(np.arange(1.0, size + 1.0))
    )


def test_the_diagonal_is_stored_even_where_no_element_has_it():
    pattern = SparsePattern.from_entries(*entries(np.array([[0, 2]])), 4)
    data = np.zeros(pattern.nnz)
    data[pattern.diagonal_slots()] = 1.0
    np.testing.assert_array_equal(pattern.matrix(data).toarray(), np.eye(4))


def test_row_slots_allow_row_operations(numbering):
    equations, size = numbering
    pattern = SparsePattern.from_entries(*entries(equations), size)
    data = pattern.sum(random_matrices(len(equations)))
    before = pattern.matrix(data.copy()).toarray()
    rows = np.array([7, 2, 11])
    slots, owner = pattern.row_slots(rows)
    factor = np.array([10.0, -1.0, 3.0])
    data[slots] *= factor[owner]
    expected = before.copy()
    expected[rows] *= factor[:, None]
    np.testing.assert_allclose(pattern.matrix(data).toarray(), expected, rtol=1e-15)
    assert (np.diff(owner) >= 0).all()


def test_slots_of_two_rows_of_a_node_pair_up(numbering):
    """The row operation of friction adds one row of a node to the other."""
    equations, size = numbering
    pattern = SparsePattern.from_entries(*entries(equations), size)
    data = pattern.sum(random_matrices(len(equations)))
    element = equations[7].reshape(4, 2)
    pairs = element[(element >= 0).all(axis=1)]
    x, owner = pattern.row_slots(pairs[:1, 0])
    y, _ = pattern.row_slots(pairs[:1, 1])
    before = pattern.matrix(data.copy()).toarray()
    data[x] += 0.5 * data[y]
    before[pairs[0, 0]] += 0.5 * before[pairs[0, 1]]
    np.testing.assert_allclose(pattern.matrix(data).toarray(), before, rtol=1e-14)
    assert (owner == 0).all()
