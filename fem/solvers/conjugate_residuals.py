"""Generalised conjugate residuals [1]_, in exact arithmetic the iterates of GMRES [2]_.

References
----------
.. [1] Eisenstat, S. C., Elman, H. C., Schultz, M. H., SIAM J. Numer. Anal. 20 (1983) 345-357.
.. [2] Saad, Y., Schultz, M. H., SIAM J. Sci. Stat. Comput. 7 (1986) 856-869.
"""

from collections.abc import Callable

import numpy as np
from scipy.linalg import solve_triangular
from scipy.sparse import csc_matrix

from materials.arrays import FloatArray


def conjugate_residuals(
    matrix: csc_matrix,
    rhs: FloatArray,
    approximately: Callable[[FloatArray], FloatArray],
    *,
    tolerance: float,
    iterations_max: int,
) -> tuple[FloatArray | None, int]:
    """Solve ``matrix x = rhs`` by generalised conjugate residuals.

    Each iteration adds the approximate solution for the present residual to the space in which
    the residual is made smallest.

    Parameters
    ----------
    matrix : sparse matrix
        Matrix A, (n, n).
    rhs : (n,) float array
        Right-hand side b.
    approximately : callable
        Approximate solution of the system for a given right-hand side (the preconditioner).
    tolerance : float
        Accepted ``|A x - b| / |b|`` (Euclidean norms).
    iterations_max : int
        Allowed iterations.

    Returns
    -------
    (n,) float array or None
        Solution; None if there is none within the allowed iterations.
    int
        Iterations made.
    """
    Z, Q = np.empty((2, iterations_max, rhs.size))
    R, c = np.zeros((iterations_max, iterations_max)), np.zeros(iterations_max)
    r, bound = rhs.copy(), tolerance * np.linalg.norm(rhs)
    for k in range(iterations_max):
        Z[k] = approximately(r)
        w = matrix @ Z[k]
        R[:k, k] = Q[:k] @ w
        w -= R[:k, k] @ Q[:k]
        R[k, k] = np.linalg.norm(w)
        if not R[k, k] > 0.0:
            return None, k + 1
        Q[k] = w / R[k, k]
        c[k] = Q[k] @ r
        r -= c[k] * Q[k]
        if np.linalg.norm(r) <= bound:
            return solve_triangular(R[: k + 1, : k + 1], c[: k + 1]) @ Z[: k + 1], k + 1
    return None, iterations_max
