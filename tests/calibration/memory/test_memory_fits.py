"""Fits of relaxation times and softening: known parameters come back, wrong data are refused."""

import numpy as np
import pandas as pd
import pytest

from calibration import DataError, fit_mullins, fit_viscoelastic
from calibration.memory.histories import branch_responses, read_histories
from calibration.memory.spectrum import independent_share, memory_problem
from calibration.memory.sweeps import moduli_curve, read_moduli, shifted_problem
from calibration.memory.viscoelastic import HistoryFit
from calibration.rubber.stress_models import STRESS_MODELS
from materials import WLF, NeoHooke, Prony, Rubber, Yeoh
from materials.homogeneous import branch_histories
from tests.calibration.memory import made_up_tests as made_up

#: Kind of test: its table by seed, its parameters, and the fit.
KINDS = {
    "relaxation": (
        made_up.relaxation, made_up.RELAXATION, lambda t: fit_viscoelastic(t, "neo-hooke"),
    ),
    "stepwise relaxation": (made_up.stepwise_relaxation, made_up.STEPWISE, fit_viscoelastic),
    "cycles": (made_up.cycles, made_up.CYCLES, fit_viscoelastic),
    "sweeps": (made_up.sweeps, made_up.SWEEPS, lambda t: fit_viscoelastic(t, T_ref_C=20.0)),
    "softening": (made_up.softening_cycles, made_up.SOFTENING, fit_mullins),
}  # fmt: skip


def comes_back(kind, seed):
    """Whether all parameters of a seed lie within three standard errors."""
    table, expected, fit = KINDS[kind]
    result = fit(table(seed))
    return set(result.values) == set(expected) and all(
        abs(result.values[name] - value) <= 3.0 * result.stderr[name]
        for name, value in expected.items()
    )


@pytest.mark.parametrize("kind", KINDS)
def test_parameters_come_back_within_three_standard_errors(kind):
    assert comes_back(kind, 1)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_parameters_of_95_in_100_seeds_come_back(kind):
    assert sum(comes_back(kind, seed) for seed in range(100)) >= 95


def test_problems_have_the_derivatives_of_their_predictions():
    data = read_histories(made_up.cycles(0))
    slow = {
        "yeoh": [0.4, -0.03, 0.01],
        "van-der-waals": [0.7, 3.0, 0.5, 0.1],
        "ogden-2": [0.5, 1.8, 0.1, 3.0],
    }
    for model, constants in slow.items():
        law = STRESS_MODELS[model]
        work = HistoryFit(
            law=law, model=model, data=data, shift=None, T_ref_C=20.0, weights="tests"
        )
        curve = work.curve({})
        theta = np.array([*constants, 0.5, 0.3, 0.4, 30.0])
        same_slopes(memory_problem(curve, 2), theta)
        same_slopes(memory_problem(curve, 2, logarithmic=True), np.append(theta[:-2], [-1.0, 3.0]))
    moduli = read_moduli(made_up.sweeps(0), T_ref_C=20.0)
    same_slopes(shifted_problem(moduli, 2), np.array([2.1, 0.9, 0.5, 1e-3, 0.7, 6.5, 120.0]))


def same_slopes(problem, theta):
    exact, size = problem.slopes(theta), np.abs(problem.observed).max()
    for k in range(theta.size):
        h = 1e-5 * max(abs(theta[k]), 1e-3)
        shift = h * (np.arange(theta.size) == k)
        slope = (problem.residuals(theta + shift) - problem.residuals(theta - shift)) / (2 * h)
        rounding = 1e-10 * size  # of the slow modulus, read off a strain of 1e-6
        atol = 1e-6 * np.abs(slope).max() + 0.1 * rounding / h
        np.testing.assert_allclose(exact[:, k], slope, rtol=1e-5, atol=atol)


def test_the_spline_over_relaxation_times_is_the_history_to_1e_5():
    data = read_histories(made_up.cycles(0))
    log_tau = np.log([0.0712, 1.234, 77.7])
    values, _ = branch_responses(data, (0.03, 640.0), None, 20.0)(log_tau)
    for test in data.tests:
        h = np.concatenate([[0.0], np.diff(test.time)])[:, None] / np.exp(log_tau)
        exact = branch_histories(h, test.stretch, "uniaxial").stress
        np.testing.assert_allclose(values[test.here], exact, atol=1e-5 * np.abs(exact).max())


