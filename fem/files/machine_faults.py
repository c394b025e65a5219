"""What a machine does to a program (no space, no memory, no such folder), each in one line."""

import errno
import os

_WORDS = {
    errno.ENOSPC: "no space left on the disk",
    errno.EDQUOT: "the disk quota is used up",
    errno.EFBIG: "a file would be larger than the system allows (ulimit -f)",
    errno.EROFS: "the disk is read-only",
    errno.EACCES: "no permission",
    errno.ENAMETOOLONG: "a name that is too long",
    errno.EBADF: "closed",
    errno.EMFILE: "too many open files (ulimit -n)",
}
OUT_OF_MEMORY = "use a coarser mesh, fewer workers or a machine with more memory"


def cause(error: OSError) -> str:
    """Say in a few words why the system refused something."""
    if isinstance(error, FileNotFoundError) and not _current_folder_exists():
        return "the current folder is gone"
    known = _WORDS.get(error.errno or 0)
    return known or (error.strerror or "").lower() or str(error) or type(error).__name__


def one_line(error: OSError | MemoryError) -> str:
    """The whole fault in one line, with the file where one is known."""
    if isinstance(error, MemoryError):
        return f"out of memory: {OUT_OF_MEMORY}"
    name = error.filename
    place = f"{os.fsdecode(name)}: " if isinstance(name, str | bytes | os.PathLike) else ""
    return " ".join(f"{place}{cause(error)}".split())


def _current_folder_exists() -> bool:
    try:
        os.getcwd()
    except OSError:
        return False
    return True
