"""The [heat] section: heat partition, gap conductance, radiation, start temperature."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from contact.conductance import GapConductance
from contact.partition import HeatPartition
from fem.case.base import (
    Celsius,
    Exponent,
    NotNegative,
    NotNegativeExponent,
    Positive,
    Section,
    Share,
    Within,
    refuse,
    refuse_sentence,
)
from fem.case.errors import describe
from fem.case.window import ContactWindow
from materials.plausible import CONDUCTANCE, PRESSURE, START_TEMPERATURE

_Start = Annotated[Celsius, Within(START_TEMPERATURE)]
_Conductance = Annotated[NotNegative, Within(CONDUCTANCE)]
_Pressure = Annotated[Positive, Within(PRESSURE)]
_Velocity = Annotated[Positive, Field(ge=1e-9, le=1e9)]
_Film = Annotated[NotNegative, Field(le=1e4)]
_Prefactor = Annotated[NotNegative, Field(le=100.0)]


class Partition(Section):
    """Share of the friction power that becomes heat, kappa = prefactor p^exponent, capped."""

    law: Literal["power", "constant"] = Field(
        "power", description='"power": prefactor p^exponent, eq. (14); "constant": the prefactor'
    )
    prefactor: _Prefactor = Field(0.3146, description="kappa at 1 N/mm^2 [-]")
    exponent: Exponent = Field(-0.6833, description="exponent of the pressure [-]")
    cap: Share = Field(1.0, description="largest share that may become heat [-]")
    pressure: Literal["mean", "local"] | _Pressure = Field(
        "mean",
        description='p of eq. (14): "mean": of the contact, one for all points, as in the paper; '
        '"local"; or a number [N/mm^2]',
    )

    @model_validator(mode="before")
    @classmethod
    def _constant_has_no_exponent(cls, data: Any) -> Any:
        if not isinstance(data, dict) or data.get("law") != "constant":
            return data
        if data.get("exponent", 0.0) != 0.0:
            refuse("exponent", describe(data["exponent"]), 'none for law = "constant"')
        return {**data, "exponent": 0.0}


class Heat(Section):
    """Heat made at the contact, passed to the road and radiated."""

    partition: Partition = Field(Partition(), description="share of friction power made heat")
    window: ContactWindow | None = Field(
        None, description="ranges the partition was fitted to; a run says what leaves them"
    )
    conductance_W_per_m2K: _Conductance = Field(
        1600.0, description="gap conductance at pressure_N_per_mm2 [W/(m^2 K)]"
    )
    pressure_N_per_mm2: _Pressure = Field(
        0.3, description="pressure the conductance was measured at [N/mm^2]"
    )
    exponent: NotNegativeExponent = Field(
        0.94, description="conductance over pressure, eq. (11) [-]"
    )
    modulus_exponent: NotNegativeExponent = Field(
        0.0, description="exponent m of E1(v)/E1(0) = (1 + v/v_ref)^m; the paper gives none [-]"
    )
    modulus_velocity_mm_per_s: _Velocity = Field(
        1.0, description="v_ref of the stiffening of the rubber's surface [mm/s]"
    )
    emissivity: Share = Field(0.9, description="of every free surface [-]")
    convection_W_per_m2K: _Film = Field(
        0.0, description="film coefficient of the block's free surfaces [W/(m^2 K)]"
    )
    ambient_C: _Start = Field(20.0, description="surroundings and start temperature [deg C]")

    def partition_object(self) -> HeatPartition:
        """Build kappa(p)."""
        return HeatPartition(
            prefactor=self.partition.prefactor,
            exponent=self.partition.exponent,
            cap=self.partition.cap,
            pressure=self.partition.pressure,
        )

    def conductance_object(self) -> GapConductance:
        """Build h(p, v) in W/(m^2 K)."""
        return GapConductance(
            h_ref=self.conductance_W_per_m2K,
            p_ref=self.pressure_N_per_mm2,
            exponent=self.exponent,
            modulus_exponent=self.modulus_exponent,
            v_ref=self.modulus_velocity_mm_per_s,
        )

    @model_validator(mode="after")
    def _objects_exist(self) -> Heat:
        for key, build in (
            ("partition", self.partition_object),
            ("conductance_W_per_m2K", self.conductance_object),
        ):
            try:
                build()
            except ValueError as error:
                refuse_sentence(key, "parameters outside their range", error)
        return self
