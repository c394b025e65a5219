"""Steps of the mechanics alone, and blocks to make them with."""

from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from fem import newton
from fem.mechanics import BlockMechanics, StepLoad
from fem.mechanics.elements import Q1P0Elements
from fem.stepping.step_control import StepController, StepPlan, landed
from materials import compound
from tests.fem.small_blocks import uniform_block

YEOH = compound("yeoh-bars-series-1-load")
OPTIONS = newton.NewtonOptions(iterations_max=40)


def small_block(mesh=None, model=YEOH, bulk_ratio=100.0, **options):
    """Mechanics of a 6 x 4 mm block of 9 x 5 cells."""
    mesh = mesh or uniform_block(6.0, 4.0, 9, 5)
    elements = Q1P0Elements(mesh, model, bulk_ratio * model.initial_shear_modulus)
    return BlockMechanics(mesh, elements, **{"tolerance": 1e-9, **options})


#: Kelvin-Voigt viscosity of the steps of blocks with mass [N s/mm^2].
VISCOSITY = 0.01


def load_of(system, *, force, mu=0.0, sweep=0.0, dt=1.0, viscosity=None):
    """Load of a step; a block with mass is damped too, unless a viscosity is given."""
    values = np.broadcast_to(np.asarray(mu, dtype=float), (system.candidates.size,)).copy()
    if viscosity is None:
        viscosity = VISCOSITY if system.mass.any() else 0.0
    rate = np.full((len(system.mesh.cells), 1), viscosity / dt)
    damping = rate if viscosity > 0.0 else None
    return StepLoad(dt=dt, sweep=sweep, force=force, mu=values, damping=damping)


def solved(system, state, load):
    """Problem and converged result of a step, and the state it leads to."""
    problem = system.step(state, load)
    result = newton.solve(problem, problem.start(), OPTIONS)
    assert result.converged, (result.failure, result.detail)
    return problem, result, problem.end(result.x, problem.rubber_end(result.evaluation))


def pressed(system, force, mu=0.0, steps=2, dt=1.0):
    """State of a block pressed to a force in equal steps."""
    state = system.initial_state()
    for step in range(1, steps + 1):
        load = load_of(system, force=force * step / steps, mu=mu, dt=dt)
        _, _, state = solved(system, state, load)
    return state


def slid(system, state, *, distance, speed, force, mu, step=0.05):
    """State after sliding a distance [mm] at a speed [mm/s] in steps that converge."""
    control = StepController(step_max=step, step_min=1e-5, enough_help=0.0)
    at, plan = 0.0, StepPlan(step=step)
    while at < distance:
        length = landed(at, plan.step, distance)
        load = load_of(system, force=force, mu=mu, sweep=length, dt=length / speed)
        problem = system.step(state, load)
        result = newton.solve(problem, problem.start(), OPTIONS)
        if result.converged:
            at += length
            state = problem.end(result.x, problem.rubber_end(result.evaluation))
            plan = control.accepted(plan, length, result.iterations)
            continue
        plan = control.rejected(plan, length)
        assert not control.exhausted(plan), (at, result.failure, result.detail)
    return state


def reactions(system, result):
    """Normal and tangential force of the road on the candidates [N/mm]."""
    nodal = result.evaluation.nodal[system.candidates]
    return nodal[:, 1], nodal[:, 0]


def cylinder_block(radius, half_width, cells_x, cells_y, *, cell, height):
    """Block of 2 x half_width whose bottom is a parabola of the given radius at x = 0.

    The cells near x = 0, y = 0 have the size `cell` and grow from there.
    """
    mesh = uniform_block(2.0, 1.0, cells_x, cells_y)
    xi, eta = mesh.points[:, 0] - 1.0, mesh.points[:, 1]
    b = brentq(lambda b: half_width * b * 2.0 / cells_x / np.sinh(b) - cell, 1e-3, 30.0)
    c = brentq(lambda c: height * np.expm1(c / cells_y) / np.expm1(c) - cell, 1e-3, 30.0)
    x = half_width * np.sinh(b * xi) / np.sinh(b)
    y = height * np.expm1(c * eta) / np.expm1(c)
    y = y + (1.0 - y / height) * x**2 / (2.0 * radius)
    return replace(mesh, points=np.column_stack([x, y]))
