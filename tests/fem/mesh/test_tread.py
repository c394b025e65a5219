"""Meshes of blocks with chamfers, sipes and grooves: area, quality, chains, mirror image."""

import numpy as np
import pytest

from fem.case.case import Case
from fem.case.errors import CaseError
from fem.mesh.grading import NAMED_GRADINGS
from fem.mesh.sizes import Fine, divided
from fem.mesh.tread import quality
from fem.stepping.model_parts import mesh_of

L, H = 20.0, 8.0


def sipe(position, **more):
    return {"position_mm": position, "depth_mm": 6.0, "width_mm": 0.4} | more


def mesh_with(velocity=300.0, **block):
    loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": velocity, "distance_mm": 4.0}
    return mesh_of(Case.from_dict({"loading": loading, "block": {"mesh": "coarse"} | block}))


FLAT = [sipe(7.0, base="flat", angle_deg=30.0), sipe(14.0, base="flat", depth_mm=5.0)]
SHAPES = {
    "chamfers": {"chamfer_leading_mm": 1.0, "chamfer_trailing_mm": 0.5},
    "a round sipe": {"sipes": [sipe(10.0)]},
    "oblique sipes": {"sipes": [sipe(5.0, angle_deg=-20.0), sipe(13.0, angle_deg=30.0)]},
    "flat sipes": {"sipes": FLAT},
    "a cut": {"sipes": [sipe(10.0, depth_mm=8.0)]},
    "three sipes and chamfers": {
        "sipes": [sipe(5.0), sipe(10.0, depth_mm=4.8), sipe(15.0)], "chamfer_leading_mm": 2.0,
    },
    "two blocks": {"blocks": 2},
    "two blocks on a base": {"blocks": 2, "base_mm": 1.5, "sipes": [sipe(10.0, depth_mm=5.0)]},
}  # fmt: skip
AREAS = {
    "chamfers": L * H - 0.5 - 0.125,
    "flat sipes": L * H - 0.4 * 6.0 / np.cos(np.radians(30.0)) - 0.4 * 5.0,
    "a cut": (L - 0.4) * H,
    "two blocks": 2.0 * L * H,
}


def area(mesh):
    x, y = mesh.points[mesh.cells].transpose(2, 0, 1)
    return 0.5 * np.sum(x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y, axis=1)


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("name", SHAPES)
def test_cells_are_well_shaped_and_every_node_is_used(name, direction):
    mesh = mesh_with(velocity=300.0 * direction, **SHAPES[name])
    smallest, aspect = quality(mesh)
    assert smallest > 25.0
    assert aspect < 12.0
    assert (area(mesh) > 0.0).all()
    assert np.unique(mesh.cells).size == len(mesh.points)
    np.testing.assert_array_equal(
        np.concatenate([chain.nodes for chain in mesh.chains]), mesh.candidates
    )


@pytest.mark.parametrize("name", AREAS)
def test_straight_outlines_have_their_area(name):
    assert area(mesh_with(**SHAPES[name])).sum() == pytest.approx(AREAS[name], rel=1e-12)


def test_a_rounded_base_is_a_polygon_on_its_arc():
    """Four sides, whose corners lie on the half circle below the depth of the sipe."""
    polygon = 0.5 * 4 * 0.2**2 * np.sin(np.pi / 4)
    mesh = mesh_with(sipes=[sipe(10.0)])
    assert area(mesh).sum() == pytest.approx(L * H - 0.4 * 5.8 - polygon, rel=1e-9)
    wall = mesh.points[mesh.chains[2].nodes]
    on_arc = wall[wall[:, 1] > 5.8 - 1e-9]
    np.testing.assert_allclose(np.hypot(on_arc[:, 0] - 10.0, on_arc[:, 1] - 5.8), 0.2, rtol=1e-9)


@pytest.mark.parametrize("name", SHAPES)
def test_a_slide_to_the_left_has_the_mirror_image(name):
    right, left = mesh_with(**SHAPES[name]), mesh_with(velocity=-300.0, **SHAPES[name])
    np.testing.assert_allclose(left.points[:, 0], right.length - right.points[:, 0], atol=1e-12)
    np.testing.assert_array_equal(left.boundary, right.boundary)
    names = [[(c.name, c.block) for c in mesh.chains] for mesh in (left, right)]
    assert names[0] == names[1]


def test_zero_sizes_give_the_plain_mesh():
    plain, zero = mesh_with(), mesh_with(chamfer_leading_mm=0.0, sipes=[], blocks=1, base_mm=2.0)
    np.testing.assert_array_equal(plain.points, zero.points)
    np.testing.assert_array_equal(plain.cells, zero.cells)


def test_two_blocks_are_twice_the_plain_one():
    plain, two = mesh_with(), mesh_with(blocks=2, groove_mm=7.0)
    assert two.length == 47.0
    assert two.top_length == pytest.approx(40.0, rel=1e-12)
    assert len(two.bottoms) == len(two.curves) == two.blocks == 2
    assert two.points[two.bottoms[1].nodes[0], 0] == pytest.approx(27.0)
    for start, half in (
        (0.0, slice(None, len(plain.points))),
        (27.0, slice(-len(plain.points), None)),
    ):
        np.testing.assert_allclose(two.points[half] - [start, 0.0], plain.points, atol=1e-12)


def test_cells_are_as_small_as_the_grading_says_where_it_counts():
    grading = NAMED_GRADINGS["coarse"]
    mesh = mesh_with(sipes=[sipe(10.0)])
    for chain in mesh.bottoms:
        steps = np.diff(mesh.from_trailing(chain.nodes))
        assert steps[-1] == pytest.approx(grading.smallest_x, rel=0.1)
    assert mesh.bottom_cell_height == pytest.approx(grading.smallest_y, rel=0.1)


def test_divisions_hold_the_fixed_places_and_grow_away_from_the_fine_ones():
    x = divided([0.0, 3.0, 10.0], [Fine(at=3.0, size=0.1, growth=0.2)])
    steps = np.diff(x)
    middle = int(np.argmin(np.abs(x - 3.0)))
    assert x[middle] == 3.0
    assert (np.diff(steps[:middle]) < 0.0).all()
    assert (np.diff(steps[middle:]) > 0.0).all()
    assert steps.min() == pytest.approx(0.1, rel=0.15)


def test_too_little_rubber_between_oblique_sipes_is_refused_with_its_place():
    crossing = [sipe(8.0, angle_deg=25.0), sipe(11.0, angle_deg=-25.0)]
    with pytest.raises(CaseError, match=r"block\.sipes: found .* mm of rubber between"):
        mesh_with(sipes=crossing)
