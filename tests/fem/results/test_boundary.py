"""Tables of the free boundary of runs: every node once, and the same numbers as elsewhere."""

import numpy as np
import pytest

from fem import Case, simulate
from fem.results.boundary import BOTTOM
from fem.stepping.model_parts import mesh_of

TRAILING_FACE, LEADING_FACE = "trailing face", "leading face"
SPEC = {"cells_x": 16, "cells_y": 8, "smallest_x_mm": 0.5, "smallest_y_mm": 0.4}


def case_of(velocity=300.0, **block):
    return Case.from_dict(
        {
            "loading": {
                "mean_pressure_N_per_mm2": 0.25,
                "velocity_mm_per_s": velocity,
                "distance_mm": 4.0,
            },
            "block": {"mesh": SPEC} | block,
            "friction": {"law": "coulomb", "mu": 0.9, "wlf": False},
            "output": {"snapshots": 1},
        }
    )


@pytest.fixture(scope="module", params=[False, True], ids=["deformable", "rigid"])
def run(request):
    return simulate(case_of(rigid=request.param))


def test_every_free_boundary_node_has_one_row_chain_by_chain(run):
    boundary = run.boundary
    assert list(boundary["chain"]) == [TRAILING_FACE] * 7 + [BOTTOM] * 17 + [LEADING_FACE] * 7
    assert not boundary.duplicated(["X_mm", "Y_mm"]).any()
    for _, chain in boundary.groupby("chain"):
        assert (np.diff(chain["s_mm"]) > 0.0).all()
    assert (boundary["block"] == 1).all()


def test_the_length_along_a_chain_is_that_of_its_edges(run):
    for name, start in ((TRAILING_FACE, (0.0, 8.0)), (BOTTOM, (0.0, 0.0)), (LEADING_FACE, None)):
        chain = run.boundary[run.boundary["chain"] == name]
        places = chain[["X_mm", "Y_mm"]].to_numpy()
        places = np.vstack([(20.0, 0.0) if start is None else start, places])
        steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
        np.testing.assert_allclose(chain["s_mm"], np.cumsum(steps), rtol=1e-12, atol=1e-12)


def test_the_table_is_the_last_state(run):
    mesh, last = mesh_of(run.case), run.snapshots[-1]
    nodes = mesh.candidates
    x = mesh.points[nodes] + last.displacement[nodes]
    np.testing.assert_allclose(run.boundary[["x_mm", "y_mm"]], x, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(run.boundary["T_C"], last.temperature[nodes], rtol=1e-12)


def test_open_nodes_carry_nothing_and_the_surface_is_the_bottom(run):
    boundary = run.boundary
    off = boundary["status"] == "open"
    assert (boundary.loc[off, ["pressure_N_per_mm2", "shear_N_per_mm2"]] == 0.0).all(axis=None)
    bottom = boundary[boundary["chain"] == BOTTOM]
    np.testing.assert_array_equal(bottom["T_C"], run.surface["T_C"])
    np.testing.assert_array_equal(bottom["status"] != "open", run.surface["in_contact"])


def test_the_rolled_face_is_in_the_table_and_its_forces_make_up_the_normal_force():
    """Pressure times current contact length over all chains; the face has rolled under."""
    finer = {"cells_x": 24, "cells_y": 12, "smallest_x_mm": 0.2, "smallest_y_mm": 0.1}
    hard = {"loading.mean_pressure_N_per_mm2": 0.4, "loading.distance_mm": 6.0}
    run = simulate(case_of(mesh=finer).with_overrides(hard))
    boundary, last = run.boundary, run.history.iloc[-1]
    touching = boundary["status"].to_numpy() != "open"
    assert touching[boundary["chain"] == LEADING_FACE].any()
    x = boundary["x_mm"].to_numpy()
    half = 0.5 * np.abs(np.diff(x)) * (touching[1:] & touching[:-1])
    length = np.append(half, 0.0) + np.append(0.0, half)
    assert length.sum() == pytest.approx(last["contact_length_mm"], rel=1e-9)
    force = float(boundary["pressure_N_per_mm2"] @ length)
    assert force == pytest.approx(last["normal_force_N_per_mm"], rel=1e-9)


def test_the_edge_is_as_hot_as_its_hottest_place_on_bottom_or_face(run):
    face = run.boundary.loc[run.boundary["chain"] == LEADING_FACE, "T_C"]
    corner = run.surface["T_C"].iloc[-1]
    assert run.summary["T_edge_C"] >= max(face.max(), corner)


def test_a_slide_to_the_left_gives_the_mirrored_table():
    right, left = simulate(case_of()).boundary, simulate(case_of(-300.0)).boundary
    for name in ("s_mm", "X_mm", "Y_mm", "y_mm", "pressure_N_per_mm2", "T_C"):
        np.testing.assert_allclose(left[name], right[name], rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(left["x_mm"], 20.0 - right["x_mm"], atol=1e-8)
    for name in ("shear_N_per_mm2", "slip_velocity_mm_per_s"):
        np.testing.assert_allclose(left[name], -right[name], rtol=1e-8, atol=1e-8)


def test_the_history_of_the_bottom_has_a_row_per_step_and_ends_with_the_surface():
    run = simulate(case_of())
    assert run.bottom.kind.shape == (len(run.history), len(run.surface))
    np.testing.assert_allclose(
        run.bottom.pressure[-1], run.surface["pressure_N_per_mm2"], rtol=1e-6
    )
    np.testing.assert_array_equal(run.bottom.kind[-1] > 0, run.surface["in_contact"])
    assert simulate(case_of(rigid=True)).bottom is None
