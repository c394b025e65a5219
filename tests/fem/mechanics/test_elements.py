"""Q1P0 elements: gradient and tangent, scikit-fem forms, patch test, orders, published forces."""

from dataclasses import asdict, replace
from itertools import product

import numpy as np
import pytest
from scipy.optimize import brentq
from skfem import Basis, BilinearForm, ElementQuad1, ElementVector, LinearForm
from skfem.helpers import ddot

from fem.mechanics.corners import CornerBarrier
from fem.mechanics.elements import NO_PAST, Past, Q1P0Elements, Viscosity
from fem.mechanics.kinematics import area_gradient
from materials import NeoHooke, Yeoh, compound
from materials.plane_strain import cauchy_stress
from tests.fem.small_blocks import (
    boundary_nodes,
    consistent_pressure,
    distorted_block,
    global_forces,
    global_tangent,
    leading_face,
    random_displacement,
    solve_dirichlet,
    trailing_face,
    uniform_block,
)
from tests.materials.models import MODELS
from tests.reference_solutions.homogeneous import plane_strain_stress
from tests.reference_solutions.plane_strain import dP_dF, first_piola_kirchhoff

YEOH = compound("yeoh-bars-series-1-load")


def elements_of(model, mesh=None, K_over_G=100.0):
    return Q1P0Elements(mesh or distorted_block(), model, K_over_G * model.initial_shear_modulus)


def energy_of(elements, u):
    kin = elements.kinematics(u)
    return elements.strain_energy(kin, elements.model.end(kin).stored)


def states(mesh):
    return {
        "undeformed": np.zeros_like(mesh.points),
        "small": 0.01 * random_displacement(mesh),
        "large": random_displacement(mesh),
        "folded": folded_corner(mesh),
    }


