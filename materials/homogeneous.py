"""Histories of homogeneous incompressible tests of rubber that remembers."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import FloatArray
from materials.hyperelastic_base import MODES, TRANSVERSE, Hyperelastic, Mode, checked_stretch
from materials.maxwell import dissipated_share, step_weights
from materials.prony import Prony
from materials.softening import OgdenRoxburgh


@dataclass(frozen=True, kw_only=True)
class HomogeneousTest:
    """History of a homogeneous test, arrays (n,).

    Attributes
    ----------
    nominal_stress : ndarray
        Force per undeformed area, in each of the pulled directions [N/mm^2].
    stored, viscous, damage : ndarray
        Energy per volume that is stored, dissipated by the branches and consumed by softening
        since the start [N/mm^2].
    eta : ndarray
        Factor of softening on the elastic stress [-].
    """

    nominal_stress: FloatArray
    stored: FloatArray
    viscous: FloatArray
    damage: FloatArray
    eta: FloatArray


def homogeneous_test(
    elastic: Hyperelastic,
    viscous: Prony | None,
    damage: OgdenRoxburgh | None,
    *,
    time_s: ArrayLike,
    stretch: ArrayLike,
    mode: Mode,
    T_C: ArrayLike | None,
) -> HomogeneousTest:
    """History of a homogeneous test (see `materials.rubber.Rubber.nominal_stress`)."""
    time, lam = _rows(time_s, stretch)
    factor = viscous.slow_share if viscous else 1.0
    stress = factor * elastic.nominal_stress(lam, mode)
    stored = W = factor * elastic.strain_energy(lam, mode)
    consumed, lost, eta = np.zeros_like(lam), np.zeros_like(lam), np.ones_like(lam)
    if damage is not None:
        largest = np.maximum.accumulate(W)
        eta = damage.factor(W, largest)[0]
        stress, stored = eta * stress, damage.recoverable(W, largest)
        consumed = damage.consumed(largest)
    if viscous is not None:
        h = reduced_steps(viscous, time, T_C)
        G = elastic.initial_shear_modulus * np.asarray(viscous.g)
        branch = branch_histories(h, lam, mode)
        stress = stress + branch.stress @ G
        stored, lost = stored + branch.stored @ G, branch.dissipated @ G
    elif T_C is not None:
        raise ValueError("T_C is given; expected none for rubber without viscous branches")
    return HomogeneousTest(
        nominal_stress=stress, stored=stored, viscous=lost, damage=consumed, eta=eta
    )


def reduced_steps(viscous: Prony, time: FloatArray, T_C: ArrayLike | None) -> FloatArray:
    """Reduced lengths ``h = integral of dt/(a_T tau)`` of the steps to each row, (n, branches)."""
    if T_C is not None and viscous.shift is None:
        raise ValueError("T_C is given; expected none for branches without a shift")
    rate = np.broadcast_to(1.0 / viscous.shift_factor(T_C), time.shape)
    pace = np.concatenate([[0.0], 0.5 * (rate[1:] + rate[:-1]) * np.diff(time)])
    return np.asarray(pace[:, None] / np.asarray(viscous.tau_s))


@dataclass(frozen=True, kw_only=True)
class BranchHistories:
    """Histories of branches of modulus 1 in a homogeneous test, arrays (n, branches).

    Attributes
    ----------
    stress : ndarray
        Nominal stress [-].
    stored, dissipated : ndarray
        Energy stored and dissipated since the start [-].
    """

    stress: FloatArray
    stored: FloatArray
    dissipated: FloatArray


def branch_histories(h: FloatArray, lam: FloatArray, mode: Mode) -> BranchHistories:
    """Branches of modulus 1 in a homogeneous test.

    Parameters
    ----------
    h : ndarray, shape (n, branches)
        Reduced length of the step to each row; that to the first is not used.
    lam : ndarray, shape (n,)
        Stretch in the loading direction [-].

    Notes
    -----
    What a branch does does not depend on its modulus, so that a fit of the moduli is linear.
    """
    X = _squared_stretches(lam, mode)
    Ci = np.ones((3, h.shape[1]))
    M = np.empty((len(lam), *Ci.shape))
    M[0] = X[0][:, None] / Ci
    for i in range(1, len(lam)):
        old, k_n, k = step_weights(h[i], M[i - 1].mean(axis=0))
        A = old * Ci + k_n * X[i - 1][:, None] + k * X[i][:, None]
        Ci = A / np.cbrt(A[0] * A[1] * A[2])
        M[i] = X[i][:, None] / Ci
    traces = M.sum(axis=1)
    e = M - traces[:, None] / 3.0
    inner = np.zeros((3, *h.shape))
    inner[0, 1:] = np.sum(e[:-1] * e[:-1], axis=1)
    inner[1, 1:] = np.sum(e[:-1] * e[1:], axis=1)
    inner[2, 1:] = np.sum(e[1:] * e[1:], axis=1)
    lost = np.zeros_like(h)
    lost[1:] = 0.5 * dissipated_share(h[1:], *inner[:, 1:])
    return BranchHistories(
        stress=(M[:, 0] - M[:, 2]) / lam[:, None],
        stored=0.5 * (traces - 3.0),
        dissipated=np.cumsum(lost, axis=0),
    )


def _squared_stretches(lam: FloatArray, mode: Mode) -> FloatArray:
    """Squared principal stretches (n, 3), the free direction last."""
    if mode not in TRANSVERSE:
        raise ValueError(f"mode is {mode!r}; expected one of {', '.join(MODES)}")
    free = lam ** -TRANSVERSE[mode]
    return np.stack([lam, 1.0 / (lam * free), free], axis=1) ** 2


def _rows(time_s: ArrayLike, stretch: ArrayLike) -> tuple[FloatArray, FloatArray]:
    time, lam = np.atleast_1d(np.asarray(time_s, dtype=float)), checked_stretch(stretch)
    lam = np.atleast_1d(lam)
    if time.ndim != 1 or time.shape != lam.shape:
        raise ValueError(
            f"time_s has the shape {time.shape} and stretch {lam.shape}; expected one row each"
        )
    if not np.all(np.isfinite(time)) or not np.all(np.isfinite(lam)):
        raise ValueError("time_s or stretch holds nan or inf; expected finite numbers")
    falling = np.flatnonzero(np.diff(time) < 0.0)
    if falling.size:
        i = int(falling[0]) + 1
        raise ValueError(
            f"time_s falls from {time[i - 1]:g} to {time[i]:g} at entry {i + 1}; "
            "expected times that do not fall"
        )
    return time, lam
