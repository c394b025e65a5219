"""The plain sections of a case file: road, solver and output."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Annotated, Literal

from pydantic import Field, field_validator, model_validator

from contact.wear import EnergyWear
from fem.case.base import NotNegative, Positive, Section, Within, refuse
from materials.plausible import (
    CONDUCTIVITY,
    PYROMETER_GAP,
    PYROMETER_SPOT,
    SOLID_DENSITY,
    SPECIFIC_HEAT,
)
from materials.thermal import ThermalProperties

#: Passes over friction coefficient and pairs of self-contact that a step can take.
MOST_PASSES = 6
_Conductivity = Annotated[Positive, Within(CONDUCTIVITY)]
_Density = Annotated[Positive, Within(SOLID_DENSITY)]
_SpecificHeat = Annotated[Positive, Within(SPECIFIC_HEAT)]
_StepLength = Annotated[float, Field(ge=1e-7, le=1e3, allow_inf_nan=False)]
_ViscousDistance = Annotated[float, Field(ge=0.0, le=1e6, allow_inf_nan=False)]


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
        1e-5,
        description="shortest sliding step before giving up, a hundredth of it where the "
        "rubber damps the snaps [mm]",
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


class Pyrometer(Section):
    """A pyrometer behind the end of the road, which sees the bottom of the block run off."""

    gap_mm: Annotated[NotNegative, Within(PYROMETER_GAP)] = Field(
        description="from the end of the road to the near edge of the spot [mm]"
    )
    spot_mm: Annotated[NotNegative, Within(PYROMETER_SPOT)] = Field(
        description="width of the spot along the sliding direction; 0: a point [mm]"
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
