"""What the rubber remembers: ``viscoelastic`` and ``mullins`` of the [rubber] section."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from fem.case.base import Celsius, NotNegative, Positive, Section, Within, refuse, refuse_sentence
from materials.plausible import TEMPERATURE, WLF_D1, WLF_D2
from materials.prony import Prony
from materials.softening import OgdenRoxburgh
from materials.wlf import WLF

_Modulus = Annotated[Positive, Field(ge=1e-9, le=1e4)]
_Time = Annotated[Positive, Field(ge=1e-12, le=1e12)]
#: A branch takes three numbers at each point; no measured spectrum needs more of them.
_Branches = Field(min_length=1, max_length=40)


class Viscoelastic(Section):
    """Maxwell branches beside the elastic law."""

    g: Annotated[list[_Modulus], _Branches] = Field(
        description="moduli of the branches over the law's initial shear modulus [-]"
    )
    tau_s: Annotated[list[_Time], _Branches] = Field(description="their relaxation times [s]")
    moduli: Literal["long-term", "instantaneous"] = Field(
        "long-term", description="what the elastic constants come from: slow or very fast tests"
    )
    heats: bool = Field(True, description="what the branches dissipate heats the block")
    C1: Annotated[Positive | None, Within(WLF_D1)] = Field(
        None, description="WLF constant of the relaxation times [-]; no shift without"
    )
    C2_K: Annotated[Positive | None, Within(WLF_D2)] = Field(None, description="the other one [K]")
    T_ref_C: Annotated[Celsius, Within(TEMPERATURE)] = Field(
        20.0, description="temperature of the relaxation times [deg C]"
    )

    @model_validator(mode="after")
    def _spectrum_exists(self) -> Viscoelastic:
        for key, other in (("C1", "C2_K"), ("C2_K", "C1")):
            if getattr(self, key) is None and getattr(self, other) is not None:
                refuse(key, "nothing", f"a number: {other} is given")
        try:
            self.prony()
        except ValueError as error:
            refuse_sentence("g", str(self.g), error)
        return self

    def prony(self) -> Prony:
        """Build the spectrum."""
        shift = None
        if self.C1 is not None and self.C2_K is not None:
            shift = WLF(d1=self.C1, d2_K=self.C2_K)
        return Prony(
            g=tuple(self.g),
            tau_s=tuple(self.tau_s),
            moduli=self.moduli,
            shift=shift,
            T_ref_C=self.T_ref_C,
        )

    @property
    def pole_C(self) -> float:
        """Temperature at which the shift ends [deg C]; minus infinity without a shift."""
        return -float("inf") if self.C2_K is None else self.T_ref_C - self.C2_K


class Mullins(Section):
    """Softening by the largest load so far (Ogden and Roxburgh)."""

    r: Annotated[float, Field(ge=1.0, le=1e6, allow_inf_nan=False)] = Field(
        description="softening is at most 1/r of the elastic stress [-]"
    )
    m_N_per_mm2: Annotated[Positive, Field(ge=1e-9, le=1e6)] = Field(
        description="energy below the maximum over which it acts [N/mm^2]"
    )
    beta: Annotated[NotNegative, Field(le=1e3)] = Field(
        0.0, description="share of the largest energy that is added to m [-]"
    )
    heats: bool = Field(True, description="what the softening consumes heats the block")

    def softening(self) -> OgdenRoxburgh:
        """Build the law."""
        return OgdenRoxburgh(r=self.r, m=self.m_N_per_mm2, beta=self.beta)
