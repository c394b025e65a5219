"""Q1P0 elements of nearly incompressible rubber in plane strain: residual and tangent.

The isochoric energy is integrated with 2 x 2 points; the volumetric energy K/2 (Jbar - 1)^2 uses
the mean dilatation ``Jbar = v_e/V_e`` of the element [1]_. The element pressure ``p`` is an
unknown of its own, condensed on the element and updated with the *linearised* pressure law [2]_:
the geometric stiffness then does not see the large spurious pressures of an intermediate iterate.

All kernels run over all elements at once. With ``G_a`` the reference gradients of the shape
functions, the tangent is ``K_aibj = sum_q w A_imjn G_am G_bn`` with ``A = dP/dF``. The products
``G_am G_bn`` never change, so the whole sum is one small matrix product per element.

References
----------
.. [1] Simo, J. C., Taylor, R. L., Pister, K. S., Comput. Methods Appl. Mech. Eng. 51 (1985)
   177-208.
.. [2] Simo, J. C., Taylor, R. L., Comput. Methods Appl. Mech. Eng. 85 (1991) 273-310.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from skfem import Basis, ElementQuad1, ElementVector

from fem.mechanics.corners import CornerBarrier, CornerForces
from fem.mechanics.kinematics import Kinematics, area_gradient
from fem.mesh import BlockMesh
from fem.solvers import summed
from materials.arrays import FloatArray, IntArray
from materials.material import (
    EnergyDerivatives,
    InPlane,
    Material,
    MaterialStep,
    Response,
    Stiffness,
)
from materials.plane_strain import cauchy_stress

#: Elements whose tangents are computed at once, so that intermediate arrays stay in the cache.
BATCH = 1024


@dataclass(frozen=True, kw_only=True)
class Viscosity:
    """Kelvin-Voigt term of one time step: ``S = eta (E - E_n)/dt``.

    Attributes
    ----------
    rate : float or (ne, 1) float array
        eta/dt [N/mm^2].
    strain_n : InPlane of (ne, 4) arrays
        Green-Lagrange strains at the last accepted step.
    """

    rate: float | FloatArray
    strain_n: InPlane

    def stress(self, kinematics: Kinematics) -> InPlane:
        """Viscous second Piola-Kirchhoff stresses [N/mm^2]."""
        pairs = zip(kinematics.green_lagrange, self.strain_n, strict=True)
        return InPlane(*(self.rate * (E - E_n) for E, E_n in pairs))


@dataclass(frozen=True, kw_only=True)
class Past:
    """What the elements know of the last accepted step.

    Attributes
    ----------
    viscosity : Viscosity or None
        Kelvin-Voigt term of the step.
    material : MaterialStep or None
        The material in the step, points (ne, 4); None: in no time, from its virgin state.
    """

    viscosity: Viscosity | None = None
    material: MaterialStep | None = None


@dataclass(frozen=True, kw_only=True)
class ElementForces:
    """Nodal forces of the elements and what the tangent reuses.

    Attributes
    ----------
    residual : (ne, 8) float array
        Internal forces of each element, dofs (node, component) interleaved [N/mm].
    pressure_residual : (ne,) float array
        ``U'(Jbar) - p`` [N/mm^2].
    response : Response
        Of the material at the Gauss points.
    S : InPlane or None
        Second Piola-Kirchhoff stresses besides those of the invariants [N/mm^2].
    past : Past
        What the step began from.
    corners : CornerForces or None
        Of the elements of which a corner resists, in `residual`.
    """

    residual: FloatArray
    pressure_residual: FloatArray
    kinematics: Kinematics
    response: Response
    S: InPlane | None
    pressure: FloatArray
    past: Past
    corners: CornerForces | None


#: No viscosity, and the virgin material.
NO_PAST = Past()


class Q1P0Elements:
    """Vectorised Q1P0 kernel on one mesh and one material.

    Parameters
    ----------
    mesh : BlockMesh
        Reference mesh.
    model : Material
        Isochoric energy, or a material with a state.
    K_bulk : float
        Bulk modulus [N/mm^2].
    """

    def __init__(self, mesh: BlockMesh, model: Material, K_bulk: float) -> None:
        self.mesh, self.model, self.K_bulk = mesh, model, K_bulk
        self.basis = Basis(mesh.mesh, ElementVector(ElementQuad1()), intorder=3)
        scalar = self.basis.with_element(ElementQuad1())
        gradients = np.stack([scalar.basis[a][0].grad for a in range(4)])  # (a, I, ne, q)
        self.weights = np.ascontiguousarray(scalar.dx)
        self._shapes = np.array([np.asarray(scalar.basis[a][0])[0] for a in range(4)])  # (a, q)
        self.G = np.ascontiguousarray(gradients.transpose(2, 3, 0, 1))  # (ne, q, a, I)
        self._G_flat = np.ascontiguousarray(gradients.transpose(2, 0, 3, 1)).reshape(-1, 4, 8)
        self._GG = np.einsum("eqaI,eqbJ->eqIJab", self.G, self.G).reshape(-1, 16, 16)
        self.volume = self.weights.sum(axis=1)
        self.cells = mesh.cells
        self._X = mesh.points[mesh.cells]
        self.corners = CornerBarrier(self._X, self.volume, model.initial_shear_modulus)

    @cached_property
    def dofs(self) -> IntArray:
        """Global dofs (2 node + component) of the elements, (ne, 8)."""
        return (2 * self.cells[:, :, None] + np.arange(2)).reshape(-1, 8)

    def kinematics(self, u: FloatArray) -> Kinematics:
        """Deformation of the nodal displacements `u` (n, 2) [mm]."""
        u_e = u[self.cells]
        H = np.matmul(u_e.transpose(0, 2, 1), self._G_flat)  # (ne, i, (q, I))
        H = H.reshape(-1, 2, 4, 2)
        x = self._X + u_e
        b = area_gradient(x)
        area = 0.5 * np.einsum("eai,eai->e", b, x)
        return Kinematics(
            F11=1.0 + H[:, 0, :, 0],
            F12=H[:, 0, :, 1].copy(),
            F21=H[:, 1, :, 0].copy(),
            F22=1.0 + H[:, 1, :, 1],
            Jbar=area / self.volume,
            area_gradient=b,
            x=x,
        )

    def largest_gradient(self, u: FloatArray) -> float:
        """Largest norm of the gradient of nodal displacements `u` (n, 2) at a Gauss point [-]."""
        H = np.matmul(u[self.cells].transpose(0, 2, 1), self._G_flat)  # (ne, i, (q, I))
        squares = H[:, 0] ** 2 + H[:, 1] ** 2
        return float(np.sqrt((squares[:, ::2] + squares[:, 1::2]).max()))

    def admissible(self, kinematics: Kinematics) -> bool:
        """Whether the energy exists at every Gauss point."""
        return bool(self.model.admissible(kinematics.I1, kinematics.J).all())

    @cached_property
    def virgin(self) -> FloatArray | None:
        """State of the material before the first step, (k, ne, 4); None where it has none."""
        return self.model.virgin(self.weights.shape)

    def material(self, past: Past) -> MaterialStep:
        """The material in a step."""
        return past.material or self._at_rest

    @cached_property
    def _at_rest(self) -> MaterialStep:
        return self.model.step(self.virgin, 0.0, None)

    def forces(self, p: FloatArray, kin: Kinematics, past: Past = NO_PAST) -> ElementForces:
        """Internal nodal forces at kinematics `kin` and element pressures `p` (ne,)."""
        response = self.material(past).respond(kin)
        S = response.S
        if past.viscosity is not None:
            viscous = past.viscosity.stress(kin)
            S = viscous if S is None else InPlane(*map(np.add, S, viscous))
        P = _first_piola_kirchhoff(kin, response.energy, S, self.weights)
        P_flat = P.transpose(0, 1, 3, 2).reshape(-1, 8, 2)
        residual = np.matmul(self._G_flat, P_flat).reshape(-1, 8)
        b = kin.area_gradient.reshape(-1, 8)
        dU_dJ = self.K_bulk * (kin.Jbar - 1.0)
        residual += dU_dJ[:, None] * b
        corners = self.corners.forces(kin.x)
        if corners is not None:
            residual[corners.cells] += corners.residual
        return ElementForces(
            residual=residual,
            pressure_residual=dU_dJ - p,
            kinematics=kin,
            response=response,
            S=S,
            pressure=p,
            past=past,
            corners=corners,
        )

    def tangent(self, forces: ElementForces) -> FloatArray:
        """Element tangents with the condensed pressure [N/mm^2].

        Returns
        -------
        (ne, 2, 2, 4, 4) float array
            Entry ``[e, i, j, a, b]`` is the change of the force on node a along i with the
            displacement of node b along j; see `tangent_entries` for its place in a matrix.
        """
        K = np.empty((len(self.cells), 2, 2, 4, 4))
        for start in range(0, len(K), BATCH):
            cells = slice(start, start + BATCH)
            kin, w = forces.kinematics.part(cells), self.weights[cells]
            energy = EnergyDerivatives(*(W[cells] for W in forces.response.energy))
            A = _weighted_stiffness(kin, energy, w, forces.pressure[cells])
            if forces.S is not None:
                S = InPlane(*(w * component[cells] for component in forces.S))
                D = self._stiffness(kin, forces, cells)
                _add_second_stress(A, kin, S, Stiffness(*(w * component for component in D)))
            A[:, 2] = A[:, 1]
            np.matmul(A.reshape(-1, 4, 16), self._GG[cells], out=K[cells].reshape(-1, 4, 16))
            K[cells, 1, 0] = K[cells, 0, 1].transpose(0, 2, 1)
            b = kin.area_gradient.transpose(0, 2, 1)
            c = b * (self.K_bulk / self.volume[cells])[:, None, None]
            K[cells] += c[:, :, None, :, None] * b[:, None, :, None, :]
        if forces.corners is not None:
            K[forces.corners.cells] += self.corners.tangent(forces.corners)
        return K

    def _stiffness(
        self, kin: Kinematics, forces: ElementForces, cells: slice
    ) -> Iterator[FloatArray]:
        """Tangent of the stresses S of some of the elements, in the order of `Stiffness`."""
        parts, past = [], forces.past
        if past.viscosity is not None:
            rate = np.broadcast_to(past.viscosity.rate, (len(self.cells), 1))[cells]
            parts.append(Stiffness(rate, rate, 0.5 * rate, *3 * [np.zeros(1)]))
        D = self.material(past).stiffness(kin, forces.response, cells)
        parts += [] if D is None else [D]
        return (sum(components) for components in zip(*parts, strict=True))

    def pressure_increment(self, forces: ElementForces, du: FloatArray) -> FloatArray:
        """Change of the element pressures with `du` (n, 2) by the linearised pressure law."""
        du_e = du[self.cells].reshape(-1, 8)
        b = forces.kinematics.area_gradient.reshape(-1, 8)
        growth = np.einsum("ej,ej->e", b, du_e)
        return self.K_bulk / self.volume * growth + forces.pressure_residual

    def strain_energy(self, kin: Kinematics, stored: FloatArray) -> float:
        """Stored energy per depth [mJ/mm] with that of the material (ne, 4) [N/mm^2]."""
        volumetric = 0.5 * self.K_bulk * (kin.Jbar - 1.0) ** 2
        bulk = float(np.sum(self.volume * volumetric))
        return self.integral(stored) + bulk + self.corners.energy(kin.x)

    def integral(self, density: FloatArray | None) -> float:
        """Integral over the block of a density (ne, 4) per reference volume; 0 of None."""
        return 0.0 if density is None else float(np.sum(self.weights * density))

    def mean(self, density: FloatArray) -> FloatArray:
        """Means of a density (ne, 4) over the elements, (ne,)."""
        return np.asarray(np.sum(self.weights * density, axis=1) / self.volume)

    def nodal_integral(self, density: FloatArray) -> FloatArray:
        """Integrals over the block of a density (ne, 4) times the shape functions, (n,)."""
        parts = (self.weights * density) @ self._shapes.T
        n = len(self.mesh.points)
        return summed(self.cells.ravel(), parts.ravel(), n)

    def cauchy(self, kin: Kinematics, past: Past = NO_PAST) -> FloatArray:
        """Volume-averaged Cauchy stresses xx, yy, zz, xy of the cells, (ne, 4) [N/mm^2]."""
        response = self.material(past).respond(kin)
        P = _first_piola_kirchhoff(kin, response.energy, response.S, 1.0)
        sigma = cauchy_stress(P, kin.matrix, (self.K_bulk * (kin.Jbar - 1.0))[:, None])
        share = self.weights / self.volume[:, None]
        return np.asarray(np.einsum("eqc,eq->ec", sigma, share))

    def largest_stretch(self, kin: Kinematics) -> FloatArray:
        """Largest principal stretch in the plane, mean of the Gauss points, (ne,) [-]."""
        half_sum = 0.5 * (kin.I1 - 1.0)
        root = np.sqrt(np.maximum(half_sum**2 - kin.J**2, 0.0))
        share = self.weights / self.volume[:, None]
        return np.asarray(np.sum(share * np.sqrt(half_sum + root), axis=1))


def _first_piola_kirchhoff(
    kin: Kinematics, energy: EnergyDerivatives, S: InPlane | None, w: FloatArray | float
) -> FloatArray:
    """``w P = w F (2 W_1 I + S) + w W_J cof F``, (ne, 4, 2, 2)."""
    A11 = 2.0 * w * energy.W_1
    A22, A12 = A11, np.zeros_like(A11)
    if S is not None:
        A11, A22, A12 = A11 + w * S.xx, A22 + w * S.yy, w * S.xy
    c = w * energy.W_J
    P = np.empty((*kin.J.shape, 2, 2))
    P[..., 0, 0] = kin.F11 * A11 + kin.F12 * A12 + c * kin.F22
    P[..., 0, 1] = kin.F11 * A12 + kin.F12 * A22 - c * kin.F21
    P[..., 1, 0] = kin.F21 * A11 + kin.F22 * A12 - c * kin.F12
    P[..., 1, 1] = kin.F21 * A12 + kin.F22 * A22 + c * kin.F11
    return P


#: Rows of the stiffness and the components i, j of the force and the displacement they are for.
#: The row 21 repeats 12; what it leads to is the transpose of that.
_ROWS = ((0, 0, 0), (1, 0, 1), (3, 1, 1))


def _weighted_stiffness(
    kin: Kinematics, d: EnergyDerivatives, w: FloatArray, pressure: FloatArray
) -> FloatArray:
    """Weighted dP_im/dF_jn of the energy as (ne, 4, 4, 4): rows ij = 11, 12, 21, 22, (q, m, n).

    The row 21 is left out. The element pressure acts on the Hessian of the area, which is the
    integral of that of J.
    """
    F = ((kin.F11, kin.F12), (kin.F21, kin.F22))
    cof = ((kin.F22, -kin.F21), (-kin.F12, kin.F11))
    w_11, w_1J, w_JJ = 4.0 * w * d.W_11, 2.0 * w * d.W_1J, w * d.W_JJ
    w_J, w_1 = w * (d.W_J + pressure[:, None]), 2.0 * w * d.W_1
    A = np.empty((len(w), 4, 4, 4))
    for row, i, j in _ROWS:
        left = [w_11 * F[i][m] + w_1J * cof[i][m] for m in (0, 1)]
        right = [w_1J * F[i][m] + w_JJ * cof[i][m] for m in (0, 1)]
        for m, n in ((0, 0), (0, 1), (1, 0), (1, 1)):
            if i == j and m > n:  # symmetric
                A[:, row, :, 2 * m + n] = A[:, row, :, 2 * n + m]
                continue
            value = left[m] * F[j][n] + right[m] * cof[j][n]
            if i == j and m == n:
                value += w_1
            elif i != j and m != n:
                value += w_J if m < n else -w_J
            A[:, row, :, 2 * m + n] = value
    return A


def _add_second_stress(A: FloatArray, kin: Kinematics, S: InPlane, D: Stiffness) -> None:
    """Add ``delta_ij S_mn + F_ik D_mkln F_jl`` to the rows of a stiffness, both weighted."""
    F = ((kin.F11, kin.F12), (kin.F21, kin.F22))
    # F_ik D_mk.. for i, m, by the strains 11, 22 and 2 * 12
    left = [
        (
            (x * D.D11 + y * D.D13, x * D.D12 + y * D.D23, x * D.D13 + y * D.D33),
            (y * D.D12 + x * D.D13, y * D.D22 + x * D.D23, y * D.D23 + x * D.D33),
        )
        for x, y in F
    ]
    stress = ((S.xx, S.xy), (S.xy, S.yy))
    for row, i, j in _ROWS:
        x, y = F[j]
        for m, n in ((0, 0), (0, 1), (1, 0), (1, 1)):
            along = left[i][m]
            value = along[0] * x + along[2] * y if n == 0 else along[1] * y + along[2] * x
            A[:, row, :, 2 * m + n] += value + stress[m][n] if i == j else value


def tangent_entries(dofs: IntArray) -> tuple[IntArray, IntArray]:
    """Row and column dofs of the entries of `Q1P0Elements.tangent`.

    Parameters
    ----------
    dofs : (ne, 4, 2) int array
        Dofs of the corners, by component.

    Returns
    -------
    rows, columns : (ne, 2, 2, 4, 4) int arrays
    """
    d = dofs.transpose(0, 2, 1)
    shape = (len(d), 2, 2, 4, 4)
    rows = np.broadcast_to(d[:, :, None, :, None], shape)
    return rows, np.broadcast_to(d[:, None, :, None, :], shape)
