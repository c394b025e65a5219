"""Rubber with branches and softening in plane strain: stress, tangent, energy, history."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from materials import COMPOUNDS, NeoHooke, Prony, Rubber
from tests.materials.memory import (
    RUBBERS,
    SOFTENING,
    SPECTRUM,
    after,
    random_deformations,
)
from tests.reference_solutions import viscoelastic
from tests.reference_solutions.plane_strain import (
    deformation_of,
    dP_dF,
    first_piola_kirchhoff,
    step_stress,
    step_tangent,
)

SHEAR = Rubber(elastic=NeoHooke(G=1.0), viscous=Prony(g=[1.0], tau_s=[0.5]))


def prepared(name, size=20, seed=5):
    """A rubber, its state after some steps and deformations that go on from there."""
    rng = np.random.default_rng(seed)
    rubber = RUBBERS[name]
    past = [random_deformations(rng, size) for _ in range(3)]
    return rubber, after(rubber, past, 0.01), random_deformations(rng, size)


def sheared(gamma):
    return np.array([[[1.0, gamma], [0.0, 1.0]]])


def ramp(t):
    return 0.5 * min(t, 1.0)


def simple_shear(steps, end=3.0):
    """Shear stress, normal stress difference and dissipated energy by time: ramp, then rest."""
    state, lost, found = SHEAR.virgin((1,)), 0.0, {}
    for i in range(1, steps + 1):
        F = sheared(ramp(i * end / steps))
        step = SHEAR.step(state, end / steps)
        kirchhoff = (step_stress(step, F) @ np.swapaxes(F, -1, -2))[0]
        lost += step.end(deformation_of(F)).viscous[0]
        state = step.end(deformation_of(F)).state
        found[round(i * end / steps, 9)] = (
            kirchhoff[0, 1],
            kirchhoff[0, 0] - kirchhoff[1, 1],
            lost,
        )
    return found


def test_simple_shear_reaches_an_independent_integration_with_order_two():
    times = np.array([0.5, 1.0, 1.5, 2.0, 3.0])

    def F(t):
        return np.array([[1.0, ramp(t), 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])

    tau, lost = viscoelastic.branch(F, times, G=1.0, tau=0.5, breaks=[1.0])
    gamma = np.array([ramp(t) for t in times])
    expected = np.stack([gamma + tau[:, 0, 1], gamma**2 + tau[:, 0, 0] - tau[:, 1, 1], lost], 1)
    errors = []
    for steps in (30, 60, 120, 600):
        found = simple_shear(steps)
        errors.append(np.abs([found[t] for t in times] - expected).max(axis=0))
    for coarse, fine in pairwise(errors[:3]):
        np.testing.assert_allclose(np.log2(coarse / fine), 2.0, atol=0.1)
    assert errors[-1].max() < 1e-6


@pytest.mark.parametrize("name", RUBBERS)
def test_tangent_with_history_matches_central_differences(name):
    rubber, state, F = prepared(name)
    step, h = rubber.step(state, 0.02), 1e-6
    A = step_tangent(step, F)
    for k in range(2):
        for j in range(2):
            shift = np.zeros((2, 2))
            shift[k, j] = h
            above, below = (step_stress(step, F + sign * shift) for sign in (1, -1))
            difference = (above - below) / (2 * h)
            np.testing.assert_allclose(
                A[..., k, j], difference, rtol=1e-6, atol=1e-6 * np.abs(A).max()
            )


@pytest.mark.parametrize("name", RUBBERS)
def test_tangent_with_history_is_symmetric(name):
    rubber, state, F = prepared(name)
    A = step_tangent(rubber.step(state, 0.02), F)
    np.testing.assert_allclose(A, np.einsum("...ijkl->...klij", A), rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("name", RUBBERS)
def test_stress_turns_with_the_frame_and_energies_do_not(name):
    rubber, state, F = prepared(name)
    R = np.array([[np.cos(0.8), -np.sin(0.8)], [np.sin(0.8), np.cos(0.8)]])
    step = rubber.step(state, 0.02)
    P, turned = step_stress(step, F), step_stress(step, R @ F)
    np.testing.assert_allclose(turned, R @ P, rtol=0, atol=1e-12)
    one, other = (step.end(deformation_of(Q @ F)) for Q in (np.eye(2), R))
    for part in ("stored", "viscous", "damage", "softening", "state"):
        if getattr(one, part) is not None:
            np.testing.assert_allclose(getattr(one, part), getattr(other, part), rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", RUBBERS)
def test_newton_on_a_step_with_history_converges_quadratically(name):
    # F of a given stress; the mean stress of K (J - 1) makes the problem regular.
    rubber, state, F = prepared(name, size=1)
    step = rubber.step(state, 0.02)

    def residual(F):
        J = np.linalg.det(F)
        return step_stress(step, F) + (20.0 * (J - 1.0))[:, None, None] * J[
            :, None, None
        ] * np.linalg.inv(F).swapaxes(-1, -2)

    def tangent(F):
        J, inverse = np.linalg.det(F)[0], np.linalg.inv(F)[0]
        mean = 20.0 * (J - 1.0) * J
        A = step_tangent(step, F)[0] + 20.0 * J * (2 * J - 1) * np.einsum(
            "ji,lk->ijkl", inverse, inverse
        )
        return (A - mean * np.einsum("li,jk->ijkl", inverse, inverse)).reshape(4, 4)

    target, x, norms = residual(F), F + 0.02 * np.array([[0.7, -0.4], [0.5, 0.3]]), []
    for _ in range(6):
        r = residual(x) - target
        norms.append(np.abs(r).max())
        x = x - np.linalg.solve(tangent(x), r.ravel()).reshape(1, 2, 2)
    assert norms[-1] < 1e-12
    fast = [(a, b) for a, b in pairwise(norms) if 1e-7 < a < 1e-2]
    assert fast
    assert all(b < 30.0 * a * a for a, b in fast)


@given(
    seed=st.integers(0, 2**32 - 1),
    decades=st.floats(-6, 4),
    spread=st.floats(0.01, 0.6),
    name=st.sampled_from(sorted(RUBBERS)),
)
@settings(max_examples=60, deadline=None)
def test_nothing_ever_gives_energy_for_free(seed, decades, spread, name):
    """Dissipation and damage are never negative, the stored energy neither, whatever happens."""
    rng = np.random.default_rng(seed)
    rubber = RUBBERS[name]
    state = rubber.virgin((5,))
    for _ in range(8):
        F = random_deformations(rng, 5, spread)
        deformation = deformation_of(F)
        if not np.all(rubber.admissible(deformation.I1, deformation.J)):
            continue
        step = rubber.step(state, 10**decades * rng.uniform(0, 1))
        end = step.end(deformation)
        assert end.viscous is None or end.viscous.min() >= 0.0
        assert end.stored.min() >= -1e-12
        if rubber.damage is not None:
            assert end.damage.min() >= 0.0
            assert np.all((end.softening > 0.0) & (end.softening <= 1.0))
        state = end.state
        assert np.all(np.isfinite(state))


def test_work_is_stored_or_dissipated():
    # Work of the stress along a closed path in F, by the trapezoidal rule.
    rubber = Rubber(elastic=COMPOUNDS["yeoh-bars-series-1"], viscous=SPECTRUM, damage=SOFTENING)
    steps, work, lost = 600, 0.0, np.zeros(2)
    state, before = rubber.virgin((1,)), None
    for i in range(steps + 1):
        angle = 4 * np.pi * i / steps
        F = np.array(
            [[[1 + 0.2 * np.sin(angle), 0.5 * np.sin(0.5 * angle)], [0.1 * np.sin(angle), 1.0]]]
        )
        step = rubber.step(state, 1.0 / steps)
        P, energy = step_stress(step, F), step.end(deformation_of(F))
        state = energy.state
        lost += energy.viscous[0], energy.damage[0]
        if before is not None:
            work += 0.5 * np.sum((P + before[0]) * (F - before[1]))
        before = P, F
    assert min(lost) > 0.02 * work
    assert work == pytest.approx(energy.stored[0] + lost.sum(), rel=1e-3)


@pytest.mark.parametrize(("tau", "share"), [(1e-9, 1.0), (1e9, 1.5)])
@pytest.mark.parametrize("name", COMPOUNDS)
def test_very_fast_and_very_slow_branches_are_elastic(name, tau, share):
    elastic = COMPOUNDS[name]
    rubber = Rubber(elastic=elastic, viscous=Prony(g=[0.5], tau_s=[tau]))
    rng = np.random.default_rng(2)
    states = [random_deformations(rng, 10, 0.2) for _ in range(4)]
    state = after(rubber, states[:3], 0.01)
    step, F = rubber.step(state, 0.01), states[3]
    extra = NeoHooke(G=elastic.initial_shear_modulus * (share - 1.0)) if share > 1.0 else None
    for function, of_model in (
        (lambda F: step_stress(step, F), first_piola_kirchhoff),
        (lambda F: step_tangent(step, F), dP_dF),
    ):
        expected = of_model(elastic, F)
        if extra is not None:
            expected = expected + of_model(extra, F)
        np.testing.assert_allclose(
            function(F), expected, rtol=0, atol=1e-4 * np.abs(expected).max()
        )


def test_rubber_without_a_memory_is_the_elastic_law():
    elastic = COMPOUNDS["yeoh-bars-series-1"]
    rubber, F = Rubber(elastic=elastic), random_deformations(np.random.default_rng(0), 5)
    step = rubber.step(rubber.virgin((5,)), 0.1)
    assert len(rubber.virgin((5,))) == 0
    np.testing.assert_array_equal(step_stress(step, F), first_piola_kirchhoff(elastic, F))
    np.testing.assert_array_equal(step_tangent(step, F), dP_dF(elastic, F))


def test_no_time_asks_for_the_response_of_the_state():
    rubber, state, F = prepared("yeoh")
    step = rubber.step(state, 0.02)
    P, state = step_stress(step, F), step.end(deformation_of(F)).state
    again = rubber.step(state, 0.0)
    np.testing.assert_allclose(step_stress(again, F), P, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(again.end(deformation_of(F)).state, state, rtol=1e-12, atol=1e-13)


def test_a_warmer_point_relaxes_as_a_cooler_one_does_in_a_longer_step():
    from materials import WLF

    shift = WLF(d1=7.0, d2_K=120.0)
    spectrum = Prony(g=[0.5], tau_s=[0.1], shift=shift, T_ref_C=20.0)
    rubber, F = Rubber(elastic=NeoHooke(G=1.0), viscous=spectrum), sheared(0.4)
    a_T = 10.0 ** -(7.0 * 15.0 / 135.0)
    state = rubber.step(rubber.virgin((1,)), 0.0).end(deformation_of(F)).state
    warm = step_stress(rubber.step(state, 0.05, T_C=np.array([35.0])), F)
    cool = step_stress(rubber.step(state, 0.05 / a_T, T_C=np.array([20.0])), F)
    np.testing.assert_allclose(warm, cool, rtol=1e-12)


class FelupeBranch:
    """A branch of modulus 0.7 and tau = 0.3 s with felupe's first-order update."""

    def __init__(self, dt):
        import felupe  # takes a second to load

        energy = felupe.finite_strain_viscoelastic
        self.umat = felupe.Hyperelastic(energy, mu=0.7, eta=0.7 * 0.3, dtime=dt, nstatevars=6)

    def __call__(self, F, state):
        """P and dP/dF in the plane and the new state (11, 12, 13, 22, 23, 33), at one F (2, 2)."""
        at = [three_dimensional(F[None]), state[:, None, None]]
        stress, after_step = self.umat.gradient(at)
        tangent = self.umat.hessian(at)[0]
        return stress[:2, :2, 0, 0], tangent[:2, :2, :2, :2, 0, 0], after_step[:, 0, 0]


