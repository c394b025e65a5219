"""Parameter files: origin, uncertainty, and the way into a case."""

import hashlib
import tomllib
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from calibration import fit_friction, fit_hyperelastic, fit_wlf
from calibration.datasets import DATASETS, dataset_path
from calibration.rubber.stress_models import STRESS_MODELS
from calibration.synthetic import (
    TABLE_1,
    synthetic_bar_cycles,
    synthetic_friction,
    synthetic_stress,
)
from contact import HuemerFriction
from fem.case.case import Case
from fem.case.friction import Friction
from fem.case.rubber import CONSTANTS
from materials import WLF, compound
from tests.calibration.made_up_sweeps import synthetic_sweeps

LOADING = """
[loading]
mean_pressure_N_per_mm2 = 0.25
velocity_mm_per_s = 300.0
distance_mm = 120.0
"""


def test_file_says_where_the_numbers_come_from(tmp_path):
    source = tmp_path / 'bars "7".csv'
    synthetic_bar_cycles(1, noise_N_per_mm2=0.01).to_csv(source, index=False)
    result = fit_hyperelastic(source, "yeoh", branch="load", window=(1.0, 2.2))
    content = tomllib.loads(result.to_toml(tmp_path / "deep" / "rubber.toml").read_text())
    fit = content["fit"]
    assert fit["data_file"] == 'bars "7".csv'
    assert fit["data_sha256"] == hashlib.sha256(source.read_bytes()).hexdigest()
    assert fit["cycle"] == "last full cycle at the highest strain (uniaxial 5)"
    assert (fit["branch"], fit["window"], fit["model"]) == ("load", [1.0, 2.2], "yeoh")
    assert fit["version"]
    assert fit["rmse"] == result.rmse
    assert fit["r2"] == result.r2
    assert fit["stderr"] == result.stderr
    assert fit["values"] == result.values
    np.testing.assert_array_equal(fit["covariance"]["matrix"], result.covariance)
    assert content["rubber"]["C10_N_per_mm2"] == result.values["C10"]
    assert sorted(path.name for path in (tmp_path / "deep").iterdir()) == ["rubber.toml"]


@pytest.mark.parametrize("name", TABLE_1)
def test_a_case_takes_fitted_rubber(name, tmp_path):
    result = fit_hyperelastic(synthetic_stress(name, noise_N_per_mm2=0.0), TABLE_1[name].model)
    result.to_toml(tmp_path / "rubber.toml")
    case_file = tmp_path / "case.toml"
    case_file.write_text('[rubber]\nparameters = "rubber.toml"\n' + LOADING)
    model = Case.from_toml(case_file).rubber.model()
    assert type(model) is type(compound(name))
    assert vars(model) == pytest.approx(vars(compound(name)), rel=1e-6)


def as_in_a_case(law):
    """A fitted law with the case's memory: tables of steady sliding say nothing about that."""
    return replace(law, memory_mm=Friction().memory_mm)


def test_a_case_takes_fitted_friction_with_its_shift(tmp_path):
    table = synthetic_friction(
        HuemerFriction(v_min=1e-9), temperatures_C=(5.0, 35.0), wlf=WLF(), repeats=1
    )
    result = fit_friction(table, "huemer", wlf="fit", T_ref_C=25.0)
    result.to_toml(tmp_path / "friction.toml")
    case_file = tmp_path / "case.toml"
    case_file.write_text('[friction]\nparameters = "friction.toml"\n' + LOADING)
    law = Case.from_toml(case_file).friction.law_object()
    assert law == as_in_a_case(result.model)


def test_a_case_takes_fitted_friction_without_a_shift(tmp_path):
    result = fit_friction(synthetic_friction(HuemerFriction()), "exponential")
    result.to_toml(tmp_path / "friction.toml")
    case_file = tmp_path / "case.toml"
    case_file.write_text('[friction]\nparameters = "friction.toml"\n' + LOADING)
    assert Case.from_toml(case_file).friction.law_object() == as_in_a_case(result.model)


