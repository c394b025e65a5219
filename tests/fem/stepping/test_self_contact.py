"""Self-contact in the equations of the block: mirrored halves, a notch that closes, the roll."""

from dataclasses import replace
from functools import cached_property

import numpy as np
import pytest

from fem import Case, simulate
from fem.mesh.block import BlockMesh
from fem.stepping.model_parts import mesh_of
from materials import NeoHooke
from tests.fem.contact_steps import load_of, pressed, small_block
from tests.fem.self_contact_blocks import (
    crossings,
    overlap,
    pressed_onto_itself,
)
from tests.fem.small_blocks import leading_face, trailing_face, uniform_block

LARGEST = 0.01


def test_a_chain_that_cuts_itself_is_seen():
    """The judge of the tests below, on a loop whose depth is known."""
    loop = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, -0.1], [3.0, -5.0]])
    assert [k.tolist() for k in crossings(loop)] == [[0], [3]]
    assert not crossings(loop[:4])[0].size


# ------------------------------------------------------------------------------ mirrored halves

HALF_LENGTH, HEIGHT, BULGE, FORCE = 4.0, 3.0, 0.25, 3.0
INITIAL_OVERLAP = 1e-4


def bulged_half(cells_x=24, cells_y=10):
    """Block whose bottom is a parabola that touches y = 0 in its middle."""
    mesh = uniform_block(2.0 * HALF_LENGTH, HEIGHT, cells_x, cells_y)
    x, y = mesh.points.T
    rise = BULGE * ((x - HALF_LENGTH) / HALF_LENGTH) ** 2
    return replace(mesh, points=np.column_stack([x, y + (1.0 - y / HEIGHT) * rise]))


class StackedMesh(BlockMesh):
    """Two pieces, of which only the upper one is held: their boundaries, not closed, one by one."""

    @cached_property
    def curves(self):
        half, n = bulged_half(), len(self.points) // 2
        rear, front = trailing_face(half), leading_face(half)
        lower = [half.bottom[::-1], rear[1:], half.top[1:], front[::-1][1:-1]]
        return [half.boundary, n + np.concatenate(lower)]


def mirrored_halves():
    """The half on top of its mirror image, which stands on the road with its flat side."""
    half = bulged_half()
    n = len(half.points)
    upper = half.points + np.array([0.0, HEIGHT - INITIAL_OVERLAP])
    lower = half.points * [1.0, -1.0] + [0.0, HEIGHT]
    cells = np.vstack([half.cells, n + half.cells[:, ::-1]])
    return StackedMesh(points=np.vstack([upper, lower]), cells=cells, top=half.top)


@pytest.fixture(scope="module")
def halves():
    """System and steps of the two halves pressed together; the road holds the lower one."""
    system = small_block(mirrored_halves(), NeoHooke(G=1.0), bulk_ratio=50.0, tolerance=1e-8)
    steps = pressed_onto_itself(system, FORCE, first=0.003, step_max=0.3, reach=0.5, road_mu=50.0)
    return system, steps


@pytest.fixture(scope="module")
def on_a_plane():
    """System and state of one half pressed onto the frictionless rigid road."""
    system = small_block(bulged_half(), NeoHooke(G=1.0), bulk_ratio=50.0, tolerance=1e-8)
    return system, pressed(system, FORCE, steps=4)


def test_mirrored_halves_meet_in_a_plane(halves):
    system, step = halves[0], halves[1][-1]
    x = system.mesh.points + step.state.u
    touching = np.unique(step.pairs.nodes[step.result.evaluation.pairs.normal > 0.0, 0])
    assert touching.size > 15
    # The flat side of the lower half is the road, so the plane of symmetry is half way up.
    middle = 0.5 * x[system.mesh.top[0], 1]
    assert np.abs(x[touching, 1] - middle).max() < LARGEST * system.mesh.size.min()
    assert step.penetration < LARGEST


