"""The [friction] section: law, floors and the WLF shift of the sliding velocity."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator
from pydantic.fields import FieldInfo

from contact.friction import FrictionLaw, ThermalFriction
from contact.registry import FRICTION_LAWS, Parameter
from fem.case.base import (
    Celsius,
    NotNegative,
    Positive,
    Section,
    Within,
    refuse,
    refuse_sentence,
)
from fem.case.errors import describe
from fem.case.window import ContactWindow
from materials.plausible import FRICTION, TEMPERATURE, WLF_D1, WLF_D2
from materials.wlf import WLF

_Mu = Annotated[NotNegative | None, Within(FRICTION)]
_D1 = Annotated[Positive, Within(WLF_D1)]
_D2 = Annotated[Positive, Within(WLF_D2)]
_Reference = Annotated[Celsius, Within(TEMPERATURE)]
_PressureFloor = Annotated[Positive, Field(ge=1e-9, le=10.0)]
_Memory = Annotated[NotNegative, Field(le=100.0)]
_SpeedFloor = Annotated[Positive, Field(ge=1e-9, le=1e5)]

DEFAULT_LAW = "huemer"
#: Key of the case that the parameters of the laws stand behind.
_LAW = "law"


def laws() -> dict[str, dict[str, float | None]]:
    """Parameters of each law with their defaults; None: must be given."""
    return {
        name: {one.name: one.default for one in law.parameters}
        for name, law in FRICTION_LAWS.items()
    }


def all_parameters() -> tuple[str, ...]:
    """Names of the parameters of all laws."""
    return tuple(dict.fromkeys(key for law in laws().values() for key in law))


class Friction(Section):
    """Friction between the block and the road (p in N/mm^2, v in mm/s)."""

    law: str = DEFAULT_LAW  # its type and the parameters are entered from the registry, below
    wlf: bool = Field(True, description="shift the velocity with the surface temperature, eq. (7)")
    d1: _D1 = Field(43.1, description="WLF constant [-]")
    d2_K: _D2 = Field(509.4, description="WLF constant [K]")
    T_ref_C: _Reference = Field(20.0, description="temperature the law was measured at [deg C]")
    wlf_T_ref_C: Annotated[Celsius | None, Within(TEMPERATURE)] = Field(
        None, description="temperature d1 and d2_K refer to [deg C]; T_ref_C where left out"
    )
    p_min_N_per_mm2: _PressureFloor = Field(1e-3, description="pressure floor of the law [N/mm^2]")
    v_min_mm_per_s: _SpeedFloor = Field(1.0, description="velocity floor of the law [mm/s]")

    memory_mm: _Memory = Field(
        0.3,
        description="slip over which the coefficient follows a change of speed [mm]; 0: at once",
    )
    heating_slip_mm: _Memory = Field(
        0.0,
        description="slip since touch-down over which friction goes from that of the temperature "
        "at touch-down to that of the present one [mm]; 0: at once",
    )
    window: ContactWindow | None = Field(
        None, description="ranges the law was fitted to; a run says what leaves them"
    )
    rubber_on_rubber_mu: Annotated[NotNegative, Within(FRICTION)] = Field(
        1.0, description="Coulomb's coefficient where the block touches itself [-]"
    )

    @model_validator(mode="before")
    @classmethod
    def _parameters_of_the_law(cls, data: Any) -> Any:
        if not isinstance(data, dict):
            return data
        law = data.get("law", DEFAULT_LAW)
        known = laws()
        if not isinstance(law, str) or law not in known:
            return data
        for key in all_parameters():
            if data.get(key) is not None and key not in known[law]:
                refuse(
                    key,
                    describe(data[key]),
                    f'only parameters of law = "{law}": {", ".join(known[law])}',
                )
        filled = {**known[law], **{k: v for k, v in data.items() if v is not None}}
        for key, value in filled.items():
            if value is None:
                refuse(key, "nothing", f'a number: law = "{law}" needs {key}')
        return filled

    @model_validator(mode="after")
    def _warmth_matters(self) -> Friction:
        if self.heating_slip_mm > 0.0 and not self.wlf:
            expected = "0 with wlf = false, where no temperature matters"
            refuse("heating_slip_mm", str(self.heating_slip_mm), expected)
        return self

    @model_validator(mode="after")
    def _law_exists(self) -> Friction:
        try:
            self.law_object()
        except ValueError as error:
            refuse_sentence("law", self.law, error)
        return self

    def plain_law(self) -> FrictionLaw:
        """Build the law without the temperature shift."""
        floors = {"p_min": self.p_min_N_per_mm2, "v_min": self.v_min_mm_per_s}
        plain: FrictionLaw = FRICTION_LAWS[self.law].kind(**self.constants, **floors)
        return plain

    @property
    def constants(self) -> dict[str, float]:
        """The parameters of the law."""
        return {one.name: getattr(self, one.name) for one in FRICTION_LAWS[self.law].parameters}

    def law_object(self) -> ThermalFriction:
        """Build the law mu(p, v, T) with its WLF shift."""
        shift = self.shift() if self.wlf else None
        return ThermalFriction(
            law=self.plain_law(),
            wlf=shift,
            T_ref_C=self.T_ref_C,
            memory_mm=self.memory_mm,
            heating_slip_mm=self.heating_slip_mm,
        )

    def shift(self) -> WLF:
        """Build the WLF shift for the temperature of the law, whatever its constants refer to."""
        given = WLF(d1=self.d1, d2_K=self.d2_K)
        if self.wlf_T_ref_C is None:
            return given
        return given.rebased(self.wlf_T_ref_C, self.T_ref_C)

    @property
    def pole_C(self) -> float:
        """Temperature at which the WLF shift ends [deg C]."""
        return (self.T_ref_C if self.wlf_T_ref_C is None else self.wlf_T_ref_C) - self.d2_K

    def described(self) -> str:
        """The law and its temperatures in one line, for the log of a run."""
        text = f"friction: law {self.law} at {self.T_ref_C:g} deg C"
        if not self.wlf:
            return f"{text}, no WLF shift"
        shift = self.shift()
        text += f", WLF shift d1 = {shift.d1:.6g}, d2 = {shift.d2_K:.6g} K there"
        if self.wlf_T_ref_C in (None, self.T_ref_C):
            return text
        return f"{text} (d1 = {self.d1:g}, d2 = {self.d2_K:g} K at {self.wlf_T_ref_C:g} deg C)"


def enter_laws(*outer: type[Section]) -> None:
    """Give the section a key for each parameter of the laws there are.

    Reading a case does this if a law has been registered since; `outer` are the models that hold
    the section.
    """
    names, fields = tuple(FRICTION_LAWS), Friction.__pydantic_fields__
    wanted = Literal[names]  # type: ignore[valid-type]
    if fields[_LAW].annotation == wanted:
        return
    labels = "; ".join(f'"{name}", {law.label}' for name, law in FRICTION_LAWS.items())
    entered = {_LAW: FieldInfo(annotation=wanted, default=DEFAULT_LAW, description=labels)}
    for law in FRICTION_LAWS.values():
        for one in law.parameters:
            if one.name in _OWN_KEYS or one.name == _LAW:
                raise ValueError(
                    f"parameter {one.name} of the friction law {law.name!r} is the name of another "
                    "key of [friction]; expected another name"
                )
            entered.setdefault(one.name, _key_of(one))
    own = {name: fields[name] for name in _OWN_KEYS}
    fields.clear()
    fields.update(entered | own)
    models: tuple[type[Section], ...] = (Friction, *outer)
    for model in models:
        model.model_rebuild(force=True)


def _key_of(parameter: Parameter) -> FieldInfo:
    """Key of a parameter; laws that share a name share the range of the first of them."""
    limits = Field(ge=parameter.low, le=parameter.high, allow_inf_nan=False)
    number: Any = Annotated[float, limits] | None
    if parameter.name == "mu":
        number = Annotated[number, Within(FRICTION)]
    description = Field(None, description=parameter.description)
    return FieldInfo.from_annotated_attribute(number, description)


_OWN_KEYS = tuple(name for name in Friction.__pydantic_fields__ if name != _LAW)
enter_laws()