def test_a_case_takes_a_fitted_shift_for_its_own_law(tmp_path):
    result = fit_wlf(synthetic_sweeps(WLF(d1=17.0, d2_K=150.0), (0.0, 20.0, 40.0, 60.0)))
    result.to_toml(tmp_path / "wlf.toml")
    case_file = tmp_path / "case.toml"
    case_file.write_text('[friction]\nlaw = "huemer"\nparameters = "wlf.toml"\n' + LOADING)
    assert Case.from_toml(case_file).friction.law_object().wlf == result.model


@pytest.mark.parametrize("zero_C", [-25.0, -5.0, 20.0, 60.0])
def test_a_fitted_shift_leaves_the_law_at_its_own_temperature(zero_C, tmp_path):
    shift, T = WLF(d1=25.0, d2_K=141.0).rebased(-5.0, zero_C), np.linspace(-40.0, 90.0, 14)
    factors = pd.DataFrame({"T_C": T, "log10_aT": shift.log10_shift_factor(T, zero_C)})
    fit_wlf(factors, T_ref_C=zero_C).to_toml(tmp_path / "wlf.toml")
    case_file = tmp_path / "case.toml"
    case_file.write_text('[friction]\nparameters = "wlf.toml"\n' + LOADING)
    case = Case.from_toml(case_file)
    law = case.friction.law_object()
    assert law.T_ref_C == 20.0
    assert law.coefficient(0.25, 300.0, 20.0) == HuemerFriction().coefficient(0.25, 300.0)
    # between two temperatures the shift is that of the measurement, whatever they refer to
    expected = shift.log10_shift_factor(47.0, zero_C) - shift.log10_shift_factor(20.0, zero_C)
    assert law.wlf.log10_shift_factor(47.0, 20.0) == pytest.approx(expected, rel=1e-6)
    assert f"at {zero_C:g} deg C" in case.friction.described()
    again = Case.from_dict(tomllib.loads(case.to_toml()))
    assert again.friction.law_object() == law


def test_shift_constants_of_a_case_do_not_mix_with_the_temperature_of_a_file(tmp_path):
    (tmp_path / "wlf.toml").write_text("[friction]\nd1 = 25.0\nd2_K = 141.0\nwlf_T_ref_C = -5.0\n")
    (tmp_path / "old.toml").write_text("[friction]\nd1 = 25.0\nd2_K = 141.0\nT_ref_C = -5.0\n")

    def case(friction):
        return Case.from_dict(
            {"friction": friction, "loading": tomllib.loads(LOADING)["loading"]}, folder=tmp_path
        )

    own = case({"parameters": "wlf.toml", "d1": 10.0, "d2_K": 100.0}).friction
    assert own.shift() == WLF(d1=10.0, d2_K=100.0)
    with pytest.raises(ValueError, match="d1 here and the other WLF constant"):
        case({"parameters": "wlf.toml", "d1": 10.0})
    with pytest.raises(ValueError, match="T_ref_C and d1 but no law, expected wlf_T_ref_C"):
        case({"parameters": "old.toml"})
    with pytest.raises(ValueError, match=r"friction\.law: found reference temperature -170"):
        case({"parameters": "wlf.toml", "T_ref_C": -170.0})


@pytest.mark.parametrize("model", STRESS_MODELS)
def test_every_model_that_can_be_fitted_goes_into_a_case_as_it_is(model, tmp_path):
    result = fit_hyperelastic(dataset_path("kawabata1981"), model)
    content = tomllib.loads(result.to_toml(tmp_path / "p.toml").read_text())
    assert content["fit"]["values"] == result.values
    case_file = tmp_path / "case.toml"
    case_file.write_text('[rubber]\nparameters = "p.toml"\n' + LOADING)
    assert Case.from_toml(case_file).rubber.model() == result.model


def test_every_model_of_a_case_can_be_fitted():
    assert {name.rstrip("-123") for name in STRESS_MODELS} == set(CONSTANTS)


def test_numbers_that_are_not_finite_stay_readable(tmp_path):
    result = fit_friction(synthetic_friction(HuemerFriction(), pressures_N_per_mm2=(0.3,)))
    content = tomllib.loads(result.to_toml(tmp_path / "p.toml").read_text())
    assert np.isinf(content["fit"]["stderr"]["alpha"])


def test_data_sets_name_their_papers():
    for name in DATASETS:
        assert "# Source: " in dataset_path(name).read_text()
    with pytest.raises(ValueError, match="data set is 'treloar'; expected one of"):
        dataset_path("treloar")
