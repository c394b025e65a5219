"""Line contact against Hertz, and partial slip against Cattaneo and Mindlin."""

import numpy as np
import pytest

from contact.active_set import STICK
from materials import NeoHooke
from tests.fem.contact_steps import (
    cylinder_block,
    load_of,
    pressed,
    reactions,
    small_block,
    solved,
)
from tests.reference_solutions.line_contact import LineContact, lame_constants

RADIUS, HALF_WIDTH, G, K_OVER_G, MU = 2500.0, 0.5, 1.0, 1000.0, 0.3


@pytest.fixture(scope="module")
def hertz():
    E, nu = lame_constants(G, K_OVER_G * G)
    force = np.pi * HALF_WIDTH**2 * E / (1.0 - nu**2) / (4.0 * RADIUS)
    return LineContact(radius=RADIUS, force=force, E=E, nu=nu)


@pytest.fixture(scope="module")
def system(hertz):
    """Strains are 1e-4 (a/R), the block is 40 contact widths large."""
    mesh = cylinder_block(RADIUS, 10.0, 100, 36, cell=HALF_WIDTH / 35.0, height=20.0)
    return small_block(mesh, NeoHooke(G=G), bulk_ratio=K_OVER_G, tolerance=1e-6 * hertz.force)


@pytest.fixture(scope="module")
def state(system, hertz):
    return pressed(system, hertz.force, steps=1)


@pytest.fixture(scope="module")
def profile(system, hertz, state):
    """Position [mm], pressure [N/mm^2] of the nodes in contact, without the two at the ends."""
    _, result, state = solved(system, state, load_of(system, force=hertz.force))
    active = result.x.status.active
    normal, _ = reactions(system, result)
    length = system.contact_lengths(state.u, active)
    x = (system.mesh.points + state.u)[system.candidates, 0]
    return x[active][1:-1], (normal / length)[active][1:-1]


def test_the_closed_form_is_in_balance(hertz):
    x = np.linspace(-HALF_WIDTH, HALF_WIDTH, 20001)
    assert hertz.half_width == pytest.approx(HALF_WIDTH)
    assert np.trapezoid(hertz.pressure(x), x) == pytest.approx(hertz.force, rel=1e-5)
    traction = hertz.partial_slip_traction(x, 0.5 * MU * hertz.force, MU)
    assert np.trapezoid(traction, x) == pytest.approx(0.5 * MU * hertz.force, rel=1e-5)


def test_peak_pressure_is_that_of_hertz(profile, hertz):
    _, p = profile
    assert p.max() == pytest.approx(hertz.peak_pressure, rel=0.02)


def test_half_width_is_that_of_hertz(profile, hertz):
    """p^2 is linear in x^2 and vanishes at the half width."""
    x, p = profile
    slope, at_zero = np.polyfit(x**2, p**2, 1)
    assert np.sqrt(-at_zero / slope) == pytest.approx(hertz.half_width, rel=0.02)


def test_the_pressure_follows_the_ellipse(profile, hertz):
    x, p = profile
    inner = np.abs(x) < 0.9 * HALF_WIDTH
    np.testing.assert_allclose(p[inner], hertz.pressure(x[inner]), atol=0.02 * hertz.peak_pressure)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_partial_slip_follows_cattaneo_and_mindlin(system, hertz, state, sense):
    """The stick zone ends within one node spacing of the closed form; slip opposes the sweep."""
    sweep = sense * 7e-5
    _, result, after = solved(system, state, load_of(system, force=hertz.force, mu=MU, sweep=sweep))
    _, tangential = reactions(system, result)
    status = result.x.status
    Q = abs(tangential.sum())
    assert 0.3 < Q / (MU * hertz.force) < 0.9
    assert np.sign(tangential.sum()) == -sense

    x = (system.mesh.points + after.u)[system.candidates, 0]
    c = hertz.stick_half_width(Q, MU)
    spacing = np.abs(np.diff(np.sort(x[np.abs(x) < HALF_WIDTH]))).max()
    stuck = np.abs(x[status.kind == STICK])
    assert stuck.max() == pytest.approx(c, abs=spacing)
    assert (np.abs(x[status.slipping]) > c - spacing).all()

    fine = np.linspace(-HALF_WIDTH, HALF_WIDTH, 4001)
    share = np.cumsum(hertz.partial_slip_traction(fine, Q, MU)) * (fine[1] - fine[0]) / Q
    middles = 0.5 * (x[status.active][1:] + x[status.active][:-1])
    found = np.cumsum(tangential[status.active])[:-1] / tangential.sum()
    # sums up to a point between two nodes: nodal forces of bilinear cells alternate a little
    np.testing.assert_allclose(found, np.interp(middles, fine, share), atol=0.02)
