"""Rooms hand out names of their files, and load a file only when one of its names is asked for."""

import ast
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any


def face(package: str, init: str) -> Callable[[str], Any]:
    """The ``__getattr__`` of a package that imports its names for type checkers only.

    Parameters
    ----------
    package, init : str
        ``__name__`` and ``__file__`` of the package; its statements ``from package.x import y``
        say what it hands out.
    """
    homes = {
        alias.name: statement.module
        for statement in ast.walk(ast.parse(Path(init).read_text(encoding="utf-8")))
        if isinstance(statement, ast.ImportFrom) and statement.module is not None
        for alias in statement.names
        if statement.module.startswith(f"{package}.")
    }

    def handed_out(name: str) -> Any:
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(import_module(homes[name]), name)

    return handed_out
