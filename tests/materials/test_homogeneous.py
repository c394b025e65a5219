"""Histories of homogeneous tests against closed forms and an independent integration."""

import numpy as np
import pytest

from materials import COMPOUNDS, MODES, WLF, NeoHooke, OgdenRoxburgh, Prony, Rubber, Yeoh
from tests.materials.memory import SPECTRUM
from tests.materials.models import MODELS, constants, kind
from tests.reference_solutions import homogeneous, viscoelastic

#: Young's modulus over shear modulus of the mode.
SLOPES = {"uniaxial": 3.0, "equibiaxial": 6.0, "planar": 4.0}
RUBBER = Rubber(elastic=NeoHooke(G=0.8), viscous=SPECTRUM)


@pytest.mark.parametrize("moduli", ["long-term", "instantaneous"])
@pytest.mark.parametrize("mode", MODES)
def test_relaxation_after_a_small_step_is_the_prony_series(mode, moduli):
    spectrum = Prony(g=[0.3, 0.2, 0.1], tau_s=[1e-3, 0.1, 5.0], moduli=moduli)
    rubber, strain = Rubber(elastic=NeoHooke(G=0.8), viscous=spectrum), 1e-7
    time = np.concatenate([[0.0, 0.0], np.geomspace(1e-4, 100.0, 40)])
    stress = rubber.nominal_stress(time, np.append(1.0, np.full(41, 1.0 + strain)), mode)
    decay = 0.3 * np.exp(-time / 1e-3) + 0.2 * np.exp(-time / 0.1) + 0.1 * np.exp(-time / 5.0)
    expected = 0.8 * ((1.0 if moduli == "long-term" else 0.4) + decay)
    np.testing.assert_allclose(stress[1:] / (SLOPES[mode] * strain), expected[1:], rtol=1e-6)


@pytest.mark.parametrize("mode", MODES)
def test_harmonic_moduli_and_loss_per_cycle_over_four_decades(mode):
    strain = 1e-5
    for omega in np.geomspace(0.1, 1e3, 5):
        cycles = 2 + int(np.ceil(omega * 20.0 / (2 * np.pi))) if omega < 10 else 4
        phase = np.linspace(0.0, 2 * np.pi * cycles, 200 * cycles + 1)
        spectrum = Prony(g=[0.5, 0.3], tau_s=[1.0 / omega, 0.1 / omega])
        test = Rubber(elastic=NeoHooke(G=0.8), viscous=spectrum).test(
            phase / omega, 1 + strain * np.sin(phase), mode
        )
        last = slice(-200, None)
        scale = 100.0 * SLOPES[mode] * 0.8 * strain
        storage = np.sum(test.nominal_stress[last] * np.sin(phase[last])) / scale
        loss = np.sum(test.nominal_stress[last] * np.cos(phase[last])) / scale
        expected = spectrum.harmonic_moduli(omega)
        assert expected[0] == pytest.approx(1 + 0.5 / 2 + 0.3 * 0.01 / 1.01, rel=1e-12)
        assert expected[1] == pytest.approx(0.5 / 2 + 0.3 * 0.1 / 1.01, rel=1e-12)
        assert storage == pytest.approx(expected[0], rel=5e-3)
        assert loss == pytest.approx(expected[1], rel=5e-3)
        # pi E'' eps0^2 per cycle; the strain is that of the mode's direction
        work = {"uniaxial": 1.0, "equibiaxial": 2.0, "planar": 1.0}[mode]
        dissipated = test.viscous[-1] - test.viscous[-201]
        closed = np.pi * work * SLOPES[mode] * 0.8 * expected[1] * strain**2
        assert dissipated == pytest.approx(closed, rel=1e-2)


def test_rod_under_constant_stress_creeps_as_the_closed_form():
    E_slow, E_fast, small = 6.89, 68.9, 1e-4
    rubber = Rubber(elastic=NeoHooke(G=E_slow / 3), viscous=Prony(g=[9.0], tau_s=[1.0]))
    time = np.append(0.0, np.linspace(0.0, 20.0, 201))
    strain = np.zeros_like(time)
    for _ in range(90):  # Picard's iteration of the Volterra equation
        missing = 0.689 * small - rubber.nominal_stress(time, 1 + strain)
        strain[1:] += missing[1:] / E_fast
    assert np.abs(missing[1:]).max() < 1e-9 * small
    at = {t: strain[1 + int(t * 10)] / small for t in (0, 5, 20)}
    assert [round(value, 4) for value in at.values()] == [0.01, 0.0454, 0.0878]
    closed = viscoelastic.creep_of_a_rod(
        time[1:], E_slow=E_slow, E_fast=E_fast, tau=1.0, stress=0.689 * small
    )
    np.testing.assert_allclose(strain[1:], closed, rtol=5e-3)


