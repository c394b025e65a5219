"""The energy audit: its sums, shares and what happens without work."""

from dataclasses import replace

import numpy as np
import pytest

from fem import Case
from fem.case.sections import Solver
from fem.simulation import coupled_model
from fem.stepping.audit import EnergyAudit, audited
from fem.stepping.coupled_state import AcceptedStep
from fem.stepping.programme import programme

AUDIT = EnergyAudit(work_in=10.0, friction=6.0, viscous=0.5, strain_energy=2.9, kinetic=0.5,
                    capped=1.5, dissipated=6.0)  # fmt: skip


def test_error_is_what_the_stored_and_dissipated_energies_leave_open():
    assert AUDIT.error == pytest.approx(0.01)


@pytest.mark.parametrize("name", ["friction", "viscous", "strain_energy", "kinetic"])
def test_every_part_counts(name):
    assert replace(AUDIT, **{name: getattr(AUDIT, name) + 0.1}).error == pytest.approx(0.0)


def test_shares_are_relative_to_the_work_and_to_the_friction_work():
    assert AUDIT.regularisation_share == pytest.approx(0.05)
    assert AUDIT.capped_share == pytest.approx(0.25)


def test_nothing_done_is_no_error():
    nothing = EnergyAudit()
    assert (nothing.error, nothing.regularisation_share, nothing.capped_share) == (0.0, 0.0, 0.0)


def pressing_run(steps, *, level=0.0, snaps=False, **solver):
    """Audit of the pressing phase of a frictionless block in equal steps."""
    spec = {"cells_x": 12, "cells_y": 6, "smallest_x_mm": 1.6, "smallest_y_mm": 1.3}
    case = Case.from_dict(
        {
            "loading": {
                "mean_pressure_N_per_mm2": 0.25,
                "velocity_mm_per_s": 300.0,
                "distance_mm": 1.0,
            },
            "block": {"mesh": spec},
            "friction": {"law": "coulomb", "mu": 0.0, "wlf": False},
            "solver": solver,
        }
    )
    model, phase = coupled_model(case), programme(case)[0]
    state, audit = model.initial_state(), EnergyAudit()
    for k in range(steps):
        step = model.advance(state, phase.target(k / steps, (k + 1) / steps), level)
        assert isinstance(step, AcceptedStep)
        audit, state = audited(audit, step, model.mechanics.mesh, snaps=snaps), step.after
    return audit


def test_elastic_pressing_stores_the_work_and_its_error_is_of_second_order():
    """No friction, inertia or viscosity: the trapezoidal rule alone is left."""
    errors = [pressing_run(n, inertia=False).error for n in (4, 8, 16)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 1e-3
    assert (orders > 1.8).all()
    assert (orders < 2.2).all()


def test_elastic_pressing_dissipates_nothing():
    audit = pressing_run(4, inertia=False)
    assert audit.viscous == 0.0
    assert audit.kinetic == 0.0
    # Without friction the shear forces vanish to the tolerance of the forces.
    assert abs(audit.friction) < Solver().tolerance * audit.work_in
    assert audit.work_in > 0.0


def test_damped_pressing_dissipates_and_balances_on_finer_steps():
    audits = [pressing_run(n, level=20.0) for n in (8, 32)]
    assert audits[1].viscous > 0.0
    assert audits[1].error < 0.5 * audits[0].error
    assert audits[1].error < 0.02


def test_damping_counts_as_snaps_only_where_the_step_had_no_solution_without():
    damped, snapped = (pressing_run(4, level=20.0, snaps=snaps) for snaps in (False, True))
    assert damped.viscous == snapped.viscous > 0.0
    assert (damped.snap_share, snapped.regularisation_share) == (0.0, 0.0)
    assert damped.regularisation_share == snapped.snap_share > 0.0
