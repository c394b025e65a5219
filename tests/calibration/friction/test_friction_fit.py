"""Friction fits: recovery, redundancy of scale, temperature shift, comparison of curves."""

import tomllib

import numpy as np
import pandas as pd
import pytest

import treadfem
from calibration import DataError, compare_laws, fit_friction
from calibration.friction.curves import forms
from calibration.paper_tables import FRICTION_LAWS, friction_values
from calibration.synthetic import synthetic_friction
from contact import ExponentialFriction, HuemerFriction, ThermalFriction
from materials import WLF

TABLE_2 = friction_values()
LAWS = ("exponential", "huemer")


@pytest.mark.parametrize("law", LAWS)
def test_noise_free_parameters_come_back_in_the_papers_scale(law):
    result = fit_friction(synthetic_friction(FRICTION_LAWS[law], noise=0.0), law)
    assert result.values == pytest.approx(TABLE_2[law], rel=1e-6)


@pytest.mark.parametrize("law", LAWS)
def test_noisy_parameters_come_back_within_three_standard_errors(law):
    result = fit_friction(synthetic_friction(FRICTION_LAWS[law], seed=5), law)
    for name in result.names:
        assert abs(result.values[name] - TABLE_2[law][name]) < 3.0 * result.stderr[name]


@pytest.mark.parametrize("law", LAWS)
def test_jacobian_matches_central_differences(law):
    form = forms()[law]
    p, v = (a.ravel() for a in np.meshgrid([0.1, 0.3, 0.9], [2.0, 26.0, 400.0]))
    theta = np.array([TABLE_2[law][name] for name in form.names])
    _, J, by_log_v = form.curve(theta, p, v)
    h = 1e-6
    for k in range(theta.size):
        step = h * np.eye(theta.size)[k]
        slope = (form.curve(theta + step, p, v)[0] - form.curve(theta - step, p, v)[0]) / (2 * h)
        np.testing.assert_allclose(J[:, k], slope, rtol=1e-6, atol=1e-9)
    up, down = form.curve(theta, p, v * np.exp(h))[0], form.curve(theta, p, v * np.exp(-h))[0]
    np.testing.assert_allclose(by_log_v, (up - down) / (2 * h), rtol=1e-6, atol=1e-9)


def test_another_scale_gives_the_same_curve():
    table = synthetic_friction(HuemerFriction(), seed=1)
    first = fit_friction(table, "huemer")
    second = fit_friction(table, "huemer", fixed={"a": 2.0})
    np.testing.assert_allclose(first.predicted, second.predicted, rtol=1e-7)
    assert second.values["beta"] == pytest.approx(first.values["beta"] * 2.0 / 0.9203, rel=1e-4)


@pytest.mark.parametrize("a", [1e-3, 50.0])
def test_a_scale_far_from_the_papers_is_no_harder(a):
    result = fit_friction(synthetic_friction(HuemerFriction(), noise=0.0), fixed={"a": a})
    assert result.values["c"] == pytest.approx(0.9677 * a / 0.9203, rel=1e-6)
    assert result.metadata["normalisation"] == f"a = {a:g}"


def test_holding_alpha_leaves_a_free():
    result = fit_friction(synthetic_friction(HuemerFriction(), noise=0.0), fixed={"alpha": 0.1399})
    assert "a" in result.names
    assert result.values == pytest.approx(TABLE_2["huemer"], rel=1e-6)


def test_scale_may_be_held_through_another_constant():
    table = synthetic_friction(HuemerFriction(), noise=0.0)
    result = fit_friction(table, "huemer", fixed={"c": 0.9677})
    assert result.values == pytest.approx(TABLE_2["huemer"], rel=1e-6)


@pytest.mark.parametrize("law", LAWS)
def test_wlf_constants_are_found_together_with_the_law(law):
    plain = {"exponential": ExponentialFriction(v_min=1e-9), "huemer": HuemerFriction(v_min=1e-9)}
    table = synthetic_friction(
        plain[law], temperatures_C=(0.0, 20.0, 40.0), wlf=WLF(), repeats=1, noise=0.0
    )
    result = fit_friction(table, law, wlf="fit", T_ref_C=20.0)
    assert result.values == pytest.approx({**TABLE_2[law], "d1": 43.1, "d2_K": 509.4}, rel=1e-6)
    assert isinstance(result.model, ThermalFriction)
    assert result.section["friction"]["d2_K"] == pytest.approx(509.4, rel=1e-6)


def test_given_shift_is_used_and_a_missing_one_reported():
    table = synthetic_friction(
        HuemerFriction(v_min=1e-9), temperatures_C=(5.0, 35.0), wlf=WLF(), repeats=1, noise=0.0
    )
    given = fit_friction(table, "huemer", wlf=WLF())
    assert given.values == pytest.approx(TABLE_2["huemer"], rel=1e-6)
    without = fit_friction(table, "huemer")
    assert without.rmse > 0.01
    assert any("no WLF shift takes part" in warning for warning in without.warnings)


def test_a_shift_by_an_unknown_word_is_refused():
    with pytest.raises(ValueError, match="wlf is 'auto'; expected a WLF, \"fit\" or None"):
        fit_friction(synthetic_friction(ExponentialFriction()), law="exponential", wlf="auto")


