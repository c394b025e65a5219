"""Figures and tables that are up to date are not made again.

Beside what is made into a folder, ``made/NAME.json`` keeps what it was made from and with: the
program, the meaning of the code and the data files of validation and calibration, the drawing
packages, and files that the user named. As long as all that is the same and the files are
untouched, they stay.
"""

import hashlib
import json
import re
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from fem.files import ROOT, fingerprint, program_version, write_text

_FOLDERS = (ROOT / "calibration", ROOT / "validation")
_SUFFIXES = {".py", ".toml", ".csv", ".html"}
_PACKAGES = ("matplotlib", "numpy", "pandas", "scipy")


class Made(NamedTuple):
    """A figure or table.

    Attributes
    ----------
    path : Path
        Its main file.
    again : bool
        Whether it was made just now; otherwise it was up to date.
    """

    path: Path
    again: bool


def kept(
    name: str,
    directory: str | Path,
    make: Callable[[], Path],
    inputs: Sequence[str | Path] = (),
    *,
    again: bool = False,
) -> Made:
    """Make a figure or table into a folder unless it lies there up to date.

    Parameters
    ----------
    name : str
        Its name, with which all of its files begin, e.g. ``fig9``.
    directory : str or Path
        Folder of its files.
    make : callable
        Makes it and returns its main file.
    inputs : sequence of paths
        Files of the user that it is made from.
    again : bool
        Make it even if it is up to date.

    Returns
    -------
    Made
    """
    record = Path(directory) / "made" / f"{name}.json"
    source = _fingerprint(tuple(map(str, inputs)))
    known = _read(record)
    files = known.get("files", {})
    same = known.get("source") == source and files == _contents(name, Path(directory))
    # A name among its own files leads nowhere else, whatever was written into the record.
    main = known.get("main")
    if same and isinstance(main, str) and main in files and not again:
        return Made(Path(directory) / main, again=False)
    record.unlink(missing_ok=True)
    path = make()
    about = {
        "source": source,
        "main": path.relative_to(directory).as_posix(),
        "files": _contents(name, Path(directory)),
    }
    record.parent.mkdir(exist_ok=True)
    write_text(record, json.dumps(about, indent=2) + "\n")
    return Made(path, again=True)


def _read(record: Path) -> dict[str, Any]:
    """What the record says; nothing if there is none, or it is damaged."""
    try:
        known = json.loads(record.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return known if isinstance(known, dict) and isinstance(known.get("files"), dict) else {}


def _contents(name: str, directory: Path) -> dict[str, str]:
    """Digests of the files whose names begin with `name` (and no further digit)."""
    own = re.compile(rf"{re.escape(name)}(?!\d)")
    return {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(directory.glob(f"{name}*"))
        if path.is_file() and own.match(path.name)
    }


def _fingerprint(inputs: tuple[str, ...]) -> str:
    digest = hashlib.sha256(_program_fingerprint().encode())
    for path in inputs:
        digest.update(path.encode())
        digest.update(Path(path).read_bytes())
    return digest.hexdigest()


@cache
def _program_fingerprint() -> str:
    return program_version() + fingerprint(_sources(), _PACKAGES)


def _sources() -> list[Path]:
    files = (path for folder in _FOLDERS for path in sorted(folder.rglob("*")))
    return [path for path in files if path.suffix in _SUFFIXES]
