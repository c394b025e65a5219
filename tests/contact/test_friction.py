"""Friction laws: numbers of the paper, derivatives, floors, temperature."""

import numpy as np
import pytest

from contact import CoulombFriction, ExponentialFriction, HuemerFriction, ThermalFriction, shifted
from contact.interface import InterfaceState
from materials import WLF

LAWS = {
    "coulomb": CoulombFriction(mu=0.9),
    "exponential": ExponentialFriction(),
    "huemer": HuemerFriction(),
}
P = np.array([0.05, 0.2, 0.3, 0.9])
V = np.array([2.0, 26.5, 50.0, 300.0])


def test_coefficients_of_table_2():
    assert HuemerFriction().coefficient(0.3, 26.5) == pytest.approx(0.960, abs=5e-4)
    assert HuemerFriction().coefficient(0.3, 300.0) == pytest.approx(0.9055, abs=5e-5)
    assert ExponentialFriction().coefficient(0.3, 300.0) == pytest.approx(0.973, abs=5e-4)


def test_huemer_peak_is_at_26_5_mm_per_s():
    law = HuemerFriction()
    assert law.peak_velocity == pytest.approx(26.5, abs=0.05)
    around = law.coefficient(0.3, law.peak_velocity * np.array([0.99, 1.0, 1.01]))
    assert around[1] > around[0]
    assert around[1] > around[2]


@pytest.mark.parametrize("name", LAWS)
def test_below_the_floors_the_coefficient_stays(name):
    p, v = np.array([-0.1, 0.0, 5e-4, 1e-3]), np.array([0.0, 0.3, 0.9, 1.0])
    mu = LAWS[name].coefficient(p, v)
    np.testing.assert_allclose(mu, LAWS[name].coefficient(1e-3, 1.0), rtol=1e-15)


@pytest.mark.parametrize("name", LAWS)
def test_numbers_and_arrays_broadcast(name):
    mu = LAWS[name].coefficient(P[:, None], V)
    assert mu.shape == (4, 4)
    assert mu[1, 2] == LAWS[name].coefficient(P[1], V[2])


@pytest.mark.parametrize("name", LAWS)
def test_direction_of_sliding_does_not_matter(name):
    np.testing.assert_array_equal(LAWS[name].coefficient(P, V), LAWS[name].coefficient(P, -V))


def test_floors_are_inputs():
    law = HuemerFriction(p_min=0.01, v_min=5.0)
    assert law.coefficient(0.3, 0.0) == law.coefficient(0.3, 5.0)
    assert law.coefficient(0.0, 50.0) == law.coefficient(0.01, 50.0)


def test_scaling_huemers_constants_changes_nothing():
    base, k = HuemerFriction(), 3.7
    scaled = HuemerFriction(
        alpha=k * base.alpha, beta=k * base.beta, a=k * base.a, b=k * base.b, c=k * base.c
    )
    np.testing.assert_allclose(scaled.coefficient(P, V), base.coefficient(P, V), rtol=1e-13)


def test_temperature_shifts_the_velocity():
    law = shifted(HuemerFriction(), WLF(), 20.0)
    p, v, T = 0.3, np.array([50.0, 300.0, 300.0]), np.array([15.0, 25.0, 32.0])
    v_equ = WLF().equivalent_velocity(v, T, 20.0)
    np.testing.assert_allclose(
        law.coefficient(p, v, T), HuemerFriction().coefficient(p, v_equ), rtol=1e-13
    )


def test_a_hot_surface_acts_like_one_at_the_floor():
    law = ThermalFriction(law=HuemerFriction(), wlf=WLF())
    assert law.coefficient(0.3, 50.0, 80.0) == HuemerFriction().coefficient(0.3, 0.0)


def test_without_wlf_temperature_does_not_matter():
    law = ThermalFriction(law=HuemerFriction())
    mu = law.coefficient(0.3, np.array([50.0, 300.0]), 90.0)
    np.testing.assert_array_equal(mu, HuemerFriction().coefficient(0.3, [50.0, 300.0]))


