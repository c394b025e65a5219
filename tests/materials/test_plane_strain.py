"""Stress and tangent in plane strain against independent derivatives."""

import numpy as np
import pytest

from materials import NeoHooke, VanDerWaals
from materials.plane_strain import cauchy_stress
from tests.materials.models import MODELS, constants, kind
from tests.reference_solutions import homogeneous
from tests.reference_solutions.plane_strain import dP_dF, first_piola_kirchhoff


def random_states(size=40, spread=0.35):
    rng = np.random.default_rng(7)
    F = np.eye(2) + spread * rng.uniform(-1, 1, (size, 2, 2))
    return F[np.linalg.det(F) > 0.4]


def cauchy_of(model, F, pressure=0.0):
    return cauchy_stress(first_piola_kirchhoff(model, F), F, pressure)


def central_differences(model, F, step):
    A = np.empty((*F.shape, 2, 2))
    for k in range(2):
        for j in range(2):
            shift = np.zeros((2, 2))
            shift[k, j] = step
            above = first_piola_kirchhoff(model, F + shift)
            A[..., k, j] = (above - first_piola_kirchhoff(model, F - shift)) / (2 * step)
    return A


@pytest.mark.parametrize("name", MODELS)
def test_stress_is_the_derivative_of_the_energy(name):
    model, F = MODELS[name], random_states()
    expected = homogeneous.plane_strain_stress(kind(model), constants(model), F)
    np.testing.assert_allclose(first_piola_kirchhoff(model, F), expected, rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("name", MODELS)
def test_energy_matches_its_definition(name):
    model, F = MODELS[name], random_states()
    I1 = np.sum(F * F, axis=(-2, -1)) + 1
    W = model.derivatives(I1, np.linalg.det(F)).W
    expected = homogeneous.plane_strain_energy(kind(model), constants(model), F.astype(complex))
    np.testing.assert_allclose(W, expected.real, rtol=1e-11, atol=1e-14)


@pytest.mark.parametrize("name", MODELS)
def test_invariant_derivatives_match_central_differences(name):
    model, h = MODELS[name], 1e-6
    rng = np.random.default_rng(3)
    I1, J = rng.uniform(3.4, 4.5, 30), rng.uniform(0.8, 1.1, 30)
    W = model.derivatives(I1, J)
    up, down = model.derivatives(I1 + h, J), model.derivatives(I1 - h, J)
    right, left = model.derivatives(I1, J + h), model.derivatives(I1, J - h)
    tolerance = {"rtol": 1e-7, "atol": 1e-8}
    np.testing.assert_allclose(W.W_1, (up.W - down.W) / (2 * h), **tolerance)
    np.testing.assert_allclose(W.W_J, (right.W - left.W) / (2 * h), **tolerance)
    np.testing.assert_allclose(W.W_11, (up.W_1 - down.W_1) / (2 * h), **tolerance)
    np.testing.assert_allclose(W.W_1J, (right.W_1 - left.W_1) / (2 * h), **tolerance)
    np.testing.assert_allclose(W.W_JJ, (right.W_J - left.W_J) / (2 * h), **tolerance)


@pytest.mark.parametrize("name", MODELS)
def test_tangent_matches_central_differences_at_random_states(name):
    model, F = MODELS[name], random_states()
    np.testing.assert_allclose(
        dP_dF(model, F), central_differences(model, F, 1e-6), rtol=2e-7, atol=2e-8
    )


@pytest.mark.parametrize("size", [0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3])
@pytest.mark.parametrize("name", MODELS)
def test_tangent_matches_central_differences_at_and_near_the_undeformed_state(name, size):
    # The van der Waals stress has a term G c |eps| eps there: a central difference over the step
    # h is off by the order of h itself, so the step is small and the tolerance its multiple.
    model, h = MODELS[name], 1e-7
    F = np.eye(2) + size * np.random.default_rng(1).uniform(-1, 1, (10, 2, 2))
    A = dP_dF(model, F)
    np.testing.assert_allclose(A, central_differences(model, F, h), rtol=0, atol=2e-6)


@pytest.mark.parametrize("beta", [0.0, 0.4])
def test_van_der_waals_tangent_at_the_undeformed_state_is_exactly_the_linear_one(beta):
    model = VanDerWaals(G=0.75, lambda_m=3.5, a=1.0, beta=beta)
    expected = dP_dF(NeoHooke(G=0.75), np.eye(2))
    np.testing.assert_allclose(dP_dF(model, np.eye(2)), expected, rtol=0, atol=1e-14)
    assert not np.any(first_piola_kirchhoff(model, np.eye(2)))


@pytest.mark.parametrize("angle", [0.3, 1.2, 2.9])
def test_rotated_undeformed_states_give_no_nan_and_no_stress(angle):
    R = rotation(angle)
    for model in MODELS.values():
        assert np.abs(first_piola_kirchhoff(model, R)).max() < 1e-14
        assert np.all(np.isfinite(dP_dF(model, R)))


def test_tangent_matches_central_differences_close_to_locking():
    model = MODELS["van-der-waals-bars-series-1"]
    lam = 3.3  # eta = 0.987
    F = np.array([[[lam, 0.1], [0.0, 1 / lam]]])
    assert model.admissible(np.sum(F * F) + 1, 1.0)
    A, differences = dP_dF(model, F), central_differences(model, F, 1e-6)
    np.testing.assert_allclose(A, differences, rtol=1e-6, atol=1e-6 * np.abs(A).max())


@pytest.mark.parametrize("name", MODELS)
def test_tangent_has_major_symmetry(name):
    A = dP_dF(MODELS[name], random_states())
    np.testing.assert_allclose(A, np.einsum("...ijkl->...klij", A), rtol=1e-13, atol=1e-14)


@pytest.mark.parametrize("name", MODELS)
def test_stress_turns_with_the_frame(name):
    model, F, R = MODELS[name], random_states(), rotation(0.8)
    np.testing.assert_allclose(
        first_piola_kirchhoff(model, R @ F),
        R @ first_piola_kirchhoff(model, F),
        rtol=1e-9,
        atol=1e-12,
    )


@pytest.mark.parametrize("name", MODELS)
def test_stress_across_the_plane_is_the_derivative_of_the_energy(name):
    model, F = MODELS[name], random_states()
    expected = homogeneous.out_of_plane_stress(kind(model), constants(model), F)
    np.testing.assert_allclose(cauchy_of(model, F)[..., 2], expected, rtol=1e-9, atol=1e-12)


def test_cauchy_stress_of_simple_shear_is_the_textbook_one():
    # sigma_xy = G gamma, sigma_xx - sigma_yy = G gamma^2 (Treloar 1975, chapter 5)
    gamma, G = 0.4, 0.7
    sigma = cauchy_of(NeoHooke(G=G), np.array([[1.0, gamma], [0.0, 1.0]]), pressure=0.25)
    assert sigma[3] == pytest.approx(G * gamma, rel=1e-13)
    assert sigma[0] - sigma[1] == pytest.approx(G * gamma**2, rel=1e-13)
    assert sigma[:3].mean() == pytest.approx(0.25, rel=1e-13)


@pytest.mark.parametrize("name", MODELS)
def test_planar_test_is_recovered_from_plane_strain(name):
    # The free surface fixes the mean stress; the nominal stress is the Cauchy stress over lambda.
    model, lam = MODELS[name], np.array([0.8, 1.2, 1.7])
    F = np.zeros((3, 2, 2))
    F[:, 0, 0], F[:, 1, 1] = lam, 1 / lam
    sigma = cauchy_of(model, F)
    np.testing.assert_allclose(
        (sigma[:, 0] - sigma[:, 1]) / lam, model.nominal_stress(lam, "planar"), rtol=1e-11
    )


def rotation(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
