"""Geometry behind the pictures of the block."""

from __future__ import annotations

import numpy as np
import pytest

from fem.mesh.block import block_mesh
from fem.mesh.grading import Grading
from validation.drawing.block_drawing import cell_areas, front_window, nodal_average, outline

MESH = block_mesh(20.0, 8.0, Grading(cells_x=12, cells_y=6, smallest_x=0.5, smallest_y=0.3))


def test_outline_is_the_boundary_of_the_block():
    edges = outline(MESH.cells)
    length = np.linalg.norm(np.diff(MESH.points[edges], axis=1)[:, 0], axis=1).sum()
    assert len(edges) == 2 * (12 + 6)
    assert length == pytest.approx(56.0)


def test_areas_of_the_cells_add_up_to_the_block():
    assert cell_areas(MESH.points[MESH.cells]).sum() == pytest.approx(160.0)


def test_nodal_average_keeps_a_constant_and_removes_a_checkerboard():
    uniform = block_mesh(6.0, 6.0, Grading(cells_x=6, cells_y=6, smallest_x=1.0, smallest_y=1.0))
    column, row = np.divmod(np.arange(36), 6)
    checkerboard = np.where((column + row) % 2 == 0, 1.0, -1.0)
    smooth = nodal_average(uniform.points, uniform.cells, 5.0 + checkerboard)
    inner = np.setdiff1d(np.arange(49), np.unique(outline(uniform.cells)))
    assert smooth[inner] == pytest.approx(5.0)
    constant = nodal_average(MESH.points, MESH.cells, np.full(72, -0.3))
    assert constant == pytest.approx(-0.3)


@pytest.mark.parametrize("direction", [1, -1])
def test_front_window_holds_the_leading_corner_and_mirrors(direction):
    mesh = block_mesh(
        20.0, 8.0, Grading(cells_x=40, cells_y=20, smallest_x=0.2, smallest_y=0.1), direction
    )
    window = front_window(mesh.points, mesh.points, direction=direction, aspect=0.66)
    corner = mesh.points[mesh.leading_corners[0], 0]
    assert window[0] < corner < window[1]
    assert window[2] < 0.0 < window[3]
    assert (window[3] - window[2]) / (window[1] - window[0]) == pytest.approx(0.66)
    assert abs(0.5 * (window[0] + window[1]) - corner) < 3.0
