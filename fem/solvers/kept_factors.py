"""Solution of the linear systems of Newton's method: a factorisation serves several of them.

Between two Newton iterations of one step few rows of the tangent change much: those of nodes that
change their contact status, and some around the most strained elements. Conjugate residuals,
preconditioned with the factors of an earlier iteration, then need up to ten iterations. Each costs
a solution with existing factors, which is about 1/15 of a factorisation.
"""

from dataclasses import dataclass, field
from typing import Literal

from scipy.sparse import csc_matrix

from fem.solvers.conjugate_residuals import conjugate_residuals
from fem.solvers.direct import (
    DirectSolver,
    LinearSolver,
    PardisoSolver,
    SinglePrecisionSolver,
    SuperLUSolver,
    pardiso_available,
)
from fem.solvers.stopwatch import Stopwatch
from materials.arrays import FloatArray

#: Unknowns from which single precision pays: factorisation and solution take 0.7 times as long with
#: 40,000, as long with 6,000.
SINGLE_PAYS = 12_000


@dataclass
class KeptFactorsSolver:
    """Conjugate residuals preconditioned with the factors of an earlier system, until they age.

    The first system after `forget` is factorised. The tolerance is that of an inexact Newton
    iteration: with 20,000 elements, 1e-3 to 1e-6 took the same Newton iterations within 3 %.

    Attributes
    ----------
    direct : DirectSolver
        Factorises.
    relative_residual : float
        Accepted ``|A x - b| / |b|`` (Euclidean norms) of the iteration.
    iterations_max : int
        Iterations after which the system is factorised instead.
    aged : int
        Factors that took more iterations than this are not used again.
    iterations : int
        Count of all iterations.
    """

    direct: DirectSolver
    relative_residual: float = 1e-4
    iterations_max: int = 14
    aged: int = 10
    iterations: int = field(default=0, init=False)
    _usable: bool = field(default=False, init=False)
    _stopwatch: Stopwatch = field(default_factory=Stopwatch, init=False, repr=False)

    @property
    def factorisations(self) -> int:
        """Count of all factorisations."""
        return self.direct.factorisations

    @property
    def seconds(self) -> float:
        """Time spent in factorisations and solves [s]."""
        return self.direct.seconds + self._stopwatch.seconds

    def forget(self) -> None:
        """Drop the factors."""
        self.direct.forget()
        self._usable = False

    def solve(self, matrix: csc_matrix, rhs: FloatArray) -> FloatArray:
        """Solution of ``matrix x = rhs``; raises `SingularSystemError`."""
        if self._usable:
            with self._stopwatch:
                x = self._iterated(matrix, rhs)
            if x is not None:
                return x
        self._usable = False
        x = self.direct.solve(matrix, rhs)
        self._usable = True
        return x

    def _iterated(self, matrix: csc_matrix, rhs: FloatArray) -> FloatArray | None:
        """Solution with the kept factors; None if it takes too many iterations."""
        x, count = conjugate_residuals(
            matrix,
            rhs,
            self.direct.solve_again,
            tolerance=self.relative_residual,
            iterations_max=self.iterations_max,
        )
        self.iterations += count
        self._usable = count <= self.aged
        return x


def linear_solver(name: Literal["auto", "superlu", "pardiso"], unknowns: int) -> LinearSolver:
    """Solver by name; "auto" is SuperLU.

    With one thread, whole runs with Pardiso spend 2.2 times as long in the solver with 20,000 and
    with 50,000 elements: its solutions with kept factors take three times as long.

    Parameters
    ----------
    name : str
        "auto", "superlu" or "pardiso".
    unknowns : int
        Size of the systems.

    Raises
    ------
    ValueError
        If pardiso is asked for and not installed.
    """
    if name != "pardiso":
        single = unknowns >= SINGLE_PAYS
        return KeptFactorsSolver(SinglePrecisionSolver() if single else SuperLUSolver())
    if not pardiso_available():
        raise ValueError('linear_solver = "pardiso" needs pypardiso: pip install treadfem[fast]')
    return KeptFactorsSolver(PardisoSolver())
