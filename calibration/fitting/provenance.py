"""Which version of the program made a result."""

from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as _installed


def version() -> str:
    """Version of the installed program, or "not installed"."""
    try:
        return _installed("treadfem")
    except PackageNotFoundError:
        return "not installed"
