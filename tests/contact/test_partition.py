"""Heat partition: eq. (14) and its cap."""

import numpy as np
import pytest

from contact import HeatPartition, InterfaceState


def test_partition_of_eq_14():
    assert HeatPartition()(0.3) == pytest.approx(0.3146 * 0.3**-0.6833, rel=1e-14)
    assert HeatPartition()(0.3) == pytest.approx(0.716, abs=5e-4)


def test_cap_holds_below_0_184():
    kappa = HeatPartition()
    assert kappa.uncapped(0.184) == pytest.approx(1.0, abs=1e-3)
    np.testing.assert_array_equal(kappa([0.0, 0.1, 0.18]), 1.0)
    assert kappa(0.19) < 1.0
    assert HeatPartition(cap=0.8)(0.2) == 0.8


def test_no_heat_at_all_is_allowed():
    np.testing.assert_array_equal(HeatPartition(prefactor=0.0)([0.0, 0.3]), 0.0)


def test_wrong_parameters_are_refused():
    with pytest.raises(ValueError, match=r"cap is 1.2; expected a number from 0 to 1"):
        HeatPartition(cap=1.2)
    with pytest.raises(ValueError, match=r"prefactor is -0.3; expected zero or more"):
        HeatPartition(prefactor=-0.3)


def test_the_governing_pressure_is_mean_local_or_fixed():
    state = InterfaceState(p=[0.1, 0.3, 5.0], mean_pressure=0.3)
    for pressure, expected in (("mean", [0.3] * 3), ("local", state.p), (0.25, [0.25] * 3)):
        law = HeatPartition(pressure=pressure)
        assert law.governing(state) == pytest.approx(expected)
        np.testing.assert_array_equal(law.at(state), law(expected))
        np.testing.assert_array_equal(law.capped(state), law.uncapped(expected) > 1.0)


@pytest.mark.parametrize("pressure", ["nominal", 0.0, -0.3, float("nan")])
def test_a_pressure_that_cannot_be_meant_is_refused(pressure):
    with pytest.raises(ValueError, match="pressure"):
        HeatPartition(pressure=pressure)
