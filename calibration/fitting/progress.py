"""How a fit shows that it is at work: a line on a terminal, nothing in a pipe.

Large tables take seconds to minutes, and nobody knows beforehand how many looks at them a fit
needs: what is counted are these looks. A fit that nobody watches counts nothing.
"""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

_LINE = "{desc}: {n_fmt} evaluations [{elapsed}]"
_line: ContextVar[Any] = ContextVar("line", default=None)


@contextmanager
def watched(text: str, *, quiet: bool = False) -> Iterator[None]:
    """Show the fits inside, beginning with a text; `quiet` and in a pipe: nothing."""
    if quiet or not sys.stderr.isatty():
        yield
        return
    from tqdm import tqdm

    with tqdm(desc=text, bar_format=_LINE, miniters=1, leave=False) as line:
        token = _line.set(line)
        try:
            yield
        finally:
            _line.reset(token)


def stage(text: str) -> None:
    """Say what is being done now."""
    if (line := _line.get()) is not None:
        line.set_description_str(text)


def evaluated() -> None:
    """Count one evaluation of the model at the data."""
    if (line := _line.get()) is not None:
        line.update()
