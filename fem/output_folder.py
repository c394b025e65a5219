"""The folder that results are to go to."""

from __future__ import annotations

import os
from pathlib import Path

from fem.case_errors import CaseError


def check_output_folder(directory: str | Path) -> None:
    """Refuse a folder that cannot be made or written, before hours are spent on filling it.

    Raises
    ------
    CaseError
        Naming what stands in the way.
    """
    existing = Path(directory).absolute()
    while not existing.exists() and existing != existing.parent:
        existing = existing.parent
    if existing.is_dir() and os.access(existing, os.W_OK | os.X_OK):
        return
    reason = "a folder without permission to write" if existing.is_dir() else "a file"
    raise CaseError(
        file=str(directory), key="-o", found=f"{existing}: {reason}", expected="a writable folder"
    )
