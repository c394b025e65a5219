"""Direct solution: residual, fallback to pivoting, singular systems, factors used again."""

import numpy as np
import pytest
from scipy.sparse import csc_matrix, diags, random

from fem.direct_solver import (
    PardisoSolver,
    SingularSystemError,
    SuperLUSolver,
    pardiso_available,
)


def dominant(size=200, seed=1):
    """Unsymmetric matrix of symmetric pattern with a strong diagonal."""
    rng = np.random.default_rng(seed)
    pattern = random(size, size, 0.02, random_state=rng)
    A = (pattern + pattern.T).tocsc()
    A.data *= rng.uniform(0.5, 1.5, A.nnz)
    return (A + diags(np.full(size, 10.0))).tocsc()


def test_solution_has_a_residual_at_rounding():
    A, b = dominant(), np.random.default_rng(2).normal(size=200)
    x = SuperLUSolver().solve(A, b)
    assert np.abs(A @ x - b).max() < 1e-12


def test_the_right_hand_side_and_the_matrix_are_not_changed():
    A, b = dominant(), np.ones(200)
    data = A.data.copy()
    SuperLUSolver().solve(A, b)
    np.testing.assert_array_equal(A.data, data)
    np.testing.assert_array_equal(b, np.ones(200))


def test_a_zero_diagonal_is_solved_all_the_same():
    """A saddle point has no diagonal pivots; symmetric mode alone would break down."""
    A = csc_matrix(np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 2.0], [0.0, 3.0, 1.0]]))
    b = np.array([1.0, 2.0, 3.0])
    x = SuperLUSolver().solve(A, b)
    np.testing.assert_allclose(A @ x, b, atol=1e-13)


def test_growth_of_the_symmetric_mode_is_noticed_and_mended():
    """Wilkinson's matrix with small diagonal pivots: each step multiplies the entries by 900."""
    n = 12
    A = np.tril(-np.ones((n, n)), -1) + 0.0011 * np.eye(n)
    A[:, -1] = 1.0
    b = np.random.default_rng(5).normal(size=n)
    solver = SuperLUSolver()
    x = solver.solve(csc_matrix(A), b)
    np.testing.assert_allclose(A @ x, b, atol=1e-7)
    assert solver.fallbacks == 1


@pytest.mark.parametrize(
    "matrix",
    [np.zeros((3, 3)), np.ones((3, 3)), np.diag([1.0, 1.0, 0.0])],
    ids=["zero", "rank-one", "empty-row"],
)
def test_a_singular_matrix_is_named_so(matrix):
    with pytest.raises(SingularSystemError, match="singular"):
        SuperLUSolver().solve(csc_matrix(matrix), np.array([1.0, 2.0, 3.0]))


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_values_that_are_not_finite_are_refused(bad):
    A, b = dominant(), np.ones(200)
    b[3] = bad
    with pytest.raises(SingularSystemError, match="finite"):
        SuperLUSolver().solve(A, b)
    A.data[5] = bad
    with pytest.raises(SingularSystemError, match="finite"):
        SuperLUSolver().solve(A, np.ones(200))


def test_the_error_is_an_arithmetic_error_as_newton_expects():
    assert issubclass(SingularSystemError, ArithmeticError)


def test_work_is_counted():
    solver = SuperLUSolver()
    solver.solve(dominant(), np.ones(200))
    solver.solve(dominant(), np.ones(200))
    assert solver.factorisations >= 2
    assert solver.seconds > 0.0


def test_kept_factors_solve_again_and_are_dropped_on_request():
    A, rng = dominant(), np.random.default_rng(3)
    solver = SuperLUSolver()
    solver.solve(A, np.ones(200))
    b = rng.normal(size=200)
    np.testing.assert_allclose(A @ solver.solve_again(b), b, atol=1e-12)
    assert solver.factorisations == 1
    solver.forget()
    with pytest.raises(AttributeError):
        solver.solve_again(b)


@pytest.mark.skipif(not pardiso_available(), reason="needs the extra fast")
def test_pardiso_solves_and_solves_again():
    A, rng = dominant(), np.random.default_rng(3)
    solver = PardisoSolver()
    for b in rng.normal(size=(2, 200)):
        np.testing.assert_allclose(A @ solver.solve(A, b), b, atol=1e-12)
    np.testing.assert_allclose(A @ solver.solve_again(b), b, atol=1e-12)
    assert solver.factorisations == 2
