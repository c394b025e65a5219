"""Files and folders that appear under their final names only when they are complete."""

from __future__ import annotations

import errno
import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from fem.files.interruption import deferring

if TYPE_CHECKING:
    import pandas as pd

#: Every unfinished file and folder begins with this; nothing that is finished does.
UNFINISHED = ".unfinished-"


def write_text(path: str | Path, text: str) -> None:
    """Write a UTF-8 text file under a temporary name, then rename it."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


def write_table(path: str | Path, table: pd.DataFrame, number_format: str | None = None) -> Path:
    """Write a table as CSV, without its index, under a temporary name, then rename it."""
    text = table.to_csv(index=False, lineterminator="\n", float_format=number_format)
    write_text(path, text)
    return Path(path)


@contextmanager
def replacing(path: str | Path) -> Iterator[Path]:
    """Give a temporary path with the same suffix; it replaces `path` if the block succeeds.

    The content is on the disk before it gets its name, so that not even a power cut leaves an
    empty file under it.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    # A name of its own length: that of the file may be as long as the system allows.
    number, name = tempfile.mkstemp(prefix=UNFINISHED, suffix=path.suffix, dir=path.parent)
    os.close(number)
    temporary = Path(name)
    try:
        with _faults_of(path):
            temporary.chmod(0o666 & ~_umask())
            yield temporary
            _on_disk(temporary)
            os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def remove_remains(directory: str | Path) -> None:
    """Remove what killed programs left half-written in a folder (of nobody who is still at it)."""
    for remains in Path(directory).glob(f"{UNFINISHED}*"):
        if remains.is_dir() and not remains.is_symlink():
            shutil.rmtree(remains, ignore_errors=True)
        else:
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
    stage = Path(tempfile.mkdtemp(prefix=UNFINISHED, dir=place))
    # mkdtemp makes the folder private to its owner; the result has the usual permissions.
    stage.chmod(0o777 & ~_umask())
    try:
        with _faults_of(target):
            yield stage
            files = sorted(p.relative_to(stage) for p in stage.rglob("*") if p.is_file())
            for name in files:
                _on_disk(stage / name)
            with deferring():
                if place == target:
                    _merge(stage, target, files, outdated, last)
                else:
                    os.replace(stage, target)
    finally:
        shutil.rmtree(stage, ignore_errors=True)


def _merge(
    stage: Path, target: Path, files: list[Path], outdated: Sequence[str], last: str | None
) -> None:
    for name in files:
        # Before anything is touched.
        if (target / name).is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(target / name))
        (target / name).parent.mkdir(parents=True, exist_ok=True)
    if last is not None:
        (target / last).unlink(missing_ok=True)
    for pattern in outdated:
        for old in target.glob(pattern):
            old.unlink()
    for name in sorted(files, key=lambda name: str(name) == last):
        os.replace(stage / name, target / name)


@contextmanager
def _faults_of(path: Path) -> Iterator[None]:
    """Let faults of the system name what the user knows, not the temporary file (or nothing)."""
    try:
        yield
    except OSError as error:
        nameless = error.filename is None and error.errno is not None
        if nameless or UNFINISHED in os.fsdecode(error.filename or ""):
            error.filename, error.filename2 = str(path), None
        raise


def _on_disk(path: Path) -> None:
    with path.open("rb+") as file:
        os.fsync(file.fileno())


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
