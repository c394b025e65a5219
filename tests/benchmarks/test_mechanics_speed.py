"""Time of the mechanics on the default mesh; ratios compare medians of the same session."""

import time

import numpy as np
import pytest
from scipy.sparse.linalg import splu

from fem import Case, newton, simulate
from fem.mechanics import BlockMechanics
from fem.mechanics.elements import Q1P0Elements
from fem.mesh.block import block_mesh
from fem.mesh.grading import NAMED_GRADINGS
from fem.solvers.direct import SYMMETRIC
from materials import Prony, Rubber
from tests.fem.contact_steps import YEOH, load_of, pressed

ROUNDS = 15


@pytest.fixture(scope="module")
def system():
    """The introductory example's block with its inertia and a Kelvin-Voigt term."""
    mesh = block_mesh(20.0, 8.0, NAMED_GRADINGS["default"])
    elements = Q1P0Elements(mesh, YEOH, 100.0 * YEOH.initial_shear_modulus)
    return BlockMechanics(mesh, elements, density=1.207e-9, tolerance=5e-8)


@pytest.fixture(scope="module")
def step(system):
    """A sliding step of the pressed block, at its first iterate."""
    state = pressed(system, 5.0, mu=0.3, steps=4, dt=0.02)
    problem = system.step(state, load_of(system, force=5.0, mu=0.3, sweep=0.02, dt=1e-3))
    return problem, problem.start()


def assembly(problem, x):
    """Residual, contact status and tangent of an iterate."""
    return problem.tangent(problem.evaluate(x))


def factorisation(matrix):
    return splu(matrix, permc_spec="NATURAL", **SYMMETRIC)


def medians(*calls, rounds=ROUNDS):
    """Median times of calls made in turn, so that a busy machine slows all alike [s]."""
    times = np.empty((rounds, len(calls)))
    for row in times:
        for column, call in enumerate(calls):
            start = time.perf_counter()
            call()
            row[column] = time.perf_counter() - start
    return np.median(times, axis=0)


def test_residual_and_tangent(benchmark, step):
    matrix = benchmark(assembly, *step)
    assert np.isfinite(matrix.data).all()


def test_residual_alone(benchmark, step):
    problem, x = step
    assert np.isfinite(benchmark(problem.evaluate, x).merit)


def test_factorisation_of_the_same_mesh(benchmark, step):
    benchmark(factorisation, assembly(*step))


def test_newton_iteration(benchmark, step):
    """Residual, tangent, solution and the residual of the new iterate."""
    problem, x = step

    def iteration():
        evaluation = problem.evaluate(x)
        direction = problem.direction(x, evaluation)
        return problem.evaluate(problem.moved(x, evaluation, direction, 1.0))

    assert np.isfinite(benchmark(iteration).merit)


def test_mechanics_step(benchmark, step):
    problem, x = step
    options = newton.NewtonOptions(iterations_max=40)
    assert benchmark.pedantic(newton.solve, (problem, x, options), rounds=5).converged


def test_assembly_costs_less_than_one_factorisation(benchmark, step):
    matrix = assembly(*step)
    assembling, factorising = benchmark.pedantic(
        medians, (lambda: assembly(*step), lambda: factorisation(matrix)), rounds=1
    )
    benchmark.extra_info["assembly_over_factorisation"] = assembling / factorising
    assert assembling < factorising


def test_a_law_without_memory_pays_nothing_for_the_seam(benchmark, system, step):
    """Response and end of a step against the bare derivatives, as a share of the assembly."""
    elements, model = system.elements, system.elements.model
    kin = elements.kinematics(step[1].u)

    def bare():
        return model.derivatives(kin.I1, kin.J)

    def through():
        return model.step(elements.virgin, 1.0, None).respond(kin)

    direct, asked, whole = benchmark.pedantic(
        medians, (bare, through, lambda: assembly(*step)), {"rounds": 5 * ROUNDS}, rounds=1
    )
    benchmark.extra_info["seam_over_assembly"] = (asked - direct) / whole
    assert asked - direct < 0.05 * whole


def iteration_of(model):
    """Residual, tangent and solution of the first iterate of a sliding step, evaluated anew."""
    mesh = block_mesh(20.0, 8.0, NAMED_GRADINGS["default"])
    elements = Q1P0Elements(mesh, model, 100.0 * YEOH.initial_shear_modulus)
    system = BlockMechanics(mesh, elements, density=1.207e-9, tolerance=5e-8)
    state = pressed(system, 5.0, mu=0.3, steps=4, dt=0.02)
    load = load_of(system, force=5.0, mu=0.3, sweep=0.02, dt=1e-3, viscosity=0.0)

    def iteration():
        problem = system.step(state, load)
        x = problem.start()
        return problem.direction(x, problem.evaluate(x))

    return iteration


def test_an_iteration_with_four_branches_costs_at_most_1_4_elastic_ones(benchmark):
    spectrum = Prony(g=[1.5, 0.8, 0.4, 0.3], tau_s=[1e-4, 1e-3, 1e-2, 1e-1])
    calls = map(iteration_of, (YEOH, Rubber(elastic=YEOH, viscous=spectrum)))
    elastic, viscous = benchmark.pedantic(medians, tuple(calls), rounds=1)
    benchmark.extra_info["viscous_over_elastic"] = viscous / elastic
    assert viscous < 1.4 * elastic


def short_slide(distance):
    loading = {
        "mean_pressure_N_per_mm2": 0.25,
        "velocity_mm_per_s": 300.0,
        "distance_mm": distance,
    }
    return simulate(Case.from_dict({"loading": loading, "output": {"snapshots": 1}}))


def test_short_sliding_run(benchmark):
    """2 mm of the introductory example, press and snap included; at most 3 x its solver time."""
    summary = benchmark.pedantic(short_slide, (2.0,), rounds=1).summary
    assert summary["status"] == "ok"
    ratio = summary["wall_s"] / summary["solver_s"]
    benchmark.extra_info["wall_over_solver"] = ratio
    assert ratio < 3.0