def folded_corner(mesh):
    """Displacements that take most of its area from a corner of an element."""
    u, cell = np.zeros_like(mesh.points), mesh.cells[len(mesh.cells) // 2]
    diagonal = mesh.points[cell[0]] - mesh.points[cell[2]]
    u[cell[2]] = 0.42 * diagonal
    return u


def viscosity_of(elements, rate=3.0):
    """Kelvin-Voigt term of a step that began at another deformation."""
    u_n = random_displacement(elements.mesh, seed=7) * 0.7
    viscosity = Viscosity(rate=rate, strain_n=elements.kinematics(u_n).green_lagrange)
    return Past(viscosity=viscosity)


@pytest.mark.parametrize("state", ["undeformed", "small", "large", "folded"])
@pytest.mark.parametrize("name", MODELS)
def test_residual_is_the_gradient_of_the_strain_energy(name, state):
    elements = elements_of(MODELS[name])
    u, h = states(elements.mesh)[state], 1e-5
    gradient = np.empty_like(u)
    for node, component in np.ndindex(u.shape):
        du = np.zeros_like(u)
        du[node, component] = h
        up, down = (energy_of(elements, u + s * du) for s in (1, -1))
        gradient[node, component] = (up - down) / (2 * h)
    forces = global_forces(elements, u)
    scale = max(np.abs(forces).max(), elements.K_bulk)
    np.testing.assert_allclose(forces, gradient, rtol=0.0, atol=2e-8 * scale)


@pytest.mark.parametrize("viscous", [False, True], ids=["elastic", "viscous"])
@pytest.mark.parametrize("state", ["undeformed", "small", "large", "folded"])
@pytest.mark.parametrize("name", MODELS)
def test_tangent_matches_central_differences(name, state, viscous):
    """The van der Waals tangent has a kink at F = I; central differences see it to order h."""
    elements = elements_of(MODELS[name])
    past = viscosity_of(elements) if viscous else NO_PAST
    u, h = states(elements.mesh)[state], 1e-6
    tangent = global_tangent(elements, u, past)
    differences = np.empty_like(tangent)
    for column in range(u.size):
        du = np.zeros(u.size)
        du[column] = h
        du = du.reshape(u.shape)
        up, down = (global_forces(elements, u + s * du, past) for s in (1, -1))
        differences[:, column] = ((up - down) / (2 * h)).ravel()
    assert np.isfinite(tangent).all()
    np.testing.assert_allclose(tangent, differences, rtol=0.0, atol=1e-7 * np.abs(tangent).max())


def test_the_folded_state_has_sound_points_and_a_corner_that_resists():
    elements = elements_of(YEOH)
    kin = elements.kinematics(folded_corner(elements.mesh))
    assert elements.admissible(kin)
    assert elements.forces(np.zeros(len(kin.J)), kin).corners is not None


def test_tangent_is_symmetric():
    elements = elements_of(YEOH)
    tangent = global_tangent(elements, random_displacement(elements.mesh), viscosity_of(elements))
    np.testing.assert_allclose(tangent, tangent.T, rtol=0.0, atol=1e-12 * np.abs(tangent).max())


def test_geometric_part_uses_the_element_pressure_not_that_of_the_iterate():
    """The tangents of two pressures differ by pressure times the Hessian of the area."""
    elements = elements_of(YEOH)
    u = random_displacement(elements.mesh)
    kin, p = elements.kinematics(u), consistent_pressure(elements, u)
    one = elements.tangent(elements.forces(p, kin))
    other = elements.tangent(elements.forces(np.zeros_like(p), kin))
    x = (elements.mesh.points + u)[elements.cells]
    for node, component in product(range(4), range(2)):
        dx = np.zeros((4, 2))
        dx[node, component] = 0.5
        hessian = (area_gradient(x + dx) - area_gradient(x - dx)).transpose(0, 2, 1)
        change = (one - other)[:, :, component, :, node]
        np.testing.assert_allclose(change, p[:, None, None] * hessian, atol=1e-10)


def test_pressure_increment_is_the_linearised_pressure_law():
    elements = elements_of(YEOH)
    u = random_displacement(elements.mesh)
    p = consistent_pressure(elements, u) + 0.1
    du = 1e-6 * random_displacement(elements.mesh, seed=5)
    forces = elements.forces(p, elements.kinematics(u))
    expected = consistent_pressure(elements, u + du)
    np.testing.assert_allclose(p + elements.pressure_increment(forces, du), expected, atol=1e-8)


def skfem_fields(elements, u):
    """Vector basis and F at its quadrature points, (2, 2, ne, nq)."""
    basis = Basis(elements.mesh.mesh, ElementVector(ElementQuad1()), intorder=3)
    x = np.zeros(basis.N)
    x[basis.nodal_dofs] = u.T
    grad = basis.interpolate(x).grad
    return basis, grad + np.eye(2)[:, :, None, None]


def to_skfem(basis, nodal):
    x = np.zeros(basis.N)
    x[basis.nodal_dofs] = nodal.T
    return x


@pytest.mark.parametrize("name", MODELS)
def test_residual_equals_the_scikit_fem_form(name):
    model = MODELS[name]
    elements = elements_of(model)
    u = random_displacement(elements.mesh)
    past = viscosity_of(elements)
    basis, F = skfem_fields(elements, u)
    F_last = np.moveaxis(F, (0, 1), (-2, -1))
    P = np.moveaxis(first_piola_kirchhoff(model, F_last), (-2, -1), (0, 1))
    cofactor = np.array([[F[1, 1], -F[1, 0]], [-F[0, 1], F[0, 0]]])
    P = P + consistent_pressure(elements, u)[:, None] * cofactor
    E = 0.5 * (np.einsum("ki...,kj...->ij...", F, F) - np.eye(2)[:, :, None, None])
    E11, E22, E12 = past.viscosity.strain_n
    S = past.viscosity.rate * (E - np.array([[E11, E12], [E12, E22]]))
    P = P + np.einsum("ik...,kj...->ij...", F, S)

    form = LinearForm(lambda v, w: ddot(P, v.grad)).assemble(basis)
    ours = to_skfem(basis, global_forces(elements, u, past))
    np.testing.assert_allclose(ours, form, rtol=0.0, atol=1e-12 * np.abs(form).max())


@pytest.mark.parametrize("name", MODELS)
def test_isochoric_tangent_equals_the_scikit_fem_form(name):
    """Without bulk modulus nothing is condensed and the plain bilinear form is the tangent."""
    model = MODELS[name]
    elements = Q1P0Elements(distorted_block(), model, 0.0)
    u = random_displacement(elements.mesh)
    basis, F = skfem_fields(elements, u)
    A = np.moveaxis(dP_dF(model, np.moveaxis(F, (0, 1), (-2, -1))), (-4, -3, -2, -1), (0, 1, 2, 3))
    form = BilinearForm(
        lambda u, v, w: np.einsum("ijkl...,kl...,ij...->...", A, u.grad, v.grad)
    ).assemble(basis)
    order = basis.nodal_dofs.T.ravel()
    expected = form.toarray()[np.ix_(order, order)]
    tangent = global_tangent(elements, u)
    np.testing.assert_allclose(tangent, expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())


def test_area_gradient_is_the_derivative_of_the_area():
    mesh = distorted_block()
    x = (mesh.points + random_displacement(mesh))[mesh.cells]

    def area(x):
        diagonals = x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]
        return 0.5 * (
            diagonals[0][:, 0] * diagonals[1][:, 1] - diagonals[0][:, 1] * diagonals[1][:, 0]
        )

    for node, component in np.ndindex(4, 2):
        dx = np.zeros_like(x)
        dx[:, node, component] = 1e-3
        slope = (area(x + dx) - area(x - dx)) / 2e-3
        np.testing.assert_allclose(area_gradient(x)[:, node, component], slope, atol=1e-12)


