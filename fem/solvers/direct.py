"""Direct solution of the sparse linear systems: SuperLU in symmetric mode, checked, with fallback.

Quadrilateral meshes give matrices of symmetric pattern. SuperLU's symmetric mode (ordering of
A^T + A, preference for diagonal pivots) then needs about half the time of its default column
ordering [1]_. Small pivots can spoil that factorisation, so each solution is checked; where it
fails, the system is solved again with COLAMD and partial pivoting.

References
----------
.. [1] Li, X. S., "An overview of SuperLU", ACM Trans. Math. Software 31 (2005) 302-325.
.. [2] Buttari, A., et al., "Using mixed precision for sparse matrix computations to enhance the
   performance while achieving 64-bit accuracy", ACM Trans. Math. Software 34 (2008) article 17.
"""

from dataclasses import dataclass, field
from importlib.util import find_spec
from typing import Any, Protocol

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix
from scipy.sparse.linalg import splu

from fem.solvers.conjugate_residuals import conjugate_residuals
from fem.solvers.stopwatch import Stopwatch
from materials.arrays import FloatArray

SYMMETRIC = {"diag_pivot_thresh": 0.001, "options": {"SymmetricMode": True}}


class SingularSystemError(ArithmeticError):
    """The matrix has no usable factorisation (singular, or not finite)."""


class LinearSolver(Protocol):
    """Solves systems that share one sparsity pattern; counts its work."""

    @property
    def factorisations(self) -> int:
        """Count of all factorisations."""
        ...

    @property
    def seconds(self) -> float:
        """Time spent in factorisations and solves [s]."""
        ...

    def solve(self, matrix: csc_matrix, rhs: FloatArray) -> FloatArray:
        """Solution of ``matrix x = rhs``; raises `SingularSystemError`."""
        ...

    def forget(self) -> None:
        """Forget earlier systems: what follows depends on nothing before."""
        ...


class DirectSolver(LinearSolver, Protocol):
    """A solver that keeps the factors of the last matrix."""

    def solve_again(self, rhs: FloatArray) -> FloatArray:
        """Solution with the factors that `solve` has left, unchecked."""
        ...


@dataclass
class SuperLUSolver:
    """SuperLU on a matrix whose equations are already numbered in a fill-reducing order.

    Attributes
    ----------
    relative_residual : float
        Largest accepted ``|A x - b| / |b|`` of the symmetric mode (one step of iterative
        refinement is tried first).
    factorisations, fallbacks : int
        Counts of all factorisations, and of those with COLAMD.
    seconds : float
        Time spent in factorisations and solves.
    """

    relative_residual: float = 1e-8
    factorisations: int = field(default=0, init=False)
    fallbacks: int = field(default=0, init=False)
    _stopwatch: Stopwatch = field(default_factory=Stopwatch, init=False, repr=False)
    _factors: Any = field(default=None, init=False, repr=False)

    @property
    def seconds(self) -> float:
        """Time spent in factorisations and solves [s]."""
        return self._stopwatch.seconds

    def solve(self, matrix: csc_matrix, rhs: FloatArray) -> FloatArray:
        """Solution of ``matrix x = rhs``; raises `SingularSystemError`."""
        with self._stopwatch:
            return self._checked(matrix, rhs)

    def solve_again(self, rhs: FloatArray) -> FloatArray:
        """Solution with the factors that `solve` has left, unchecked."""
        return np.asarray(self._factors.solve(rhs))

    def forget(self) -> None:
        """Drop the factors."""
        self._factors = None

    def _checked(self, matrix: csc_matrix, rhs: FloatArray) -> FloatArray:
        self.forget()
        if not (np.isfinite(matrix.data).all() and np.isfinite(rhs).all()):
            raise SingularSystemError("the linear system holds values that are not finite")
        bound = self.relative_residual * np.abs(rhs).max(initial=0.0)
        for ordering, options in (("NATURAL", SYMMETRIC), ("COLAMD", {})):
            self.factorisations += 1
            self.fallbacks += ordering == "COLAMD"
            try:
                factors = splu(matrix, permc_spec=ordering, **options)
            except RuntimeError:
                continue
            x = factors.solve(rhs)
            residual = rhs - matrix @ x
            if not np.abs(residual).max(initial=0.0) <= bound:
                x = x + factors.solve(residual)
                residual = rhs - matrix @ x
            if np.abs(residual).max(initial=0.0) <= bound:
                self._factors = factors
                return np.asarray(x)
        raise SingularSystemError("the linear system is singular to working precision")