@pytest.mark.parametrize("mode", MODES)
def test_large_cycles_reach_an_independent_integration_with_order_two(mode):
    paths = {
        "uniaxial": (1.0, -0.5, -0.5),
        "equibiaxial": (1.0, 1.0, -2.0),
        "planar": (1.0, 0.0, -1.0),
    }

    def stretch(t):
        return 1.0 + 0.6 * np.sin(3.0 * t) ** 2

    times = np.array([0.4, 1.0, 1.6])
    tau, lost = viscoelastic.branch(
        lambda t: np.diag(stretch(t) ** np.array(paths[mode])), times, G=0.9, tau=0.3
    )
    elastic = Yeoh(C10=0.45, C20=0.02)
    rubber = Rubber(elastic=elastic, viscous=Prony(g=[1.0], tau_s=[0.3]))
    lam = stretch(times)
    expected = elastic.nominal_stress(lam, mode) + (tau[:, 0, 0] - tau[:, 2, 2]) / lam
    errors = []
    for rows in (40, 80, 160):
        time = np.linspace(0.0, 1.6, rows + 1)
        test, at = rubber.test(time, stretch(time), mode), (times * rows / 1.6).round().astype(int)
        errors.append(
            [
                np.abs(test.nominal_stress[at] - expected).max(),
                np.abs(test.viscous[at] - lost).max(),
            ]
        )
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    np.testing.assert_allclose(orders, 2.0, atol=0.15)
    assert np.max(errors[-1]) < 1e-3


def test_temperature_shifts_the_relaxation_times():
    shift = WLF(d1=7.0, d2_K=120.0)
    warm = Rubber(
        elastic=NeoHooke(G=1.0), viscous=Prony(g=[0.5], tau_s=[0.1], shift=shift, T_ref_C=20.0)
    )
    plain = Rubber(elastic=NeoHooke(G=1.0), viscous=Prony(g=[0.5], tau_s=[0.1]))
    time = np.linspace(0.0, 1.0, 101)
    lam = 1.0 + 0.3 * time
    a_T = 10.0 ** -(7.0 * 25.0 / 145.0)
    expected = plain.nominal_stress(time / a_T, lam)
    np.testing.assert_allclose(warm.nominal_stress(time, lam, T_C=45.0), expected, rtol=1e-12)
    np.testing.assert_allclose(
        warm.nominal_stress(time, lam, T_C=np.full(101, 45.0)), expected, rtol=1e-12
    )
    at_reference = warm.nominal_stress(time, lam)
    np.testing.assert_allclose(at_reference, plain.nominal_stress(time, lam), rtol=1e-12)


SOFT = OgdenRoxburgh(r=2.0, m=0.3, beta=0.1)
CYCLES = 1.0 + np.interp(np.arange(601) / 100, [0, 1, 2, 3.8, 5, 6], [0.0, 0.5, 0.0, 0.9, 0.0, 0.4])


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", COMPOUNDS)
def test_softening_acts_below_the_largest_load_and_not_above(name, mode):
    elastic = COMPOUNDS[name]
    test = Rubber(elastic=elastic, damage=SOFT).test(np.arange(601.0), CYCLES, mode)
    virgin = elastic.nominal_stress(CYCLES, mode)
    above = np.zeros(601, dtype=bool)
    above[:101] = True
    above[200:381] = CYCLES[200:381] > 1.5
    # the first loading and what goes beyond its maximum follow the virgin curve, permanently
    np.testing.assert_allclose(test.nominal_stress[above], virgin[above], rtol=1e-12)
    below = ~above & (CYCLES > 1.0 + 1e-9) & (CYCLES < 1.5 - 1e-9)
    assert np.all(test.nominal_stress[below] < virgin[below])
    # a second loading to the old maximum retraces the unloading
    np.testing.assert_allclose(
        test.nominal_stress[200:240], test.nominal_stress[200:160:-1], rtol=1e-9
    )


