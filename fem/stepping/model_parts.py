"""What deformable and rigid runs have in common: the mesh of a case and the report of progress."""

from __future__ import annotations

from dataclasses import dataclass

from fem.case.case import Case
from fem.mesh.block import BlockMesh, block_mesh
from fem.mesh.grading import NAMED_GRADINGS, Grading


@dataclass(frozen=True, kw_only=True)
class Progress:
    """How far a run is, for a progress display."""

    sliding_distance_mm: float
    T_max_C: float
    newton_iterations: int


def mesh_of(case: Case) -> BlockMesh:
    """Block mesh of a case, its leading edge on the side of the motion."""
    block = case.block
    if isinstance(block.mesh, str):
        grading = NAMED_GRADINGS[block.mesh]
    else:
        spec = block.mesh
        grading = Grading(
            cells_x=spec.cells_x, cells_y=spec.cells_y,
            smallest_x=spec.smallest_x_mm, smallest_y=spec.smallest_y_mm,
        )  # fmt: skip
    direction = 1 if case.loading.velocity_mm_per_s > 0 else -1
    return block_mesh(block.length_mm, block.height_mm, grading, direction)
