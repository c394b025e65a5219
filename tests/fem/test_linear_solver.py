"""Solution with kept factors: accuracy, when they are renewed, and the choice of the solver."""

import numpy as np
import pytest
from scipy.sparse import csc_matrix, diags
from scipy.sparse.linalg import LinearOperator, gmres

from fem import linear_solver as module
from fem.direct_solver import SingularSystemError, SuperLUSolver
from fem.linear_solver import (
    PARDISO_PAYS,
    KeptFactorsSolver,
    conjugate_residuals,
    linear_solver,
)
from tests.fem.test_direct_solver import dominant

SIZE = 200


def with_changed_rows(A, count, seed=4):
    """The matrix with some rows replaced by those of the identity, as closing contacts do."""
    rows = np.random.default_rng(seed).choice(SIZE, count, replace=False)
    kept = np.ones(SIZE)
    kept[rows] = 0.0
    return (diags(kept) @ A + diags(1.0 - kept)).tocsc()


def right_hand_side(seed=5):
    return np.random.default_rng(seed).normal(size=SIZE)


def relative_residual(A, x, b):
    return np.linalg.norm(A @ x - b) / np.linalg.norm(b)


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


def test_one_factorisation_serves_systems_that_differ_in_few_rows():
    solver, A, b = KeptFactorsSolver(SuperLUSolver()), dominant(), right_hand_side()
    for changed in range(6):
        B = with_changed_rows(A, changed)
        assert relative_residual(B, solver.solve(B, b), b) <= solver.relative_residual
    assert solver.factorisations == 1
    assert 0 < solver.iterations < 40


def test_a_system_too_far_from_the_factors_is_factorised():
    solver, b = KeptFactorsSolver(SuperLUSolver()), right_hand_side()
    solver.solve(csc_matrix(diags(np.ones(SIZE))), b)
    A = csc_matrix(diags(np.linspace(1.0, 1e4, SIZE)))
    assert relative_residual(A, solver.solve(A, b), b) < 1e-12
    assert solver.factorisations == 2


def test_aged_factors_are_not_used_again():
    A, b = dominant(), right_hand_side()
    solver = KeptFactorsSolver(SuperLUSolver(), aged=2)
    solver.solve(A, b)
    B = with_changed_rows(A, 6)
    solver.solve(B, b)
    assert solver.factorisations == 1
    solver.solve(B, b)
    assert solver.factorisations == 2


def test_after_forgetting_the_solution_depends_on_nothing_before():
    A, b = dominant(), right_hand_side()
    used, fresh = KeptFactorsSolver(SuperLUSolver()), KeptFactorsSolver(SuperLUSolver())
    used.solve(with_changed_rows(A, 5), b)
    used.solve(A, b)
    used.forget()
    np.testing.assert_array_equal(used.solve(A, b), fresh.solve(A, b))


def test_a_singular_system_is_named_with_kept_factors_too():
    solver, A = KeptFactorsSolver(SuperLUSolver()), dominant()
    solver.solve(A, right_hand_side())
    A.data[:] = np.nan
    with pytest.raises(SingularSystemError, match="finite"):
        solver.solve(A, right_hand_side())


@pytest.mark.parametrize(
    "name, unknowns, installed, expected",
    [
        ("auto", PARDISO_PAYS - 1, True, "SuperLUSolver"),
        ("auto", PARDISO_PAYS, True, "PardisoSolver"),
        ("auto", PARDISO_PAYS, False, "SuperLUSolver"),
        ("superlu", PARDISO_PAYS, True, "SuperLUSolver"),
        ("pardiso", 10, True, "PardisoSolver"),
    ],
)
def test_pardiso_is_taken_where_it_is_installed_and_pays(
    name, unknowns, installed, expected, monkeypatch
):
    monkeypatch.setattr(module, "pardiso_available", lambda: installed)
    monkeypatch.setattr(module.PardisoSolver, "__post_init__", lambda self: None)
    assert type(linear_solver(name, unknowns).direct).__name__ == expected


def test_pardiso_without_its_package_says_what_to_install(monkeypatch):
    monkeypatch.setattr(module, "pardiso_available", lambda: False)
    with pytest.raises(ValueError, match=r"pip install treadfem\[fast\]"):
        linear_solver("pardiso", 10)
