"""WLF: shifting of frequency sweeps and fit of the constants."""

import numpy as np
import pandas as pd
import pytest

from calibration import DataError, fit_wlf, shift_sweeps
from calibration.shifting.master_curve import vertical_shift
from materials import WLF
from tests.calibration.made_up_sweeps import synthetic_sweeps

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


def plateau_sweeps(vertical=True, columns=("modulus_N_per_mm2",), T=(0.0, 20.0, 40.0, 60.0)):
    """Sweeps near a rubbery plateau, E = 2 + 2 (f a_T/100)^0.6 cos, sin of 0.3 pi, times T/T_0."""
    rows = []
    for temperature in T:
        x = np.logspace(-1, 2, 7) * 10.0 ** PLATEAU.log10_shift_factor(temperature, 20.0)
        power = 2.0 * (x / 100.0) ** 0.6 * np.exp(0.3j * np.pi)
        b = (temperature + 273.15) / 293.15 if vertical else 1.0
        storage, loss = b * (2.0 + power.real), b * power.imag
        rows.append(
            pd.DataFrame(
                {
                    "T_C": temperature,
                    "frequency_Hz": np.logspace(-1, 2, 7),
                    "modulus_N_per_mm2": storage,
                    "loss_modulus_N_per_mm2": loss,
                    "tan_delta": loss / storage,
                }
            )
        )
    return pd.concat(rows, ignore_index=True)[["T_C", "frequency_Hz", *columns]]


PLATEAU = WLF(d1=8.86, d2_K=101.6)
ALL = ("modulus_N_per_mm2", "loss_modulus_N_per_mm2", "tan_delta")


@pytest.mark.parametrize("vertical", [True, False])
@pytest.mark.parametrize("columns", [ALL[:1], ALL[:2], ALL[::2], ALL, ALL[2:]])
def test_sweeps_near_the_plateau_give_their_shift_factors(columns, vertical):
    # of sweeps as measured, and of sweeps that were divided by T/T_0 before
    master = shift_sweeps(plateau_sweeps(vertical, columns), 20.0)
    expected = PLATEAU.log10_shift_factor(master.shifts["T_C"], 20.0)
    np.testing.assert_allclose(master.shifts["log10_aT"], expected, atol=0.02)
    assert master.warnings == ()
    assert master.vertical.startswith("b_T" if vertical and columns != ALL[2:] else "none")


def test_expansion_enters_the_vertical_shift():
    b = vertical_shift(np.array([20.0, 60.0]), 20.0, 6.6e-4)
    assert b[0] == 1.0
    assert b[1] == pytest.approx(333.15 / 293.15 / (1.0 + 6.6e-4 * 40.0))
    assert "6.6e-04" not in shift_sweeps(plateau_sweeps()).vertical
    said = shift_sweeps(plateau_sweeps(), vertical="temperature", expansion_per_K=6.6e-4).vertical
    assert "expansion of 0.00066/K" in said


def test_angular_frequency_is_frequency_times_two_pi():
    table = plateau_sweeps()
    turned = table.assign(omega_rad_per_s=2.0 * np.pi * table["frequency_Hz"])
    both = shift_sweeps(turned).shifts
    only = shift_sweeps(turned.drop(columns="frequency_Hz"))
    np.testing.assert_allclose(both["log10_aT"], only.shifts["log10_aT"], atol=1e-9)
    assert only.curve["frequency_Hz"].to_numpy() == pytest.approx(table["frequency_Hz"].to_numpy())
    with pytest.raises(DataError, match=r"expected omega_rad_per_s/\(2 pi\)"):
        shift_sweeps(turned.assign(frequency_Hz=table["frequency_Hz"] * 2.0))


