"""A block cut into lamellae by sipes of its full height: slender cantilevers side by side.

The closed form is that of small loads on free ends, so the road is left out: the force acts along
the bottom, spread evenly, and nothing hinders the ends from turning.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve

from contact.active_set import ContactStatus
from fem import Case
from fem.mechanics import StepLoad
from fem.simulation import coupled_model
from tests.reference_solutions.cantilever import cantilever_stiffness

LENGTH, GAP, G = 20.0, 0.4, 1.0


def width_of(count):
    return (LENGTH - (count - 1) * GAP) / count


def cut_block(count, height):
    """Mechanics of a block of `count` lamellae of neo-Hookean rubber."""
    middle = np.arange(1, count) * (width_of(count) + GAP) - 0.5 * GAP
    sipes = [
        {"position_mm": x, "depth_mm": height, "width_mm": GAP, "base": "flat"} for x in middle
    ]
    mesh = {
        "cells_x": 40,
        "cells_y": 40,
        "smallest_x_mm": LENGTH / 40,
        "smallest_y_mm": height / 40,
    }
    case = Case.from_dict(
        {
            "block": {"length_mm": LENGTH, "height_mm": height, "sipes": sipes, "mesh": mesh},
            "rubber": {"model": "neo-hooke", "G_N_per_mm2": G},
            "loading": {
                "mean_pressure_N_per_mm2": 0.25,
                "velocity_mm_per_s": 300.0,
                "distance_mm": 1.0,
            },
            "solver": {"inertia": False, "self_contact": False},
        }
    )
    return coupled_model(case).mechanics


def shear_stiffness(mechanics):
    """Force along the bottom over its mean motion, linear, without a road."""
    mesh, count = mechanics.mesh, mechanics.candidates.size
    state = replace(mechanics.initial_state(), status=ContactStatus.all_open(count))
    problem = mechanics.step(state, StepLoad(dt=1.0, sweep=0.0, force=0.0, mu=np.zeros(count)))
    tangent = problem.tangent(problem.evaluate(problem.start()))
    edges = mesh.boundary_edges
    edges = edges[np.all(mesh.points[edges, 1] == 0.0, axis=1)]
    halves = 0.5 * np.abs(np.diff(mesh.points[edges, 0], axis=1)[:, 0])
    share = np.bincount(edges.ravel(), np.repeat(halves, 2), minlength=len(mesh.points))
    share /= share.sum()
    load = np.column_stack([share, np.zeros_like(share)])
    u = mechanics.scatter(spsolve(tangent, mechanics.gather(load)))
    return 1.0 / float(share @ u[:, 0])


@pytest.fixture(scope="module")
def ratios():
    """Stiffness over that of as many cantilevers, by slenderness from 3.1 to 8."""
    blocks = [(3, 20.0), (5, 14.0), (5, 20.0), (7, 20.0)]
    return [
        shear_stiffness(cut_block(count, height))
        / (count * cantilever_stiffness(width_of(count), height, G))
        for count, height in blocks
    ]


def test_lamellae_are_cantilevers_in_bending_and_shear(ratios):
    """Without the shear of the closed form, 13 % of the deflection of the stoutest, not."""
    assert all(abs(ratio - 1.0) < 0.05 for ratio in ratios)


def test_lamellae_tend_to_cantilevers_as_they_get_slender(ratios):
    errors = [ratio - 1.0 for ratio in ratios]
    assert errors == sorted(errors, reverse=True)
    assert abs(errors[-1]) < 0.01 < errors[0]
