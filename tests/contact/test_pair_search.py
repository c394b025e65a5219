"""Which nodes of a boundary meet which of its segments, and how pairs go on."""

from dataclasses import replace

import numpy as np
import pytest

from contact.pair_search import (
    BEHIND,
    HOLD,
    NEIGHBOURS,
    OPPOSING,
    OVERHANG,
    UNSEEN,
    Boundary,
    _near,
    find_pairs,
    followed,
    pair_penetration,
)
from contact.self_contact import pair_forces, segment_geometry

STIFFNESS, MU = 3.0, 0.7
REACH = 0.15


def slot(gap, count=41, spacing=0.1, shift=0.0):
    """Chain around a slot that opens to the left: lower face, two end nodes, upper face.

    The material lies around the slot, to the right of the chain (orientation -1).
    """
    x = spacing * np.arange(count)
    lower = np.column_stack([x, np.full(count, -0.5 * gap)])
    upper = np.column_stack([x[::-1] + shift, np.full(count, 0.5 * gap)])
    end = np.column_stack([np.full(2, x[-1] + 0.08), [-0.5, 0.5]])
    return np.vstack([lower, end, upper])


def boundary_of(points, orientation=-1, size=0.1):
    nodes = np.arange(len(points))
    return Boundary.of(nodes, orientation, points, np.full(len(points), size))


def pairs_of(points, accepted=None, *, reach=REACH, orientation=-1, size=0.1, shear_n=None):
    boundary = boundary_of(points, orientation, size)
    zeros = np.zeros(len(points))
    return find_pairs(
        boundary, points if accepted is None else accepted, points, reach=reach,
        stiffness=STIFFNESS, mu=MU, shear_n=zeros if shear_n is None else shear_n,
    )  # fmt: skip


def couples(pairs):
    """Node and first segment node of each pair."""
    return {(int(s), int(min(a, b))) for s, a, b in pairs.nodes}


def brute_force_search(points, reach):
    """Nodes and segments that `find_pairs` has to look at, one by one."""
    count, found = len(points), set()
    for s in range(count):
        for a in range(count - 1):
            apart = min(abs(s - a), abs(s - a - 1))
            near = min(np.linalg.norm(points[s] - points[i]) for i in (a, a + 1))
            if apart > NEIGHBOURS and near <= reach:
                found.add((s, a))
    return found


def brute_force_pairs(points, reach, orientation):
    """Pairs of `find_pairs` at rest with no penetration: the nearest segment of each node."""
    best = {}
    for s, a in sorted(brute_force_search(points, reach)):
        one = segment_geometry(points[[s]], points[[a]], points[[a + 1]], orientation)
        own = [i for i in (s - 1, s) if 0 <= i < len(points) - 1]
        normals = [
            segment_geometry(points[[i]], points[[i]], points[[i + 1]], orientation).n[0]
            for i in own
        ]
        if min(n @ one.n[0] for n in normals) >= OPPOSING:
            continue
        if abs(one.xi[0] - 0.5) > 0.5 + OVERHANG:
            continue
        if 0.0 < one.gap[0] < min(best.get(s, (reach,))[0], reach):
            best[s] = (one.gap[0], a)
    return {(s, a) for s, (_, a) in best.items()}


def wavy_slot(seed=5):
    """Slot whose nodes are shifted at random, so that no two distances are equal."""
    points = slot(0.08, shift=0.033)
    return points + np.random.default_rng(seed).uniform(-0.02, 0.02, points.shape)


def test_boundary_lengths_add_up_to_the_length_of_the_chain():
    points = wavy_slot()
    total = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert boundary_of(points).length.sum() == pytest.approx(total, rel=1e-14)


def test_node_at_the_tip_of_a_fold_meets_the_face_beside_it():
    """The mean normal of the tip points along the fold, not against the face."""
    wall = [[0.0, -0.5], [0.0, 0.5], [0.0, 1.5]]
    fold = [[0.02, 1.5], [0.02, 1.0], [0.015, 0.0], [0.06, 1.0]]
    points = np.array(wall + fold)
    tip = len(wall) + 2
    assert (tip, 0) in couples(pairs_of(points, reach=0.6, orientation=1))
    assert (tip, 0) in couples(pairs_of(points[:-1], reach=0.6, orientation=1))
    away = points * [-1.0, 1.0]
    assert not any(s == tip for s, _ in couples(pairs_of(away, reach=0.6, orientation=1)))


