"""Hyperelastic fits: recovery of known parameters, independent implementations, real rubbers."""

import numpy as np
import pandas as pd
import pytest
from scipy.optimize import least_squares

from calibration import DataError, compare_models, fit_hyperelastic
from calibration.datasets import DATASETS, dataset_path
from calibration.rubber.stress_data import select_data
from calibration.rubber.stress_models import STRESS_MODELS, Kinematics
from calibration.synthetic import TABLE_1, synthetic_stress
from materials import COMPOUNDS, MODES
from tests.reference_solutions import homogeneous

# Points from which the independent optimisers start, and the reference energy of each model.
REFERENCE = {
    "neo-hooke": ("NeoHooke", {"G": 0.4}),
    "mooney-rivlin": ("MooneyRivlin", {"C10": 0.2, "C01": 0.01}),
    "yeoh": ("Yeoh", {"C10": 0.2, "C20": 0.0, "C30": 0.0}),
    "van-der-waals": ("VanDerWaals", {"G": 0.4, "lambda_m": 11.0, "a": 0.25}),
    "arruda-boyce": ("ArrudaBoyce", {"C1": 0.3, "lambda_m": 4.5}),
}


@pytest.mark.parametrize("name", TABLE_1)
def test_noise_free_parameters_come_back(name):
    paper = vars(COMPOUNDS[name])
    result = fit_hyperelastic(synthetic_stress(name, noise_N_per_mm2=0.0), TABLE_1[name].model)
    for parameter in result.names:
        assert result.values[parameter] == pytest.approx(paper[parameter], rel=1e-6)


@pytest.mark.parametrize("name", TABLE_1)
def test_noisy_parameters_come_back_within_three_standard_errors(name):
    paper = vars(COMPOUNDS[name])
    result = fit_hyperelastic(synthetic_stress(name, seed=3), TABLE_1[name].model)
    for parameter in result.names:
        error = abs(result.values[parameter] - paper[parameter])
        assert error < 3.0 * result.stderr[parameter]
        assert result.stderr[parameter] < 0.5 * abs(paper[parameter])


@pytest.mark.parametrize("model", STRESS_MODELS)
def test_jacobian_matches_central_differences(model):
    law = STRESS_MODELS[model]
    stretch = np.tile(np.linspace(0.7, 2.0, 9), 3)
    kin = Kinematics.of(stretch, np.repeat(np.array(MODES), 9))
    typical = {"G": 0.5, "lambda_m": 5.0, "a": 0.5, "beta": 0.2, "C1": 0.4, "alpha3": -2.0}
    theta = np.array([typical.get(n, 1.3 + 0.7 * i) for i, n in enumerate(law.names)])
    J = law.jacobian(theta, kin)
    for k in range(theta.size):
        h = np.zeros_like(theta)
        h[k] = 1e-6
        slope = (law.stress(theta + h, kin) - law.stress(theta - h, kin)) / 2e-6
        np.testing.assert_allclose(J[:, k], slope, rtol=1e-6, atol=1e-7)


