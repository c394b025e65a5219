"""Steps with self-contact of the mechanics alone, and an independent look at the outcome."""

from dataclasses import dataclass, replace

import numpy as np

from contact.pair_search import find_pairs, followed, pair_penetration
from contact.self_contact import dissipation
from fem import newton
from fem.mechanics.state import MechanicalState
from fem.simulation import SELF_CONTACT_STIFFNESS
from fem.stepping.step_control import StepController, StepPlan, landed
from tests.fem.contact_steps import OPTIONS, load_of


@dataclass(frozen=True, kw_only=True)
class SelfStep:
    """A converged step: its result, the state it leads to, and what happened to the pairs."""

    result: object
    state: MechanicalState
    pairs: object
    penetration: float
    friction_work: float


def self_contact_step(system, state, load, *, reach, mu=1.0, passes=8):
    """One step with self-contact, partners settled; None where Newton's method fails."""
    points, boundary = system.mesh.points, system.boundary
    shear = state.self_shear
    if shear is None:
        shear = np.zeros(boundary.nodes.size)

    def found(u):
        return find_pairs(
            boundary, points + state.u, points + u, reach=reach, mu=mu, shear_n=shear,
            stiffness=SELF_CONTACT_STIFFNESS * system.elements.K_bulk,
        )  # fmt: skip

    pairs, start = found(state.u), None
    for _ in range(passes):
        problem = system.step(state, replace(load, pairs=pairs))
        result = newton.solve(problem, start or problem.start(), OPTIONS)
        if not result.converged:
            return None
        u = result.x.u
        after = followed(pairs, found(u), points + u, boundary)
        if after is pairs:
            break
        carried = result.x.pairs.carried(pairs, after) if result.x.pairs is not None else None
        pairs, start = after, replace(result.x, reactions=None, pairs=carried)
    else:
        return None
    forces = result.evaluation.pairs
    shear = np.zeros(boundary.nodes.size)
    np.add.at(shear, pairs.place, forces.shear)
    after = problem.end(result.x, problem.rubber_end(result.evaluation), shear)
    return SelfStep(
        result=result, state=after, pairs=pairs,
        penetration=pair_penetration(pairs, points + u, boundary),
        friction_work=float(dissipation(pairs, forces).sum()),
    )  # fmt: skip


def pressed_onto_itself(system, force, *, first, step_max, reach, mu=1.0, road_mu=0.0):
    """Accepted steps of a block that is pressed to a force [N/mm]; steps that fail are halved."""
    control = StepController(step_max=step_max, step_min=1e-4 * force, enough_help=0.0)
    state, steps, at, plan = system.initial_state(), [], 0.0, StepPlan(step=first)
    while at < force:
        length = landed(at, plan.step, force)
        load = load_of(system, force=at + length, mu=road_mu)
        step = self_contact_step(system, state, load, reach=reach, mu=mu)
        if step is None:
            plan = control.rejected(plan, length)
            assert not control.exhausted(plan), f"stuck at {at} N/mm"
            continue
        steps.append(step)
        state, at = step.state, at + length
        plan = control.accepted(plan, length, step.result.iterations)
    return steps


def crossings(chain):
    """Numbers of the pairs of segments of a chain (m, 2) that cut each other, (k,) and (k,)."""

    def cross(a, b):
        return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]

    a, b = chain[:-1], chain[1:]
    d = (b - a)[:, None]
    sides = cross(d, a[None] - a[:, None]) * cross(d, b[None] - a[:, None])
    return np.nonzero(np.triu((sides < 0.0) & (sides.T < 0.0), 2))


def overlap(mesh, u):
    """Depth to which the free boundary cuts itself, relative to the local element size [-].

    The larger of what crossing segments and what nodes inside the material show. Nothing of the
    contact's own search is used.
    """
    chain = (mesh.points + u)[mesh.boundary]
    size = np.full(len(mesh.points), np.inf)
    np.minimum.at(size, mesh.cells, mesh.size[:, None])
    size = size[mesh.boundary]
    return max(_crossing_depth(chain, size), _node_depth(chain, size, mesh.direction))


def _crossing_depth(chain, size):
    """Shortest distance of an end of one crossing segment from the other, the largest of all."""
    i, j = crossings(chain)
    ends = ((i, j), (i + 1, j), (j, i), (j + 1, i))
    depth = [_distance(chain[k], chain[m], chain[m + 1]) / size[k] for k, m in ends]
    return float(np.min(depth, axis=0).max(initial=0.0))


def _node_depth(chain, size, orientation, ahead=0.01):
    """Largest depth of a node in the material, by the winding number of a point before it.

    The point is `ahead` of the local size in front of the node; what it is deeper than that
    below the surface is the depth of the node.
    """
    e = np.diff(chain, axis=0) / np.linalg.norm(np.diff(chain, axis=0), axis=1)[:, None]
    e, turn = np.vstack([e[:1], e, e[-1:]]), np.append(0.0, np.append(np.sum(e[1:] * e[:-1], 1), 0))
    t = e[1:] + e[:-1]
    n = orientation * np.column_stack([t[:, 1], -t[:, 0]])
    points = chain + (ahead * size / np.linalg.norm(n, axis=1))[:, None] * n
    to = chain[None] - points[:, None]
    a, b = to, np.roll(to, -1, axis=1)
    angle = np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], np.sum(a * b, axis=2))
    # The tip of a fold has no point before it; there the crossings tell.
    inside = np.flatnonzero((np.rint(angle.sum(axis=1) / (2.0 * np.pi)) != 0.0) & (turn > 0.0))
    count = len(chain)
    node, segment = (k.ravel() for k in np.meshgrid(inside, np.arange(count - 1), indexing="ij"))
    distance = _distance(points[node], chain[segment], chain[segment + 1])
    distance[(segment == node) | (segment == node - 1)] = np.inf
    depth = distance.reshape(inside.size, count - 1).min(axis=1, initial=np.inf) / size[inside]
    return float((depth - ahead).max(initial=0.0))


def _distance(s, a, b):
    """Distance of points from segments, all (k, 2)."""
    e = b - a
    xi = np.clip(np.sum((s - a) * e, axis=1) / np.sum(e**2, axis=1), 0.0, 1.0)
    return np.linalg.norm(s - a - xi[:, None] * e, axis=1)
