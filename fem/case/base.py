"""What every section of a case file shares: strict frozen models and the kinds of numbers."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Any, NoReturn

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler, model_validator
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from fem.case.errors import describe
from materials.plausible import Finding, Quantity, judge
from materials.units import ABSOLUTE_ZERO_C

Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]
Celsius = Annotated[float, Field(gt=ABSOLUTE_ZERO_C, allow_inf_nan=False)]
#: A material constant: no law of friction or rubber has larger ones.
Constant = Annotated[float, Field(ge=-1e6, le=1e6, allow_inf_nan=False)]
Factor = Annotated[float, Field(gt=0.0, le=1e6, allow_inf_nan=False)]
#: Of a pressure or a velocity.
NotNegativeExponent = Annotated[float, Field(ge=0.0, le=5.0, allow_inf_nan=False)]
Exponent = Annotated[float, Field(ge=-5.0, le=5.0, allow_inf_nan=False)]
Count = Annotated[int, Field(ge=1)]


@dataclass(frozen=True)
class Within:
    """Says what quantity a key is: ``Annotated[Positive, Within(PRESSURE)]``.

    Numbers outside its physical range are refused, those outside its usual range found by
    `Section.unusual`.
    """

    quantity: Quantity

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return core_schema.no_info_after_validator_function(self._possible, handler(source))

    def _possible(self, value: float | None) -> float | None:
        finding = self.judge(value)
        if finding is not None and finding.impossible:
            refuse_finding("", describe(value), finding)
        return value

    def judge(self, value: float | None) -> Finding | None:
        """What is wrong with the value of the key."""
        return None if value is None else judge(value, self.quantity)


class Section(BaseModel):
    """A table of the case file: frozen, no unknown keys, no silent conversion of types."""

    model_config = ConfigDict(
        extra="forbid", frozen=True, strict=True, allow_inf_nan=False, validate_default=True
    )

    @model_validator(mode="before")
    @classmethod
    def _plain_numbers(cls, data: Any) -> Any:
        """Numbers of numpy as those of Python, and one zero."""
        if not isinstance(data, dict):
            return data
        return {key: _plain(value) for key, value in data.items()}

    def unusual(self) -> Iterator[tuple[str, Finding]]:
        """Keys (dotted) whose numbers are possible, but outside their usual range."""
        for name, info in type(self).model_fields.items():
            value, key = getattr(self, name), info.alias or name
            parts = {key: value}
            if isinstance(value, tuple):
                parts = {f"{key}.{number}": part for number, part in enumerate(value)}
            for where, part in parts.items():
                if isinstance(part, Section):
                    yield from ((f"{where}.{inner}", finding) for inner, finding in part.unusual())
            for kind in info.metadata:
                finding = kind.judge(value) if isinstance(kind, Within) else None
                if finding is not None:
                    yield key, finding


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    return value + 0.0 if isinstance(value, float) else value


def refuse(key: str, found: str, expected: str) -> NoReturn:
    """Reject a value inside a validator; the reader adds file and section to the message."""
    raise PydanticCustomError(
        "case", "{expected}", {"key": key, "found": found, "expected": expected}
    )


def refuse_finding(key: str, found: str, finding: Finding) -> NoReturn:
    """Reject a number outside its physical range, naming the unit it is likely in."""
    refuse(key, f"{found}, which {finding.likely}" if finding.likely else found, finding.expected)


def given(data: Any, key: str) -> Any:
    """Value of `key` in raw section data, None when it is absent."""
    return data.get(key) if isinstance(data, dict) else None


def refuse_sentence(key: str, value: str, error: ValueError) -> NoReturn:
    """Reject with the sentence of a deeper package, ``<what is wrong>; expected <what>``."""
    found, separator, expected = str(error).partition("; expected ")
    if separator:
        refuse(key, found, expected)
    refuse(key, value, str(error))
