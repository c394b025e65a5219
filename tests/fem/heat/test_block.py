"""Conduction in the deformed block: pull-back, kernel, orders, bounds."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve
from skfem import Basis, BilinearForm, ElementQuad1, ElementVector

from fem.heat.block import NODAL_RULE, BlockConduction, relative_change
from fem.mesh.block import block_mesh
from fem.mesh.grading import Grading
from materials.thermal import RUBBER
from tests.reference_solutions.conduction import constant_flux


def a_mesh(cells_x=12, cells_y=8, smallest_x=0.8, smallest_y=0.3):
    grading = Grading(
        cells_x=cells_x, cells_y=cells_y, smallest_x=smallest_x, smallest_y=smallest_y
    )
    return block_mesh(20.0, 8.0, grading)


def uniform(cells_x, cells_y, length=20.0, height=8.0):
    grading = Grading(cells_x=cells_x, cells_y=cells_y, smallest_x=1e3, smallest_y=1e3)
    return block_mesh(length, height, grading)


def bend(points):
    """A smooth deformation with stretches of 0.7 to 1.5 and shear."""
    x, y = points.T
    return np.column_stack(
        [1.5 * np.sin(0.2 * x + 0.1 * y) + 0.2 * y, 0.6 * np.sin(0.3 * x) + 0.08 * x * y / 4.0]
    )


def moved(mesh, displacement):
    return replace(mesh, points=mesh.points + displacement)


@BilinearForm
def pulled_back_conduction(T, w, parameters):
    """k J F^-1 F^-T Grad T . Grad w, written as in the book."""
    F = parameters["u"].grad + np.eye(2)[:, :, None, None]
    J = F[0, 0] * F[1, 1] - F[0, 1] * F[1, 0]
    inverse = np.array([[F[1, 1], -F[0, 1]], [-F[1, 0], F[0, 0]]]) / J
    grad_T = np.einsum("ji...,j...->i...", inverse, T.grad)
    grad_w = np.einsum("ji...,j...->i...", inverse, w.grad)
    return RUBBER.conductivity * J * np.einsum("i...,i...->...", grad_T, grad_w)


def test_kernel_equals_the_scikit_fem_form():
    mesh = a_mesh()
    u = bend(mesh.points)
    vector = Basis(mesh.mesh, ElementVector(ElementQuad1()), quadrature=NODAL_RULE)
    nodal = np.zeros(vector.N)
    nodal[vector.nodal_dofs] = u.T
    basis = Basis(mesh.mesh, ElementQuad1(), quadrature=NODAL_RULE)
    form = pulled_back_conduction.assemble(basis, u=vector.interpolate(nodal))
    kernel = BlockConduction(mesh, RUBBER).conduction_matrix(u)
    assert abs(form - kernel).max() < 1e-13 * abs(form).max()


def test_pull_back_equals_conduction_on_the_deformed_mesh():
    mesh = a_mesh()
    F = np.array([[1.3, 0.4], [-0.1, 0.7]])
    u = mesh.points @ (F - np.eye(2)).T
    on_reference = BlockConduction(mesh, RUBBER).conduction_matrix(u)
    on_deformed = BlockConduction(moved(mesh, u), RUBBER).conduction_matrix(np.zeros_like(u))
    assert abs(on_reference - on_deformed).max() < 1e-13 * abs(on_deformed).max()


def test_capacity_is_that_of_the_reference_volume():
    block = BlockConduction(a_mesh(), RUBBER)
    assert block.capacity.sum() == pytest.approx(RUBBER.heat_capacity * 160.0, rel=1e-13)


def harmonic_error(refinement):
    """L2 error of k grad T in equilibrium with T = exp(x/6) sin(y/6) on the bent block."""
    mesh = uniform(10 * refinement, 4 * refinement)
    u = bend(mesh.points)
    x, y = (mesh.points + u).T
    exact = np.exp(x / 6.0) * np.sin(y / 6.0)
    block = BlockConduction(mesh, RUBBER)
    K = block.conduction_matrix(u).tocsr()
    X, Y = mesh.points.T
    fixed = np.isin(X, [X.min(), X.max()]) | np.isin(Y, [Y.min(), Y.max()])
    T = exact.copy()
    free = ~fixed
    T[free] = spsolve(K[free][:, free].tocsc(), -K[free][:, fixed] @ exact[fixed])
    weight = block.capacity / block.capacity.sum()
    return np.sqrt(weight @ (T - exact) ** 2)


def test_manufactured_temperature_in_a_bent_block_converges_with_order_two():
    errors = [harmonic_error(n) for n in (2, 4, 8)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all((orders > 1.9) & (orders < 2.1)), orders


def decay_error(steps):
    """Error of a cosine that decays over one time constant on a fine mesh."""
    mesh = uniform(64, 4, length=4.0, height=1.0)
    block = BlockConduction(mesh, RUBBER)
    cosine = np.cos(np.pi * mesh.points[:, 0] / 4.0)
    rate = RUBBER.diffusivity * (2.0 - 2.0 * np.cos(np.pi / 64)) * 16.0**2
    dt = 1.0 / rate / steps
    u = np.zeros_like(mesh.points)
    T = cosine
    factor = block.factorise(u, dt).factor
    for _ in range(steps):
        T = factor.solve(block.capacity * T)
    return np.abs(T - np.exp(-1.0) * cosine).max()


def test_time_scheme_has_order_one():
    errors = [decay_error(n) for n in (20, 40, 80)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all((orders > 0.95) & (orders < 1.05)), orders


def flux_error(refinement):
    """Relative error of the surface temperature under constant flux; dt follows the mesh."""
    flux, t = 0.04, 0.4
    steps = 10 * refinement**2
    mesh = uniform(1, 20 * refinement, length=0.2, height=3.0)
    block = BlockConduction(mesh, RUBBER)
    heat = np.zeros(len(mesh.points))
    heat[mesh.bottom] = flux * 0.1 * t / steps
    factor = block.factorise(np.zeros_like(mesh.points), t / steps).factor
    T = np.zeros(len(mesh.points))
    for _ in range(steps):
        T = factor.solve(block.capacity * T + heat)
    exact = constant_flux(
        mesh.points[:, 1], t, flux=flux, k=RUBBER.conductivity, rho_c=RUBBER.heat_capacity
    )
    return np.abs(T - exact).max() / exact.max()


def test_constant_flux_on_a_half_space_converges_with_order_two_in_space():
    errors = [flux_error(n) for n in (2, 4, 8)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all((orders > 1.8) & (orders < 2.2)), orders
    assert errors[-1] < 2e-3


def test_no_node_is_cooled_by_heat_beside_it():
    """Flat cells (aspect ratio above 10) at a contact surface, heat on half of the bottom."""
    mesh = a_mesh(cells_x=40, cells_y=20, smallest_x=0.5, smallest_y=0.04)
    block = BlockConduction(mesh, RUBBER)
    heat = np.zeros(len(mesh.points))
    heat[mesh.bottom[:20]] = 1e-3
    factor = block.factorise(np.zeros_like(mesh.points), 1.7e-3).factor
    T = np.zeros(len(mesh.points))
    for _ in range(20):
        T = factor.solve(block.capacity * T + heat)
    assert T.min() > -1e-12 * T.max()


def test_a_corner_that_is_turned_over_conducts_like_its_cell():
    mesh = a_mesh()
    block = BlockConduction(mesh, RUBBER)
    u = np.zeros_like(mesh.points)
    cell = 30
    corner, opposite = mesh.cells[cell, 2], mesh.cells[cell, 0]
    u[corner] = 0.7 * (mesh.points[opposite] - mesh.points[corner])
    _, J = block.inverse_deformation(u)
    assert J.min() < 0.0
    K = block.conduction_matrix(u)
    assert np.all(np.isfinite(K.data))
    assert np.linalg.eigvalsh(K.toarray()).min() > -1e-10 * abs(K).max()
    np.testing.assert_allclose(K.sum(axis=0), 0.0, atol=1e-12 * abs(K).max())
    XX, YY, _ = block.conductivity(u)[:, cell]
    turned = J[cell] < 0.0
    assert (XX + YY)[turned].max() < 4.0 * RUBBER.conductivity


def test_a_cell_crushed_to_nothing_keeps_a_bounded_conductivity():
    mesh = a_mesh()
    block = BlockConduction(mesh, RUBBER)
    conductivity = block.conductivity(mesh.points * [0.0, -1.0])
    assert np.all(np.isfinite(conductivity))
    assert conductivity.max() <= RUBBER.conductivity / block.smallest_volume_ratio * (1 + 1e-12)
    assert conductivity.min() >= 0.0


def test_relative_change_of_a_stretched_block():
    """10 % stretch at constant height: k J/lambda^2 = k/1.1 along x, 1.1 k across."""
    mesh = a_mesh()
    block = BlockConduction(mesh, RUBBER)
    u = mesh.points * np.array([0.1, 0.0])
    change = relative_change(block.conductivity(u), block.conductivity(0.0 * u))
    assert change == pytest.approx(np.hypot(1.0 - 1.0 / 1.1, 0.1) / np.sqrt(2.0), rel=1e-12)
