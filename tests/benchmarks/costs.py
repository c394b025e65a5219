"""Costs in units of a reference factorisation, whose time is taken in turn with theirs.

The reference is a fixed matrix, so that no change of the program moves the unit: two unknowns per
node of a structured mesh as large as the default one. CPU times, because others may use the
machine too.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from itertools import count

import numpy as np
from scipy.sparse import csc_matrix, diags, identity, kron
from scipy.sparse.linalg import splu

from fem import newton
from fem.heat.model import HeatModel
from fem.heat.state import HeatLoad
from fem.mechanics import BlockMechanics
from fem.mechanics.elements import Q1P0Elements
from fem.mesh.block import BlockMesh, block_mesh
from fem.mesh.grading import NAMED_GRADINGS
from fem.solvers.direct import SYMMETRIC
from materials.thermal import ASPHALT, RUBBER
from tests.benchmarks.counts import counted_run
from tests.benchmarks.measured_run import introductory
from tests.fem.contact_steps import YEOH, load_of, pressed

Call = Callable[[], object]

#: Rounds in which every cost and the reference are timed once.
ROUNDS = 15
#: Whole runs of which the best ratio of wall to solver time counts.
WHOLE_RUNS = 3


def reference_matrix() -> csc_matrix:
    """Symmetric positive definite matrix with nine-node stencils of two unknowns each."""
    grading = NAMED_GRADINGS["default"]

    def line(n: int) -> csc_matrix:
        return diags([-1.0, 2.1, -1.0], [-1, 0, 1], shape=(n, n))

    def neighbours(n: int) -> csc_matrix:
        return diags([1.0, 4.0, 1.0], [-1, 0, 1], shape=(n, n))

    nx, ny = grading.cells_x + 1, grading.cells_y + 1
    grid = kron(line(nx), neighbours(ny)) + kron(neighbours(nx), line(ny))
    coupled = kron(grid, np.array([[1.0, 0.3], [0.3, 1.0]])) + identity(2 * nx * ny)
    return csc_matrix(coupled)


def reference_factorisation() -> Call:
    """Factorisation of the reference matrix."""
    matrix = reference_matrix()
    return lambda: splu(
        matrix,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.001,
        options={"SymmetricMode": True},
    )


def mechanical_calls(mesh: BlockMesh) -> dict[str, Call]:
    """Assembly, factorisation, iteration and whole step of the pressed block's first slide."""
    elements = Q1P0Elements(mesh, YEOH, 100.0 * YEOH.initial_shear_modulus)
    system = BlockMechanics(mesh, elements, density=1.207e-9, tolerance=5e-8)
    state = pressed(system, 5.0, mu=0.3, steps=4, dt=0.02)
    problem = system.step(
        state, load_of(system, force=5.0, mu=0.3, sweep=0.02, dt=1e-3, viscosity=0.008)
    )
    x = problem.start()

    def assembly() -> csc_matrix:
        return problem.tangent(problem.evaluate(x))

    def iteration() -> object:
        evaluation = problem.evaluate(x)
        direction = problem.direction(x, evaluation)
        return problem.evaluate(problem.moved(x, evaluation, direction, 1.0))

    tangent, options = assembly(), newton.NewtonOptions(iterations_max=40)
    return {
        "assembly": assembly,
        "factorisation": lambda: splu(tangent, permc_spec="NATURAL", **SYMMETRIC),
        "newton_iteration": iteration,
        "mechanics_step": lambda: newton.solve(problem, x, options),
    }


def heat_calls(mesh: BlockMesh) -> dict[str, Call]:
    """Steps of 1 mm of the heat, with a new conduction matrix and with that of the step before."""
    return {
        "heat_step_new_matrix": heat_step(mesh, shiver=0.2),
        "heat_step_same_matrix": heat_step(mesh, shiver=1e-3),
    }


def heat_step(mesh: BlockMesh, shiver: float) -> Call:
    """A step of a block whose shear changes by a fraction `shiver` from call to call."""
    model, lengths, number = HeatModel(mesh, RUBBER, ASPHALT), mesh.bottom_lengths, count(1)
    lag = -2.0 * (1.0 - mesh.points[:, 1] / mesh.height) ** 2

    def load(step: int) -> HeatLoad:
        shear = lag * (1.0 + shiver * np.sin(step))
        return HeatLoad(
            dt=1.0 / 300.0,
            sweep=1.0,
            displacement=np.column_stack([shear, np.zeros_like(lag)]),
            contact_nodes=mesh.bottom,
            power=60.0 * lengths,
            conductance=1.6 * lengths,
        )

    state = model.advance(model.initial_state(), load(0), 0.0)
    return lambda: model.advance(state, load(next(number)), 1.0)


def relative_costs(calls: dict[str, Call], reference: Call, rounds: int) -> dict[str, float]:
    """Median over the rounds of each call's CPU time over that of the reference just before it."""
    ratios: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds):
        for name, call in calls.items():
            unit = cpu_time(reference)
            ratios[name].append(cpu_time(call) / unit)
    return {name: float(np.median(values)) for name, values in ratios.items()}


def cpu_time(call: Call) -> float:
    """CPU time of a call [s]."""
    start = time.process_time()
    call()
    return time.process_time() - start


def wall_over_solver() -> float:
    """Wall over solver time of 2 mm of the introductory example, the best of a few runs."""
    case = introductory(2.0, mesh="default")
    summaries = [counted_run(case)[0].summary for _ in range(WHOLE_RUNS)]
    return min(float(summary["wall_s"] / summary["solver_s"]) for summary in summaries)


def measured_costs() -> dict[str, float]:
    """Costs in reference factorisations, and wall over solver time of a whole run."""
    mesh = block_mesh(20.0, 8.0, NAMED_GRADINGS["default"])
    calls = mechanical_calls(mesh) | heat_calls(mesh)
    costs = relative_costs(calls, reference_factorisation(), ROUNDS)
    return costs | {"whole_run_wall_over_solver": wall_over_solver()}
