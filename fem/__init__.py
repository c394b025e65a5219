"""Case, mesh, mechanics, heat, stepping and results of the sliding tread block.

Examples
--------
>>> from fem import Case
>>> Case.from_toml("examples/introductory.toml").loading.velocity_mm_per_s
300.0
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fem.case.case import Case
    from fem.results.result import Result
    from fem.simulation import simulate

__all__ = ["Case", "Result", "simulate"]

_HOMES = {
    "Case": "fem.case.case",
    "Result": "fem.results.result",
    "simulate": "fem.simulation",
}


def __getattr__(name: str) -> Any:
    """What the package hands out, imported when it is asked for: a command loads what it needs."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
