"""Direct solution: residual, fallback to pivoting, singular systems, factors used again."""

import numpy as np
import pytest
from scipy.sparse import csc_matrix

from fem.solvers.direct import (
    PardisoSolver,
    SinglePrecisionSolver,
    SingularSystemError,
    SuperLUSolver,
    pardiso_available,
)
from tests.fem.solvers.linear_systems import dominant


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


def test_single_precision_is_refined_to_the_accuracy_asked_for():
    A, b = dominant(), np.random.default_rng(3).normal(size=200)
    solver = SinglePrecisionSolver(relative_residual=1e-12)
    x = solver.solve(A, b)
    assert np.linalg.norm(A @ x - b) <= 1e-12 * np.linalg.norm(b)
    assert (solver.factorisations, solver.fallbacks) == (1, 0)


@pytest.mark.parametrize("size", [1e-60, 1e60])
def test_the_small_range_of_single_precision_does_not_bound_the_right_hand_side(size):
    A, b = dominant(), size * np.random.default_rng(3).normal(size=200)
    solver = SinglePrecisionSolver()
    x = solver.solve(A, b)
    assert np.linalg.norm(A @ x - b) <= 1e-6 * np.linalg.norm(b)
    assert solver.fallbacks == 0
    np.testing.assert_allclose(A @ solver.solve_again(b), b, atol=1e-4 * np.abs(b).max())


def test_a_system_too_hard_for_single_precision_is_solved_in_double():
    """The Hilbert matrix of order 9 has a condition number of 5e11."""
    A = csc_matrix(1.0 / (np.arange(9)[:, None] + np.arange(9) + 1.0))
    b = np.ones(9)
    solver = SinglePrecisionSolver(relative_residual=1e-12, refinements_max=2)
    x = solver.solve(A, b)
    assert np.abs(A @ x - b).max() < 1e-8
    assert solver.fallbacks == 1
    np.testing.assert_allclose(A @ solver.solve_again(b), b, atol=1e-3)


@pytest.mark.parametrize("bad", [0.0, np.nan])
def test_single_precision_names_what_double_precision_names(bad):
    A = dominant()
    A.data[:] = bad
    with pytest.raises(SingularSystemError):
        SinglePrecisionSolver().solve(A, np.ones(200))


def test_values_beyond_single_precision_are_solved_in_double():
    A, b = 1e300 * dominant(), np.ones(200)
    solver = SinglePrecisionSolver()
    x = solver.solve(A, b)
    np.testing.assert_allclose(A @ x, b, atol=1e-12)
    assert x.all()
    assert solver.fallbacks == 1


@pytest.mark.skipif(not pardiso_available(), reason="needs the extra fast")
def test_pardiso_solves_and_solves_again():
    A, rng = dominant(), np.random.default_rng(3)
    solver = PardisoSolver()
    for b in rng.normal(size=(2, 200)):
        np.testing.assert_allclose(A @ solver.solve(A, b), b, atol=1e-12)
    np.testing.assert_allclose(A @ solver.solve_again(b), b, atol=1e-12)
    assert solver.factorisations == 2