def test_felupe_agrees_on_a_branch_after_a_history():
    # felupe differentiates its update too, so that its stress is that of the model only in the
    # limit of no time step: the states come from first-order steps extrapolated to it, and stress
    # and tangent are asked for without a time step.
    def F(t):
        return np.array([[1.0 + 0.2 * t, 0.6 * t], [0.1 * t, 1.0 - 0.1 * t]])

    table = []
    for steps in (10, 20, 40, 80):
        branch, state = FelupeBranch(0.5 / steps), np.array([1.0, 0.0, 0.0, 1.0, 0.0, 1.0])
        for i in range(1, steps + 1):
            state = branch(F(i / steps), state)[2]
        table.append(state)
    for power in (2, 4, 8):  # Romberg: the error is a series in the step
        table = [(power * fine - coarse) / (power - 1) for coarse, fine in pairwise(table)]
    P, A, _ = FelupeBranch(0.0)(F(1.0), table[0])

    rubber = Rubber(elastic=NeoHooke(G=1e-9), viscous=Prony(g=[0.7e9], tau_s=[0.3]))
    ours = [after(rubber, [F(i / n)[None] for i in range(1, n + 1)], 0.5 / n) for n in (200, 400)]
    step = rubber.step((4 * ours[1] - ours[0]) / 3, 0.0)
    np.testing.assert_allclose(step_stress(step, F(1.0)[None])[0], P, rtol=1e-6)
    np.testing.assert_allclose(
        step_tangent(step, F(1.0)[None])[0], A, rtol=1e-6, atol=1e-6 * A.max()
    )


