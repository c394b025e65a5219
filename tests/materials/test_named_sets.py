"""Named compounds and thermal data hold the numbers of the paper's tables."""

import pytest

from materials import ASPHALT, COMPOUNDS, RUBBER, ThermalProperties, compound


@pytest.mark.parametrize(
    ("name", "modulus"),
    [
        ("mooney-rivlin-dumbbells", 1.4334),
        ("yeoh-bars-series-1", 0.6988),
        ("yeoh-bars-series-2", 0.64),
        ("yeoh-bars-series-1-load", 0.7588),
        ("van-der-waals-bars-series-1", 0.75),
        ("van-der-waals-bars-series-2", 0.6),
    ],
)
def test_initial_shear_modulus_of_the_compounds_in_table_1(name, modulus):
    assert compound(name).initial_shear_modulus == pytest.approx(modulus, abs=1e-12)


def test_table_1_has_six_sets():
    assert len(COMPOUNDS) == 6


def test_unknown_compound_names_the_nearest():
    with pytest.raises(ValueError, match="nearest is 'yeoh-bars-series-1'"):
        compound("yeoh-bar-series-1")


def test_thermal_diffusivities_in_mm2_per_s():
    assert RUBBER.diffusivity == pytest.approx(0.284 / (1207 * 1450) * 1e6, rel=1e-12)
    assert ASPHALT.diffusivity == pytest.approx(0.70 / (2000 * 920) * 1e6, rel=1e-12)


def test_effusivity_converts_to_the_si_value():
    # 1 J/(m^2 K s^0.5) = 1e-3 N/(mm K s^0.5)
    assert RUBBER.effusivity == pytest.approx((0.284 * 1207 * 1450) ** 0.5 * 1e-3, rel=1e-12)


def test_thermal_properties_must_be_positive():
    with pytest.raises(ValueError, match="density is 0; expected a number above zero"):
        ThermalProperties.from_paper_units(0.284, 0.0, 1.45)
