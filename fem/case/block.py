"""The block of a case file: its outline, its mesh, or the file that holds both."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag, model_validator

from fem.case.base import Count, NotNegative, Positive, Section, Within, refuse
from materials.plausible import BLOCK_SIZE, SIPE_WIDTH

#: Elements a mesh may have at most. 250,000 take about ten gigabytes in the sparse solver.
LARGEST_MESH = 250_000
#: Deepest sipe that does not cut the block, and lowest base, over the height [-].
DEEPEST = 0.95
#: Largest chamfer, over the height and over half the length [-].
LARGEST_CHAMFER = 0.5
_Size = Annotated[Positive, Within(BLOCK_SIZE)]


class MeshSpec(Section):
    """Cell counts and smallest cells of a graded mesh, fine at the bottom and the leading edge."""

    cells_x: Count = Field(description="cells along the length [-]")
    cells_y: Count = Field(description="cells over the height [-]")
    smallest_x_mm: Positive = Field(description="length of the cell at the leading edge [mm]")
    smallest_y_mm: Positive = Field(description="height of the cell at the bottom [mm]")

    @model_validator(mode="after")
    def _not_huge(self) -> MeshSpec:
        cells = self.cells_x * self.cells_y
        if cells > LARGEST_MESH:
            refuse(
                "cells_x",
                f"{self.cells_x} x {self.cells_y} = {cells} elements",
                f"at most {LARGEST_MESH} elements",
            )
        return self


def _name_or_table(value: object) -> str:
    return "<table>" if isinstance(value, (dict, MeshSpec)) else "<name>"


MeshName = Literal["coarse", "default", "fine"]
Mesh = Annotated[
    Annotated[MeshName, Tag("<name>")] | Annotated[MeshSpec, Tag("<table>")],
    Discriminator(_name_or_table),
]


class Sipe(Section):
    """A straight cut into the block from the road."""

    position_mm: _Size = Field(
        description="middle of the mouth, from the trailing corner of the block [mm]"
    )
    width_mm: Annotated[Positive, Within(SIPE_WIDTH)] = Field(
        0.4, description="distance of its walls [mm]"
    )
    depth_mm: _Size = Field(description="height of its base above the road [mm]")
    angle_deg: Annotated[float, Field(ge=-30.0, le=30.0, allow_inf_nan=False)] = Field(
        0.0, description="to the vertical, positive when the base is ahead of the mouth [degrees]"
    )
    base: Literal["round", "flat"] = Field("round", description='"round" or "flat"')


class Block(Section):
    """The tread block's cross-section: one or several equal blocks on one platen, or a file."""

    length_mm: _Size = Field(20.0, description="length of one block along the motion [mm]")
    height_mm: _Size = Field(8.0, description="height from the road to the platen [mm]")
    mesh: Mesh = Field(
        "default",
        description='"coarse", "default", "fine" or a table of cells_x, cells_y, smallest_x_mm, '
        "smallest_y_mm",
    )
    chamfer_leading_mm: NotNegative = Field(0.0, description="at 45 degrees, leading edge [mm]")
    chamfer_trailing_mm: NotNegative = Field(0.0, description="the same, trailing edge [mm]")
    sipes: list[Sipe] = Field(
        default_factory=list,
        description="of each block: {position_mm, width_mm, depth_mm, angle_deg, base}, ...",
    )
    blocks: Annotated[int, Field(ge=1, le=20)] = Field(1, description="equal blocks in a row [-]")
    groove_mm: _Size = Field(5.0, description="distance between the blocks [mm]")
    base_mm: NotNegative = Field(
        0.0, description="rubber above the grooves, common to all blocks [mm]"
    )
    file: str | None = Field(
        None, description="mesh of the block: quadrilaterals, mm, road at y = 0, group top held"
    )
    file_sha256: str | None = Field(None, description="content of that file")
    rigid: bool = Field(
        False, description="true: no deformation, uniform pressure; heat and friction only"
    )

    @property
    def plain(self) -> bool:
        """Whether the outline is one rectangle."""
        return not (self.file or self._shaped)

    @property
    def _shaped(self) -> str:
        """A key that makes the outline other than a rectangle, or nothing."""
        shaped = {"chamfer_leading_mm", "chamfer_trailing_mm", "sipes"}
        more = "blocks" if self.blocks > 1 else ""
        return next((key for key in sorted(shaped) if getattr(self, key)), more)

    @property
    def pressed_length_mm(self) -> float:
        """Length that the mean pressure acts on, whatever chamfers and sipes take away [mm]."""
        return self.blocks * self.length_mm

    @model_validator(mode="after")
    def _mesh_fits(self) -> Block:
        if isinstance(self.mesh, MeshSpec):
            _check_grading("length_mm", self.length_mm, self.mesh.cells_x, "x", self.mesh)
            _check_grading("height_mm", self.height_mm, self.mesh.cells_y, "y", self.mesh)
        return self

    @model_validator(mode="after")
    def _file_alone(self) -> Block:
        if self.file is None and self.file_sha256 is not None:
            refuse("file_sha256", "a sum without file", "file, or neither")
        if self.file is not None and (self._shaped or self.mesh != "default"):
            key = self._shaped or "mesh"
            refuse(key, f"{key} beside file", "one of both: the file has the outline and the mesh")
        return self

    @model_validator(mode="after")
    def _outline_fits(self) -> Block:
        H, L = self.height_mm, self.length_mm
        largest = LARGEST_CHAMFER * min(H, 0.5 * L)
        for key in ("chamfer_leading_mm", "chamfer_trailing_mm"):
            if getattr(self, key) > largest:
                refuse(key, str(getattr(self, key)), f"at most {largest:.6g} mm for this block")
        if self.base_mm > DEEPEST * H:
            refuse("base_mm", str(self.base_mm), f"at most {DEEPEST * H:.6g} mm, or no groove")
        if self.base_mm and self.base_mm < (1.0 - DEEPEST) * H:
            refuse("base_mm", str(self.base_mm), f"0, or at least {(1.0 - DEEPEST) * H:.6g} mm")
        for number, sipe in enumerate(self.sipes):
            _check_sipe(f"sipes.{number}", sipe, self)
        return self


