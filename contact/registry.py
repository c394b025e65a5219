"""The friction laws there are: each is registered once, where its class is.

Case files, error messages, the template, fits, figures and the list of the documents take the
names, parameters and labels from here.
"""

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeVar

Law = TypeVar("Law")

#: Parameters that all laws have: keys of the case of their own.
FLOORS = ("p_min", "v_min")


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A parameter of a law.

    Attributes
    ----------
    name : str
        Field of the class and key of the case file; the unit belongs to it.
    default : float or None
        None: it must be given.
    description : str
        Meaning and unit.
    low, high : float
        Range that a case file may give and a fit searches.
    """

    name: str
    default: float | None
    description: str
    low: float
    high: float


@dataclass(frozen=True, kw_only=True)
class RegisteredLaw:
    """A friction law under its name.

    Attributes
    ----------
    name : str
        ``law`` of a case file.
    kind : type
        The class.
    label : str
        For figures and messages.
    fitted : bool
        Whether `calibrate friction` may fit it.
    """

    name: str
    kind: Any
    label: str
    fitted: bool

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The parameters of the class but the floors."""
        return tuple(
            Parameter(
                name=item.name,
                default=None if item.default is dataclasses.MISSING else item.default,
                description=item.metadata.get("description", f"{self.name} law"),
                low=item.metadata.get("low", -1e6),
                high=item.metadata.get("high", 1e6),
            )
            for item in dataclasses.fields(self.kind)
            if item.name not in FLOORS
        )


_LAWS: dict[str, RegisteredLaw] = {}
#: Names to laws, in the order they were registered.
FRICTION_LAWS: Mapping[str, RegisteredLaw] = MappingProxyType(_LAWS)


def parameter(
    description: str, default: Any = dataclasses.MISSING, *, low: float = -1e6, high: float = 1e6
) -> Any:
    """Field of a law's class: meaning and unit, default, range (see `Parameter`).

    Examples
    --------
    >>> parameter("exponent of the speed [-]", 0.05, low=-5.0, high=5.0).default
    0.05
    """
    metadata = {"description": description, "low": low, "high": high}
    return dataclasses.field(default=default, metadata=metadata)


def friction_law(name: str, *, label: str, fitted: bool = True) -> Callable[[type[Law]], type[Law]]:
    """Register a law: a decorator of its frozen, keyword-only dataclass.

    Examples
    --------
    >>> import numpy as np
    >>> from contact import FRICTION_LAWS, FrictionLaw
    >>> @friction_law("worn-in", label="Coulomb's law after some way")
    ... @dataclass(frozen=True, kw_only=True)
    ... class WornIn(FrictionLaw):
    ...     mu_end: float = parameter("coefficient after the first slip [-]", 0.6, low=0.0)
    ...     way_mm: float = parameter("slip over which it comes to that [mm]", 2.0, low=1e-3)
    ...
    ...     def _mu(self, at):
    ...         return self.mu_end * (1.0 - np.exp(-at.slip / self.way_mm)) + 0.0 * at.p
    >>> [one.name for one in FRICTION_LAWS["worn-in"].parameters]
    ['mu_end', 'way_mm']
    >>> del _LAWS["worn-in"]  # as if it had never been

    Raises
    ------
    ValueError
        If there is another law of that name.
    """

    def registered(kind: type[Law]) -> type[Law]:
        known = _LAWS.get(name)
        if known is not None and known.kind.__qualname__ != kind.__qualname__:
            raise ValueError(f"friction law {name!r} is registered already; expected another name")
        _LAWS[name] = RegisteredLaw(name=name, kind=kind, label=label, fitted=fitted)
        return kind

    return registered
