"""Time-temperature shift: invariants, numbers of the paper, derivatives."""

import numpy as np
import pytest

from materials import WLF


def test_reduced_velocity_is_invariant():
    wlf, T_ref = WLF(), 20.0
    T = np.array([0.0, 20.0, 35.0, 80.0])
    v = 300.0 / 10 ** wlf.log10_shift_factor(T, T_ref)
    np.testing.assert_allclose(wlf.equivalent_velocity(v, T, T_ref), 300.0, rtol=1e-13)


def test_ten_kelvin_hotter_act_like_0_15_of_the_velocity():
    assert WLF().equivalent_velocity(1.0, 30.0, 20.0) == pytest.approx(0.148, abs=5e-4)
    assert WLF().equivalent_velocity(300.0, 20.0, 20.0) == 300.0


def test_rebased_constants_describe_the_same_shift():
    old, T = WLF(d1=8.86, d2_K=101.6), np.array([10.0, 40.0, 90.0])
    new = old.rebased(20.0, 50.0)
    expected = old.log10_shift_factor(T, 20.0) - old.log10_shift_factor(50.0, 20.0)
    np.testing.assert_allclose(new.log10_shift_factor(T, 50.0), expected, rtol=1e-12, atol=1e-14)


def test_temperatures_at_the_pole_are_refused():
    with pytest.raises(ValueError, match="lies at or below the pole"):
        WLF(d1=17.44, d2_K=51.6).equivalent_velocity(1.0, -60.0, 20.0)
    with pytest.raises(ValueError, match="lies at or below the pole"):
        WLF(d1=17.44, d2_K=51.6).rebased(20.0, -40.0)
    with pytest.raises(ValueError, match="d2_K is -1; expected a number above zero"):
        WLF(d2_K=-1.0)
