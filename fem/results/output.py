"""The folder that results are to go to: it can be written, and it is nobody else's meanwhile."""

import errno
import os
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from fem.case import CaseError
from fem.files import cause, remove_remains

if sys.platform != "win32":  # where nothing keeps two programs apart
    import fcntl

#: Locked while a program works in the folder. The lock dies with the program, whatever kills it;
#: a file that is left behind means nothing.
LOCK_FILE = ".lock"
_TAKEN = (errno.EWOULDBLOCK, errno.EAGAIN, errno.EACCES)
_LOOK_S = 0.05


@contextmanager
def output_folder(
    directory: str | Path,
    *,
    files: Sequence[str] = (),
    folders: Sequence[str] = (),
    patience_s: float = 0.0,
) -> Iterator[Path]:
    """Make a folder and hold it against every other program until the block ends.

    What killed programs left half-written in it is removed. A folder that was made for nothing
    disappears again.

    Parameters
    ----------
    directory : str or Path
        The folder.
    files, folders : sequence of str
        Names that will be written in it, which must not be taken by something of the other kind.
    patience_s : float
        How long to wait for a program that is using the folder [s].

    Raises
    ------
    CaseError
        If the folder cannot be made, written or had, in one line.
    """
    check_output_folder(directory)
    folder = Path(directory)
    _check_kinds(folder, files, folders)
    made: list[Path] = []
    try:
        # A program that is about to leave may remove the folder under our feet.
        lock = _made_and_locked(folder, made, time.monotonic() + patience_s)
        try:
            for place in ("", *folders):
                remove_remains(folder / place)
            yield folder
        finally:
            _unlock(folder, lock)
    finally:
        for path in reversed(made):
            with suppress(OSError):
                path.rmdir()


def chosen_output(wanted: str | None, default: Path) -> Path:
    """The place that was asked for; an empty name is not the default.

    Raises
    ------
    CaseError
        If it has no name.
    """
    if wanted is not None and not wanted.strip():
        raise CaseError("-o", "name", "nothing", "a file or folder")
    return default if wanted is None else Path(wanted)


def check_output_folder(directory: str | Path) -> None:
    """Refuse a folder that cannot be made or written, before hours are spent on filling it.

    Raises
    ------
    CaseError
        Naming what stands in the way.
    """
    try:
        existing = _nearest_existing(Path(directory))
    except OSError as error:
        raise _refused(directory, cause(error)) from None
    if not existing.is_dir():
        what = "a link to nowhere" if not existing.exists() else "a file"
    elif not os.access(existing, os.W_OK | os.X_OK):
        what = "a folder without permission to write"
    else:
        return
    raise _refused(directory, f"{existing}: {what}")


def check_output_file(path: str | Path) -> None:
    """Refuse a file that cannot be written because of what stands there.

    Raises
    ------
    CaseError
        Naming what stands in the way.
    """
    check_output_folder(Path(path).parent)
    if Path(path).is_dir():
        raise _refused(path, "a folder", "a file")
    if Path(path).is_symlink() and not Path(path).exists():
        raise _refused(path, "a link to nowhere", "a file")


def _nearest_existing(path: Path) -> Path:
    """The path, or the nearest folder above it that is there, links to nowhere included."""
    path = path.absolute()
    for place in (path, *path.parents):
        try:
            place.lstat()
        except (FileNotFoundError, NotADirectoryError):
            continue
        return place
    return path


def _check_kinds(folder: Path, files: Sequence[str], folders: Sequence[str]) -> None:
    for name in files:
        if (folder / name).is_dir():
            raise _refused(folder, f"a folder named {name}", "a file or nothing by that name")
    for name in folders:
        if os.path.lexists(folder / name) and not (folder / name).is_dir():
            raise _refused(folder, f"a file named {name}", "a folder or nothing by that name")


def _made_and_locked(folder: Path, made: list[Path], until: float) -> int:
    """Descriptor of the locked file; `made` gets the folders that were not there before."""
    while True:
        try:
            _make(folder, made)
            lock = os.open(folder / LOCK_FILE, os.O_RDWR | os.O_CREAT, 0o666)
        except FileNotFoundError as error:
            # Whoever made the folder has just left and taken it along; not for ever, though.
            if time.monotonic() > until + _LOOK_S:
                raise _refused(folder, cause(error)) from None
            continue
        except OSError as error:
            raise _refused(folder, cause(error)) from None
        if _locked(lock, folder):
            if _same_file(lock, folder / LOCK_FILE):
                return lock
            os.close(lock)
            continue
        os.close(lock)
        if time.monotonic() >= until:
            raise _refused(folder, "another run that is using it", "its end, or another folder")
        time.sleep(_LOOK_S)


def _make(folder: Path, made: list[Path]) -> None:
    absolute = folder.absolute()
    missing = [p for p in (absolute, *absolute.parents) if not p.exists()]
    for path in reversed(missing):
        path.mkdir(exist_ok=True)
        if path not in made:
            made.append(path)


def _locked(lock: int, folder: Path) -> bool:
    """Lock a file unless somebody else has; where nothing can be locked, say so and go on."""
    if sys.platform == "win32":
        return True
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        if error.errno in _TAKEN:
            return False
        text = f"treadfem: {folder} cannot be locked ({cause(error)}): run nothing else in it"
        print(text, file=sys.stderr)
    return True


def _same_file(lock: int, path: Path) -> bool:
    """Whether the descriptor still is the file of that name."""
    try:
        return os.path.samestat(os.fstat(lock), path.stat())
    except OSError:
        return False


def _unlock(folder: Path, lock: int) -> None:
    # Removed while it is locked: whoever has opened it meanwhile sees that it is another one.
    if _same_file(lock, folder / LOCK_FILE):
        with suppress(OSError):
            (folder / LOCK_FILE).unlink()
    os.close(lock)


def _refused(directory: str | Path, found: str, expected: str = "a writable folder") -> CaseError:
    return CaseError(str(directory), "-o", found, expected)
