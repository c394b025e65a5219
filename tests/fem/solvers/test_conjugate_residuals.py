"""Conjugate residuals: iterations by the distance from the preconditioner, and against GMRES."""

import numpy as np
import pytest
from scipy.sparse.linalg import LinearOperator, gmres

from fem.solvers.conjugate_residuals import conjugate_residuals
from fem.solvers.direct import SuperLUSolver
from tests.fem.solvers.linear_systems import (
    dominant,
    relative_residual,
    right_hand_side,
    with_changed_rows,
)


def test_exact_factors_take_one_iteration():
    A, b = dominant(), right_hand_side()
    direct = SuperLUSolver()
    direct.solve(A, b)
    x, count = conjugate_residuals(A, b, direct.solve_again, tolerance=1e-10, iterations_max=5)
    assert count == 1
    assert relative_residual(A, x, b) < 1e-10


@pytest.mark.parametrize("changed", [1, 3, 6])
def test_each_changed_row_costs_at_most_one_more_iteration(changed):
    """A preconditioned matrix that differs from one in k rows has at most k + 1 eigenvalues."""
    A, b = dominant(), right_hand_side()
    direct = SuperLUSolver()
    direct.solve(A, b)
    B = with_changed_rows(A, changed)
    x, count = conjugate_residuals(B, b, direct.solve_again, tolerance=1e-9, iterations_max=20)
    assert count <= changed + 1
    assert relative_residual(B, x, b) < 1e-9


def test_iterations_and_solution_are_those_of_scipys_gmres():
    A, b = dominant(), right_hand_side()
    direct = SuperLUSolver()
    direct.solve(dominant(seed=2), b)
    ours, count = conjugate_residuals(A, b, direct.solve_again, tolerance=1e-6, iterations_max=60)
    right = LinearOperator(A.shape, matvec=lambda v: A @ direct.solve_again(v))
    seen = []
    y, info = gmres(right, b, rtol=1e-6, atol=0.0, restart=60, callback=seen.append,
                    callback_type="pr_norm")  # fmt: skip
    assert info == 0
    assert abs(count - len(seen)) <= 1
    np.testing.assert_allclose(ours, direct.solve_again(y), atol=1e-5 * np.abs(ours).max())


def test_too_many_iterations_give_no_solution():
    A, b = dominant(), right_hand_side()
    x, count = conjugate_residuals(A, b, lambda r: r, tolerance=1e-14, iterations_max=3)
    assert x is None
    assert count == 3
