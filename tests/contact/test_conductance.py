"""Gap conductance: the identified number, eq. (11) and its dimensions."""

import numpy as np
import pytest

from contact import GapConductance
from contact.conductance import (
    ContactSurface,
    effective_modulus,
    harmonic_mean_conductivity,
    mikic_conductance,
    mikic_constant,
)

SURFACE = ContactSurface(
    mean_conductivity_W_per_mK=harmonic_mean_conductivity(0.284, 0.70),
    effective_modulus_N_per_mm2=effective_modulus(6.0, 0.5, 30000.0, 0.2),
    rms_roughness_um=300.0,
    mean_slope=0.3,
)


def test_identified_conductance_and_pressure_law():
    h = GapConductance()
    assert h.conductance(0.3) == 1600.0
    assert h.conductance(0.6) == pytest.approx(1600.0 * 2**0.94, rel=1e-12)
    np.testing.assert_array_equal(h.conductance([0.0, -0.1]), 0.0)


def test_stiffening_lowers_the_conductance_and_is_off_by_default():
    assert GapConductance().conductance(0.3, 300.0) == 1600.0
    h = GapConductance(modulus_exponent=0.1, v_ref=1.0)
    assert h.conductance(0.3, 0.0) == 1600.0
    assert h.conductance(0.3, 300.0) == pytest.approx(1600.0 * 301**-0.094, rel=1e-12)


def test_mean_conductivity_of_rubber_and_asphalt():
    assert harmonic_mean_conductivity(0.284, 0.70) == pytest.approx(0.404, abs=5e-4)


def test_effective_modulus_of_a_soft_body_on_a_rigid_one_is_plane_strain():
    assert effective_modulus(6.0, 0.5, 1e12, 0.2) == pytest.approx(6.0 / 0.75, rel=1e-9)
    assert effective_modulus(6.0, 0.4, 9.0, 0.2) == effective_modulus(9.0, 0.2, 6.0, 0.4)


def test_eq_11_has_the_dimensions_of_a_conductance():
    # Change of the unit of length: k [W/(m K)] and sigma [m] scale together, h as W/(m^2 K).
    h = mikic_conductance(0.3, SURFACE)
    by_hand = 0.404065 * 0.3 / 300e-6 * (0.3 * 2**0.5 / (7.99872 * 0.3)) ** 0.94
    assert h == pytest.approx(by_hand, rel=1e-4)


def test_eq_11_keeps_the_pressure_law_of_the_gap_conductance():
    C = mikic_constant(1600.0, 0.3, SURFACE)
    p = np.array([0.05, 0.3, 0.8])
    np.testing.assert_allclose(
        mikic_conductance(p, SURFACE, C=C), GapConductance().conductance(p), rtol=1e-12
    )


def test_wrong_parameters_are_refused():
    with pytest.raises(ValueError, match="h_ref is -1; expected zero or more"):
        GapConductance(h_ref=-1.0)
    with pytest.raises(ValueError, match="p_ref is 0; expected a number above zero"):
        GapConductance(p_ref=0.0)