def test_search_agrees_with_brute_force():
    points = wavy_slot()
    place, segment = _near(boundary_of(points), points, REACH)
    found = set(zip(place.tolist(), segment.tolist(), strict=True))
    assert len(found) == len(place) > 100
    assert found == brute_force_search(points, REACH)


@pytest.mark.parametrize("seed", range(4))
def test_pairs_agree_with_brute_force(seed):
    points = wavy_slot(seed)
    found = couples(pairs_of(points))
    assert len(found) > 60
    assert found == brute_force_pairs(points, REACH, -1)


def test_pairs_do_not_depend_on_the_direction_of_the_chain():
    points, last = wavy_slot(), len(wavy_slot()) - 1
    backwards = pairs_of(points[::-1], orientation=1)
    mirrored = {(last - s, last - a - 1) for s, a in couples(backwards)}
    assert mirrored == couples(pairs_of(points))


def test_candidates_grow_in_proportion_to_the_nodes():
    counts = []
    for count in (500, 1000, 2000, 4000):
        points = slot(0.08, count=count)
        counts.append(len(_near(boundary_of(points), points, REACH)[0]) / len(points))
    np.testing.assert_allclose(counts, counts[-1], rtol=0.02)
    assert counts[-1] < 10.0


def test_both_faces_meet_each_other():
    points = slot(0.05, shift=0.05)
    lower = {s for s, _ in couples(pairs_of(points)) if s < 41}
    upper = {s for s, _ in couples(pairs_of(points)) if s > 42}
    assert len(lower) >= 39
    assert len(upper) >= 39


def fold(opening):
    """Right half of the material cut by a fold whose tip is the middle node, 3 nodes a side.

    The faces enclose `opening` degrees; the material is to the right of the chain.
    """
    half, r = np.radians(0.5 * opening), 0.1 * np.arange(3, 0, -1)[:, None]
    lower = r * [[-np.cos(half), -np.sin(half)]]
    upper = 0.85 * r[::-1] * [[-np.cos(half), np.sin(half)]]
    return np.vstack([lower, [[0.0, 0.0]], upper])


def test_a_fold_closes_between_its_first_nodes():
    """Otherwise they pass through each other, and the loop grows from there."""
    accepted, now = fold(6.0), fold(-6.0)
    found = pairs_of(now, accepted)
    assert {(4, 2), (2, 4)} & couples(found)
    assert np.all(pair_forces(found, now).normal > 0.0)


def test_a_node_never_meets_its_own_segments():
    for points in (fold(2.0), fold(-0.1), wavy_slot()):
        found = pairs_of(points, fold(2.0) if len(points) == 7 else None, reach=0.5)
        assert found.place.size
        assert not np.any(found.nodes[:, 1:] == found.nodes[:, :1])


def test_the_sharp_corner_of_a_wedge_does_not_meet_itself():
    """The faces of a wedge are as close and as opposed as those of a fold, but behind."""
    assert couples(pairs_of(fold(20.0), orientation=-1))
    assert not couples(pairs_of(fold(20.0), orientation=1))


def test_faces_with_the_same_normal_never_meet():
    """Two faces above each other that look the same way, as both sides of a thin step do."""
    points = slot(0.05, shift=0.05)
    points[41:43] = [[4.5, 3.0], [-1.0, 3.0]]
    points[43:] = points[43:][::-1]
    assert len(_near(boundary_of(points), points, REACH)[0]) > 100
    assert not couples(pairs_of(points))


@pytest.mark.parametrize("beyond, expected", [(0.5 * OVERHANG, True), (2.0 * OVERHANG, False)])
def test_only_nodes_in_front_of_a_segment_meet_it(beyond, expected):
    points = slot(0.05, shift=0.05)
    points[-1, 0] = points[0, 0] - beyond * 0.1
    found = {s for s, _ in couples(pairs_of(points))}
    assert (len(points) - 1 in found) == expected