# -------------------------------------------------------------------------- exact solutions


@pytest.mark.parametrize("name", MODELS)
def test_patch_test_linear_displacements_give_constant_stress_and_no_inner_forces(name):
    model = MODELS[name]
    elements = elements_of(model)
    mesh = elements.mesh
    A = np.array([[1.2, 0.3], [-0.1, 0.8]])
    u = mesh.points @ (A - np.eye(2)).T
    forces = global_forces(elements, u)
    inner = np.setdiff1d(np.arange(len(u)), boundary_nodes(mesh))
    assert np.abs(forces[inner]).max() < 1e-12 * np.abs(forces).max()
    stress = elements.cauchy(elements.kinematics(u))
    J = np.linalg.det(A)
    P = first_piola_kirchhoff(model, A)
    expected = cauchy_stress(P, A, elements.K_bulk * (J - 1.0))
    np.testing.assert_allclose(
        stress, np.tile(expected, (len(stress), 1)), rtol=0.0, atol=1e-12 * np.abs(expected).max()
    )


@pytest.mark.parametrize("name", MODELS)
def test_patch_test_is_solved_from_the_boundary_values(name):
    elements = elements_of(MODELS[name], K_over_G=50.0)
    mesh = elements.mesh
    exact = mesh.points @ (np.array([[1.1, 0.2], [0.0, 0.93]]) - np.eye(2)).T
    free = np.ones_like(exact, dtype=bool)
    free[boundary_nodes(mesh)] = False
    start = np.where(free, 0.8 * exact, exact)
    u = solve_dirichlet(elements, start, free, tolerance=1e-11)
    np.testing.assert_allclose(u, exact, rtol=0.0, atol=1e-11)


def compressed_width(model, K_bulk, stretch):
    """Lateral stretch of homogeneous plane-strain compression with stress-free sides."""
    name, constants = type(model).__name__, asdict(model)

    def side_stress(l1):
        F = np.diag([l1, stretch])
        return plane_strain_stress(name, constants, F)[0, 0] + K_bulk * (l1 * stretch - 1) * stretch

    l1 = brentq(side_stress, 0.8 / stretch, 1.2 / stretch, xtol=1e-15)
    F = np.diag([l1, stretch])
    P = plane_strain_stress(name, constants, F)[1, 1] + K_bulk * (l1 * stretch - 1) * l1
    return l1, P


@pytest.mark.parametrize("stretch", [0.7, 1.3])
@pytest.mark.parametrize("name", MODELS)
def test_homogeneous_compression_and_tension_match_the_closed_form(name, stretch):
    """Sliding top and bottom; closed form from the energy in principal stretches."""
    elements = elements_of(MODELS[name], distorted_block(share=0.2))
    mesh = elements.mesh
    l1, P = compressed_width(MODELS[name], elements.K_bulk, stretch)
    u = np.zeros_like(mesh.points)
    u[:, 1] = (stretch - 1.0) * mesh.points[:, 1]
    u[:, 0] = (1.0 / stretch - 1.0) * mesh.points[:, 0]
    free = np.ones_like(u, dtype=bool)
    free[mesh.top, 1] = free[mesh.bottom, 1] = False
    free[trailing_face(mesh)[0], 0] = False
    u = solve_dirichlet(elements, u, free, tolerance=1e-11)
    np.testing.assert_allclose(u[leading_face(mesh), 0], (l1 - 1.0) * 3.0, rtol=1e-9)
    force = global_forces(elements, u)[mesh.top, 1].sum()
    assert force == pytest.approx(3.0 * P, rel=1e-9)


