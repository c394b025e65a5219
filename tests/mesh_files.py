"""Mesh files of blocks as mesh generators write them: scattered numbers, in several formats."""

from __future__ import annotations

from pathlib import Path

import meshio
import numpy as np

Arrays = tuple[np.ndarray, np.ndarray, np.ndarray]


def grid(nx: int = 8, ny: int = 4, length: float = 20.0, height: float = 8.0) -> Arrays:
    """Points (n, 2), quadrilaterals and the lines of the top of a rectangle."""
    x, y = np.meshgrid(
        np.linspace(0, length, nx + 1), np.linspace(0, height, ny + 1), indexing="ij"
    )
    node = np.arange((nx + 1) * (ny + 1)).reshape(nx + 1, ny + 1)
    corners = [node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]]
    cells = np.column_stack([corner.ravel() for corner in corners])
    top = np.column_stack([node[:-1, -1], node[1:, -1]])
    return np.column_stack([x.ravel(), y.ravel()]), cells, top


def scattered(mesh: Arrays, seed: int = 1) -> Arrays:
    """The same mesh with its points, cells and first corners in another order."""
    points, cells, top = mesh
    random = np.random.default_rng(seed)
    numbers = random.permutation(len(points))
    moved = np.empty_like(points)
    moved[numbers] = points
    turned = np.array(
        [np.roll(cell, turn) for cell, turn in zip(cells, cells[:, 0] % 4, strict=True)]
    )
    return moved, numbers[random.permutation(turned)], numbers[random.permutation(top)]


def write_gmsh(
    path: Path, mesh: Arrays, *, group: str = "top", triangles: np.ndarray | None = None
) -> None:
    """A file of format 2.2 with a physical group of lines and one of the surface."""
    points, cells, top = mesh
    lists = [("line", top), ("quad", cells)]
    tags = [np.full(len(top), 1), np.full(len(cells), 2)]
    if triangles is not None:
        lists.append(("triangle", triangles))
        tags.append(np.full(len(triangles), 2))
    file = meshio.Mesh(
        np.column_stack([points, np.zeros(len(points))]) if points.shape[1] == 2 else points,
        [(kind, data) for kind, data in lists if len(data)],
        cell_data={
            name: [tag for tag, (_, data) in zip(tags, lists, strict=True) if len(data)]
            for name in ("gmsh:physical", "gmsh:geometrical")
        },
        field_data={group: np.array([1, 1]), "rubber": np.array([2, 2])},
    )
    meshio.gmsh.write(str(path), file, fmt_version="2.2", binary=False)


def write_abaqus(path: Path, mesh: Arrays) -> None:
    """A deck with a node set."""
    points, cells, top = mesh
    file = meshio.Mesh(points, [("quad", cells)], point_sets={"TOP": np.unique(top)})
    meshio.abaqus.write(str(path), file)


def write_vtk(path: Path, mesh: Arrays) -> None:
    """A file with an array of points."""
    points, cells, top = mesh
    held = np.zeros(len(points))
    held[np.unique(top)] = 1.0
    flat = np.column_stack([points, np.zeros(len(points))])
    meshio.Mesh(flat, [("quad", cells)], point_data={"top": held}).write(path)


WRITERS = {"block.msh": write_gmsh, "block.inp": write_abaqus, "block.vtk": write_vtk,
           "block.vtu": write_vtk}  # fmt: skip