def test_felupe_differs_in_finite_steps_because_it_differentiates_its_update():
    """The model's stress holds Ci fixed; that of felupe is that of its update, off by O(dt).

    Asked without a time step felupe gives the stress of a state: ours is that of its own new Ci in
    steps of any length, felupe's is not that of felupe's.
    """
    F, past, tau = np.array([[1.3, 0.5], [0.0, 0.85]]), np.array([1.2, 0.1, 0.0, 0.9, 0.0]), 0.3
    past = np.append(past, 1.0 / (past[0] * past[3] - past[1] ** 2))
    stress_of_state, off = FelupeBranch(0.0), []

    def energy(F, dt):
        """Stored after a first-order update of Ci, written anew."""
        whole = np.eye(3)
        whole[:2, :2] = F
        C = whole.T @ whole * np.linalg.det(whole) ** (-2.0 / 3.0)
        Ci = past[[0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(3, 3) + dt / tau * C
        Ci *= np.linalg.det(Ci) ** (-1.0 / 3.0)
        return 0.35 * (np.trace(C @ np.linalg.inv(Ci)) - 3.0)

    for dt in (0.03, 0.015, 0.0075, 0.00375):
        P, _, state = FelupeBranch(dt)(F, past)
        off.append(np.abs(P - stress_of_state(F, state)[0]).max() / np.abs(P).max())
        slopes = [
            (energy(F + h, dt) - energy(F - h, dt)) / 2e-6
            for h in 1e-6 * np.eye(4).reshape(4, 2, 2)
        ]
        np.testing.assert_allclose(P, np.reshape(slopes, (2, 2)), rtol=1e-6, atol=1e-8)
        rubber = Rubber(elastic=NeoHooke(G=1e-9), viscous=Prony(g=[0.7e9], tau_s=[tau]))
        before = np.array([1.0, 1.0, 0.0, past[0], past[3], past[1]])[:, None]
        step = rubber.step(before, dt)
        Ci = step.end(deformation_of(F[None])).state[3:, 0]
        own = np.array([Ci[0], Ci[2], 0.0, Ci[1], 0.0, 1.0 / (Ci[0] * Ci[1] - Ci[2] ** 2)])
        ours = step_stress(step, F[None])[0]
        np.testing.assert_allclose(ours, stress_of_state(F, own)[0], rtol=1e-6, atol=1e-8)
    assert 0.02 < off[0] < 0.2
    np.testing.assert_allclose(np.log2(np.divide(off[:-1], off[1:])), 1.0, atol=0.1)


def test_felupe_agrees_on_stress_and_tangent_of_softening():
    import felupe

    rubber, past = Rubber(elastic=NeoHooke(G=0.7), damage=SOFTENING), np.random.default_rng(3)
    F = random_deformations(past, 12)
    step = rubber.step(after(rubber, [random_deformations(past, 12)], 0.05), 0.05)
    assert 0 < np.count_nonzero(step.end(deformation_of(F)).softening < 1.0) < 12
    umat = felupe.OgdenRoxburgh(felupe.NeoHooke(mu=0.7), **vars(SOFTENING))
    at = [three_dimensional(F), step.state[:, None]]
    stress, tangent = umat.gradient(at)[0], umat.hessian(at)[0]
    P, A = step_stress(step, F), step_tangent(step, F)
    np.testing.assert_allclose(P, np.moveaxis(stress[:2, :2, 0], -1, 0), rtol=1e-6, atol=1e-9)
    expected = np.moveaxis(tangent[:2, :2, :2, :2, 0], -1, 0)
    np.testing.assert_allclose(A, expected, rtol=1e-6, atol=1e-9)


def three_dimensional(F):
    """Deformation gradients (n, 2, 2) of plane strain as felupe takes them, (3, 3, 1, n)."""
    whole = np.zeros((3, 3, 1, len(F)))
    whole[:2, :2, 0], whole[2, 2] = np.moveaxis(F, 0, -1), 1.0
    return whole
