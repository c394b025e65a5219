"""Ogden's energy where its principal stretches are equal or nearly so, and at its limits."""

import numpy as np
import pytest
from scipy.special import eval_chebyt

from materials import MooneyRivlin, NeoHooke, Ogden
from materials.ogden import chebyshev
from tests.reference_solutions.plane_strain import dP_dF, first_piola_kirchhoff

MODEL = Ogden(mu=(0.4, 0.01, 0.05), alpha=(1.3, 7.0, -2.0))


@pytest.mark.parametrize("order", [0, 1, 2, 5, 9])
def test_chebyshev_function_of_whole_order_is_the_polynomial(order):
    c = np.array([1.0, 1.0 + 1e-9, 1.004, 1.03, 1.2, 3.0, 8.0])
    T, T_c, T_cc = chebyshev(order, c)
    polynomial = np.polynomial.Chebyshev.basis(order)
    np.testing.assert_allclose(T, eval_chebyt(order, c), rtol=1e-12)
    np.testing.assert_allclose(T_c, polynomial.deriv(1)(c), rtol=1e-11)
    np.testing.assert_allclose(T_cc, polynomial.deriv(2)(c), rtol=1e-10, atol=1e-15)


@pytest.mark.parametrize("nu", [-7.5, -0.2, 0.65, 1.5, 15.0])
def test_series_and_closed_form_meet(nu):
    # on both sides of the change, and of the same slope: no step in stress or stiffness
    change = 1.0 + min(0.1, 0.5 / nu**2)
    below, above = (chebyshev(nu, change * (1.0 + d)) for d in (-1e-12, 1e-12))
    np.testing.assert_allclose(below, above, rtol=1e-8)


@pytest.mark.parametrize("apart", [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.03])
@pytest.mark.parametrize("area", [0.8, 1.0, 1.3])
def test_tangent_at_nearly_equal_stretches_matches_central_differences(apart, area):
    angle, h = 0.7, 1e-6
    R = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    F = R @ np.diag(np.sqrt(area) * np.array([1.0 + apart, 1.0 / (1.0 + apart)]))
    A = dP_dF(MODEL, F)
    differences = np.empty_like(A)
    for k in range(2):
        for j in range(2):
            shift = np.zeros((2, 2))
            shift[k, j] = h
            above = first_piola_kirchhoff(MODEL, F + shift)
            differences[..., k, j] = (above - first_piola_kirchhoff(MODEL, F - shift)) / (2 * h)
    np.testing.assert_allclose(A, differences, rtol=1e-7, atol=1e-8)


def test_the_undeformed_state_is_free_of_stress_and_linear():
    tangent = dP_dF(NeoHooke(G=MODEL.initial_shear_modulus), np.eye(2))
    np.testing.assert_allclose(dP_dF(MODEL, np.eye(2)), tangent, rtol=0, atol=1e-14)
    assert not np.any(first_piola_kirchhoff(MODEL, np.eye(2)))


def test_exponents_two_and_minus_two_are_mooney_rivlin():
    rng = np.random.default_rng(4)
    F = np.eye(2) + 0.4 * rng.uniform(-1, 1, (50, 2, 2))
    F = F[np.linalg.det(F) > 0.3]
    ogden = Ogden(mu=(0.8, 0.3), alpha=(2.0, -2.0))
    mooney = MooneyRivlin(C10=0.4, C01=0.15)
    for function in (first_piola_kirchhoff, dP_dF):
        np.testing.assert_allclose(function(ogden, F), function(mooney, F), rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize(
    ("mu", "alpha", "message"),
    [
        ((1.0,), (1.0, 2.0), "mu has 1 and alpha 2 entries"),
        ((), (), "mu has 0 and alpha 0 entries"),
        ((1.0,), (0.0,), "alpha1 is 0; expected another number"),
        ((0.5, -0.6), (2.0, 3.0), "the sum of mu is -0.1; expected a number above zero"),
        ((float("nan"),), (2.0,), "mu1 is nan; expected a finite number"),
    ],
)
def test_wrong_constants_are_refused(mu, alpha, message):
    with pytest.raises(ValueError, match=message):
        Ogden(mu=mu, alpha=alpha)
