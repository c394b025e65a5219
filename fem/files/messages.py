"""What every command says in the same way: exit codes, warnings, how a file was understood."""

import sys
from collections.abc import Iterable

#: Exit codes; the head of `treadfem.py` says what they promise.
DONE, BAD_INPUT, NOT_CONVERGED, WARNED, INTERRUPTED = 0, 2, 3, 4, 130


def warn(sentences: Iterable[str]) -> None:
    """Print each warning as one line on standard error."""
    for sentence in sentences:
        print(" ".join(f"treadfem: warning: {sentence}".split()), file=sys.stderr)


def say_of(file: str, notes: Iterable[str], unusual: Iterable[str]) -> None:
    """Say how a file of measurements was understood, and what is unusual about it."""
    for line in notes:
        print(f"treadfem: {file}: {line}", file=sys.stderr)
    warn(f"{file}: {line}" for line in unusual)
