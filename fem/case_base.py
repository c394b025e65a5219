"""What every section of a case file shares: strict frozen models and the kinds of numbers."""

from __future__ import annotations

from typing import Annotated, Any, NoReturn

from pydantic import BaseModel, ConfigDict, Field
from pydantic_core import PydanticCustomError

Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0.0, le=1.0, allow_inf_nan=False)]
Celsius = Annotated[float, Field(gt=-273.15, allow_inf_nan=False)]
Count = Annotated[int, Field(ge=1)]


class Section(BaseModel):
    """A table of the case file: frozen, no unknown keys, no silent conversion of types."""

    model_config = ConfigDict(
        extra="forbid", frozen=True, strict=True, allow_inf_nan=False, validate_default=True
    )


def refuse(key: str, found: str, expected: str) -> NoReturn:
    """Reject a value inside a validator; the reader adds file and section to the message."""
    raise PydanticCustomError(
        "case", "{expected}", {"key": key, "found": found, "expected": expected}
    )


def given(data: Any, key: str) -> Any:
    """Value of `key` in raw section data, None when it is absent."""
    return data.get(key) if isinstance(data, dict) else None


def refuse_sentence(key: str, value: str, error: ValueError) -> NoReturn:
    """Reject with the sentence of a deeper package, ``<what is wrong>; expected <what>``."""
    found, separator, expected = str(error).partition("; expected ")
    if separator:
        refuse(key, found, expected)
    refuse(key, value, str(error))
