"""WLF: shifting of frequency sweeps and fit of the constants."""

import numpy as np
import pandas as pd
import pytest

from calibration import DataError, fit_wlf, shift_sweeps
from calibration.synthetic import synthetic_sweeps
from materials import WLF

RUBBER = WLF(d1=17.0, d2_K=150.0)
TEMPERATURES = (-20.0, -10.0, 0.0, 10.0, 20.0, 40.0, 60.0, 80.0)


def test_constants_come_back_from_shift_factors():
    T = np.linspace(-20.0, 80.0, 11)
    table = pd.DataFrame({"T_C": T, "log10_aT": WLF().log10_shift_factor(T, 20.0)})
    result = fit_wlf(table, T_ref_C=20.0)
    assert result.values["d1"] == pytest.approx(43.1, rel=1e-6)
    assert result.values["d2_K"] == pytest.approx(509.4, rel=1e-6)
    assert result.values["offset"] == pytest.approx(0.0, abs=1e-9)


def test_plain_shift_factors_and_another_reference_are_taken():
    T = np.linspace(-10.0, 60.0, 8)
    table = pd.DataFrame({"T_C": T, "aT": 10.0 ** RUBBER.log10_shift_factor(T, 20.0)})
    result = fit_wlf(table, T_ref_C=50.0)
    expected = RUBBER.rebased(20.0, 50.0)
    assert result.model.d1 == pytest.approx(expected.d1, rel=1e-6)
    assert result.model.d2_K == pytest.approx(expected.d2_K, rel=1e-6)
    assert result.values["offset"] == pytest.approx(
        float(RUBBER.log10_shift_factor(50.0, 20.0)), rel=1e-6
    )
    assert fit_wlf(table).metadata["T_ref_C"] == 20.0


def test_sweeps_are_shifted_onto_one_curve():
    master = shift_sweeps(synthetic_sweeps(RUBBER, TEMPERATURES), 20.0)
    expected = RUBBER.log10_shift_factor(master.shifts["T_C"], 20.0)
    np.testing.assert_allclose(master.shifts["log10_aT"], expected, atol=5e-3)
    assert master.overlap_error < 1e-4
    assert master.warnings == ()
    curve = master.curve.sort_values("reduced_frequency_Hz")
    assert np.all(np.diff(np.log10(curve["modulus_N_per_mm2"])) > -1e-3)


def test_noisy_sweeps_give_the_constants_and_an_overlap_error_of_the_noise():
    table = synthetic_sweeps(RUBBER, TEMPERATURES, noise_decades=0.005, seed=2)
    result = fit_wlf(table, T_ref_C=20.0)
    assert result.values["d1"] == pytest.approx(17.0, rel=0.05)
    assert result.values["d2_K"] == pytest.approx(150.0, rel=0.05)
    assert 0.002 < shift_sweeps(table, 20.0).overlap_error < 0.02


def test_shift_of_the_whole_curve_changes_only_the_reference():
    table = synthetic_sweeps(RUBBER, TEMPERATURES)
    cold, warm = shift_sweeps(table, 0.0).shifts, shift_sweeps(table, 40.0).shifts
    difference = cold["log10_aT"] - warm["log10_aT"]
    np.testing.assert_allclose(difference, difference.iloc[0], atol=2e-3)


def test_sweeps_that_hardly_overlap_are_reported():
    far = synthetic_sweeps(WLF(d1=17.0, d2_K=60.0), (0.0, 25.0), T_ref_C=0.0)
    master = shift_sweeps(far, 10.0)
    assert any("overlaps its neighbour by only" in warning for warning in master.warnings)
    assert any("no sweep at 10 deg C" in warning for warning in master.warnings)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"T_C": -300.0},
            r"row 3, column T_C: found -300.0, expected a temperature from -150",
        ),
        ({"modulus_N_per_mm2": 0.0}, r"row 3, column modulus_N_per_mm2: found 0.0, expected"),
        ({"frequency_Hz": -1.0}, r"row 3, column frequency_Hz: found -1.0, expected"),
    ],
)
def test_impossible_sweeps_are_refused(change, message):
    table = synthetic_sweeps(RUBBER, TEMPERATURES)
    for column, value in change.items():
        table.loc[2, column] = value
    with pytest.raises(DataError, match=message):
        shift_sweeps(table)


def test_too_few_temperatures_are_refused():
    with pytest.raises(DataError, match="found 2 different temperatures, expected at least 3"):
        fit_wlf(pd.DataFrame({"T_C": [0.0, 20.0], "log10_aT": [1.0, 0.0]}))
    with pytest.raises(DataError, match="found one temperature, expected two or more sweeps"):
        shift_sweeps(synthetic_sweeps(RUBBER, (20.0,)))
    with pytest.raises(DataError, match="column log10_aT"):
        fit_wlf(pd.DataFrame({"T_C": [0.0, 20.0, 40.0]}))
