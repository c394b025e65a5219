"""Heat exchange between the moving block and the road at rest.

A contact node of the block is a short piece of surface (half of each contact edge at the node).
While the block moves by a sub-step, this piece passes over the road. The share of road node j in
the exchange is the average of its hat function over all positions of the piece, which is known in
closed form. The shares of a block node sum to one, and the same shares give the road temperature
the node sees and distribute its heat: the transfer is conservative and symmetric.

The heat flow q_i = G_i (T_i - sum_j W_ij T_j) uses the temperatures at the *end* of the sub-step
on both sides. With the linear responses T_block = T_b - R_b q and T_road = T_r + R_r W^T q this is
the symmetric positive system (G^-1 + R_b + W R_r W^T) q = T_b - W T_r, solved by conjugate
gradients with the square root of G as scaling. Its eigenvalues are 1 + O(h sqrt(dt) / e), with the
thermal effusivity e, so a few iterations do for short steps, and it converges where a fixed-point
iteration between the two sides would not (h sqrt(dt) > e). Heat is conserved for any number of
iterations, because both sides receive the same q.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from materials.arrays import FloatArray, IntArray

#: Lengths below this fraction of a road column are treated as points.
POINT_LENGTH = 1e-5


def hat_integral(s: FloatArray) -> FloatArray:
    """Integral of the unit hat function from minus infinity to s [-]."""
    c = np.clip(s, -1.0, 1.0)
    return np.asarray(0.5 + c - 0.5 * c * np.abs(c))


def hat_double_integral(s: FloatArray) -> FloatArray:
    """Integral of `hat_integral` from minus infinity to s [-]."""
    c = np.clip(s, -1.0, 1.0)
    inside = np.where(c < 0.0, (1.0 + c) ** 3 / 6.0, c + (1.0 - c) ** 3 / 6.0)
    return np.asarray(inside + np.maximum(s - 1.0, 0.0))


@dataclass(frozen=True, kw_only=True)
class Passage:
    """Shares of the road nodes in the exchange of each contact node during a sub-step.

    Attributes
    ----------
    columns : (m, w) int array
        Road nodes a contact node can reach, counted from the first one of the window.
    shares : (m, w) float array
        Their shares; each row sums to one [-].
    count : int
        Number of road nodes of the window.
    """

    columns: IntArray
    shares: FloatArray
    count: int

    def seen(self, surface: FloatArray) -> FloatArray:
        """Mean road temperature below each contact node, (m,)."""
        return np.asarray((surface[self.columns] * self.shares).sum(axis=1))

    def distributed(self, heat: FloatArray) -> FloatArray:
        """Heat of the contact nodes (m,) on the road nodes (nc,)."""
        parts = (heat[:, None] * self.shares).ravel()
        return np.bincount(self.columns.ravel(), weights=parts, minlength=self.count).astype(
            np.float64, copy=False
        )


def passage(
    start: FloatArray, end: FloatArray, piece: FloatArray, *, first: int, dx: float, count: int
) -> Passage:
    """Exact averages of the road's hat functions over the moving pieces of contact surface.

    Parameters
    ----------
    start, end : (m,) float array
        Road coordinates of the contact nodes at the start and at the end of the sub-step [mm].
    piece : (m, 2) float array
        Ends of the surface piece of each node relative to the node, left <= 0 <= right [mm].
    first, count : int
        Number of the window's first road node, and number of road nodes.
    dx : float
        Distance of the road nodes [mm].
    """
    if len(start) == 0:
        return Passage(columns=np.zeros((0, 1), np.int64), shares=np.zeros((0, 1)), count=count)
    left = np.minimum(start, end) / dx - first
    sweep = np.abs(end - start) / dx
    low, high = piece[:, 0] / dx, piece[:, 1] / dx
    lowest = np.floor(left + low).astype(np.int64)
    highest = np.ceil(left + sweep + high).astype(np.int64)
    if lowest.min() < 0 or highest.max() >= count:
        raise ValueError(
            f"contact from road node {lowest.min()} to {highest.max()} leaves the road window "
            f"of {count} nodes"
        )
    width = int((highest - lowest).max()) + 1
    lowest = np.minimum(lowest, count - width)
    columns = lowest[:, None] + np.arange(width)
    shares = _average_hats(left[:, None] - columns, sweep, low, high)
    return Passage(columns=columns, shares=shares, count=count)


def _average_hats(
    s: FloatArray, sweep: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """Averages of hats over a piece that moves from s to s + sweep; lengths in columns."""
    sweep, low, high = sweep[:, None], low[:, None], high[:, None]
    sweep = np.where(sweep < POINT_LENGTH, 0.0, sweep)
    piece = np.where(high - low < POINT_LENGTH, 0.0, high - low)
    centre = s + 0.5 * (sweep + low + high)
    long, short = np.maximum(sweep, piece), np.minimum(sweep, piece)
    shares = np.where(
        short > 0.0,
        _second_difference(centre, long, short),
        np.where(long > 0.0, _first_difference(centre, long), np.maximum(1 - np.abs(centre), 0)),
    )
    return np.asarray(shares / shares.sum(axis=1, keepdims=True))


def _first_difference(centre: FloatArray, length: FloatArray) -> FloatArray:
    """Average of the hat over an interval."""
    length = np.maximum(length, POINT_LENGTH)
    upper, lower = centre + 0.5 * length, centre - 0.5 * length
    return np.asarray((hat_integral(upper) - hat_integral(lower)) / length)


def _second_difference(centre: FloatArray, long: FloatArray, short: FloatArray) -> FloatArray:
    """Average of the hat over an interval that moves by another length."""
    long, short = np.maximum(long, POINT_LENGTH), np.maximum(short, POINT_LENGTH)
    outer, inner = 0.5 * (long + short), 0.5 * (long - short)
    theta = hat_double_integral
    difference = theta(centre + outer) - theta(centre + inner) - theta(centre - inner)
    return np.asarray((difference + theta(centre - outer)) / (long * short))


@dataclass(frozen=True, kw_only=True)
class ExchangeResult:
    """Solution of the interface system.

    Attributes
    ----------
    flow : (m,) float array
        Heat flow from the block to the road [mJ/s] per mm depth.
    block_change : (n,) float array, or () when the guess was good enough
        Change of the block temperature relative to the one for the initial guess [K].
    iterations : int
        Iterations used.
    mismatch : float
        Largest |q/G - (T_block - T_road)| left [K].
    """

    flow: FloatArray
    block_change: FloatArray
    iterations: int
    mismatch: float


def solve_exchange(
    flow: FloatArray,
    conductance: FloatArray,
    difference: FloatArray,
    block_response: Callable[[FloatArray], FloatArray],
    difference_response: Callable[[FloatArray, FloatArray], FloatArray],
    *,
    tolerance_K: float,
    iterations_max: int = 200,
) -> ExchangeResult:
    """Heat flow between block and road that fits the temperatures it causes.

    Parameters
    ----------
    flow : (m,) float array
        Initial guess of the flow [mJ/s] per mm depth.
    conductance : (m,) float array
        G = h times tributary length [N/(s K)].
    difference : (m,) float array
        T_block - T_road at the contact nodes for the initial guess [K].
    block_response : callable
        Drop of the whole block temperature caused by a flow, (m,) -> (n,) [K].
    difference_response : callable
        Drop of the difference for a flow and the drop of the block temperature,
        ((m,), (n,)) -> (m,) [K].
    tolerance_K : float
        Allowed mismatch [K].

    Returns
    -------
    ExchangeResult
    """
    root = np.sqrt(conductance)
    active = root > 0.0
    inverse_root = np.where(active, 1.0 / np.where(active, root, 1.0), 0.0)
    flow = np.where(active, flow, 0.0)
    residual = root * difference - inverse_root * flow
    block_change: FloatArray = np.zeros(())
    direction, rho = residual.copy(), float(residual @ residual)
    mismatch = float(np.max(np.abs(inverse_root * residual), initial=0.0))
    iterations = 0
    while mismatch > tolerance_K and iterations < iterations_max:
        drop = block_response(root * direction)
        image = direction + root * difference_response(root * direction, drop)
        step = rho / float(direction @ image)
        flow = flow + step * root * direction
        block_change = block_change - step * drop
        residual = residual - step * image
        rho_n, rho = rho, float(residual @ residual)
        direction = residual + (rho / rho_n) * direction
        mismatch = float(np.max(np.abs(inverse_root * residual)))
        iterations += 1
    return ExchangeResult(
        flow=flow, block_change=block_change, iterations=iterations, mismatch=mismatch
    )
