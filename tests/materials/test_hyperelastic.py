"""Energies in homogeneous incompressible tests, and their parameter checks."""

import numpy as np
import pytest

from materials import MODES, ArrudaBoyce, MooneyRivlin, NeoHooke, VanDerWaals, Yeoh
from tests.materials.models import MODELS, constants, kind
from tests.reference_solutions import homogeneous

STRETCHES = np.array([0.75, 0.9, 1.1, 1.3, 1.6, 1.75])


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", MODELS)
def test_nominal_stress_is_the_derivative_of_the_energy_along_the_path(name, mode):
    model = MODELS[name]
    expected = homogeneous.nominal_stress(kind(model), constants(model), STRETCHES, mode)
    np.testing.assert_allclose(model.nominal_stress(STRETCHES, mode), expected, rtol=1e-10)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", MODELS)
def test_undeformed_state_is_free_of_stress(name, mode):
    assert MODELS[name].nominal_stress(1.0, mode) == 0.0


@pytest.mark.parametrize(
    ("mode", "factor"), [("uniaxial", 3.0), ("equibiaxial", 6.0), ("planar", 4.0)]
)
@pytest.mark.parametrize("name", MODELS)
def test_initial_slope_is_the_shear_modulus_times_the_factor_of_the_mode(name, mode, factor):
    model = MODELS[name]
    slope = (model.nominal_stress(1 + 1e-6, mode) - model.nominal_stress(1 - 1e-6, mode)) / 2e-6
    assert slope == pytest.approx(factor * model.initial_shear_modulus, rel=1e-5)


def test_yeoh_without_higher_terms_is_neo_hookean():
    np.testing.assert_allclose(
        Yeoh(C10=0.35).nominal_stress(STRETCHES, "uniaxial"),
        NeoHooke(G=0.7).nominal_stress(STRETCHES, "uniaxial"),
        rtol=1e-14,
    )


def test_mooney_rivlin_is_neo_hookean_in_incompressible_plane_strain():
    mooney = MODELS["mooney-rivlin-dumbbells"]
    assert mooney.initial_shear_modulus == pytest.approx(1.4334, abs=1e-12)
    np.testing.assert_allclose(
        mooney.nominal_stress(STRETCHES, "planar"),
        NeoHooke(G=1.4334).nominal_stress(STRETCHES, "planar"),
        rtol=1e-13,
    )


def test_van_der_waals_locks_near_3_34_in_plane_strain():
    model = MODELS["van-der-waals-bars-series-1"]
    lam = np.array([3.33, 3.36])
    I1 = lam**2 + lam**-2 + 1.0
    assert model.admissible(I1, np.ones(2)).tolist() == [True, False]


def test_van_der_waals_beyond_locking_is_nan_without_a_warning():
    with np.errstate(all="raise"):
        assert np.isnan(MODELS["van-der-waals-bars-series-1"].nominal_stress(4.0, "uniaxial"))


@pytest.mark.parametrize("name", MODELS)
def test_inverted_and_infinite_states_are_not_admissible(name):
    I1 = np.array([3.0, 3.0, 3.0, np.nan, np.inf])
    J = np.array([1.0, 0.0, -1.0, 1.0, 1.0])
    assert MODELS[name].admissible(I1, J).tolist() == [True, False, False, False, False]


@pytest.mark.parametrize("name", MODELS)
def test_shapes_and_scalars_are_kept(name):
    shape = (3, 4)
    derivatives = MODELS[name].derivatives(np.full(shape, 3.5), np.full(shape, 1.01))
    assert all(value.shape == shape for value in derivatives)
    assert all(np.shape(value) == () for value in MODELS[name].derivatives(3.5, 1.01))


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: NeoHooke(G=0.0), "G is 0; expected a number above zero"),
        (lambda: NeoHooke(G=float("nan")), "G is nan; expected a finite number"),
        (lambda: NeoHooke(G="1"), "G is '1'; expected a number"),
        (lambda: MooneyRivlin(C10=0.2, C01=-0.2), "C10 \\+ C01 is 0; expected"),
        (lambda: Yeoh(C10=-0.1), "C10 is -0.1; expected a number above zero"),
        (lambda: Yeoh(C10=0.1, C20=float("inf")), "C20 is inf; expected a finite number"),
        (lambda: VanDerWaals(G=1.0, lambda_m=1.5, a=0.1), "lambda_m is 1.5; expected a locking"),
        (lambda: VanDerWaals(G=1.0, lambda_m=-4.0, a=0.1), "lambda_m is -4; expected a locking"),
        (lambda: VanDerWaals(G=1.0, lambda_m=4.0, a=0.1, beta=2.0), "beta is 2; expected"),
        (lambda: ArrudaBoyce(C1=1.0, lambda_m=1.0), "lambda_m is 1; expected a stretch above 1"),
        (lambda: Yeoh(C10=0.1).nominal_stress(-1.0), "stretch holds -1; expected values above"),
        (lambda: Yeoh(C10=0.1).nominal_stress(1.0, "shear"), "mode is 'shear'; expected one of"),
    ],
)
def test_wrong_parameters_are_refused_in_one_sentence(build, message):
    with pytest.raises(ValueError, match=message) as caught:
        build()
    assert "\n" not in str(caught.value)