@pytest.mark.parametrize("model", REFERENCE)
def test_stress_of_the_fit_is_the_stress_of_the_energy(model):
    law, (reference, constants) = STRESS_MODELS[model], REFERENCE[model]
    stretch = np.linspace(0.8, 2.0, 7)
    theta = np.array([constants.get(name, 0.0) for name in law.names])
    for mode in MODES:
        kin = Kinematics.of(stretch, np.full(7, mode))
        expected = homogeneous.nominal_stress(reference, constants, stretch, mode)
        np.testing.assert_allclose(law.stress(theta, kin), expected, rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("dataset", DATASETS)
@pytest.mark.parametrize("model", REFERENCE)
def test_fit_agrees_with_an_independent_one_in_rmse(model, dataset):
    data = select_data(dataset_path(dataset))
    name, start = REFERENCE[model]
    found = fit_hyperelastic(data, model)

    def residuals(theta):
        constants = dict(zip(start, theta, strict=True))
        return np.concatenate(
            [
                homogeneous.nominal_stress(name, constants, data.stretch[data.mode == mode], mode)
                - data.stress[data.mode == mode]
                for mode in MODES
            ]
        )

    # the independent optimiser has finite differences only, so it starts near the minimum found
    near = np.array([found.values[key] for key in start]) * 1.02
    tight = {"xtol": 1e-14, "ftol": 1e-14, "gtol": 1e-14, "x_scale": "jac"}
    other = least_squares(residuals, near, jac="3-point", **tight)
    rmse = np.sqrt(np.mean(other.fun**2))
    assert found.rmse == pytest.approx(rmse, abs=1e-6)


# Ogden is left out here: felupe separates equal eigenvalues by a small disturbance, which moves the
# equibiaxial stress by 1e-4 and the RMSE by 1e-6; van der Waals too, whose invariant it offsets.
@pytest.mark.parametrize("model", ["neo-hooke", "mooney-rivlin", "yeoh", "arruda-boyce"])
def test_fit_to_treloar_agrees_with_felupe_in_rmse(model):
    import felupe  # takes a second to load; its energies need tensortrax

    data = select_data(dataset_path("treloar1944"))
    found = fit_hyperelastic(data, model)
    energy, build = felupe_model(felupe, model)

    def residuals(theta):
        umat = felupe.Hyperelastic(energy, **build(theta))
        tests = {"ux": "uniaxial", "ps": "planar", "bx": "equibiaxial"}
        stretches = {key: data.stretch[data.mode == mode] for key, mode in tests.items()}
        view = umat.view(incompressible=True, **stretches)
        predicted = (view.uniaxial(), view.planar(), view.biaxial())
        return np.concatenate(
            [
                stress - data.stress[data.mode == mode]
                for (_, stress, *_), mode in zip(predicted, tests.values(), strict=True)
            ]
        )

    theta = np.array([found.values[name] for name in found.names])
    other = least_squares(residuals, theta * 1.001, x_scale="jac", xtol=1e-13, ftol=1e-13)
    assert found.rmse == pytest.approx(np.sqrt(np.mean(other.fun**2)), abs=1e-6)
    assert np.sqrt(np.mean(residuals(theta) ** 2)) == pytest.approx(found.rmse, rel=1e-6)


def felupe_model(felupe, model):
    """Energy of felupe and its keywords from our parameters."""
    return {
        "neo-hooke": (felupe.neo_hooke, lambda t: {"mu": t[0]}),
        "mooney-rivlin": (felupe.mooney_rivlin, lambda t: {"C10": t[0], "C01": t[1]}),
        "yeoh": (felupe.yeoh, lambda t: {"C10": t[0], "C20": t[1], "C30": t[2]}),
        "arruda-boyce": (felupe.arruda_boyce, lambda t: {"C1": t[0], "limit": t[1]}),
    }[model]


@pytest.mark.parametrize("dataset", DATASETS)
def test_ogden_fit_agrees_with_an_independent_one_in_rmse(dataset):
    data = select_data(dataset_path(dataset))
    found = fit_hyperelastic(data, "ogden-3")

    def residuals(theta):
        return np.concatenate(
            [
                homogeneous.nominal_stress(
                    "Ogden",
                    {"mu": theta[0::2], "alpha": theta[1::2]},
                    data.stretch[data.mode == mode],
                    mode,
                )
                - data.stress[data.mode == mode]
                for mode in MODES
            ]
        )

    tight = {"xtol": 1e-14, "ftol": 1e-14, "gtol": 1e-14, "x_scale": "jac"}
    other = least_squares(residuals, found.theta * 1.01, jac="3-point", **tight)
    assert found.rmse == pytest.approx(np.sqrt(np.mean(other.fun**2)), abs=1e-6)


def test_ogden_finds_the_better_of_two_minima():
    # two terms of opposite sign; random positive exponents end at an RMSE half as large again
    stretch = np.array([1.0, 1.13, 1.32, 1.61, 2.0, 2.49, 2.75, 3.0, 3.43, 3.75, 4.0])
    exact = 8.2 / 1.1 * (stretch**0.1 - stretch**-1.55)
    exact += 4.6 / -6.3 * (stretch**-7.3 - stretch ** (0.5 * 6.3 - 1.0))
    table = pd.DataFrame(
        {"stretch": stretch, "nominal_stress_N_per_mm2": exact.round(2), "mode": "uniaxial"}
    )
    result = fit_hyperelastic(table, "ogden-2")
    assert result.rmse < 0.004  # rounding to 0.01 leaves 0.003
    assert result.values["alpha2"] == pytest.approx(-6.3, abs=0.3)


def test_yeoh_follows_treloar_up_to_stretch_4():
    result = fit_hyperelastic(
        dataset_path("treloar1944"), "yeoh", modes=["uniaxial"], window=(1.0, 4.0)
    )
    assert result.r2 > 0.99


@pytest.mark.parametrize("dataset", DATASETS)
def test_every_model_fits_every_rubber_and_stays_admissible(dataset):
    table = compare_models(dataset_path(dataset))
    assert set(table["model"]) == set(STRESS_MODELS)
    assert table["rmse_N_per_mm2"].notna().all()
    assert (table["r2"] > 0.8).all()
    assert table["aic"].is_monotonic_increasing


@pytest.mark.slow
def test_more_starts_do_not_find_a_better_ogden_fit():
    for dataset in DATASETS:
        few = fit_hyperelastic(dataset_path(dataset), "ogden-3", starts=20)
        many = fit_hyperelastic(dataset_path(dataset), "ogden-3", starts=60, seed=1)
        assert few.rmse == pytest.approx(many.rmse, rel=1e-6)


def test_mooney_rivlin_cannot_follow_the_upturn_of_the_bars():
    table = synthetic_stress("yeoh-bars-series-2")
    yeoh, mooney = (fit_hyperelastic(table, model).rmse for model in ("yeoh", "mooney-rivlin"))
    assert mooney > 5.0 * yeoh


def test_mooney_rivlin_stays_admissible_where_the_bars_ask_for_a_negative_modulus():
    result = fit_hyperelastic(synthetic_stress("yeoh-bars-series-2"), "mooney-rivlin")
    assert result.model.initial_shear_modulus > 0.0
    assert any("no admissible energy" in warning for warning in result.warnings)


def test_a_free_beta_is_recovered():
    from materials import VanDerWaals

    truth = VanDerWaals(G=0.6, lambda_m=5.0, a=0.5, beta=0.15)
    stretch = np.linspace(1.02, 2.8, 40)
    parts = [
        pd.DataFrame(
            {
                "stretch": stretch,
                "nominal_stress_N_per_mm2": truth.nominal_stress(stretch, mode),
                "mode": mode,
            }
        )
        for mode in MODES
    ]
    result = fit_hyperelastic(pd.concat(parts), "van-der-waals", fixed={})
    for name, value in vars(truth).items():
        assert result.values[name] == pytest.approx(value, rel=1e-6)


def test_held_parameters_stay_and_have_no_standard_error():
    result = fit_hyperelastic(synthetic_stress("yeoh-bars-series-1"), "yeoh", fixed={"C10": 0.35})
    assert result.values["C10"] == 0.35
    assert result.names == ("C20", "C30")
    assert set(result.stderr) == {"C20", "C30"}
    with pytest.raises(ValueError, match="fixed holds C11; expected names of C10, C20, C30"):
        fit_hyperelastic(synthetic_stress("yeoh-bars-series-1"), "yeoh", fixed={"C11": 0.35})


def test_weighting_by_mode_counts_every_mode_alike():
    data = select_data(dataset_path("meunier2008"))
    many = pd.DataFrame(
        {"stretch": data.stretch, "nominal_stress_N_per_mm2": data.stress, "mode": data.mode}
    )
    repeated = pd.concat([many, many[many["mode"] == "uniaxial"]], ignore_index=True)
    first = fit_hyperelastic(many, "yeoh", weights="modes").values
    second = fit_hyperelastic(repeated, "yeoh", weights="modes").values
    assert first == pytest.approx(second, rel=1e-9)
    assert fit_hyperelastic(many, "yeoh").values["C10"] != pytest.approx(first["C10"], rel=1e-3)


def test_robust_loss_shrugs_off_outliers():
    table = synthetic_stress("yeoh-bars-series-1")
    table.loc[::20, "nominal_stress_N_per_mm2"] += 2.0
    plain = fit_hyperelastic(table, "yeoh")
    robust = fit_hyperelastic(table, "yeoh", loss="soft_l1", noise_N_per_mm2=0.02)
    assert robust.values["C10"] == pytest.approx(0.3494, abs=0.02)
    assert abs(plain.values["C10"] - 0.3494) > 3 * abs(robust.values["C10"] - 0.3494)
    assert any("bootstrap" in warning for warning in robust.warnings)


def test_unknown_names_are_refused():
    table = synthetic_stress("yeoh-bars-series-1")
    with pytest.raises(ValueError, match="model is 'gent'; expected one of"):
        fit_hyperelastic(table, "gent")
    with pytest.raises(ValueError, match="weights is 'none'; expected"):
        fit_hyperelastic(table, "yeoh", weights="none")
    with pytest.raises(ValueError, match="modes holds 'shear'; expected"):
        fit_hyperelastic(table, "yeoh", modes=["shear"])


def test_data_that_no_rubber_gives_end_in_one_sentence():
    stretch = np.linspace(1.1, 2.0, 10)
    table = pd.DataFrame(
        {"stretch": stretch, "nominal_stress_N_per_mm2": 1.0 - stretch, "mode": "uniaxial"}
    )
    with pytest.raises(DataError, match="tensile stretch"):
        fit_hyperelastic(table, "mooney-rivlin")
