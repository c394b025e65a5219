"""Heat conduction in the deformed block, written on its reference mesh.

The balance rho c dT/dt = div(k grad T) holds in the deformed block. Pulled back to the reference
mesh it reads rho_0 c dT/dt = Div(k J F^-1 F^-T Grad T), with the reference density rho_0 [1]_:
the capacity stays constant and only the conductivity follows the deformation.

Bilinear quadrilaterals with nodal quadrature (2 x 2 trapezoidal rule). The rule keeps the order of
the element and makes the capacity diagonal; on rectangles the conduction matrix becomes the
five-point difference scheme, an M-matrix for any aspect ratio. Heat that enters at one surface
node then never cools its neighbours, which Gauss quadrature does by a quarter of the temperature
rise on the flat cells along a contact surface.

References
----------
.. [1] J. Bonet, R. D. Wood: Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed.,
   Cambridge University Press, 2008 (Piola transformation of a flux vector).
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix
from scipy.sparse.linalg import SuperLU, splu
from skfem import Basis, ElementQuad1

from fem.mesh import BlockMesh
from fem.solvers import SYMMETRIC, Stopwatch
from materials.arrays import FloatArray
from materials.thermal import ThermalProperties

#: Nodal quadrature of the unit square: points (2, 4) and weights (4,).
NODAL_RULE = (
    np.array([[0.0, 1.0, 1.0, 0.0], [0.0, 0.0, 1.0, 1.0]]),
    np.full(4, 0.25),
)

#: Volume ratio below which the deformation of a corner is replaced by the mean one of its cell.
#: In the crease of the rolled-up edge a corner may be crushed, or even turned over, while the cell
#: keeps its volume; its own pull-back, with 1/J, would make it conduct like a metal. If the cell
#: as a whole is crushed as well, its J is bounded by the same number. (Strongly sheared cells have
#: no M-matrix: one to three nodes in the crease were seen to cool by 2 % of the largest rise.)
SMALLEST_VOLUME_RATIO = 0.2


def relative_change(new: FloatArray, old: FloatArray) -> float:
    """Largest change of a pull-back conductivity relative to its own norm at a point [-].

    Parameters
    ----------
    new, old : (3, ne, 4) float array
        Components XX, YY, XY [N/(s K)].
    """
    XX, YY, XY = new - old
    change = XX**2 + YY**2 + 2.0 * XY**2
    size = old[0] ** 2 + old[1] ** 2 + 2.0 * old[2] ** 2
    return float(np.sqrt(np.max(change / size)))


@dataclass(frozen=True, kw_only=True)
class Factorisation:
    """Factor of M + dt K for one displacement field and one time increment.

    Attributes
    ----------
    displacement : (n, 2) float array
        Nodal displacement whose conduction matrix was factored [mm].
    dt : float
        Time increment [s].
    factor : scipy.sparse.linalg.SuperLU
        Factor of the symmetric matrix.
    """

    displacement: FloatArray
    dt: float
    factor: SuperLU


class BlockConduction:
    """Capacity and conduction matrix of the block.

    Parameters
    ----------
    mesh : BlockMesh
        Reference mesh [mm].
    rubber : ThermalProperties
        Conductivity, density and specific heat in internal units.
    smallest_volume_ratio : float, optional
        See `SMALLEST_VOLUME_RATIO` [-].
    """

    def __init__(
        self,
        mesh: BlockMesh,
        rubber: ThermalProperties,
        *,
        smallest_volume_ratio: float = SMALLEST_VOLUME_RATIO,
    ) -> None:
        basis = Basis(mesh.mesh, ElementQuad1(), quadrature=NODAL_RULE)
        self.mesh = mesh
        self.rubber = rubber
        self.smallest_volume_ratio = smallest_volume_ratio
        # (element, point, node, direction), contiguous for the matrix products below
        gradients = np.array([basis.basis[a][0].grad for a in range(4)])
        self.shape_gradients = np.ascontiguousarray(gradients.transpose(2, 3, 0, 1))
        self.weights = np.asarray(basis.dx)
        self.cells = np.asarray(mesh.cells, dtype=np.int64)
        self.n = len(mesh.points)
        self.capacity = self._lumped_capacity(basis)
        self._prepare_pattern()
        self._prepare_gradient()
        #: Time spent in factorisations and solves.
        self.stopwatch = Stopwatch()

    def _lumped_capacity(self, basis: Basis) -> FloatArray:
        """Heat capacity of each node per mm depth, (n,) [mJ/K]."""
        shares = np.array(
            [np.sum(np.asarray(basis.basis[a][0]) * basis.dx, axis=1) for a in range(4)]
        )
        volume = np.bincount(self.cells.ravel(), weights=shares.T.ravel(), minlength=self.n)
        return np.asarray(self.rubber.heat_capacity * volume, dtype=np.float64)

    def _prepare_pattern(self) -> None:
        """Store where each entry of the element matrices goes in the sparse matrix."""
        rows = np.repeat(self.cells, 4, axis=1).ravel()
        columns = np.tile(self.cells, (1, 4)).ravel()
        keys, self._slot = np.unique(columns * self.n + rows, return_inverse=True)
        self._indices = (keys % self.n).astype(np.int32)
        self._indptr = np.searchsorted(keys // self.n, np.arange(self.n + 1)).astype(np.int32)
        diagonal = np.arange(self.n, dtype=np.int64) * (self.n + 1)
        self._diagonal = np.searchsorted(keys, diagonal)

    def _prepare_gradient(self) -> None:
        """Sparse operator from nodal values to their gradient at the points of the rule."""
        elements, points, _, directions = self.shape_gradients.shape
        values = self.shape_gradients.transpose(0, 1, 3, 2).reshape(elements, -1)
        columns = np.tile(self.cells, (1, points * directions))
        rows = np.repeat(np.arange(elements * points * directions), 4)
        gradient = csr_matrix(
            (values.ravel(), (rows, columns.ravel())),
            shape=(elements * points * directions, self.n),
        )
        gradient.eliminate_zeros()
        self._gradient = gradient

    def inverse_deformation(self, displacement: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Adjugate of F (so that F^-1 = adj F / J) and J at the points of the nodal rule.

        Parameters
        ----------
        displacement : (n, 2) float array [mm]

        Returns
        -------
        adjugate : (ne, 4, 2, 2) float array [-]
        J : (ne, 4) float array [-], not bounded
        """
        grad_u = (self._gradient @ displacement).reshape(len(self.cells), 4, 2, 2)
        adjugate = np.empty_like(grad_u)
        # grad_u[..., j, i] = du_i/dX_j
        adjugate[..., 0, 0] = 1.0 + grad_u[..., 1, 1]
        adjugate[..., 1, 1] = 1.0 + grad_u[..., 0, 0]
        adjugate[..., 0, 1] = -grad_u[..., 1, 0]
        adjugate[..., 1, 0] = -grad_u[..., 0, 1]
        J = adjugate[..., 0, 0] * adjugate[..., 1, 1] - adjugate[..., 0, 1] * adjugate[..., 1, 0]
        return adjugate, J

    def regular_deformation(self, displacement: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Adjugate of F and J > 0, with crushed corners replaced by the mean of their cell."""
        adjugate, J = self.inverse_deformation(displacement)
        cell, corner = np.nonzero(self.smallest_volume_ratio > J)
        if len(cell):
            mean = adjugate[cell].mean(axis=1)  # linear in F, so it belongs to the mean of F
            J_mean = mean[:, 0, 0] * mean[:, 1, 1] - mean[:, 0, 1] * mean[:, 1, 0]
            adjugate[cell, corner] = mean
            J[cell, corner] = np.maximum(J_mean, self.smallest_volume_ratio)
        return adjugate, J

    def conductivity(self, displacement: FloatArray) -> FloatArray:
        """Pull-back k J F^-1 F^-T at the points of the nodal rule.

        Parameters
        ----------
        displacement : (n, 2) float array [mm]

        Returns
        -------
        (3, ne, 4) float array [N/(s K)]
            Components XX, YY, XY of the tensor. It is symmetric and positive for any
            displacement.
        """
        A, J = self.regular_deformation(displacement)
        scale = self.rubber.conductivity / J
        XX = A[..., 0, 0] ** 2 + A[..., 0, 1] ** 2
        YY = A[..., 1, 0] ** 2 + A[..., 1, 1] ** 2
        XY = A[..., 0, 0] * A[..., 1, 0] + A[..., 0, 1] * A[..., 1, 1]
        return np.array([XX, YY, XY]) * scale

    def element_matrices(self, displacement: FloatArray) -> FloatArray:
        """Conduction matrix of each cell, (ne, 4, 4) [N/(s K)] per mm depth."""
        adjugate, J = self.regular_deformation(displacement)
        scale = np.sqrt(self.rubber.conductivity * self.weights / J)
        spatial = np.matmul(self.shape_gradients * scale[..., None, None], adjugate)
        flat = spatial.transpose(0, 2, 1, 3).reshape(len(self.cells), 4, 8)
        return np.asarray(flat @ flat.swapaxes(1, 2))

    def conduction_matrix(self, displacement: FloatArray) -> csc_matrix:
        """Conduction matrix K of the deformed block, n x n [N/(s K)] per mm depth."""
        entries = self.element_matrices(displacement).ravel()
        data = np.bincount(self._slot, weights=entries, minlength=len(self._indices))
        return csc_matrix((data, self._indices, self._indptr), shape=(self.n, self.n))

    def factorise(
        self, displacement: FloatArray, dt: float, film: FloatArray | None = None
    ) -> Factorisation:
        """Factor M + dt K for the deformed block and a time increment [s].

        A `film` (n,) [N/(s K)] to surroundings at the temperature that excess counts from is added.
        """
        matrix = self.conduction_matrix(displacement)
        matrix.data *= dt
        matrix.data[self._diagonal] += self.capacity if film is None else self.capacity + dt * film
        with self.stopwatch:
            factor = splu(matrix, permc_spec="MMD_AT_PLUS_A", **SYMMETRIC)
        return Factorisation(displacement=displacement, dt=dt, factor=factor)

    def solve(self, factorisation: Factorisation, rhs: FloatArray) -> FloatArray:
        """Solution of a factored system."""
        with self.stopwatch:
            return np.asarray(factorisation.factor.solve(rhs))

    def heat_content(self, T: FloatArray, T_0_C: float) -> float:
        """Heat stored above a reference temperature per mm depth [mJ/mm]."""
        return float(self.capacity @ (T - T_0_C))