def test_a_node_behind_the_segment_in_the_accepted_state_cannot_meet_it():
    """In a thin wedge the other face is near, opposed and behind: through the material."""
    wedge = slot(0.05, shift=0.05)
    assert couples(pairs_of(wedge, orientation=-1))
    assert not couples(pairs_of(wedge, orientation=1))


@pytest.mark.parametrize("depth, expected", [(0.8 * BEHIND, True), (1.2 * BEHIND, False)])
def test_what_counts_as_behind_is_a_share_of_the_local_size(depth, expected):
    accepted = slot(-depth * 0.1, shift=0.05)
    found = pairs_of(slot(-0.001, shift=0.05), accepted)
    assert bool(couples(on_flanks(found))) == expected


def test_a_node_that_has_passed_through_within_the_step_is_found():
    accepted, now = slot(0.02, shift=0.05), slot(-0.02, shift=0.05)
    found = on_flanks(pairs_of(now, accepted))
    assert len(couples(found)) > 70
    assert np.all(pair_forces(found, now).normal > 0.0)


@pytest.mark.parametrize("cosine, expected", [(-0.14, True), (-0.02, True), (0.1, False)])
def test_normals_that_hardly_oppose_each_other_still_meet(cosine, expected):
    """Beside a corner that a fold has closed on: a node passed through at a cosine of -0.14."""
    slope = np.array([-cosine, np.sqrt(1.0 - cosine**2)])
    face = np.array([[0.3, 0.0], [0.2, 0.0], [0.1, 0.0], [0.0, 0.0]])  # looks upwards
    node = np.array([0.15, 0.004])
    back = np.array([[-1.0, -1.0], [-1.0, 1.0]])
    tip = np.array([node + 0.1 * slope * [-1.0, 1.0], node, node + 0.1 * slope])
    chain = np.vstack([face, back, tip])
    assert ((7, 1) in couples(pairs_of(chain, orientation=1))) == expected


def test_an_open_node_meets_its_nearest_segment_only():
    points = wavy_slot()
    found = pairs_of(points, reach=0.3)
    assert np.unique(found.place).size == found.place.size


def crease(depth):
    """Groove with a right angle whose sides a corner touches on both sides at once.

    The corner of the upper body sits in the groove, pressed in by `depth` along both normals.
    """
    t = np.linspace(1.0, 0.0, 11)[:, None]
    left = np.array([[-1.0, 1.0]]) * t
    groove = np.vstack([left, (left * [-1.0, 1.0])[::-1][1:]])
    body = groove[::-1] * 0.97 + [0.0, 0.4]
    tip = len(body) // 2
    body[tip] = [0.0, -depth * np.sqrt(2.0)]
    turn = np.array([[2.0, 1.0], [2.0, 2.0]])
    return np.vstack([groove, turn, body]), len(groove) + len(turn) + tip


def test_a_node_in_a_crease_touches_both_sides():
    size = 0.1
    points, tip = crease(0.5 * BEHIND * size)
    found = pairs_of(points, reach=0.2, size=size)
    segments = {a for s, a in couples(found) if s == tip}
    assert segments == {9, 10}


def test_an_open_node_above_a_crease_meets_one_side():
    points, tip = crease(-0.01)
    found = pairs_of(points, reach=0.2)
    assert len([s for s, _ in couples(found) if s == tip]) == 1


def test_the_force_of_the_accepted_state_goes_to_one_pair_of_a_node():
    points, tip = crease(0.5 * BEHIND * 0.1)
    shear = np.zeros(len(points))
    shear[tip] = 0.4
    found = pairs_of(points, reach=0.2, shear_n=shear)
    assert found.shear_n[found.place == tip].sum() == pytest.approx(0.4)


def test_slip_is_measured_from_the_accepted_state():
    accepted, now = slot(-0.001, shift=0.05), slot(-0.001, shift=0.06)
    found = pairs_of(now, accepted)
    middle = np.abs(accepted[found.place, 0] - 2.0) < 1.0
    np.testing.assert_allclose(np.abs(pair_forces(found, now).slip[middle]), 0.01, rtol=1e-10)


