"""Solution with kept factors: accuracy, when they are renewed, and the choice of the solver."""

import numpy as np
import pytest
from scipy.sparse import csc_matrix, diags

from fem.solvers import kept_factors as module
from fem.solvers.direct import SingularSystemError, SuperLUSolver
from fem.solvers.kept_factors import SINGLE_PAYS, KeptFactorsSolver, linear_solver
from tests.fem.solvers.linear_systems import (
    SIZE,
    dominant,
    relative_residual,
    right_hand_side,
    with_changed_rows,
)


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
    "name, unknowns, expected",
    [
        ("auto", SINGLE_PAYS - 1, "SuperLUSolver"),
        ("auto", SINGLE_PAYS, "SinglePrecisionSolver"),
        ("superlu", SINGLE_PAYS, "SinglePrecisionSolver"),
        ("pardiso", 10, "PardisoSolver"),
    ],
)
def test_solvers_are_chosen_by_name_and_size(name, unknowns, expected, monkeypatch):
    monkeypatch.setattr(module, "pardiso_available", lambda: True)
    monkeypatch.setattr(module.PardisoSolver, "__post_init__", lambda self: None)
    assert type(linear_solver(name, unknowns).direct).__name__ == expected


def test_pardiso_without_its_package_says_what_to_install(monkeypatch):
    monkeypatch.setattr(module, "pardiso_available", lambda: False)
    with pytest.raises(ValueError, match=r"pip install treadfem\[fast\]"):
        linear_solver("pardiso", 10)
