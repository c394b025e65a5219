"""Relaxation of a damped step: where it ends, what it costs, and that it is the same step."""

from dataclasses import replace

import numpy as np
import pytest

from fem import Case, newton
from fem.simulation import coupled_model
from fem.stepping.audit import EnergyAudit, audited
from fem.stepping.coupled_state import AcceptedStep, RejectedStep
from fem.stepping.programme import programme
from fem.stepping.relaxation import (
    FADING,
    HOLDS_AT_REST,
    LAST_LEVEL,
    NEGLIGIBLE,
    REST,
    TOLERABLE,
    Damping,
    relaxed,
)

FAILED = RejectedStep(failure=newton.Failure.STALLED, detail="", iterations=7)


class Stubborn:
    """A model that finds solutions with a damping of at least 1 only."""

    def __init__(self, model):
        self.model, self.levels = model, []

    def advance(self, state, target, level, guess):
        self.levels.append(level)
        return self.model.advance(state, target, level, guess) if level >= 1.0 else FAILED


@pytest.fixture(scope="module")
def pressed():
    """Model, pressing step and target of a first sliding step, which has a solution undamped."""
    spec = {"cells_x": 12, "cells_y": 6, "smallest_x_mm": 1.6, "smallest_y_mm": 1.3}
    case = Case.from_dict(
        {
            "loading": {
                "mean_pressure_N_per_mm2": 0.25,
                "velocity_mm_per_s": 300.0,
                "distance_mm": 1.0,
            },
            "block": {"mesh": spec},
            "friction": {"law": "coulomb", "mu": 0.3, "wlf": False},
        }
    )
    model, (pressing, slide) = coupled_model(case), programme(case)
    step = model.advance(model.initial_state(), pressing.target(0.0, 1.0))
    assert isinstance(step, AcceptedStep)
    return model, step, slide.target(0.0, 0.1)


@pytest.fixture(scope="module")
def sliding(pressed):
    """Model, pressed state and target of the sliding step."""
    model, step, target = pressed
    return model, step.after, target


def test_where_an_undamped_solution_exists_relaxation_ends_next_to_it(sliding):
    model, state, target = sliding
    damped, elastic = model.advance(state, target, 4.0), model.advance(state, target)
    step, (level, _) = relaxed(model, damped, Damping(4.0))
    forces = [s.after.contact.friction_force for s in (damped, elastic, step)]
    assert level < 0.1
    assert step.energies.viscous <= NEGLIGIBLE * forces[2] * target.sweep
    assert abs(forces[0] - forces[1]) > 0.05 * forces[1]
    assert forces[2] == pytest.approx(forces[1], rel=10.0 * NEGLIGIBLE)
    np.testing.assert_allclose(
        step.after.mechanics.u, elastic.after.mechanics.u, atol=1e-2 * target.sweep
    )


def test_damping_that_dissipates_next_to_nothing_fades_without_another_solution(sliding):
    model, state, target = sliding
    weak = model.advance(state, target, LAST_LEVEL)
    level = 0.5
    slack = replace(weak, energies=replace(weak.energies, viscous=0.0))
    step, left = relaxed(model, slack, Damping(level))
    assert (step.iterations, step.relaxed) == (weak.iterations, False)
    assert left == Damping(FADING * level)


def test_a_relaxed_step_starts_and_goes_where_the_damped_one_did(sliding):
    model, state, target = sliding
    damped = model.advance(state, target, 4.0)
    step, _ = relaxed(model, damped, Damping(4.0))
    assert step.before is state
    assert step.target is target
    assert step.after.time == damped.after.time
    assert step.iterations > damped.iterations


def test_relaxation_ends_where_there_is_no_solution_and_counts_what_it_cost(sliding):
    model, state, target = sliding
    damped = model.advance(state, target, 4.0)
    stubborn = Stubborn(model)
    step, (level, rest) = relaxed(stubborn, damped, Damping(4.0))
    # a quarter, a quarter of that in vain, and the same as before once more
    assert stubborn.levels == [1.0, 0.25, 1.0]
    assert (level, rest) == (1.0, REST)
    assert step.problem.load.damping is not None
    assert step.iterations > damped.iterations + FAILED.iterations


@pytest.fixture(scope="module")
def nearly_elastic(sliding):
    """A step whose damping takes a thousandth of its work."""
    model, state, target = sliding
    damped = model.advance(state, target, 4.0)
    work = damped.after.contact.friction_force * target.sweep
    return replace(damped, energies=replace(damped.energies, viscous=0.5 * TOLERABLE * work))


def test_steps_after_a_quarter_in_vain_keep_their_damping_for_a_while(sliding, nearly_elastic):
    stubborn = Stubborn(sliding[0])
    _, damping = relaxed(stubborn, nearly_elastic, Damping(1.0, REST))
    assert stubborn.levels == [1.0]
    assert damping == Damping(1.0, REST - 1)
    stubborn.levels.clear()
    _, damping = relaxed(stubborn, nearly_elastic, Damping(1.0, 0))
    assert stubborn.levels == [0.25, 1.0]
    assert damping == Damping(1.0, REST)


def test_damping_that_takes_more_than_a_little_of_the_work_gets_no_rest(sliding):
    model, state, target = sliding
    damped, stubborn = model.advance(state, target, 4.0), Stubborn(model)
    relaxed(stubborn, damped, Damping(4.0, REST))
    assert stubborn.levels == [1.0, 0.25, 1.0]


def test_a_block_at_rest_keeps_its_damping_for_more_solutions_before_it_goes_on(sliding):
    model, state, target = sliding
    damped, stubborn = model.advance(state, target, 4.0), Stubborn(model)
    still = replace(damped, target=replace(target, sweep=0.0))
    _, (level, _) = relaxed(stubborn, still, Damping(1.0))
    assert stubborn.levels == HOLDS_AT_REST * [0.25, 1.0]
    assert level == 1.0


def test_the_last_solution_has_no_damping_at_all(sliding):
    model, state, target = sliding
    weak = model.advance(state, target, LAST_LEVEL)
    step, left = relaxed(model, weak, Damping(LAST_LEVEL))
    assert left.level == 0.0
    assert step.problem.load.damping is None


def test_a_step_that_needed_no_damping_releases_nothing_in_the_audit(pressed):
    model, pressing, target = pressed
    energies, mesh = pressing.energies, model.mechanics.mesh
    before = EnergyAudit(
        strain_energy=energies.strain_energy,
        kinetic=energies.kinetic,
        platen_force_x=float(pressing.evaluation.nodal[mesh.top, 0].sum()),
        platen_force_y=pressing.target.force,
    )
    damped = model.advance(pressing.after, target, 4.0)
    step, _ = relaxed(model, damped, Damping(4.0))
    work = audited(before, step, mesh).work_in
    assert audited(before, damped, mesh).viscous > 0.02 * work
    assert audited(before, step, mesh).snaps < 2e-3 * work
