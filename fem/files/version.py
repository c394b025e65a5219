"""Which program made a result: the released version and a fingerprint of what it computes."""

import ast
import hashlib
from collections.abc import Iterable
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

#: Where the packages of the program lie side by side.
ROOT = Path(__file__).parents[2]
#: The packages that decide the numbers of a run, and what does not although it lies among them.
_COMPUTING = ("materials", "contact", "fem")
_NOT_COMPUTING = ROOT / "fem" / "sweeps"
#: Packages of others that do.
_NUMERICAL = ("numpy", "scipy", "scikit-fem", "pypardiso")


@cache
def program_version() -> str:
    """Return e.g. ``0.1.0+5c0ffee5``: what may change a number changes the second part.

    That is the meaning of the computing code and the versions of the numerical packages; comments,
    docstrings and layout may change.
    """
    sources = (
        path
        for package in _COMPUTING
        for path in sorted((ROOT / package).rglob("*.py"))
        if not path.is_relative_to(_NOT_COMPUTING)
    )
    return f"{version_of('treadfem', '0')}+{fingerprint(sources, _NUMERICAL)[:8]}"


def fingerprint(files: Iterable[Path], packages: Iterable[str] = ()) -> str:
    """Digest of what files of the program mean, and of the versions of other packages.

    Of a Python file its syntax tree counts, without docstrings; of any other its bytes.
    """
    digest = hashlib.sha256()
    for package in packages:
        digest.update(f"{package} {version_of(package)}\n".encode())
    for path in files:
        digest.update(path.relative_to(ROOT).as_posix().encode())
        content = path.read_bytes()
        if path.suffix == ".py":
            content = _meaning(content).encode()
        digest.update(content)
    return digest.hexdigest()


def version_of(package: str = "treadfem", otherwise: str = "not installed") -> str:
    """Version of an installed package, or what is said otherwise."""
    try:
        return version(package)
    except PackageNotFoundError:
        return otherwise


def _meaning(source: bytes) -> str:
    """A syntax tree in words; a text that stands alone in a body is a docstring."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(body := getattr(node, "body", None), list):
            node.body = [line for line in body if not _is_text(line)]  # type: ignore[attr-defined]
    return ast.dump(tree)


def _is_text(line: ast.AST) -> bool:
    return isinstance(line, ast.Expr) and isinstance(line.value, ast.Constant)
