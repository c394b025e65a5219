"""Meshes from files: the formats, scattered numbers, mirrored motion, the same results."""

from pathlib import Path

import numpy as np
import pytest

from fem import Case, simulate
from fem.mesh.block import block_mesh
from fem.mesh.file import read_mesh
from fem.mesh.grading import Grading
from fem.stepping import mesh_of
from tests.mesh_files import WRITERS, grid, scattered, write_gmsh

EXAMPLES = Path(__file__).parents[3] / "examples"
SPEC = {"cells_x": 24, "cells_y": 10, "smallest_x_mm": 0.3, "smallest_y_mm": 0.15}


@pytest.mark.parametrize("name", WRITERS)
def test_every_format_gives_the_same_block(name, tmp_path):
    WRITERS[name](tmp_path / name, scattered(grid()))
    mesh = read_mesh(tmp_path / name, 1)
    assert len(mesh.cells) == 32
    assert mesh.top_length == pytest.approx(20.0)
    assert [chain.name for chain in mesh.chains] == ["trailing face", "bottom", "leading face"]
    np.testing.assert_allclose(mesh.points[mesh.bottom, 0], np.linspace(0.0, 20.0, 9), atol=1e-9)
    np.testing.assert_allclose(mesh.points[mesh.top, 0], np.linspace(0.0, 20.0, 9), atol=1e-9)


def test_places_are_counted_from_the_trailing_end_whatever_the_file_says(tmp_path):
    points, cells, top = grid()
    write_gmsh(tmp_path / "b.msh", scattered((points - np.array([7.0, 0.0]), cells, top)))
    for direction in (1, -1):
        mesh = read_mesh(tmp_path / "b.msh", direction)
        np.testing.assert_allclose(
            mesh.from_trailing(mesh.bottom), np.linspace(0.0, 20.0, 9), atol=1e-9
        )
        assert mesh.direction == direction


def test_points_without_cells_are_left_out(tmp_path):
    points, cells, top = grid()
    write_gmsh(tmp_path / "b.msh", (np.vstack([points, [[50.0, -3.0]]]), cells, top))
    assert len(read_mesh(tmp_path / "b.msh", 1).points) == len(points)


def case_of(folder, **block):
    loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 2.0}
    tables = {"loading": loading, "block": block, "output": {"snapshots": 1}}
    return Case.from_dict(tables, folder=folder)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A file of the mesh that the builder makes, its numbers scattered."""
    folder = tmp_path_factory.mktemp("meshes")
    mesh = block_mesh(20.0, 8.0, Grading(cells_x=24, cells_y=10, smallest_x=0.3, smallest_y=0.15))
    top = np.column_stack([mesh.top[:-1], mesh.top[1:]])
    write_gmsh(folder / "block.msh", scattered((mesh.points, mesh.cells, top)))
    return folder


def test_a_rectangle_from_a_file_slides_like_the_one_of_the_builder(folder):
    built = simulate(case_of(folder, mesh=SPEC))
    read = simulate(case_of(folder, file="block.msh"))
    for name in ("friction_force_N_per_mm", "contact_length_mm", "platen_displacement_mm"):
        np.testing.assert_allclose(
            read.history[name].iloc[-1], built.history[name].iloc[-1], rtol=1e-2
        )
    assert read.summary["T_max_C"] == pytest.approx(built.summary["T_max_C"], abs=0.05)


def test_the_resolved_case_has_the_sizes_and_the_content_of_the_file(folder, tmp_path):
    result = simulate(
        case_of(folder, file="block.msh").with_overrides({"loading.distance_mm": 0.1})
    )
    assert result.case.block.length_mm == pytest.approx(20.0)
    assert len(result.case.block.file_sha256) == 64
    (tmp_path / "case.toml").write_text(result.case.to_toml())
    assert Case.from_toml(tmp_path / "case.toml") == result.case


def test_the_place_of_a_file_does_not_matter_but_its_content(folder, tmp_path):
    (tmp_path / "copy.msh").write_bytes((folder / "block.msh").read_bytes())
    write_gmsh(tmp_path / "other.msh", grid())
    first, copy = case_of(folder, file="block.msh"), case_of(tmp_path, file="copy.msh")
    assert first.hash() == copy.hash()
    assert first.hash() != case_of(tmp_path, file="other.msh").hash()


def test_the_example_is_the_outline_of_its_script_and_runs():
    """`tapered_block.geo`: 20 mm at the road, flanks that lean by 8 degrees, rounded edges."""
    case = Case.from_toml(EXAMPLES / "tapered_block.toml", {"loading.distance_mm": 0.05})
    mesh = mesh_of(case)
    lean = 8.0 * np.tan(np.radians(8.0))
    # Read, its first point along the road is at 0.
    assert mesh.points.min(axis=0) == pytest.approx([0.0, 0.0])
    assert mesh.points.max(axis=0) == pytest.approx([20.0 + 2.0 * lean, 8.0])
    assert np.ptp(mesh.points[mesh.top, 0]) == pytest.approx(20.0 + 2.0 * lean)
    on_road = mesh.points[mesh.points[:, 1] == 0.0, 0] - lean
    rounding = 0.5 * np.tan(np.radians(0.5 * (90.0 - 8.0)))
    assert [on_road.min(), on_road.max()] == pytest.approx([rounding, 20.0 - rounding])
    assert simulate(case).summary["status"] == "ok"
