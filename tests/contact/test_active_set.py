"""Open, stick and slip: what gaps, reactions and slips of an iterate ask for."""

import numpy as np
import pytest

from contact.active_set import OPEN, SLIP, STICK, ContactForces, ContactStatus, next_status

MU = 0.5


def status_of(kind, sense=1.0):
    return ContactStatus(kind=np.array([kind]), sense=np.array([sense]))


def forces_of(gap=0.0, normal=1.0, tangential=0.0, slip=0.0):
    values = {"gap": gap, "normal": normal, "tangential": tangential, "slip": slip}
    return ContactForces(**{name: np.array([value]) for name, value in values.items()})


def after(kind, sense=1.0, **forces):
    tolerances = {k: forces.pop(k) for k in ("force_tolerance", "slip_tolerance") if k in forces}
    status = next_status(status_of(kind, sense), forces_of(**forces), np.array([MU]), **tolerances)
    return status.kind[0], status.sense[0]


def test_an_open_node_above_the_road_stays_open():
    assert after(OPEN, gap=1e-9, normal=0.0)[0] == OPEN


def test_a_penetrating_node_closes_and_slips_along_its_motion():
    assert after(OPEN, gap=-1e-9, normal=0.0, slip=0.2) == (SLIP, 1.0)
    assert after(OPEN, gap=-1e-9, normal=0.0, slip=-0.2) == (SLIP, -1.0)


def test_a_penetrating_node_that_does_not_move_sticks():
    assert after(OPEN, gap=-1e-9, normal=0.0, slip=0.0)[0] == STICK


@pytest.mark.parametrize("kind", [STICK, SLIP])
def test_a_pulled_node_opens(kind):
    assert after(kind, normal=-1e-9)[0] == OPEN


@pytest.mark.parametrize("kind", [STICK, SLIP])
def test_a_pressed_node_stays_in_contact(kind):
    assert after(kind, normal=1.0, slip=0.1)[0] == kind


def test_stick_holds_up_to_the_friction_limit():
    assert after(STICK, normal=2.0, tangential=MU * 2.0)[0] == STICK
    assert after(STICK, normal=2.0, tangential=MU * 2.0 + 1e-9)[0] == SLIP


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_breaking_node_slips_against_the_force_of_the_road(sign):
    """The road holds the block back; released, the block moves against that force."""
    assert after(STICK, normal=1.0, tangential=sign) == (SLIP, -sign)


def test_a_slipping_node_that_turns_back_sticks():
    assert after(SLIP, sense=1.0, slip=0.1)[0] == SLIP
    assert after(SLIP, sense=1.0, slip=-1e-9)[0] == STICK
    assert after(SLIP, sense=-1.0, slip=1e-9)[0] == STICK


def test_violations_within_the_tolerances_change_nothing():
    """At a switch, rounding would otherwise toggle a node for ever."""
    assert after(STICK, normal=-1e-9, force_tolerance=1e-8)[0] == STICK
    assert after(STICK, normal=1.0, tangential=MU + 1e-9, force_tolerance=1e-8)[0] == STICK
    assert after(SLIP, slip=-1e-13, slip_tolerance=1e-12)[0] == SLIP


def test_a_pulling_reaction_has_no_friction_limit_below_zero():
    """A node that pulls within the tolerance must not break loose because of a negative limit."""
    assert after(STICK, normal=-9e-9, tangential=9e-9, force_tolerance=1e-8)[0] == STICK


def test_every_state_that_satisfies_the_contact_conditions_is_kept():
    """Complementarity and Coulomb's cone: fixed points of the switch, so no ping-pong."""
    rng = np.random.default_rng(1)
    m = 300
    kind = rng.integers(0, 3, m)
    sense = rng.choice([-1.0, 1.0], m)
    active, slip = kind != OPEN, kind == SLIP
    normal = np.where(active, rng.uniform(0.0, 2.0, m), 0.0)
    normal[:20] = 0.0
    mu = rng.uniform(0.1, 1.0, m)
    share = np.where(slip, -sense, rng.uniform(-1.0, 1.0, m))
    forces = ContactForces(
        gap=np.where(active, 0.0, rng.uniform(0.0, 1.0, m)),
        normal=normal,
        tangential=share * mu * normal,
        slip=np.where(slip, sense * rng.uniform(0.0, 1.0, m), 0.0),
    )
    status = ContactStatus(kind=kind, sense=sense)
    again = next_status(status, forces, mu, force_tolerance=1e-14)
    assert again.same_as(status)


def test_evaluation_changes_neither_status_nor_forces():
    status, forces = status_of(STICK), forces_of(normal=-1.0)
    next_status(status, forces, np.array([MU]))
    assert status.kind[0] == STICK
    assert forces.normal[0] == -1.0


def test_statuses_are_the_same_if_they_lead_to_the_same_equations():
    """The sense matters for slipping nodes only."""
    assert status_of(STICK, 1.0).same_as(status_of(STICK, -1.0))
    assert not status_of(SLIP, 1.0).same_as(status_of(SLIP, -1.0))
    assert not status_of(STICK).same_as(status_of(SLIP))


def test_masks_partition_the_candidates():
    status = ContactStatus(kind=np.array([OPEN, STICK, SLIP]), sense=np.ones(3))
    assert status.active.tolist() == [False, True, True]
    assert status.sticking.tolist() == [False, True, False]
    assert status.slipping.tolist() == [False, False, True]
    assert not ContactStatus.all_open(4).active.any()
