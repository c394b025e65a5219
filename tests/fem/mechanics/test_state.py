"""Materials with a state in the elements and in the steps of a block."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from fem import Case
from fem.files.packing import pack, unpack
from fem.heat.state import HeatLoad
from fem.mechanics.elements import Past, Q1P0Elements
from fem.simulation import coupled_model
from fem.stepping.audit import EnergyAudit, audited
from fem.stepping.coupled_state import AcceptedStep, CoupledState
from fem.stepping.programme import programme
from fem.stepping.summary import heat_error
from tests.fem.mechanics.linear_branch import LinearBranch
from tests.fem.small_blocks import (
    boundary_nodes,
    distorted_block,
    global_forces,
    global_tangent,
    random_displacement,
)

BRANCH = LinearBranch(per_kelvin=0.02)


@pytest.fixture
def elements():
    return Q1P0Elements(distorted_block(), BRANCH, 80.0)


def past_of(elements, dt=0.01, seed=5):
    """A step after one to another deformation, at temperatures that differ."""
    n, rng = len(elements.cells), np.random.default_rng(seed)
    T_C = rng.uniform(20.0, 60.0, (n, 1))
    kin = elements.kinematics(0.7 * random_displacement(elements.mesh, seed=seed))
    state = BRANCH.step(elements.virgin, 0.03, T_C).end(kin).state
    return Past(material=BRANCH.step(state, dt, T_C))


@pytest.mark.parametrize("dt", [1e-4, 0.01, 1.0])
def test_tangent_with_a_state_matches_central_differences(elements, dt):
    past = past_of(elements, dt)
    u, h = random_displacement(elements.mesh), 1e-6
    tangent = global_tangent(elements, u, past)
    differences = np.empty_like(tangent)
    for column in range(u.size):
        du = np.zeros(u.size)
        du[column] = h
        up, down = (global_forces(elements, u + s * du.reshape(u.shape), past) for s in (1, -1))
        differences[:, column] = ((up - down) / (2 * h)).ravel()
    np.testing.assert_allclose(tangent, differences, rtol=0.0, atol=1e-6 * np.abs(tangent).max())


def test_patch_test_with_a_state(elements):
    """Linear displacements step after step: one stress everywhere, no forces inside."""
    mesh = elements.mesh
    inner = np.setdiff1d(np.arange(len(mesh.points)), boundary_nodes(mesh))
    state, T_C = elements.virgin, np.full((len(mesh.cells), 1), 30.0)
    for share in (0.5, 1.0, 1.0):
        A = np.eye(2) + share * np.array([[0.2, 0.3], [-0.1, -0.2]])
        u = mesh.points @ (A - np.eye(2)).T
        step = BRANCH.step(state, 0.01, T_C)
        forces = global_forces(elements, u, Past(material=step))
        assert np.abs(forces[inner]).max() < 1e-12 * np.abs(forces).max()
        state = step.end(elements.kinematics(u)).state
    assert np.ptp(state, axis=(1, 2)).max() < 1e-13
    stress = elements.cauchy(elements.kinematics(u), Past(material=step))
    assert np.ptp(stress, axis=0).max() < 1e-11


def test_no_time_gives_the_response_of_the_state_itself(elements):
    kin = elements.kinematics(random_displacement(elements.mesh))
    step = past_of(elements).material
    now = BRANCH.step(step.end(kin).state, 0.0, None)
    np.testing.assert_allclose(now.respond(kin).S, step.respond(kin).S, rtol=0.0, atol=1e-14)
    assert not now.end(kin).viscous.any()


def test_a_rigid_rotation_turns_the_forces(elements):
    past = past_of(elements)
    u, mesh = random_displacement(elements.mesh), elements.mesh
    c, s = np.cos(0.7), np.sin(0.7)
    R = np.array([[c, -s], [s, c]])
    turned = (mesh.points + u) @ R.T - mesh.points
    forces = global_forces(elements, u, past)
    np.testing.assert_allclose(
        global_forces(elements, turned, past), forces @ R.T, rtol=0.0,
        atol=1e-12 * np.abs(forces).max(),
    )  # fmt: skip


# ------------------------------------------------------------------------- steps of a block


def a_model(material=BRANCH, **solver):
    """A coarse block of a material with a state, and what is done to it."""
    case = Case.from_dict(
        {
            "block": {"mesh": {"cells_x": 10, "cells_y": 5, "smallest_x_mm": 2.0,
                               "smallest_y_mm": 1.6}},
            "loading": {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0,
                        "distance_mm": 1.0},
            "friction": {"law": "coulomb", "mu": 0.4, "wlf": False},
            "solver": {"inertia": False, **solver},
        }
    )  # fmt: skip
    model = coupled_model(case)
    model.mechanics.elements.model = material
    return model, programme(case)


def run(model, phases, steps, start=None, first=0):
    """States of equal steps of both phases, and the audit."""
    state, audit, states = start or model.initial_state(), EnergyAudit(), []
    for phase in phases:
        ends = np.linspace(0.0, phase.end, steps + 1)
        for at, stop in pairwise(ends):
            if len(states) >= first:
                step = model.advance(state, phase.target(at, stop))
                assert isinstance(step, AcceptedStep), step
                audit, state = audited(audit, step, model.mechanics.mesh), step.after
            states.append(state)
    return states, audit


def test_only_an_accepted_step_changes_the_state():
    model, phases = a_model()
    state = model.initial_state()
    before = state.mechanics.rubber.copy()
    one, two = (model.advance(state, phases[0].target(0.0, 0.25)) for _ in range(2))
    np.testing.assert_array_equal(state.mechanics.rubber, before)
    np.testing.assert_array_equal(one.after.mechanics.rubber, two.after.mechanics.rubber)
    assert np.abs(one.after.mechanics.rubber - before).max() > 1e-3


def test_a_run_goes_on_from_a_kept_state_to_the_last_bit():
    model, phases = a_model()
    states, _ = run(model, phases, 6)
    tree, arrays = pack(states[7])
    kept = unpack(CoupledState, tree, {k: a.copy() for k, a in arrays.items()})
    again, _ = run(a_model()[0], phases, 6, start=kept, first=8)
    for name in ("u", "p", "rubber"):
        one, other = (getattr(s[-1].mechanics, name) for s in (states, again))
        np.testing.assert_array_equal(one, other)
    np.testing.assert_array_equal(states[-1].heat.T, again[-1].heat.T)


def test_energy_and_heat_balance_and_the_bulk_heats():
    """The audit's own error and that of the integration of the branch fall with the steps."""
    audits = {}
    for steps in (8, 32):
        model, phases = a_model()
        states, audits[steps] = run(model, phases, steps)
        heat = states[-1].heat
        assert heat.in_bulk == pytest.approx(audits[steps].rubber, rel=1e-12)
        assert heat_error(heat) < 1e-9
    assert audits[32].rubber > 0.02 * audits[32].work_in
    assert audits[32].error < 0.6 * audits[8].error
    assert audits[32].error < 0.01


