"""What deformable and rigid runs have in common: the mesh of a case and the report of progress."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fem.case import LARGEST_MESH, Block, Case, CaseError, Sipe
from fem.mesh import (
    NAMED_GRADINGS,
    BlockMesh,
    Grading,
    MeshFileError,
    Slot,
    TreadShape,
    block_mesh,
    quality,
    read_mesh,
    shape_of_blocks,
    tread_mesh,
)


@dataclass(frozen=True, kw_only=True)
class Progress:
    """How far a run is, for a progress display."""

    sliding_distance_mm: float
    T_max_C: float
    newton_iterations: int


def mesh_of(case: Case) -> BlockMesh:
    """Block mesh of a case, its leading edge on the side of the motion.

    Raises
    ------
    CaseError
        If the outline leaves too little rubber somewhere.
    """
    block = case.block
    direction = 1 if case.loading.velocity_mm_per_s > 0 else -1
    if block.file is not None:
        return _mesh_of_file(case, direction)
    if block.plain:
        return block_mesh(block.length_mm, block.height_mm, _grading(block), direction)
    try:
        mesh = tread_mesh(_shape(block), _grading(block), block.length_mm, direction)
    except ValueError as error:
        found, _, expected = str(error).partition("; expected ")
        raise CaseError(case.source, "block.sipes", found, expected) from None
    if len(mesh.cells) > LARGEST_MESH:
        found, expected = f"{len(mesh.cells)} elements", f"at most {LARGEST_MESH}"
        raise CaseError(case.source, "block.mesh", found, expected)
    return mesh


def _mesh_of_file(case: Case, direction: int) -> BlockMesh:
    block = case.block
    assert block.file is not None
    try:
        mesh = read_mesh(block.file, direction)
    except MeshFileError as error:
        found = f"{Path(block.file).name}: {error.found}"
        raise CaseError(case.source, "block.file", found, error.expected) from None
    for key, size in (("length_mm", mesh.top_length), ("height_mm", mesh.height)):
        if key in block.model_fields_set and not np.isclose(getattr(block, key), size, rtol=1e-6):
            found, expected = str(getattr(block, key)), f"{size:.9g}, that of the file, or nothing"
            raise CaseError(case.source, f"block.{key}", found, expected)
    return mesh


def sized(case: Case) -> Case:
    """The case with the length and the height of the block's file, if it has one."""
    if case.block.file is None:
        return case
    mesh = mesh_of(case)
    sizes = {"block.length_mm": mesh.top_length, "block.height_mm": mesh.height}
    return case.with_overrides(sizes)


def mesh_described(case: Case) -> str:
    """Size and quality of the mesh of a case, in a sentence."""
    mesh = mesh_of(case)
    angle, ratio = quality(mesh)
    return (
        f"{len(mesh.cells)} quadrilaterals, smallest angle {angle:.0f} degrees, longest over "
        f"shortest side {ratio:.3g} at most, smallest side {mesh.size.min():.3g} mm"
    )


def _grading(block: Block) -> Grading:
    spec = block.mesh
    if isinstance(spec, str):
        return NAMED_GRADINGS[spec]
    return Grading(
        cells_x=spec.cells_x,
        cells_y=spec.cells_y,
        smallest_x=spec.smallest_x_mm,
        smallest_y=spec.smallest_y_mm,
    )


def _shape(block: Block) -> TreadShape:
    return shape_of_blocks(
        length=block.length_mm,
        height=block.height_mm,
        blocks=block.blocks,
        groove=block.groove_mm,
        base=block.base_mm,
        chamfers=(block.chamfer_trailing_mm, block.chamfer_leading_mm),
        sipes=[_slot(sipe) for sipe in block.sipes],
    )


def _slot(sipe: Sipe) -> Slot:
    angle = np.radians(sipe.angle_deg)
    return Slot(
        at=sipe.position_mm,
        width=float(sipe.width_mm / np.cos(angle)),
        depth=sipe.depth_mm,
        slope=float(np.tan(angle)),
        rounded=sipe.base == "round",
    )
