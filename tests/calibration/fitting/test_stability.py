"""Where fitted energies lose stability."""

import numpy as np
import pytest

from calibration.fitting.stability import check_stability, drucker_margin, ellipticity_margin
from materials import MODES, MooneyRivlin, NeoHooke, Ogden, VanDerWaals, Yeoh, compound
from tests.materials.models import MODELS, constants, kind
from tests.reference_solutions import homogeneous

OGDEN = Ogden(mu=(0.4, 0.01, 0.05), alpha=(1.3, 5.0, -2.0))
E1, E2 = np.array([0.3, -0.2, 0.5]), np.array([0.1, 0.4, -0.5])


@pytest.mark.parametrize("name", MODELS)
def test_log_derivatives_match_central_differences(name):
    model, h = MODELS[name], 1e-6
    gradient, hessian = model.log_derivatives(E1, E2)
    for j, (d1, d2) in enumerate([(h, 0.0), (0.0, h)]):
        up, down = model.log_derivatives(E1 + d1, E2 + d2), model.log_derivatives(E1 - d1, E2 - d2)
        slope = (up[0] - down[0]) / (2 * h)
        np.testing.assert_allclose(hessian[:, :, j], slope, rtol=1e-7, atol=1e-8)
    stretches = [np.exp(e).astype(complex) for e in (E1, E2, -E1 - E2)]
    step = 1e-100
    moved = [stretches[0] * (1 + 1j * step), stretches[1], stretches[2] / (1 + 1j * step)]
    W = homogeneous.isochoric_energy(kind(model), constants(model), *moved)
    np.testing.assert_allclose(gradient[:, 0], W.imag / step, rtol=1e-9, atol=1e-12)


def test_gradient_is_the_cauchy_stress_of_a_uniaxial_test():
    lam = np.array([0.7, 1.4, 2.0])
    gradient, _ = OGDEN.log_derivatives(np.log(lam), -0.5 * np.log(lam))
    np.testing.assert_allclose(gradient[:, 0], lam * OGDEN.nominal_stress(lam, "uniaxial"))


def test_neo_hooke_is_stable_everywhere():
    found = check_stability(NeoHooke(G=0.7), {"uniaxial": (0.5, 5.0)})
    assert found.stable
    assert found.drucker == dict.fromkeys(MODES, (0.0, np.inf))
    assert found.ellipticity == (0.0, np.inf)


def test_initial_margins_are_those_of_linear_elasticity():
    one = np.array([1.0])
    for mode in MODES:
        assert drucker_margin(NeoHooke(G=0.7), one, mode) == pytest.approx(2.0)
    assert ellipticity_margin(NeoHooke(G=0.7), one) == pytest.approx(1.0)


def test_ellipticity_of_yeoh_ends_where_the_shear_stress_stops_rising():
    # tau = 2 k W'(3 + k^2): d tau/dk = 0 for W' + 2 k^2 W'' = 0, a quadratic in k^2
    model = Yeoh(C10=0.4, C20=-0.05)
    k = np.sqrt(0.4 / (6 * 0.05))
    lam = 0.5 * (k + np.sqrt(k * k + 4.0))
    found = check_stability(model, {"planar": (1.0, 2.5)})
    assert found.ellipticity[1] == pytest.approx(lam, rel=1e-8)
    assert found.ellipticity[0] == pytest.approx(1 / lam, rel=1e-8)
    assert not found.stable
    assert any(f"above the stretch {lam:.4g}" in sentence for sentence in found.warnings)


def test_drucker_ends_no_later_than_the_top_of_the_true_stress():
    # along a test the true stress rises while the Hessian is positive definite
    model = Yeoh(C10=0.4, C20=-0.05)
    found = check_stability(model, {"uniaxial": (1.0, 3.0)})
    lam = np.linspace(1.0, 4.0, 4000)
    top = lam[np.argmax(lam * model.nominal_stress(lam, "uniaxial"))]
    assert 1.0 < found.drucker["uniaxial"][1] <= top + 1e-3


def test_the_loading_set_with_negative_c30_is_stable_over_its_bars_but_not_for_ever():
    found = check_stability(compound("yeoh-bars-series-1-load"), {"uniaxial": (1.0, 2.5)})
    assert found.stable
    assert 3.0 < found.ellipticity[1] < 8.0


def test_a_locking_stretch_is_no_loss_of_stability():
    found = check_stability(VanDerWaals(G=0.75, lambda_m=3.5, a=1.0), {"uniaxial": (1.0, 2.5)})
    assert found.drucker["uniaxial"][1] == np.inf


def test_instability_outside_the_tests_is_named_for_every_mode():
    model = MooneyRivlin(C10=0.5, C01=-0.15)
    found = check_stability(model, {"uniaxial": (1.0, 1.8)})
    assert found.stable
    assert found.warnings == ()
    ends = {mode: found.drucker[mode] for mode in MODES}
    for mode, (low, high) in ends.items():
        assert (
            f"outside the tests, {mode}: the energy is not stable (Drucker) below the stretch "
            in (found.text)
        )
        assert (
            f"{mode}: the energy is not stable (Drucker) above the stretch {high:.4g}" in found.text
        )
        margins = drucker_margin(model, np.array([0.999 * low, 1.001 * low]), mode)
        assert margins[0] < 0.0 < margins[1]
    assert ends["equibiaxial"] == pytest.approx((0.740, 1.404), abs=1e-3)
    assert ends["planar"][1] == pytest.approx(1.73, abs=1e-3)
    assert "stable over the data and from 0.3 to 3" in check_stability(NeoHooke(G=1.0), {}).text


def test_warnings_count_only_inside_the_data():
    model = Yeoh(C10=0.4, C20=-0.05)
    end = check_stability(model, {}).drucker["uniaxial"][1]
    assert check_stability(model, {"uniaxial": (1.0, 0.9 * min(end, 1.9))}).stable
    assert check_stability(model, {}).warnings == ()
