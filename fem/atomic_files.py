"""Files and folders that appear under their final names only when they are complete."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path


def write_text(path: str | Path, text: str) -> None:
    """Write a UTF-8 text file under a temporary name, then rename it."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


@contextmanager
def replacing(path: str | Path) -> Iterator[Path]:
    """Give a temporary path with the same suffix; it replaces `path` if the block succeeds.

    The content is on the disk before it gets its name, so that not even a power cut leaves an
    empty file under it.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    try:
        yield temporary
        with temporary.open("rb+") as file:
            os.fsync(file.fileno())
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def remove(path: str | Path) -> None:
    """Remove a file that `replacing` wrote, and what killed processes left of writing it."""
    path = Path(path)
    path.unlink(missing_ok=True)
    for remains in path.parent.glob(f".{path.stem}.*{path.suffix}"):
        remains.unlink(missing_ok=True)


@contextmanager
def staged_directory(
    directory: str | Path, *, outdated: Sequence[str] = (), last: str | None = None
) -> Iterator[Path]:
    """Give a temporary folder whose content moves to `directory` if the block succeeds.

    A folder that does not exist yet appears in one rename. In one that exists, files of the same
    name are replaced one by one, other files stay. There, the file `last` is removed first and
    arrives last: where it is, the rest is complete.

    Parameters
    ----------
    directory : str or Path
        Final folder.
    outdated : sequence of str
        Patterns of files from an earlier write that are removed (snapshots there may be fewer of).
    last : str, optional
        Name of the file that marks completeness.
    """
    target = Path(directory)
    # Inside a folder that exists: it may be a mounted disk, and its parent closed to the user.
    place = target if target.is_dir() else target.parent
    place.mkdir(parents=True, exist_ok=True)
    stage = Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=place))
    # mkdtemp makes the folder private to its owner; the result has the usual permissions.
    stage.chmod(0o777 & ~_umask())
    try:
        yield stage
        if place == target:
            _merge(stage, target, outdated, last)
        else:
            os.replace(stage, target)
    finally:
        shutil.rmtree(stage, ignore_errors=True)


def _merge(stage: Path, target: Path, outdated: Sequence[str], last: str | None) -> None:
    if last is not None:
        (target / last).unlink(missing_ok=True)
    for pattern in outdated:
        for old in target.glob(pattern):
            old.unlink()
    files = sorted(p.relative_to(stage) for p in stage.rglob("*") if p.is_file())
    for name in sorted(files, key=lambda name: str(name) == last):
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        os.replace(stage / name, target / name)
    _remove_remains(stage, target)


def _remove_remains(stage: Path, target: Path) -> None:
    """Remove the temporary folders that killed processes left inside the target."""
    for remains in target.glob(f"{stage.name[: -len('12345678')]}????????"):
        if remains != stage and remains.is_dir():
            shutil.rmtree(remains, ignore_errors=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