def test_measured_temperatures_that_scatter_are_one_sweep():
    table = plateau_sweeps()
    noise = np.random.default_rng(3).uniform(-0.4, 0.4, len(table))
    master = shift_sweeps(table.assign(T_C=table["T_C"] + noise), 20.0)
    np.testing.assert_allclose(master.shifts["T_C"], [0.0, 20.0, 40.0, 60.0], atol=0.3)
    (note,) = master.notes
    assert "rows within 1 K are one sweep" in note
    assert len(master.curve) == len(table)
    ramp = table.assign(T_C=np.linspace(0.0, 20.0, len(table)))
    with pytest.raises(DataError, match="go on from 0 to 20 deg C without a gap of 1 K"):
        shift_sweeps(ramp)
    with pytest.raises(DataError, match="at least 3 per temperature"):
        shift_sweeps(ramp, T_tolerance_K=0.1)


def test_two_sweeps_at_one_temperature_are_both_used():
    table = plateau_sweeps()
    again = table[table["T_C"] == 20.0]
    apart = again.assign(modulus_N_per_mm2=again["modulus_N_per_mm2"] * 1.02)
    master = shift_sweeps(pd.concat([table, apart], ignore_index=True))
    assert len(master.curve) == len(table) + len(apart)
    assert master.warnings == ()
    nonsense = again.assign(modulus_N_per_mm2=99.0)
    warnings = shift_sweeps(pd.concat([table, nonsense], ignore_index=True)).warnings
    assert any("several sweeps at 20 deg C (rows 8 to 35) differ" in text for text in warnings)
    assert any("misses its neighbour" in text for text in warnings)


def test_factors_that_rise_are_refused_by_the_name_of_the_other_convention():
    T = np.linspace(10.0, 100.0, 7)
    table = pd.DataFrame({"T_C": T, "log10_aT": -PLATEAU.log10_shift_factor(T, 70.0)})
    with pytest.raises(DataError, match=r"other sign convention.* d2 = 101.60 K at 70 deg C"):
        fit_wlf(table)
    result = fit_wlf(table, other_sign=True)
    assert result.values["d1"] == pytest.approx(8.86, rel=1e-6)


@pytest.mark.parametrize(
    "log_aT",
    [[0.3, -0.2, 0.25, -0.3, 0.2, -0.26], [1.0, 0.8, 0.6, 0.4, 0.2, 0.0], [9.0, 0, 0, 0, 0, 0]],
)
def test_factors_on_no_wlf_curve_give_no_parameters(log_aT):
    # scatter, a straight line (d2 without end), and one below the glass transition
    table = pd.DataFrame({"T_C": np.linspace(0.0, 50.0, 6), "log10_aT": log_aT})
    with pytest.raises(DataError, match="no WLF curve follows"):
        fit_wlf(table, T_ref_C=20.0)


def test_factors_below_the_glass_transition_are_named_and_may_be_left_out():
    T = np.linspace(-75.0, 60.0, 10)
    table = pd.DataFrame({"T_C": T, "log10_aT": PLATEAU.log10_shift_factor(T, 20.0)})
    (warning,) = [text for text in fit_wlf(table, T_ref_C=20.0).warnings if "glass" in text]
    assert warning.startswith("-75, -60, -45 deg C lie below -30 deg C")
    result = fit_wlf(table, T_ref_C=20.0, window=(-30.0, 60.0))
    assert not any("glass" in text for text in result.warnings)
    left = ["3 rows (1-3): outside the window -30 to 60 deg C"]
    assert result.metadata["rows_left_out"] == left
    assert result.metadata["rows_used"] == 7


def test_glassy_sweeps_and_rising_factors_are_named():
    table = synthetic_sweeps(RUBBER, TEMPERATURES)
    cold = table["T_C"] == -20.0
    scale = 1500.0 / table.loc[cold, "modulus_N_per_mm2"].median()
    table.loc[cold, "modulus_N_per_mm2"] *= scale
    assert any("that of a glass" in text for text in shift_sweeps(table).warnings)
    swapped = synthetic_sweeps(RUBBER, TEMPERATURES)
    swapped["T_C"] = -swapped["T_C"]
    assert any("log10 a_T rises from" in text for text in shift_sweeps(swapped).warnings)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"T_C": -300.0},
            r"row 3, column T_C: found -300.0, expected a temperature from -200",
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