# ------------------------------------------------------------------- manufactured solution


def manufactured_displacement(X):
    """Smooth displacement (..., 2) with strains up to 0.3, and its gradient (..., 2, 2)."""
    x, y = X[..., 0], X[..., 1]
    s, c = np.sin, np.cos
    u = np.stack([0.12 * s(1.5 * x + 1.0) * c(1.2 * y), 0.10 * c(1.3 * x) * s(1.6 * y + 0.5)], -1)
    H = np.empty((*x.shape, 2, 2))
    H[..., 0, 0] = 0.18 * c(1.5 * x + 1.0) * c(1.2 * y)
    H[..., 0, 1] = -0.144 * s(1.5 * x + 1.0) * s(1.2 * y)
    H[..., 1, 0] = -0.13 * s(1.3 * x) * s(1.6 * y + 0.5)
    H[..., 1, 1] = 0.16 * c(1.3 * x) * c(1.6 * y + 0.5)
    return u, H


def manufactured_error(model, cells, K_over_G):
    """L2 error of the displacement on cells x cells; the load is the weak divergence of P."""
    mesh = uniform_block(2.0, 2.0, cells, cells)
    elements = elements_of(model, mesh, K_over_G)
    fine = Basis(mesh.mesh, ElementVector(ElementQuad1()), intorder=6)
    X = np.moveaxis(np.asarray(fine.global_coordinates()), 0, -1)
    exact, H = manufactured_displacement(X)
    F = H + np.eye(2)
    cofactor = np.stack([np.stack([F[..., 1, 1], -F[..., 1, 0]], -1),
                         np.stack([-F[..., 0, 1], F[..., 0, 0]], -1)], -2)  # fmt: skip
    P = plane_strain_stress(type(model).__name__, asdict(model), F)
    P = P + (elements.K_bulk * (np.linalg.det(F) - 1.0))[..., None, None] * cofactor
    P = np.moveaxis(P, (-2, -1), (0, 1))
    load = LinearForm(lambda v, w: ddot(P, v.grad)).assemble(fine)[fine.nodal_dofs].T
    u = manufactured_displacement(mesh.points)[0]
    free = np.ones_like(u, dtype=bool)
    free[boundary_nodes(mesh)] = False
    u = solve_dirichlet(elements, u, free, np.where(free, load, 0.0), tolerance=1e-9)
    found = np.moveaxis(np.asarray(fine.interpolate(to_skfem(fine, u))), 0, -1)
    return np.sqrt(np.sum(fine.dx * np.sum((found - exact) ** 2, axis=-1)))


@pytest.mark.parametrize("name", ["yeoh-bars-series-1-load", "van-der-waals-mixed"])
def test_manufactured_solution_converges_with_order_two(name):
    """Finite strain, K/G = 20, against loads from an independent stress."""
    errors = np.array([manufactured_error(MODELS[name], n, 20.0) for n in (8, 16, 32)])
    orders = np.log2(errors[:-1] / errors[1:])
    assert (orders > 1.8).all()
    assert (orders < 2.2).all()


# ------------------------------------------------------------------------- bonded block


def bonded_force(model, K_bulk, nx, ny, steps=2, corners=True):
    """Force on the top of a bonded 20 x 10 mm block pressed by 1 mm [N/mm]."""
    mesh = uniform_block(20.0, 10.0, nx, ny)
    elements = Q1P0Elements(mesh, model, K_bulk)
    if not corners:
        elements.corners = CornerBarrier(mesh.points[mesh.cells], elements.volume, 0.0)
    free = np.ones_like(mesh.points, dtype=bool)
    free[mesh.bottom] = free[mesh.top] = False
    u = np.zeros_like(mesh.points)
    for _ in range(steps):
        start = u - np.outer(mesh.points[:, 1] / 10.0, [0.0, 1.0 / steps])
        u = solve_dirichlet(elements, start, free, tolerance=1e-9)
    return -global_forces(elements, u)[mesh.top, 1].sum()


@pytest.mark.parametrize("nx, ny, force", [(40, 20, 14.579969), (80, 40, 14.424499)])
def test_bonded_block_gives_the_force_of_other_programs(nx, ny, force):
    """The same digits come from FElupe 11.3 and from a prototype written apart from this code."""
    assert bonded_force(YEOH, 200.0, nx, ny, corners=False) == pytest.approx(force, rel=1e-6)