def test_a_slow_or_a_fast_dashpot_gives_the_elastic_answers():
    """A branch that relaxes at once leaves the energy alone."""
    ends = []
    for material in (LinearBranch(tau=1e-9), BRANCH.elastic):
        model, phases = a_model(material)
        ends.append(run(model, phases[:1], 4)[0][-1].mechanics.u)
    np.testing.assert_allclose(*ends, rtol=0.0, atol=1e-6 * np.abs(ends[1]).max())


def test_heat_made_in_the_bulk_leaves_the_surfaces_radiating():
    model, _ = a_model()
    state = model.initial_state().heat
    mesh = model.mechanics.mesh
    state = replace(state, T=np.full_like(state.T, 80.0))

    def radiated(**sources):
        load = HeatLoad(
            dt=1e-3, sweep=0.0, displacement=state.displacement,
            contact_nodes=np.empty(0, dtype=np.int64), power=np.empty(0), conductance=np.empty(0),
            **sources,
        )  # fmt: skip
        return model.heat.advance(state, load, 0.0).radiated

    everywhere = np.arange(len(mesh.points))
    power = np.ones(everywhere.size)
    assert radiated(bulk_power=power) == pytest.approx(radiated(), rel=1e-12)
    assert radiated(surface_nodes=everywhere, surface_power=power) < 0.5 * radiated()