def test_a_fit_predicts_a_test_that_it_has_not_seen():
    rubber = fit_viscoelastic(made_up.cycles(3)).model
    law, branches = made_up.split(made_up.CYCLES, *made_up.YEOH)
    time = np.concatenate([[0.0, 0.0], np.geomspace(0.1, 300.0, 40)])
    stretch = np.append(1.0, np.full(41, 1.6))
    truth = Rubber(elastic=Yeoh(**law), viscous=made_up.spectrum(**branches))
    expected = truth.nominal_stress(time, stretch)
    error = rubber.nominal_stress(time, stretch) - expected
    assert np.abs(error).max() < 0.02 * expected.max()


def test_as_few_branches_as_the_data_support_or_as_are_asked_for():
    result = fit_viscoelastic(made_up.cycles(0))
    tried = dict(
        zip(result.metadata["branches_tried"], result.metadata["rmse_by_branches"], strict=True)
    )
    assert result.metadata["branches"] == 3
    assert tried[2] > 3 * tried[3]
    assert tried[3] < 1.01 * tried[max(tried)]
    two = fit_viscoelastic(made_up.cycles(0), branches=2)
    assert two.metadata["branches"] == 2
    assert any("what is left is of the model" in warning for warning in two.warnings)
    with pytest.raises(DataError, match="at most [0-9]+ relaxation times, expected data for 30"):
        fit_viscoelastic(made_up.cycles(0), branches=30)


def test_independent_points_are_all_of_noise_and_few_of_a_wave():
    noise = np.random.default_rng(0).normal(size=4000)
    assert independent_share(noise) == pytest.approx(1.0, abs=0.05)
    assert independent_share(np.sin(np.linspace(0, 20 * np.pi, 4000))) == pytest.approx(
        0.01, rel=0.1
    )


def test_held_constants_and_earlier_cycles_are_respected():
    table = made_up.cycles(0)
    table["cycle"] = 1 + (table.groupby("test").cumcount() > 100)
    result = fit_viscoelastic(table, fixed={"C30": 0.006}, from_cycle=2)
    assert result.values["C30"] == 0.006
    assert "C30" not in result.names
    assert result.n_data == 300
    assert result.values["g2"] == pytest.approx(0.4, rel=0.05)
    assert "they load the rubber" in result.metadata["rows_left_out"][0]


def test_of_long_records_the_rows_that_follow_their_course_are_used_and_it_is_said(monkeypatch):
    time = np.concatenate([[0.0], np.linspace(0.0, 200.0, 4001)])
    stretch = np.append(1.0, np.full(4001, 1.5))
    law, branches = made_up.split(made_up.RELAXATION, "G")
    rubber = Rubber(elastic=NeoHooke(**law), viscous=made_up.spectrum(**branches))
    stress = rubber.nominal_stress(time, stretch)
    columns = {"time_s": time, "stretch": stretch, "nominal_stress_N_per_mm2": stress}
    table = pd.DataFrame(columns)
    monkeypatch.setattr("calibration.memory.histories._MOST_ROWS", 400)
    result = fit_viscoelastic(table, "neo-hooke")
    assert 100 < result.n_data <= 400
    assert "between rows that follow the long record" in result.metadata["rows_left_out"][0]
    assert result.values["tau2_s"] == pytest.approx(2.0, rel=0.02)


def test_tests_at_several_temperatures_are_one_spectrum_with_a_shift():
    shift = WLF(d1=7.0, d2_K=120.0)
    rubber = Rubber(
        elastic=NeoHooke(G=0.8), viscous=Prony(g=[0.5], tau_s=[2.0], shift=shift, T_ref_C=25.0)
    )
    parts = []
    for T in (5.0, 25.0, 45.0):
        time = np.concatenate([[0.0, 0.0], np.geomspace(0.01, 100.0, 60)])
        stretch = np.append(1.0, np.full(61, 1.4))
        stress = rubber.nominal_stress(time, stretch, T_C=T)
        columns = {"time_s": time, "stretch": stretch, "nominal_stress_N_per_mm2": stress}
        parts.append(pd.DataFrame({"test": f"at {T:g}", **columns, "T_C": T}))
    table = pd.concat(parts, ignore_index=True)
    result = fit_viscoelastic(table, "neo-hooke", shift=shift, T_ref_C=25.0)
    assert result.values["tau1_s"] == pytest.approx(2.0, rel=1e-3)
    assert result.section["rubber"]["viscoelastic"]["C2_K"] == 120.0
    without = fit_viscoelastic(table, "neo-hooke")
    assert without.rmse > 10 * result.rmse
    assert "shifts nothing" in without.metadata["notes"][-1]


