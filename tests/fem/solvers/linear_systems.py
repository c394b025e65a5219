"""Linear systems for the tests of the solvers."""

import numpy as np
from scipy.sparse import diags, random

SIZE = 200


def dominant(size=SIZE, seed=1):
    """Unsymmetric matrix of symmetric pattern with a strong diagonal."""
    rng = np.random.default_rng(seed)
    pattern = random(size, size, 0.02, random_state=rng)
    A = (pattern + pattern.T).tocsc()
    A.data *= rng.uniform(0.5, 1.5, A.nnz)
    return (A + diags(np.full(size, 10.0))).tocsc()


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