@pytest.mark.parametrize("nx, ny", [(40, 20), (80, 40)])
def test_resistance_of_corners_is_lost_in_the_force_of_a_bonded_block(nx, ny):
    """Four elements at its corners are nearly folded, as at every bonded edge."""
    plain = bonded_force(YEOH, 200.0, nx, ny, corners=False)
    assert bonded_force(YEOH, 200.0, nx, ny) == pytest.approx(plain, rel=1e-4)


def test_no_volumetric_locking_at_a_bulk_ratio_of_1000():
    """A coarse block is 3 % too stiff, as it is at a ratio of 100; locking would add to that."""
    stiffness = {}
    for ratio in (100.0, 1000.0):
        K_bulk = ratio * YEOH.initial_shear_modulus
        coarse, fine = (bonded_force(YEOH, K_bulk, n, n // 2) for n in (20, 80))
        stiffness[ratio] = coarse / fine
    assert stiffness[1000.0] == pytest.approx(1.0, abs=0.04)
    assert stiffness[1000.0] == pytest.approx(stiffness[100.0], abs=0.005)


# ---------------------------------------------------------------------------- invariances


def test_a_rigid_rotation_and_shift_make_no_force_and_rotate_existing_ones():
    elements = elements_of(YEOH)
    X = elements.mesh.points
    angle = 0.7
    R = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    rigid = X @ (R - np.eye(2)).T + [3.0, -2.0]
    assert np.abs(global_forces(elements, rigid)).max() < 1e-12 * elements.K_bulk
    u = random_displacement(elements.mesh)
    turned = (X + u) @ R.T - X
    np.testing.assert_allclose(
        global_forces(elements, turned),
        global_forces(elements, u) @ R.T,
        rtol=0.0,
        atol=1e-12 * elements.K_bulk,
    )


def test_a_rigid_shift_of_the_reference_mesh_changes_nothing():
    mesh = distorted_block()
    shifted = replace(mesh, points=mesh.points + np.array([1000.0, 0.0]))
    u = random_displacement(mesh)
    one, other = (global_forces(elements_of(YEOH, m), u) for m in (mesh, shifted))
    np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-10 * np.abs(one).max())


def test_forces_scale_with_the_units_from_mm_and_N_to_m_and_kN():
    """1 N/mm^2 = 1000 kN/m^2; forces per depth 1 N/mm = 1 kN/m; energies 1 mJ/mm = 1e-3 kJ/m."""
    mesh = distorted_block()
    u = random_displacement(mesh)
    in_metres = replace(mesh, points=1e-3 * mesh.points)
    mm = elements_of(YEOH, mesh)
    m = Q1P0Elements(in_metres, Yeoh(**{k: 1e3 * c for k, c in asdict(YEOH).items()}),
                     1e3 * mm.K_bulk)  # fmt: skip
    forces = global_forces(mm, u, viscosity_of(mm))
    past = Past(viscosity=replace(viscosity_of(mm).viscosity, rate=3e3))
    np.testing.assert_allclose(global_forces(m, 1e-3 * u, past), forces, rtol=1e-10, atol=1e-10)
    energies = [energy_of(e, x) for e, x in ((mm, u), (m, 1e-3 * u))]
    assert energies[1] == pytest.approx(1e-3 * energies[0], rel=1e-12)


# ------------------------------------------------------------------------------- outputs


def test_admissible_is_false_for_an_inverted_element_and_beyond_the_locking_stretch():
    mesh = uniform_block(2.0, 2.0, 2, 2)
    elements = elements_of(NeoHooke(G=1.0), mesh)
    assert elements.admissible(elements.kinematics(np.zeros_like(mesh.points)))
    inverted = np.zeros_like(mesh.points)
    inverted[mesh.bottom, 1] = 1.5
    assert not elements.admissible(elements.kinematics(inverted))
    locking = elements_of(MODELS["van-der-waals-mixed"], mesh)
    far = mesh.points * [6.0, 1.0 / 6.0] - mesh.points
    assert not locking.admissible(locking.kinematics(far))
    assert elements.admissible(elements.kinematics(far))


def test_largest_stretch_is_the_largest_singular_value():
    elements = elements_of(YEOH)
    A = np.array([[1.3, 0.4], [-0.2, 0.9]])
    u = elements.mesh.points @ (A - np.eye(2)).T
    largest = np.linalg.svd(A, compute_uv=False)[0]
    np.testing.assert_allclose(elements.largest_stretch(elements.kinematics(u)), largest)