MEMORY = ThermalFriction(law=HuemerFriction(), memory_mm=0.3)
BEFORE = np.array([0.0, 300.0, 20.0, 310.0])


def test_without_memory_the_coefficient_knows_the_speed_at_once():
    at_once = ThermalFriction(law=HuemerFriction(), memory_mm=0.0)
    np.testing.assert_array_equal(at_once.remembered(BEFORE, V, 0.01), V)
    nearly = ThermalFriction(law=HuemerFriction(), memory_mm=1e-6)
    np.testing.assert_allclose(nearly.remembered(BEFORE, V, 0.01), V, rtol=1e-12)


@pytest.mark.parametrize("slip", [30.0, -30.0])
def test_after_a_slip_far_beyond_the_memory_the_old_speed_is_forgotten(slip):
    np.testing.assert_allclose(MEMORY.remembered(BEFORE, V, slip), V, rtol=1e-12)


def test_without_slip_the_old_speed_is_remembered():
    np.testing.assert_array_equal(MEMORY.remembered(BEFORE, V, 0.0), BEFORE)


def test_a_slip_of_the_memory_leaves_a_share_of_one_over_e():
    left = (MEMORY.remembered(BEFORE, V, 0.3) - V) / (BEFORE - V)
    np.testing.assert_allclose(left, np.exp(-1.0), rtol=1e-12)


@pytest.mark.parametrize("slip", [1e-3, 0.1, -0.3, 2.0])
def test_two_half_slips_are_remembered_like_one_whole(slip):
    half = MEMORY.remembered(BEFORE, V, 0.5 * slip)
    np.testing.assert_allclose(
        MEMORY.remembered(half, V, 0.5 * slip), MEMORY.remembered(BEFORE, V, slip), rtol=1e-13
    )


def test_a_steady_speed_is_remembered_as_it_is():
    np.testing.assert_array_equal(MEMORY.remembered(V, V, 0.07), V)


HEATING = ThermalFriction(law=HuemerFriction(), wlf=WLF(), heating_slip_mm=0.2)


def warmed(slip):
    return InterfaceState(p=0.3, v=300.0, T_C=80.0, T_before_C=30.0, slip=slip)


def test_friction_goes_from_that_of_touch_down_to_that_of_the_surface_over_the_slip():
    cold, hot = (HEATING.coefficient(0.3, 300.0, T) for T in (30.0, 80.0))
    assert cold > hot + 0.1
    slip = np.array([0.0, 0.2, 1.0, 50.0])
    expected = cold * np.exp(-slip / 0.2) + hot * (1.0 - np.exp(-slip / 0.2))
    np.testing.assert_allclose(HEATING.at(warmed(slip)), expected, rtol=1e-12)


def test_without_heating_slip_or_what_is_known_of_it_friction_is_that_of_the_surface():
    at_once = ThermalFriction(law=HuemerFriction(), wlf=WLF())
    hot = at_once.coefficient(0.3, 300.0, 80.0)
    assert at_once.at(warmed(0.0)) == hot
    assert HEATING.at(warmed(np.nan)) == hot
    assert HEATING.coefficient(0.3, 300.0, 80.0) == hot


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: CoulombFriction(mu=-0.1), "mu is -0.1; expected zero or more"),
        (lambda: ExponentialFriction(A=0.0), "A is 0; expected a number above zero"),
        (lambda: HuemerFriction(inverse_m=-0.1), "inverse_m is -0.1; expected"),
        (lambda: HuemerFriction(b=-3.0), "make the denominator of Huemer's law vanish"),
        (lambda: HuemerFriction(v_min=0.0), "v_min is 0; expected a number above zero"),
        (lambda: HuemerFriction(p_min=float("nan")), "p_min is nan; expected a finite number"),
    ],
)
def test_wrong_parameters_are_refused_in_one_sentence(build, message):
    with pytest.raises(ValueError, match=message):
        build()
