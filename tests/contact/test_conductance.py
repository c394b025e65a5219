"""Gap conductance: the identified number, eq. (11) and its dimensions."""

import numpy as np
import pytest

from contact import GapConductance
from contact.conductance import ContactSurface, mikic_conductance, mikic_constant

#: Rubber (0.284 W/(m K), 6 N/mm^2, incompressible) on asphalt (0.70, 30000, Poisson's ratio 0.2).
SURFACE = ContactSurface(
    mean_conductivity_W_per_mK=2.0 / (1.0 / 0.284 + 1.0 / 0.70),
    effective_modulus_N_per_mm2=1.0 / (0.75 / 6.0 + 0.96 / 30000.0),
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
