"""The first millimetre of sliding is the elastic one: nothing artificial acts before a snap."""

import numpy as np
import pytest

from fem import Case, simulate

#: Friction force [N/mm] over the platen's motion [mm] of the introductory example (default mesh)
#: without any regularisation; linear, as the block shears like a spring before it slides in full.
MOTION, FORCE = (0.1625, 0.4156, 0.9852), (0.268, 0.691, 1.649)
#: Platen after pressing without regularisation [mm].
PLATEN = 0.2610
#: 2 % of the force of full sliding, 4.5 N/mm.
TOLERANCE = 0.09


#: Force at 0.9852 mm with a coefficient of 0.6, where the edge snaps at 0.62 mm, in 0.05 mm steps
#: with a hundredth of the damping (validation/onset.csv), and 2 % of full sliding, 3 N/mm.
FORCE_AFTER_SNAP, TOLERANCE_AFTER_SNAP = 1.593, 0.06


def slid_by_a_millimetre(**friction):
    """The introductory example with default settings."""
    loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 1.0}
    output = {"snapshots": 1, "vtu": False}
    return simulate(Case.from_dict({"loading": loading, "output": output, "friction": friction}))


@pytest.fixture(scope="module")
def onset():
    return slid_by_a_millimetre()


def test_friction_force_rises_as_without_regularisation(onset):
    history = onset.history
    force = np.interp(
        MOTION, history["sliding_distance_mm"], history["friction_force_N_per_mm"].abs()
    )
    np.testing.assert_allclose(force, FORCE, rtol=0.0, atol=TOLERANCE)


def test_platen_sinks_as_without_regularisation(onset):
    pressed = onset.history[onset.history["sliding_distance_mm"] == 0.0]
    assert pressed["platen_displacement_mm"].iloc[-1] == pytest.approx(PLATEN, rel=0.02)


def test_nothing_artificial_takes_work_before_the_edge_snaps(onset):
    assert onset.history["viscous_dissipation_mJ_per_mm"].iloc[-1] == 0.0
    assert onset.summary["regularisation_share_with_onset"] == 0.0
    assert onset.summary["sliding_regime"] == "onset"


def test_an_early_snap_leaves_the_force_where_it_is_without_regularisation():
    history = slid_by_a_millimetre(law="coulomb", mu=0.6, wlf=False).history
    force = np.interp(
        0.9852, history["sliding_distance_mm"], history["friction_force_N_per_mm"].abs()
    )
    assert history["viscous_dissipation_mJ_per_mm"].iloc[-1] > 0.0
    assert force == pytest.approx(FORCE_AFTER_SNAP, abs=TOLERANCE_AFTER_SNAP)
