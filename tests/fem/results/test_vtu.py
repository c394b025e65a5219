"""Field files: the values other programs read are the ones that were computed."""

from __future__ import annotations

from xml.etree import ElementTree

import meshio
import numpy as np
import pytest

from fem.results.vtu import write_vtu
from tests.made_up_result import made_up_result


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("fields")
    result = made_up_result(snapshots=3)
    write_vtu(path, result.geometry, result.snapshots)
    return path, result


def test_displacement_is_a_three_component_vector_that_warps_the_reference_mesh(folder):
    path, result = folder
    mesh = meshio.read(path / "block_0002.vtu")
    assert mesh.points.shape == mesh.point_data["displacement_mm"].shape
    assert np.array_equal(mesh.points[:, :2], result.geometry.points)
    assert np.array_equal(
        mesh.point_data["displacement_mm"][:, :2], result.snapshots[2].displacement
    )
    assert not mesh.point_data["displacement_mm"][:, 2].any()


def test_stress_tensor_is_in_vtk_order_and_repeated_as_named_scalars(folder):
    path, result = folder
    cells = meshio.read(path / "block_0002.vtu").cell_data_dict
    tensor = cells["cauchy_stress_N_per_mm2"]["quad"]
    names = ["sigma_x", "sigma_y", "sigma_z", "sigma_xy"]
    assert tensor.shape[1] == 6
    for column, name in enumerate(names):
        expected = result.snapshots[2].cauchy_stress[:, column]
        assert np.array_equal(tensor[:, column], expected)
        assert np.array_equal(cells[f"{name}_N_per_mm2"]["quad"], expected)
    assert not tensor[:, 4:].any()


def test_quads_keep_a_positive_area(folder):
    path, _ = folder
    mesh = meshio.read(path / "block_0000.vtu")
    x, y = mesh.points[mesh.cells_dict["quad"]].transpose(2, 0, 1)[:2]
    area = 0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1)
    assert (area > 0.0).all()
    assert area.sum() == pytest.approx(160.0)


def test_collection_names_existing_files_at_their_times(folder):
    path, result = folder
    for part in ("block", "road"):
        sets = ElementTree.parse(path / f"{part}.pvd").getroot().findall("Collection/DataSet")
        assert [float(s.get("timestep")) for s in sets] == [s.time_s for s in result.snapshots]
        assert all((path / s.get("file")).is_file() for s in sets)
