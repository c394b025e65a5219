"""The mesh a case asks for."""

from __future__ import annotations

from fem.case import Case
from fem.mesh import NAMED_GRADINGS, BlockMesh, Grading, block_mesh


def case_mesh(case: Case) -> BlockMesh:
    """Build the block mesh of a case; the leading edge is on the side of the motion."""
    spec = case.block.mesh
    grading = (
        NAMED_GRADINGS[spec]
        if isinstance(spec, str)
        else Grading(
            cells_x=spec.cells_x,
            cells_y=spec.cells_y,
            smallest_x=spec.smallest_x_mm,
            smallest_y=spec.smallest_y_mm,
        )
    )
    direction = 1 if case.loading.velocity_mm_per_s > 0.0 else -1
    return block_mesh(case.block.length_mm, case.block.height_mm, grading, direction)