def test_one_pressure_cannot_determine_the_pressure_part():
    table = synthetic_friction(HuemerFriction(), pressures_N_per_mm2=(0.3,))
    result = fit_friction(table, "huemer")
    assert any("not determined" in warning for warning in result.warnings)
    assert np.isinf(result.stderr["alpha"])
    assert np.isfinite(result.stderr["inverse_m"])
    np.testing.assert_allclose(
        result.model.law.coefficient(table["p_N_per_mm2"], table["v_mm_per_s"]),
        HuemerFriction().coefficient(table["p_N_per_mm2"], table["v_mm_per_s"]),
        atol=2e-3,
    )


def test_curves_are_compared_and_the_exponential_law_misses_the_peak():
    table = compare_laws(synthetic_friction(HuemerFriction()))
    assert table["law"].tolist() == ["huemer", "exponential"]
    assert table["mu_largest_difference"][0] == 0.0
    assert table["mu_largest_difference"][1] > 0.05


def test_floors_of_the_law_follow_the_data_downwards_only():
    low = synthetic_friction(
        HuemerFriction(v_min=0.01), velocities_mm_per_s=np.geomspace(0.05, 100.0, 20)
    )
    assert fit_friction(low).section["friction"]["v_min_mm_per_s"] == pytest.approx(0.05)
    high = synthetic_friction(HuemerFriction(), velocities_mm_per_s=np.geomspace(5.0, 900.0, 20))
    assert fit_friction(high).section["friction"]["v_min_mm_per_s"] == 1.0


def exponential_table(A=0.9, B=-0.1, C=-0.02, **columns):
    p, v = (values.ravel() for values in np.meshgrid([0.1, 0.2, 0.4], [1.0, 3.0, 10.0, 30.0]))
    return pd.DataFrame(
        {"p_N_per_mm2": p, "v_mm_per_s": v, "mu": (A * p**B * v**C).round(5), **columns}
    )


def test_the_ranges_of_the_data_go_into_the_section():
    section = fit_friction(exponential_table(T_C=31.0), "exponential").section["friction"]
    assert section["window"] == {
        "p_N_per_mm2": [0.1, 0.4],
        "v_mm_per_s": [1.0, 30.0],
        "T_C": [31.0, 31.0],
    }
    assert section["T_ref_C"] == 31.0  # the temperature of the law, without any shift


def test_a_shift_given_at_another_temperature_is_rebased_to_that_of_the_law(tmp_path):
    table = tmp_path / "slides.csv"
    exponential_table(T_C=[0.0, 20.0, 40.0] * 4).to_csv(table, index=False)
    given, there = WLF(d1=25.0, d2_K=141.0), WLF(d1=25.0, d2_K=141.0).rebased(-5.0, 30.0)
    expected = fit_friction(table, "exponential", wlf=there, T_ref_C=30.0)
    words = f"--law exponential --wlf given --d1 {given.d1} --d2 {given.d2_K} --wlf-T-ref -5"
    folder = ["-o", str(tmp_path / "o"), "--no-compare", "--quiet"]
    words = ["calibrate", "friction", str(table), *words.split(), "--T-ref", "30", *folder]
    assert treadfem.main(words) == 0
    section = tomllib.loads((tmp_path / "o" / "parameters.toml").read_text())["friction"]
    assert section["d2_K"] == pytest.approx(there.d2_K)
    assert section["T_ref_C"] == 30.0
    assert section["C"] == pytest.approx(expected.values["C"], rel=1e-9)


def test_a_law_that_is_negative_beyond_its_data_is_named():
    p, v = (values.ravel() for values in np.meshgrid([0.02, 0.1, 0.2, 0.3], [5.0, 20.0, 80.0]))
    law = HuemerFriction(alpha=0.9, beta=-0.9, n=0.9)  # the numerator ends at p = 1
    table = pd.DataFrame({"p_N_per_mm2": p, "v_mm_per_s": v, "mu": law.coefficient(p, v)})
    result = fit_friction(table, "huemer")
    (warning,) = [text for text in result.warnings if "below zero" in text]
    edge = float(warning.split(" N/mm^2")[0].split()[-1])
    assert 0.9 < edge < 1.1
    assert result.model.law.coefficient(1.2 * edge, 20.0) < 0.0 < law.coefficient(0.9 * edge, 20.0)
    assert not any(
        "below zero" in t for t in fit_friction(exponential_table(), "exponential").warnings
    )


def test_laws_that_data_cannot_carry_are_compared_by_their_reason():
    few = exponential_table().iloc[:5]
    found = compare_laws(few)
    assert list(found["law"]) == ["exponential", "huemer"]
    assert found["reason"].iloc[0] == ""
    assert "free parameters of huemer" in found["reason"].iloc[1]
    assert np.isnan(found["rmse"].iloc[1])


def test_friction_that_follows_no_law_gives_no_parameters():
    mixed = pd.concat([exponential_table()] * 10, ignore_index=True)
    mixed["mu"] = np.random.default_rng(5).permutation(np.linspace(0.1, 1.5, len(mixed)))
    with pytest.raises(DataError, match="column mu: found values that the best fit does not"):
        fit_friction(mixed, "exponential")
    constant = exponential_table(B=0.0, C=0.0)
    constant["mu"] += np.random.default_rng(5).normal(0.0, 0.005, len(constant))
    assert fit_friction(constant, "exponential").rmse < 0.01  # no trend, and none needed
