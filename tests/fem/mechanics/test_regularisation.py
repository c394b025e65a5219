"""Damping of snaps: what its rate scales with, where it sits, and when there is none."""

import numpy as np
import pytest

from fem import Case
from fem.mechanics.regularisation import SnapDamping
from fem.stepping.model_parts import mesh_of

MESH = {"cells_x": 20, "cells_y": 8, "smallest_x_mm": 1.0, "smallest_y_mm": 1.0}


def case_of(**solver):
    loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 1.0}
    return Case.from_dict({"block": {"mesh": MESH}, "loading": loading, "solver": solver})


def damping(**solver):
    case = case_of(**solver)
    return SnapDamping.from_case(case, mesh_of(case))


@pytest.mark.parametrize(("level", "motion"), [(1.0, 0.02), (3.0, 0.02), (3.0, 0.5), (64.0, 2.0)])
def test_rate_is_proportional_to_the_level_and_to_the_inverse_motion(level, motion):
    one = damping()
    np.testing.assert_allclose(
        one.rate(level, motion), level / motion * one.rate(1.0, 1.0), rtol=1e-14
    )


def test_rate_is_the_shear_modulus_times_the_share_of_the_distance_slid():
    """A strain that goes on over the whole relaxation distance meets the shear modulus."""
    G = case_of().rubber.model().initial_shear_modulus
    rate = damping(viscous_distance_mm=0.4, edge_viscous_distance_mm=0.0).rate(1.0, 0.4)
    np.testing.assert_allclose(rate, G, rtol=1e-14)
    assert rate.shape == (160, 1)


def test_the_part_of_the_edge_fades_with_the_distance_from_the_leading_corner():
    case = case_of(viscous_distance_mm=0.0, edge_viscous_distance_mm=5.0, edge_radius_mm=3.0)
    mesh = mesh_of(case)
    strength = SnapDamping.from_case(case, mesh).strength.ravel()
    r = np.linalg.norm(mesh.points[mesh.cells].mean(axis=1) - np.array([20.0, 0.0]), axis=1)
    assert np.argmax(strength) == np.argmin(r)
    G = case.rubber.model().initial_shear_modulus
    np.testing.assert_allclose(strength, 5.0 * G * np.exp(-((r / 3.0) ** 2)), rtol=1e-12)


def test_without_help_or_without_distances_there_is_no_damping():
    assert damping().rate(0.0, 0.02) is None
    none = damping(viscous_distance_mm=0.0, edge_viscous_distance_mm=0.0)
    assert none.rate(64.0, 0.02) is None