def test_mirrored_halves_deform_as_one_half_on_a_rigid_plane(halves, on_a_plane):
    """Within 0.5 % of the platen's path: the faces give way by 1e-3 of an element."""
    both, one = halves[1][-1].state.u, on_a_plane[1].u
    top = on_a_plane[0].mesh.top
    approach = -one[top[0], 1]
    assert approach > 0.2
    n = len(one)
    upper, lower = both[:n], both[n:]
    assert -upper[top[0], 1] == pytest.approx(2.0 * approach, rel=5e-3)
    relative = upper - [0.0, upper[top[0], 1] + approach]
    np.testing.assert_allclose(relative, one, atol=5e-3 * approach)
    np.testing.assert_allclose(
        lower * [1.0, -1.0], one + np.array([0.0, approach]), atol=5e-3 * approach
    )


def test_the_contact_force_is_the_applied_force(halves):
    step = halves[1][-1]
    forces = step.result.evaluation.pairs
    on_nodes = forces.residual.reshape(-1, 3, 2)
    nodes, n = step.pairs.nodes, len(bulged_half().points)
    upper = np.where(nodes < n, on_nodes[..., 1], 0.0).sum()
    assert -upper == pytest.approx(FORCE, rel=1e-6)
    np.testing.assert_allclose(on_nodes.sum(axis=(0, 1)), 0.0, atol=1e-12 * FORCE)


def test_mirrored_halves_do_not_rub(halves):
    """Against the work of the platen, about half its force times its path."""
    system, steps = halves
    path = -steps[-1].state.u[system.mesh.top[0], 1]
    assert sum(step.friction_work for step in steps) < 1e-3 * 0.5 * FORCE * path


# -------------------------------------------------------------------------------------- notch

NOTCH_LENGTH, NOTCH_HEIGHT, DEPTH, MOUTH = 8.0, 8.0, 3.0, 1.2
#: The nodes beside the root do not meet: the corners of its elements resist.
NOTCH_FORCE = 6.0


def notched_block():
    """Block with a V-notch half way up its front, as deep as `DEPTH`, as wide as `MOUTH`."""
    mesh = uniform_block(NOTCH_LENGTH, NOTCH_HEIGHT, 32, 32)
    x, y = mesh.points.T
    off = (y - 0.5 * NOTCH_HEIGHT) / (0.5 * NOTCH_HEIGHT)
    # Rows crowd towards the notch: its flanks take a share of them.
    rows = 0.5 * NOTCH_HEIGHT * (1.0 + np.sign(off) * np.abs(off) ** 1.5)
    flank = np.maximum(1.0 - np.abs(rows - 0.5 * NOTCH_HEIGHT) / (0.5 * MOUTH), 0.0)
    x = x * (1.0 - DEPTH / NOTCH_LENGTH * flank)
    return replace(mesh, points=np.column_stack([x, rows]))


@pytest.fixture(scope="module")
def notch():
    """System and steps of the notched block pressed until the notch is shut."""
    system = small_block(notched_block(), NeoHooke(G=1.0), bulk_ratio=20.0, tolerance=1e-8)
    return system, pressed_onto_itself(
        system, NOTCH_FORCE, first=0.3, step_max=0.3, reach=0.4, road_mu=10.0
    )


def test_a_compressed_notch_closes(notch):
    system, steps = notch
    touching = [np.count_nonzero(s.result.evaluation.pairs.normal) for s in steps]
    assert touching[0] == 0
    assert touching[-1] > 10
    assert overlap(system.mesh, steps[0].state.u) == 0.0


def test_the_flanks_of_a_closed_notch_do_not_penetrate(notch):
    system, steps = notch
    assert max(s.penetration for s in steps) < LARGEST
    assert max(overlap(system.mesh, s.state.u) for s in steps) < LARGEST


def test_without_self_contact_the_flanks_pass_through_each_other(notch):
    system, _ = notch
    state = pressed(system, NOTCH_FORCE, mu=10.0, steps=16)
    assert overlap(system.mesh, state.u) > 0.2


def test_self_friction_of_the_notch_is_never_negative(notch):
    _, steps = notch
    assert min(s.friction_work for s in steps) >= 0.0