@pytest.mark.parametrize("mode", MODES)
def test_work_on_softening_rubber_is_stored_or_consumed(mode):
    elastic = COMPOUNDS["yeoh-bars-series-1"]
    test = Rubber(elastic=elastic, damage=SOFT).test(np.arange(601.0), CYCLES, mode)
    pulled = 2.0 if mode == "equibiaxial" else 1.0
    P = test.nominal_stress
    work = np.append(0.0, np.cumsum(0.5 * pulled * (P[1:] + P[:-1]) * np.diff(CYCLES)))
    np.testing.assert_allclose(test.stored + test.damage, work, atol=1e-3 * work.max())
    assert np.all(np.diff(test.damage) >= 0.0)
    at_rest = np.array([200, 500])
    np.testing.assert_allclose(test.stored[at_rest], 0.0, atol=1e-12)
    np.testing.assert_allclose(test.damage[at_rest], work[at_rest], rtol=1e-2)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", MODELS)
def test_energy_of_a_homogeneous_test_is_its_definition(name, mode):
    model, lam = MODELS[name], np.array([0.8, 1.0, 1.4])
    path, _ = homogeneous.PATHS[mode]
    stretches = path(lam.astype(complex))
    expected = homogeneous.isochoric_energy(kind(model), constants(model), *stretches).real
    np.testing.assert_allclose(model.strain_energy(lam, mode), expected, rtol=1e-11, atol=1e-14)


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: Prony(g=[], tau_s=[]), "g has 0 and tau_s 0 entries; expected"),
        (lambda: Prony(g=[0.1], tau_s=[1.0, 2.0]), "g has 1 and tau_s 2 entries; expected"),
        (lambda: Prony(g=0.1, tau_s=[1.0]), "g is 0.1; expected a list of numbers"),
        (
            lambda: Prony(g=[0.1, -0.2], tau_s=[1.0, 2.0]),
            r"g\[2\] is -0.2; expected a number above",
        ),
        (lambda: Prony(g=[0.1], tau_s=[0.0]), r"tau_s\[1\] is 0; expected a number above zero"),
        (lambda: Prony(g=[0.1], tau_s=["1"]), r"tau_s\[1\] is '1'; expected a number"),
        (lambda: Prony(g=[0.1], tau_s=[1.0], moduli="short"), "moduli is 'short'; expected one of"),
        (
            lambda: Prony(g=[0.6, 0.4], tau_s=[1.0, 2.0], moduli="instantaneous"),
            "the sum of g is 1; expected less than 1",
        ),
        (lambda: Prony(g=[0.1], tau_s=[1.0], T_ref_C=float("nan")), "T_ref_C is nan; expected"),
        (lambda: OgdenRoxburgh(r=0.9, m=0.1), "r is 0.9; expected a number from 1 on"),
        (lambda: OgdenRoxburgh(r=2.0, m=0.0), "m is 0; expected a number above zero"),
        (lambda: OgdenRoxburgh(r=2.0, m=0.1, beta=-1.0), "beta is -1; expected zero or more"),
        (lambda: RUBBER.nominal_stress([0.0, 1.0], [1.0]), "time_s has the shape"),
        (
            lambda: RUBBER.nominal_stress([0.0, 2.0, 1.0], [1.0, 1.1, 1.2]),
            "time_s falls from 2 to 1",
        ),
        (lambda: RUBBER.nominal_stress([0.0, np.nan], [1.0, 1.1]), "time_s or stretch holds nan"),
        (lambda: RUBBER.nominal_stress([0.0, 1.0], [1.0, -0.1]), "stretch holds -0.1; expected"),
        (lambda: RUBBER.nominal_stress([0.0], [1.0], "shear"), "mode is 'shear'; expected one of"),
        (
            lambda: RUBBER.nominal_stress([0.0], [1.0], T_C=20.0),
            "T_C is given; expected none for b",
        ),
        (
            lambda: Rubber(elastic=NeoHooke(G=1.0)).nominal_stress([0.0], [1.0], T_C=20.0),
            "T_C is given; expected none for rubber without",
        ),
    ],
)
def test_wrong_parameters_are_refused_in_one_sentence(build, message):
    with pytest.raises(ValueError, match=message) as caught:
        build()
    assert "\n" not in str(caught.value)
