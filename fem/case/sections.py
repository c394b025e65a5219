"""The plain sections of a case file: block, road, solver and output."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag, field_validator, model_validator

from contact.wear import EnergyWear
from fem.case.base import Count, Positive, Section, Within, refuse
from materials.plausible import (
    BLOCK_SIZE,
    CONDUCTIVITY,
    SOLID_DENSITY,
    SPECIFIC_HEAT,
)
from materials.thermal import ThermalProperties

#: Elements a mesh may have at most. 250,000 take about ten gigabytes in the sparse solver.
LARGEST_MESH = 250_000
#: Passes over friction coefficient and pairs of self-contact that a step can take.
MOST_PASSES = 6
_Size = Annotated[Positive, Within(BLOCK_SIZE)]
_Conductivity = Annotated[Positive, Within(CONDUCTIVITY)]
_Density = Annotated[Positive, Within(SOLID_DENSITY)]
_SpecificHeat = Annotated[Positive, Within(SPECIFIC_HEAT)]
_StepLength = Annotated[float, Field(ge=1e-7, le=1e3, allow_inf_nan=False)]
_ViscousDistance = Annotated[float, Field(ge=0.0, le=1e6, allow_inf_nan=False)]


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


class Block(Section):
    """The tread block's cross-section."""

    length_mm: _Size = Field(20.0, description="length along the sliding direction [mm]")
    height_mm: _Size = Field(8.0, description="height from the road to the platen [mm]")
    mesh: Mesh = Field(
        "default",
        description='"coarse", "default", "fine" or a table of cells_x, cells_y, smallest_x_mm, '
        "smallest_y_mm",
    )
    rigid: bool = Field(
        False, description="true: no deformation, uniform pressure; heat and friction only"
    )

    @model_validator(mode="after")
    def _mesh_fits(self) -> Block:
        if isinstance(self.mesh, MeshSpec):
            _check_grading("length_mm", self.length_mm, self.mesh.cells_x, "x", self.mesh)
            _check_grading("height_mm", self.height_mm, self.mesh.cells_y, "y", self.mesh)
        return self


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


class Road(Section):
    """Thermal data of the road (asphalt)."""

    conductivity_W_per_mK: _Conductivity = Field(0.70, description="thermal conductivity [W/(m K)]")
    density_kg_per_m3: _Density = Field(2000.0, description="density [kg/m^3]")
    specific_heat_kJ_per_kgK: _SpecificHeat = Field(0.92, description="specific heat [kJ/(kg K)]")

    @property
    def thermal(self) -> ThermalProperties:
        """Thermal properties in N, mm, s, t, K."""
        return ThermalProperties.from_paper_units(
            self.conductivity_W_per_mK, self.density_kg_per_m3, self.specific_heat_kJ_per_kgK
        )


class Solver(Section):
    """Numerical settings; the defaults are meant for every case."""

    tolerance: Annotated[float, Field(ge=1e-14, le=1e-2, allow_inf_nan=False)] = Field(
        1e-8, description="residual of the balance of forces relative to the load [-]"
    )
    step_mm_initial: _StepLength = Field(0.02, description="first sliding step [mm]")
    step_mm_max: _StepLength = Field(2.0, description="longest sliding step [mm]")
    step_mm_min: _StepLength = Field(
        1e-5, description="shortest sliding step before giving up [mm]"
    )
    newton_iterations_max: Annotated[int, Field(ge=1, le=1000)] = Field(
        25, description="Newton iterations per step at most [-]"
    )
    friction_passes: Annotated[int, Field(ge=1, le=MOST_PASSES)] = Field(
        2, description="passes per step over the lagged friction coefficient [-]"
    )
    inertia: bool = Field(True, description="backward-Euler inertia of the rubber")
    snap_damping: Literal["auto", "always", "never"] = Field(
        "auto",
        description='damping of steps without a solution: "auto": unless viscoelastic rubber damps '
        'the snaps of the edge itself; "always"; "never"',
    )
    viscous_distance_mm: _ViscousDistance = Field(
        0.05,
        description="relaxation time of that damping times velocity [mm]",
    )
    edge_viscous_distance_mm: _ViscousDistance = Field(
        5.0, description="the same, added at the leading corner [mm]"
    )
    edge_radius_mm: Annotated[Positive, Field(ge=1e-6, le=1e6)] = Field(
        2.0, description="distance from the leading corner over which that fades [mm]"
    )
    self_contact: bool = Field(True, description="contact of the block's surface with itself")
    heat_step_mm: _StepLength = Field(
        0.5, description="longest sliding distance per heat step [mm]"
    )
    steps_scale: Annotated[float, Field(ge=1e-3, le=100.0, allow_inf_nan=False)] = Field(
        1.0, description="factor on all steps; 0.5 halves them [-]"
    )
    linear_solver: Literal["auto", "superlu", "pardiso"] = Field(
        "auto",
        description='"superlu", "pardiso" (extra "fast"), or "auto": the faster, which is SuperLU',
    )

    @field_validator("linear_solver")
    @classmethod
    def _installed(cls, value: str) -> str:
        if value == "pardiso" and find_spec("pypardiso") is None:
            refuse("", '"pardiso" without pypardiso', '"superlu", or pip install treadfem[fast]')
        return value

    @model_validator(mode="after")
    def _steps_in_order(self) -> Solver:
        if self.step_mm_min > self.step_mm_initial:
            refuse("step_mm_min", str(self.step_mm_min), f"at most {self.step_mm_initial}")
        if self.step_mm_initial > self.step_mm_max:
            refuse("step_mm_initial", str(self.step_mm_initial), f"at most {self.step_mm_max}")
        return self


class Wear(Section):
    """Rubber worn off by the energy of friction; the shape of the block stays."""

    coefficient_mm3_per_J: Annotated[float, Field(ge=0.0, le=1e3, allow_inf_nan=False)] = Field(
        0.0, description="volume over friction work; tyres 0.0016 to 0.0099, 0 is off [mm^3/J]"
    )
    power_exponent: Annotated[Positive, Field(ge=0.1, le=5.0)] = Field(
        1.0, description="exponent n of the power, at a given energy; 1 is none [-]"
    )
    power_reference_W_per_mm2: Annotated[Positive, Field(ge=1e-6, le=1e6)] = Field(
        0.1, description="power at which the coefficient holds whatever n is [W/mm^2]"
    )

    def law(self) -> EnergyWear:
        """Build the law of wear."""
        return EnergyWear(
            coefficient=self.coefficient_mm3_per_J,
            power_exponent=self.power_exponent,
            reference_power=self.power_reference_W_per_mm2,
        )


class Output(Section):
    """What a run writes besides its tables."""

    snapshots: Annotated[int, Field(ge=1, le=10_000)] = Field(
        10, description="field snapshots over the slide [-]"
    )
    vtu: bool = Field(True, description="write the snapshots for ParaView")
    figures: bool = Field(True, description="draw the figures of the run")
    checkpoint_s: Annotated[float, Field(ge=0.0, le=1e7, allow_inf_nan=False)] = Field(
        5.0, description="time between checkpoints of a run [s]; 0 is one after each step"
    )
