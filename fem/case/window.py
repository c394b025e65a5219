"""Where the laws of a case were fitted: the ranges of the measurements behind its parameters."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from fem.case.base import Finite, Section, refuse
from fem.case.errors import describe

Range = Annotated[list[Finite], Field(min_length=2, max_length=2)]


class ContactWindow(Section):
    """Ranges of what a law of the contact was fitted to."""

    p_N_per_mm2: Range | None = Field(None, description="contact pressures [N/mm^2]")
    v_mm_per_s: Range | None = Field(
        None, description="sliding speeds, shifted to T_ref_C where there is a shift [mm/s]"
    )
    T_C: Range | None = Field(None, description="temperatures of the rubber's surface [deg C]")

    @model_validator(mode="after")
    def _low_before_high(self) -> ContactWindow:
        for name in type(self).model_fields:
            limits = getattr(self, name)
            if limits is not None and limits[0] > limits[1]:
                refuse(name, describe(limits), "the lowest value, then the highest")
        return self


class RubberWindow(Section):
    """Range of what an elastic law was fitted to."""

    largest_stretch: Annotated[float, Field(ge=1.0, allow_inf_nan=False)] = Field(
        description="largest principal stretch of the tests [-]"
    )
