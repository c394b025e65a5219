"""Sparse linear systems: pattern, elimination order, factorisation, iteration."""

from typing import TYPE_CHECKING

from fem.files import face

if TYPE_CHECKING:
    from fem.solvers.direct import SYMMETRIC, LinearSolver, SuperLUSolver
    from fem.solvers.kept_factors import linear_solver
    from fem.solvers.ordering import nested_dissection
    from fem.solvers.sparse_pattern import SparsePattern, summed
    from fem.solvers.stopwatch import Stopwatch
else:
    __getattr__ = face(__name__, __file__)
