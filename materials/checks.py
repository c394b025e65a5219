"""Checks of material parameters: one clear sentence for each way a number can be wrong."""

import math


def require_finite(**values: float) -> None:
    """Raise ``ValueError`` unless every keyword argument is a finite real number."""
    for name, value in values.items():
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise ValueError(f"{name} is {value!r}; expected a number")
        if not math.isfinite(value):
            raise ValueError(f"{name} is {value}; expected a finite number")


def require_positive(**values: float) -> None:
    """Raise ``ValueError`` unless every keyword argument is a finite number above zero."""
    require_finite(**values)
    for name, value in values.items():
        if value <= 0.0:
            raise ValueError(f"{name} is {value:g}; expected a number above zero")


def require_not_negative(**values: float) -> None:
    """Raise ``ValueError`` unless every keyword argument is finite and not below zero."""
    require_finite(**values)
    for name, value in values.items():
        if value < 0.0:
            raise ValueError(f"{name} is {value:g}; expected zero or more")


def require_between(low: float, high: float, **values: float) -> None:
    """Raise ``ValueError`` unless every keyword argument lies in ``[low, high]``."""
    require_finite(**values)
    for name, value in values.items():
        if not low <= value <= high:
            raise ValueError(f"{name} is {value:g}; expected a number from {low:g} to {high:g}")