def test_penetration_is_relative_to_the_local_size():
    now = slot(-0.001, shift=0.05)
    assert pair_penetration(pairs_of(now), now, boundary_of(now, size=0.1)) == pytest.approx(0.01)
    apart = slot(0.001, shift=0.05)
    assert pair_penetration(pairs_of(apart), apart, boundary_of(apart)) == 0.0
    assert pair_penetration(pairs_of(slot(5.0)), apart, boundary_of(apart)) == 0.0


# ---------------------------------------------------------------------- going on with the pairs


def on_flanks(pairs, count=41):
    """The pairs of the slot's two faces, those with the segments around its end left out."""
    first = pairs.nodes[:, 1:].min(axis=1)
    kept = (first < count - 1) | (first > count + 1)
    arrays = ("place", "nodes", "xi_n", "L_n", "stiffness", "shear_n")
    return replace(pairs, **{name: getattr(pairs, name)[kept] for name in arrays})


def rows(pairs):
    return {tuple(row) for row in pairs.nodes.tolist()}


def sheared(by):
    """Slot pressed shut by 1 % of the size, its upper face moved to the left."""
    return slot(-0.001, shift=0.05 - by)


def test_pairs_that_hold_are_handed_back_themselves():
    now = sheared(0.0)
    pairs = pairs_of(now)
    assert followed(pairs, pairs_of(now), now, boundary_of(now)) is pairs


def test_a_projection_a_little_off_its_segment_keeps_its_partner():
    """At a kink the next segment is found, but not deep enough to matter."""
    start, by = sheared(0.0), 0.05 + 0.5 * HOLD * 0.1
    now = sheared(by)
    now[43:, 1] += 0.001 - 0.5 * UNSEEN * 0.1
    pairs, found = pairs_of(start), pairs_of(now, start)
    assert not rows(found) <= rows(pairs)
    assert followed(pairs, found, now, boundary_of(now)) is pairs


def test_a_closed_pair_that_left_its_segment_is_dropped_and_its_successor_taken():
    start, now = sheared(0.0), sheared(0.05 + 2.0 * HOLD * 0.1)
    pairs, found = pairs_of(start), pairs_of(now, start)
    after = followed(pairs, found, now, boundary_of(now))
    xi = pair_forces(after, now).geometry.xi
    assert after is not pairs
    assert np.all(np.abs(xi - 0.5) <= 0.5 + HOLD)
    assert rows(found) <= rows(after)
    assert not rows(pairs) <= rows(after)


def test_an_open_pair_that_left_its_segment_does_no_harm_and_stays():
    start, now = slot(0.02, shift=0.05), slot(0.02, shift=-0.02)
    pairs = pairs_of(start)
    assert followed(pairs, pairs_of(now, start), now, boundary_of(now)) is pairs


@pytest.mark.parametrize("depth, expected", [(0.5 * UNSEEN, False), (2.0 * UNSEEN, True)])
def test_what_has_penetrated_visibly_is_added(depth, expected):
    start, now = slot(0.5, shift=0.05), slot(-depth * 0.1, shift=0.05)
    near = slot(0.02, shift=0.05)
    pairs, found = pairs_of(start), on_flanks(pairs_of(now, near))
    assert pairs.place.size == 0
    after = followed(pairs, found, now, boundary_of(now))
    assert (after is not pairs) == expected
    assert rows(after) == (rows(found) if expected else set())


def test_kept_pairs_carry_their_history():
    start, now = sheared(0.0), sheared(0.05 + 2.0 * HOLD * 0.1)
    shear = np.linspace(0.1, 0.2, len(start))
    pairs = pairs_of(start, shear_n=shear)
    after = followed(pairs, pairs_of(now, start), now, boundary_of(now))
    before = {tuple(r): i for i, r in enumerate(pairs.nodes.tolist())}
    kept = [(before[tuple(r)], j) for j, r in enumerate(after.nodes.tolist()) if tuple(r) in before]
    assert after.mu == pairs.mu
    for name in ("place", "xi_n", "L_n", "stiffness", "shear_n"):
        old, new = getattr(pairs, name), getattr(after, name)
        np.testing.assert_array_equal(new[[j for _, j in kept]], old[[i for i, _ in kept]])
