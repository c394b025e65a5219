"""Wear by the energy of friction."""

import numpy as np
import pytest

from contact.wear import EnergyWear

POWER = np.array([0.0, 1.0, 81.0, 5000.0])


def test_volume_is_the_coefficient_times_the_energy_whatever_the_power():
    """1 J per mm^2 wears off k: 0.1 s of 10 W/mm^2, or 10 s of 0.1 W/mm^2."""
    wear = EnergyWear(coefficient=2.15e-3)
    assert wear.depth_rate(1e4) * 0.1 == pytest.approx(2.15e-3, rel=1e-14)
    assert wear.depth_rate(1e2) * 10.0 == pytest.approx(2.15e-3, rel=1e-14)


def test_depth_is_linear_in_the_coefficient():
    one, three = EnergyWear(coefficient=1e-3), EnergyWear(coefficient=3e-3)
    np.testing.assert_allclose(three.depth_rate(POWER), 3.0 * one.depth_rate(POWER), rtol=1e-14)


def test_an_exponent_bends_the_law_about_the_reference_power():
    plain, bent = EnergyWear(coefficient=1e-3), EnergyWear(coefficient=1e-3, power_exponent=2.0)
    assert bent.depth_rate(100.0) == pytest.approx(plain.depth_rate(100.0), rel=1e-14)
    assert bent.depth_rate(400.0) == pytest.approx(4.0 * plain.depth_rate(400.0), rel=1e-14)


def test_friction_that_drives_the_block_adds_nothing():
    assert EnergyWear(coefficient=1e-3).depth_rate(-5.0) == 0.0


def test_wrong_parameters_are_refused():
    with pytest.raises(ValueError, match="coefficient is -1; expected zero or more"):
        EnergyWear(coefficient=-1.0)
    with pytest.raises(ValueError, match="power_exponent is 0; expected"):
        EnergyWear(power_exponent=0.0)