def test_one_sweep_needs_no_temperature_and_gives_no_shift():
    table = made_up.sweeps(0, temperatures=(20,)).drop(columns="T_C")
    slow = table.assign(frequency_Hz=table.frequency_Hz / 1e3)  # down to the plateau
    omega = 2 * np.pi * slow.frequency_Hz.to_numpy()
    storage, loss = Prony(g=[0.5], tau_s=[1.0 / omega[7]]).harmonic_moduli(omega)
    slow["modulus_N_per_mm2"], slow["loss_modulus_N_per_mm2"] = 2.0 * storage, 2.0 * loss
    result = fit_viscoelastic(slow)
    assert result.values["g1"] == pytest.approx(0.5, rel=1e-6)
    assert result.model.shift is None
    ratio = slow.assign(tan_delta=loss / storage).drop(columns="loss_modulus_N_per_mm2")
    assert fit_viscoelastic(ratio).values["g1"] == pytest.approx(0.5, rel=1e-6)


def test_moduli_of_a_master_curve_are_those_of_its_spectrum():
    data = read_moduli(made_up.sweeps(0, noise=0.0), T_ref_C=20.0)
    log_tau = np.log([1e-5, 1e-3, 0.1, 8.0])
    response = moduli_curve(data, WLF(d1=7.0, d2_K=130.0)).branch(log_tau)[0]
    size = data.omega.size
    expected = 2.0 * (response @ [2.0, 1.0, 0.6, 0.4] + np.repeat([1.0, 0.0], size))
    np.testing.assert_allclose(data.observed, expected, rtol=1e-9)


def test_one_level_of_strain_says_that_m_and_beta_are_alike():
    table = made_up.softening_cycles(0).iloc[:81]
    assert any("one level" in warning for warning in fit_mullins(table).warnings)
    held = fit_mullins(table, fixed={"beta": 0.2})
    assert not any("one level" in warning for warning in held.warnings)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: t.assign(time_s=t.time_s.iloc[::-1].to_numpy()), "times that do not fall"),
        (lambda t: t.assign(time_s=1.0), "found one time, expected times that go on"),
        (lambda t: t.iloc[:3], "3 rows of the test uniaxial, expected at least 5"),
        (lambda t: t.drop(columns="time_s"), "expected a column named time_s"),
        (lambda t: t.assign(nominal_stress_N_per_mm2=0.0), "zero in every row"),
    ],
)
def test_histories_that_cannot_be_meant_are_refused(change, message):
    with pytest.raises(DataError, match=message):
        fit_viscoelastic(change(made_up.relaxation(0)), "neo-hooke")


def test_an_elastic_rubber_has_no_relaxation_to_fit():
    table = made_up.relaxation(0)
    elastic = NeoHooke(G=0.8).nominal_stress(table.stretch)
    noise = 0.003 * np.random.default_rng(0).normal(size=len(table))
    with pytest.raises(DataError, match="no relaxation explains better"):
        fit_viscoelastic(table.assign(nominal_stress_N_per_mm2=elastic + noise), "neo-hooke")


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: fit_viscoelastic(made_up.sweeps(0), "yeoh"),
            "model is 'yeoh'; expected it for st",
        ),
        (
            lambda: fit_viscoelastic(made_up.relaxation(0), vertical="none"),
            "vertical is 'none'; exp",
        ),
        (
            lambda: fit_viscoelastic(made_up.relaxation(0), "hooke"),
            "model is 'hooke'; expected one",
        ),
        (lambda: fit_viscoelastic(made_up.relaxation(0), fixed={"g1": 1.0}), "fixed holds g1; exp"),
        (lambda: fit_viscoelastic(made_up.relaxation(0), branches=0), "branches is 0; expected 1"),
        (lambda: fit_mullins(made_up.softening_cycles(0), "hooke"), "model is 'hooke'; expected"),
        (lambda: fit_mullins(made_up.softening_cycles(0).iloc[:21]), "0 rows below an earlier"),
    ],
)
def test_wrong_options_are_refused_in_one_sentence(call, message):
    with pytest.raises(ValueError, match=message):
        call()
