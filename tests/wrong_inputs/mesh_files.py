"""Mesh files that are no block."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from tests.mesh_files import Arrays, grid, scattered, write_gmsh
from tests.wrong_inputs.cases import LOADING
from tests.wrong_inputs.rows import WrongInput

FILE = '[block]\nfile = "block.msh"\n'
NONE = np.zeros((0, 2), dtype=np.int64)


def changed(
    change: Callable[[np.ndarray, np.ndarray, np.ndarray], Arrays],
) -> Callable[[Path], None]:
    return lambda path: write_gmsh(path, change(*grid()))


def with_points(change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Path], None]:
    return changed(lambda points, cells, top: (change(points), cells, top))


def triangles(path: Path) -> None:
    points, cells, top = grid()
    write_gmsh(
        path, (points, cells[:0], top), triangles=np.vstack([cells[:, :3], cells[:, [0, 2, 3]]])
    )


def mixed(path: Path) -> None:
    points, cells, top = grid()
    write_gmsh(path, (points, cells[4:], top), triangles=cells[:4, :3])


def two_pieces(points: np.ndarray, cells: np.ndarray, top: np.ndarray) -> Arrays:
    n = len(points)
    beside = points + np.array([30.0, 0.0])
    return np.vstack([points, beside]), np.vstack([cells, cells + n]), np.vstack([top, top + n])


def doubled(points: np.ndarray, cells: np.ndarray, top: np.ndarray) -> Arrays:
    cells = cells.copy()
    cells[cells == 7] = np.where(np.arange(np.count_nonzero(cells == 7)) < 2, 7, len(points))
    return np.vstack([points, points[7:8]]), cells, top


def hanging(points: np.ndarray, cells: np.ndarray, top: np.ndarray) -> Arrays:
    """The cell beyond an edge is cut in two halves, whose common corner lies on that edge."""
    n, (a, b, c, d) = len(points), cells[-3]
    middles = [points[[a, d]].mean(axis=0), points[[b, c]].mean(axis=0)]
    cut = np.array([[a, b, n + 1, n], [n, n + 1, c, d]])
    return np.vstack([points, middles]), np.vstack([np.delete(cells, -3, axis=0), cut]), top


def hole(points: np.ndarray, cells: np.ndarray, top: np.ndarray) -> Arrays:
    return points, np.delete(cells, 13, axis=0), top


def pinched(points: np.ndarray, cells: np.ndarray, top: np.ndarray) -> Arrays:
    """Two cells of the bottom row that touch in a corner only."""
    return points, np.delete(cells, [8, 13], axis=0), top


def bent(points: np.ndarray) -> np.ndarray:
    points = points.copy()
    points[12] += [1.9, 1.4]
    return points


ROWS: list[tuple[str, Callable[[Path], None] | str, str, str]] = [
    ("triangles", triangles, "cells of type triangle", "quadrilaterals only"),
    ("mixed cells", mixed, "4 cells of type triangle", "quadrilaterals only"),
    (
        "negative areas",
        changed(lambda p, c, t: (p, c[:, ::-1], t)),
        "32 cells of negative area",
        "counter-clockwise",
    ),
    (
        "no top",
        lambda path: write_gmsh(path, grid(), group="upper"),
        "no group top (groups:",
        "a group top",
    ),
    ("two pieces", changed(two_pieces), "2 loose pieces", "one piece"),
    ("metres", with_points(lambda p: 1e-3 * p), "looks like metres", "millimetres"),
    (
        "y down",
        with_points(lambda p: p * [1.0, -1.0] + [0.0, 8.0]),
        "negative area",
        "counter-clockwise",
    ),
    ("upside down", with_points(lambda p: [20.0, 8.0] - p), "a group top at y = 0 mm", "y upwards"),
    (
        "road not at 0",
        with_points(lambda p: p + np.array([0.0, 2.0])),
        "a lowest point at y = 2 mm",
        "y = 0",
    ),
    ("double nodes", changed(doubled), "1 pairs of nodes at one place", "share their nodes"),
    (
        "hanging nodes",
        changed(hanging),
        "nodes on edges they do not belong to",
        "meet at their corners",
    ),
    ("a hole", changed(hole), "a hole", "without holes"),
    ("cells touching in a point", changed(pinched), "cells that meet in the point", "one piece"),
    ("cells not convex", with_points(bent), "not convex", "convex quadrilaterals"),
    (
        "an oblique top",
        with_points(lambda p: p * [1.0, 1.0] + np.outer(p[:, 0] * p[:, 1], [0, 1e-3])),
        "a group top from y",
        "a straight top",
    ),
    ("not a mesh", "hello", "not readable", "gmsh"),
    (
        "out of the plane",
        with_points(lambda p: np.column_stack([p, 0.1 * p[:, 0]])),
        "z from 0 to 2",
        "a plane mesh",
    ),
    (
        "a top inside",
        changed(lambda p, c, t: (p, c, t - 1)),
        "a group top at y = 6 mm",
        "above everything",
    ),
    (
        "the top alone",
        changed(lambda p, c, t: (p, c[:0], t)),
        "no quadrilaterals",
        "a mesh of them",
    ),
]

MESH_FILES = [
    WrongInput(
        kind=f"mesh file: {kind}",
        words=("run", "case.toml", "-o", "out"),
        files={"case.toml": LOADING + FILE, "block.msh": content},
        expected=("case.toml", "block.file", found, expected),
    )
    for kind, content, found, expected in ROWS
] + [
    WrongInput(
        kind="mesh file: not there",
        words=("check", "case.toml"),
        files={"case.toml": LOADING + FILE},
        expected=("case.toml", "block.file", "no such file"),
    ),
    WrongInput(
        kind="mesh file: another length",
        words=("check", "case.toml"),
        files={
            "case.toml": LOADING + FILE + "length_mm = 25.0\n",
            "block.msh": lambda path: write_gmsh(path, scattered(grid())),
        },
        expected=("case.toml", "block.length_mm", "25.0", "20, that of the file"),
    ),
    WrongInput(
        kind="mesh file: beside sipes",
        words=("check", "case.toml"),
        files={
            "case.toml": LOADING + FILE + "blocks = 2\n",
            "block.msh": lambda path: write_gmsh(path, grid()),
        },
        expected=("case.toml", "block.blocks", "blocks beside file", "one of both"),
    ),
]

SIPE = "sipes = [{position_mm = 10.0, depth_mm = 6.0}]\n"
#: Keys of [block], the key blamed, what was found and expected.
OUTLINE_ROWS = [
    ("chamfer_leading_mm = 6.0\n", "block.chamfer_leading_mm", "6.0", "at most 4 mm"),
    ("chamfer_trailing_mm = -1.0\n", "block.chamfer_trailing_mm", "-1.0", "at least 0"),
    (SIPE.replace("10.0", "20.0"), "block.sipes.0.position_mm", "20.0", "between 0.2 and 19.8 mm"),
    (SIPE.replace("6.0", "7.9"), "block.sipes.0.depth_mm", "7.9", "or 8 for a cut"),
    (SIPE.replace("6.0", "6.0, width_mm = 50.0"), "block.sipes.0.width_mm", "50.0", "0.02"),
    (SIPE.replace("6.0", "6.0, angle_deg = 45.0"), "block.sipes.0.angle_deg", "45.0", "at most 30"),
    (SIPE.replace("6.0", '6.0, base = "sharp"'), "block.sipes.0.base", "sharp", "round"),
    (
        SIPE.replace("6.0", "6.0, widht_mm = 0.4"),
        "block.sipes.0.widht_mm",
        "unknown key",
        "width_mm",
    ),
    (
        "sipes = [{position_mm = 10.0, depth_mm = 6.0}, {position_mm = 10.3, depth_mm = 5.0}]\n",
        "block.sipes.0.position_mm",
        "0.3 mm from the next",
        "do not touch",
    ),
    (
        "sipes = [{position_mm = 9.0, depth_mm = 6.0, angle_deg = 20.0}, "
        "{position_mm = 12.0, depth_mm = 6.0, angle_deg = -20.0}]\n",
        "block.sipes",
        "mm of rubber between",
        "expected at least",
    ),
    ("sipes = 3\n", "block.sipes", "3", "an array"),
    ("blocks = 0\n", "block.blocks", "0", "at least 1"),
    ("blocks = 2\nbase_mm = 7.9\n", "block.base_mm", "7.9", "at most 7.6 mm"),
    ("blocks = 2\ngroove_mm = 0.0\n", "block.groove_mm", "0.0", "greater than 0"),
]

OUTLINES = [
    WrongInput(
        kind=f"outline: {found} as {key} ({number})",
        words=("check", "case.toml"),
        files={"case.toml": LOADING + "[block]\n" + text},
        expected=("case.toml", key, found, expected),
    )
    for number, (text, key, found, expected) in enumerate(OUTLINE_ROWS)
]
