"""Small meshes, deformations and a plain Newton solver of Dirichlet problems for the tests."""

from dataclasses import replace

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from fem.mechanics.elements import NO_PAST, Q1P0Elements, tangent_entries
from fem.mesh.block import block_mesh
from fem.mesh.grading import Grading

UNIFORM = 1e9


def uniform_block(length, height, nx, ny):
    """Mesh of equal cells (a smallest cell above the mean asks for them)."""
    grading = Grading(cells_x=nx, cells_y=ny, smallest_x=UNIFORM, smallest_y=UNIFORM)
    return block_mesh(length, height, grading)


def boundary_nodes(mesh):
    return np.union1d(mesh.boundary, mesh.top)


def leading_face(mesh):
    """Nodes of the leading face of one block, from the corner at the road to the top."""
    return mesh.curves[-1][-len(mesh.chains[-1].nodes) - 2 :]


def trailing_face(mesh):
    """Nodes of the trailing face of one block, from the corner at the road to the top."""
    return mesh.curves[0][: len(mesh.chains[0].nodes) + 2][::-1]


def distorted_block(length=3.0, height=2.0, nx=4, ny=3, share=0.25, seed=1):
    """Mesh whose inner nodes are moved by a share of the cell size."""
    mesh = uniform_block(length, height, nx, ny)
    inner = np.setdiff1d(np.arange(len(mesh.points)), boundary_nodes(mesh))
    shift = np.random.default_rng(seed).uniform(-1.0, 1.0, (inner.size, 2))
    points = mesh.points.copy()
    points[inner] += share * np.array([length / nx, height / ny]) * shift
    return replace(mesh, points=points)


def random_displacement(mesh, size=0.15, seed=2):
    """Homogeneous stretch and shear plus random nodal displacements [mm]."""
    H = np.array([[0.15, 0.25], [-0.1, -0.12]])
    noise = np.random.default_rng(seed).uniform(-1.0, 1.0, mesh.points.shape)
    return mesh.points @ H.T + size * mesh.size.min() * noise


def consistent_pressure(elements, u):
    """Element pressure dU/dJ that belongs to a displacement [N/mm^2]."""
    return elements.K_bulk * (elements.kinematics(u).Jbar - 1.0)


def global_forces(elements, u, past=NO_PAST):
    """Internal forces of all nodes (n, 2) [N/mm]."""
    kin = elements.kinematics(u)
    forces = elements.forces(consistent_pressure(elements, u), kin, past)
    total = np.zeros(2 * len(u))
    np.add.at(total, elements.dofs.ravel(), forces.residual.ravel())
    return total.reshape(-1, 2)


def assembled(elements, K_e):
    """Sparse matrix of element tangents on all dofs."""
    rows, columns = (entry.ravel() for entry in tangent_entries(elements.dofs.reshape(-1, 4, 2)))
    size = 2 * len(elements.mesh.points)
    return coo_matrix((K_e.ravel(), (rows, columns)), shape=(size, size)).tocsc()


def global_tangent(elements, u, past=NO_PAST):
    """Tangent of the internal forces with consistent element pressure, dense."""
    kin = elements.kinematics(u)
    forces = elements.forces(consistent_pressure(elements, u), kin, past)
    return assembled(elements, elements.tangent(forces)).toarray()


def solve_dirichlet(elements, u, free, load=0.0, iterations=30, tolerance=1e-10):
    """Equilibrium with all dofs prescribed by `u` (n, 2) except those of the mask `free` (n, 2).

    Newton's method with the linearised element pressure, which starts at zero, so that a poor
    start value does not load the elements; `load` (n, 2) are nodal forces [N/mm].
    """
    assert isinstance(elements, Q1P0Elements)
    chosen = np.flatnonzero(free.ravel())
    p = np.zeros(len(elements.cells))
    for _ in range(iterations):
        kin = elements.kinematics(u)
        forces = elements.forces(p, kin)
        total = np.zeros(2 * len(u))
        np.add.at(total, elements.dofs.ravel(), forces.residual.ravel())
        residual = (total.reshape(-1, 2) - load).ravel()[chosen]
        mismatch = np.abs(forces.pressure_residual).max()
        if max(np.abs(residual).max(), mismatch) < tolerance:
            return u
        K = assembled(elements, elements.tangent(forces))[chosen][:, chosen]
        du = np.zeros(2 * len(u))
        du[chosen] = splu(K.tocsc()).solve(-residual)
        du = du.reshape(-1, 2)
        p = p + elements.pressure_increment(forces, du)
        u = u + du
    raise AssertionError(f"no equilibrium: residual {np.abs(residual).max():.2e} N/mm")