@dataclass
class SinglePrecisionSolver:
    """SuperLU in single precision, refined to the accuracy asked for, with the same fallback.

    Large factors are bound by memory traffic, which single precision halves [2]_.

    Attributes
    ----------
    relative_residual : float
        Accepted ``|A x - b| / |b|`` (Euclidean norms) after refinement.
    refinements_max : int
        Allowed refinements, after which the system is factorised in double precision.
    factorisations, fallbacks : int
        Counts of all factorisations, and of those in double precision.
    seconds : float
        Time spent in factorisations and solves.
    """

    relative_residual: float = 1e-6
    refinements_max: int = 6
    fallbacks: int = field(default=0, init=False)
    _count: int = field(default=0, init=False)
    _stopwatch: Stopwatch = field(default_factory=Stopwatch, init=False, repr=False)
    _factors: Any = field(default=None, init=False, repr=False)
    _double: SuperLUSolver = field(default_factory=SuperLUSolver, init=False)

    @property
    def factorisations(self) -> int:
        """Count of all factorisations."""
        return self._count + self._double.factorisations

    @property
    def seconds(self) -> float:
        """Time spent in factorisations and solves [s]."""
        return self._stopwatch.seconds + self._double.seconds

    def solve(self, matrix: csc_matrix, rhs: FloatArray) -> FloatArray:
        """Solution of ``matrix x = rhs``; raises `SingularSystemError`."""
        with self._stopwatch:
            x = self._refined(matrix, rhs)
        if x is not None:
            return x
        self.forget()
        self.fallbacks += 1
        return self._double.solve(matrix, rhs)

    def solve_again(self, rhs: FloatArray) -> FloatArray:
        """Solution with the factors that `solve` has left, unchecked."""
        if self._factors is None:
            return self._double.solve_again(rhs)
        # Scaled, since single precision has a small range.
        size = np.abs(rhs).max(initial=0.0) or 1.0
        return size * self._factors.solve((rhs / size).astype(np.float32)).astype(np.float64)

    def forget(self) -> None:
        """Drop the factors."""
        self._factors = None
        self._double.forget()

    def _refined(self, matrix: csc_matrix, rhs: FloatArray) -> FloatArray | None:
        """Solution with single precision factors; None if they are too rough."""
        self.forget()
        # Values beyond its range, or not finite, are left to double precision to judge.
        if not np.abs(matrix.data).max(initial=0.0) < np.finfo(np.float32).max:
            return None
        self._count += 1
        try:
            single = matrix.astype(np.float32)
            self._factors = splu(single, permc_spec="NATURAL", **SYMMETRIC)
        except RuntimeError:
            return None
        x, _ = conjugate_residuals(
            matrix,
            rhs,
            self.solve_again,
            tolerance=self.relative_residual,
            iterations_max=self.refinements_max,
        )
        return x


@dataclass
class PardisoSolver:
    """Intel MKL Pardiso through pypardiso (the extra `fast`), with the same check and fallback.

    Attributes
    ----------
    relative_residual, factorisations, fallbacks, seconds
        As for `SuperLUSolver`.
    """

    relative_residual: float = 1e-8
    factorisations: int = field(default=0, init=False)
    fallbacks: int = field(default=0, init=False)
    _stopwatch: Stopwatch = field(default_factory=Stopwatch, init=False, repr=False)

    def __post_init__(self) -> None:
        from pypardiso import PyPardisoSolver

        self._pardiso = PyPardisoSolver(mtype=11)
        self._superlu = SuperLUSolver(relative_residual=self.relative_residual)
        self._rows: csr_matrix | None = None

    @property
    def seconds(self) -> float:
        """Time spent in factorisations and solves [s]."""
        return self._stopwatch.seconds

    def solve(self, matrix: csc_matrix, rhs: FloatArray) -> FloatArray:
        """Solution of ``matrix x = rhs``; raises `SingularSystemError`."""
        with self._stopwatch:
            rows = matrix.tocsr()
            rows.sort_indices()
            self.factorisations += 1
            self.forget()
            self._pardiso.factorize(rows)
            x = np.asarray(self._pardiso.solve(rows, rhs))
            bound = self.relative_residual * np.abs(rhs).max(initial=0.0)
            if np.abs(rhs - matrix @ x).max(initial=0.0) <= bound:
                self._rows = rows
                return x
            self.fallbacks += 1
            return self._superlu.solve(matrix, rhs)

    def solve_again(self, rhs: FloatArray) -> FloatArray:
        """Solution with the factors that `solve` has left, unchecked."""
        if self._rows is None:
            return self._superlu.solve_again(rhs)
        return np.asarray(self._pardiso.solve(self._rows, rhs))

    def forget(self) -> None:
        """Drop the factors."""
        self._rows = None
        self._superlu.forget()


def pardiso_available() -> bool:
    """Whether pypardiso is installed."""
    return find_spec("pypardiso") is not None