def test_the_tangent_with_closed_flanks_matches_differences(notch):
    """Along a random direction that takes all unknowns with it."""
    system, steps = notch
    load = replace(load_of(system, force=NOTCH_FORCE, mu=10.0), pairs=steps[-1].pairs)
    problem = system.step(steps[-2].state, load)
    x = replace(steps[-1].result.x, reactions=None)
    evaluation = problem.evaluate(x)
    d = np.random.default_rng(6).standard_normal(system.pattern.size)

    def residual(h):
        du = h * system.scatter(d)
        p = x.p + system.elements.pressure_increment(evaluation.elements, du)
        return problem.evaluate(replace(x, u=x.u + du, p=p)).residual

    numerical = (residual(1e-7) - residual(-1e-7)) / 2e-7
    analytical = problem.tangent(evaluation) @ d
    assert np.count_nonzero(evaluation.pairs.normal) > 10
    np.testing.assert_allclose(analytical, numerical, atol=1e-5 * np.abs(numerical).max())


# -------------------------------------------------------------------------------- tread block


def rolled(mu, pressure, distance, *, self_contact=True, velocity=300.0, mesh="coarse"):
    """Run of a tread block with Coulomb friction, its leading edge rolled under."""
    return simulate(Case.from_dict({
        "block": {"mesh": mesh},
        "friction": {"law": "coulomb", "mu": mu, "wlf": False},
        "loading": {
            "mean_pressure_N_per_mm2": pressure, "velocity_mm_per_s": velocity,
            "distance_mm": distance,
        },
        "solver": {"self_contact": self_contact},
        "output": {"snapshots": 15},
    }))  # fmt: skip


def overlaps(run):
    """Overlap of the boundary in each snapshot of a run."""
    mesh = mesh_of(run.case)
    return np.array([overlap(mesh, s.displacement) for s in run.snapshots])


def assert_does_not_penetrate(run):
    assert run.summary["status"] == "ok"
    assert run.history["self_contact_penetration"].max() > 0.0, "it never touched itself"
    assert run.history["self_contact_penetration"].max() < LARGEST
    assert overlaps(run).max() < LARGEST


@pytest.mark.parametrize("mu, distance", [(0.9, 17.0), (1.2, 12.0)])
def test_the_crease_of_a_rolled_block_does_not_penetrate(mu, distance):
    assert_does_not_penetrate(rolled(mu, 0.25, distance))


@pytest.mark.parametrize("mu, distance", [(0.9, 17.0), (1.2, 12.0)])
def test_without_self_contact_the_crease_penetrates(mu, distance):
    run = rolled(mu, 0.25, distance, self_contact=False)
    assert overlaps(run).max() > 5.0 * LARGEST
    assert run.history["self_contact_penetration"].max() > 5.0 * LARGEST


@pytest.mark.slow
@pytest.mark.parametrize("velocity", [300.0, -300.0])
@pytest.mark.parametrize("pressure", [0.1, 0.25, 0.5])
@pytest.mark.parametrize("mu", [0.9, 1.2])
def test_the_crease_does_not_penetrate_while_it_grows(mu, pressure, velocity):
    run = rolled(mu, pressure, 40.0, velocity=velocity)
    assert run.summary["status"] == "ok"
    assert run.history["self_contact_penetration"].max() < LARGEST
    assert overlaps(run).max() < LARGEST


@pytest.mark.slow
def test_the_crease_does_not_penetrate_on_the_default_mesh():
    assert_does_not_penetrate(rolled(0.9, 0.3, 12.0, mesh="default"))


@pytest.mark.slow
def test_self_friction_is_part_of_the_balances():
    run = rolled(1.2, 0.5, 40.0)
    assert run.history["self_contact_penetration"].max() > 0.0
    assert run.summary["energy_error"] < 0.01
    assert run.summary["heat_error"] < 1e-9


def test_a_step_in_which_the_surface_passes_through_itself_is_rejected(monkeypatch):
    """And smaller ones are tried, until the run ends with that reason."""
    monkeypatch.setattr("fem.stepping.self_contact.crossing_depth", lambda *boundary: 1.5 * LARGEST)
    run = simulate(Case.from_dict({
        "block": {
            "mesh": {"cells_x": 12, "cells_y": 5, "smallest_x_mm": 1.0, "smallest_y_mm": 1.0}
        },
        "loading": {
            "mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 1.0,
        },
    }))  # fmt: skip
    assert run.summary["status"] == "not converged"
    assert "passes through itself" in run.summary["reason"]
    assert "finer mesh" in run.summary["advice"]
    assert run.summary["rejected_steps"] > 1
    assert run.summary["steps"] == 0
