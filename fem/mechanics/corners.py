"""What keeps the corners of the elements from turning inside out.

Between integration points that are all sound a quadrilateral can fold over one of its corners.
Nearly incompressible rubber could not: it is an error of the discretisation that grows where a
crease or the leading edge bends a few elements beyond all measure, and it ends in a boundary that
is hooked into itself for good. So a corner that has lost most of its area is given the energy

``G V_e/4 beta(j)``, ``beta = ln(j_0/j)^3`` for ``j < j_0``, none above,

with the area j of the triangle at the corner over its reference area. Meshes that resolve the
deformation have j near 1 everywhere, so that the energy is none. Below `SMALLEST` it goes on as its
Taylor polynomial of order two, which lets an iterate come back from beyond. Barriers on areas keep
moving meshes from tangling, too [1]_.

References
----------
.. [1] Escobar, J. M., et al., "Simultaneous untangling and smoothing of tetrahedral meshes",
   Comput. Methods Appl. Mech. Eng. 192 (2003) 2775-2787.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from materials.arrays import FloatArray, IntArray

#: Ratio of the areas at a corner from which on it resists [-].
FIRST = 0.2
#: Ratio below which the energy goes on as a polynomial [-].
SMALLEST = 0.02

_AFTER, _BEFORE = [1, 2, 3, 0], [3, 0, 1, 2]
#: Places a, b, c of the nodes of the triangles at the corners, in the order of the corners.
_ALPHA, _GAMMA = np.zeros((4, 4)), np.zeros((4, 4))
for _a in range(4):
    _ALPHA[_a, [_a, _AFTER[_a]]] = -1.0, 1.0
    _GAMMA[_a, [_a, _BEFORE[_a]]] = -1.0, 1.0
#: Hessians of the corner areas, (corner, i, j, a, b): constant.
_EPSILON = np.array([[0.0, 1.0], [-1.0, 0.0]])
_HESSIANS = np.einsum(
    "ij,cab->cijab",
    _EPSILON,
    np.einsum("ca,cb->cab", _ALPHA, _GAMMA) - np.einsum("ca,cb->cab", _GAMMA, _ALPHA),
)


def corner_areas(x: FloatArray) -> FloatArray:
    """Twice the areas of the triangles at the corners of quadrilaterals `x` (ne, 4, 2) [mm^2]."""
    edge = x[:, _AFTER] - x
    into = edge[:, _BEFORE]
    return np.asarray(into[..., 0] * edge[..., 1] - into[..., 1] * edge[..., 0])


def _area_gradients(x: FloatArray) -> FloatArray:
    """Gradients of `corner_areas` with respect to the corners, (ne, corner, node, 2) [mm]."""
    along = x[:, _AFTER] - x
    back = x[:, _BEFORE] - x
    of_after = np.stack([back[..., 1], -back[..., 0]], axis=-1)
    of_before = np.stack([-along[..., 1], along[..., 0]], axis=-1)
    after, before = np.maximum(_ALPHA, 0.0), np.maximum(_GAMMA, 0.0)
    gradient = of_after[:, :, None] * after[..., None] + of_before[:, :, None] * before[..., None]
    gradient[:, np.arange(4), np.arange(4)] = -of_after - of_before
    return gradient


def barrier(j: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Energy beta of area ratios and its first two derivatives [-]."""
    k = np.clip(j, SMALLEST, FIRST)
    log, below = np.log(FIRST / k), np.minimum(j - SMALLEST, 0.0)
    second = (6.0 * log + 3.0 * log**2) / k**2
    first = -3.0 * log**2 / k
    return (
        log**3 + first * below + 0.5 * second * below**2,
        first + second * below,
        second,
    )


@dataclass(frozen=True, kw_only=True)
class CornerForces:
    """Forces of the elements of which a corner resists.

    Attributes
    ----------
    cells : (k,) int array
        The elements.
    residual : (k, 8) float array
        Forces on their corners, (node, component) interleaved [N/mm].
    gradients : (k, 4, 4, 2) float array
        Gradients of the ratios at the corners [1/mm].
    first, second : (k, 4) float arrays
        Derivatives of the energy with respect to the ratios [N].
    """

    cells: IntArray
    residual: FloatArray
    gradients: FloatArray
    first: FloatArray
    second: FloatArray


class CornerBarrier:
    """Energy of corners that have lost most of their area.

    Parameters
    ----------
    X : (ne, 4, 2) float array
        Reference coordinates of the corners [mm].
    volume : (ne,) float array
        Areas of the elements [mm^2].
    G : float
        Shear modulus [N/mm^2].
    """

    def __init__(self, X: FloatArray, volume: FloatArray, G: float) -> None:
        self._reference = corner_areas(X)
        self._weight = 0.25 * G * volume

    def ratios(self, x: FloatArray) -> FloatArray:
        """Areas at the corners of elements `x` (ne, 4, 2) over those of the reference [-]."""
        return corner_areas(x) / self._reference

    def energy(self, x: FloatArray) -> float:
        """Energy at the current coordinates (ne, 4, 2) [mJ/mm]."""
        return float(np.sum(self._weight[:, None] * barrier(self.ratios(x))[0]))

    def forces(self, x: FloatArray) -> CornerForces | None:
        """Forces at the current coordinates (ne, 4, 2); None where no corner resists."""
        j = self.ratios(x)
        cells = np.flatnonzero((j < FIRST).any(axis=1))
        if cells.size == 0:
            return None
        first, second = (self._weight[cells, None] * d for d in barrier(j[cells])[1:])
        gradients = _area_gradients(x[cells]) / self._reference[cells][:, :, None, None]
        residual = np.einsum("ec,ecai->eai", first, gradients).reshape(-1, 8)
        return CornerForces(
            cells=cells, residual=residual, gradients=gradients, first=first, second=second
        )

    def tangent(self, forces: CornerForces) -> FloatArray:
        """Derivative of the forces, (k, 2, 2, 4, 4) as `Q1P0Elements.tangent` [N/mm^2]."""
        of_area = forces.first / self._reference[forces.cells]
        K = np.einsum("ec,cijab->eijab", of_area, _HESSIANS)
        g = forces.gradients
        return K + np.einsum("ec,ecai,ecbj->eijab", forces.second, g, g, optimize=True)