def _check_sipe(key: str, sipe: Sipe, block: Block) -> None:
    H, half = block.height_mm, 0.5 * sipe.width_mm
    if not (sipe.depth_mm <= DEEPEST * H or (sipe.depth_mm == H and not block.base_mm)):
        whole = "" if block.base_mm else f", or {H:g} for a cut through the block"
        refuse(f"{key}.depth_mm", str(sipe.depth_mm), f"at most {DEEPEST * H:.6g} mm{whole}")
    if sipe.depth_mm < sipe.width_mm:
        refuse(f"{key}.depth_mm", str(sipe.depth_mm), f"at least the width, {sipe.width_mm:g} mm")
    start = block.chamfer_trailing_mm + half
    stop = block.length_mm - block.chamfer_leading_mm - half
    if not start < sipe.position_mm < stop:
        expected = f"a place between {start:.6g} and {stop:.6g} mm from the trailing corner"
        refuse(f"{key}.position_mm", str(sipe.position_mm), expected)
    for other in block.sipes:
        apart = abs(other.position_mm - sipe.position_mm)
        if other is not sipe and apart <= half + 0.5 * other.width_mm:
            found = f"{sipe.position_mm:g}, {apart:.3g} mm from the next"
            refuse(f"{key}.position_mm", found, "sipes that do not touch each other")


def _check_grading(side: str, size: float, cells: int, axis: str, mesh: MeshSpec) -> None:
    key = f"smallest_{axis}_mm"
    uniform = size / cells
    # A hair of room, so that a uniform mesh may be asked for with a rounded cell size.
    if getattr(mesh, key) > uniform * (1.0 + 1e-6):
        refuse(
            f"mesh.{key}",
            str(getattr(mesh, key)),
            f"at most {uniform:.6g}, the cell of a uniform mesh ({side} / cells_{axis})",
        )
