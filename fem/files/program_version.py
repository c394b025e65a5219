"""Which program made a result: the released version and a fingerprint of what computes."""

from __future__ import annotations

import hashlib
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import contact
import materials

#: Folders of the packages that decide the numbers of a run.
_COMPUTING = (
    Path(str(materials.__file__)).parent,
    Path(str(contact.__file__)).parent,
    Path(__file__).parents[1],
)


@cache
def program_version() -> str:
    """Return e.g. ``0.1.0+5c0ffee5``: any change of the computing code changes the second part."""
    digest = hashlib.sha256()
    for folder in _COMPUTING:
        for path in sorted(folder.rglob("*.py")):
            digest.update(path.relative_to(folder.parent).as_posix().encode())
            digest.update(path.read_bytes())
    try:
        released = version("treadfem")
    except PackageNotFoundError:
        released = "0"
    return f"{released}+{digest.hexdigest()[:8]}"
