"""Standard output and standard error that never end a run.

Whatever is printed while a program computes is news, not a result: a reader that has gone, a full
disk behind a redirection, a closed stream or a terminal that has no letter for a character must not
cost the hours behind it. Inside `lenient_streams` every `print`, bar and warning goes through.
"""

import codecs
import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from typing import Any

from fem.files.machine_faults import cause

_ESCAPED = "treadfem-escaped"


def _escape(error: UnicodeError) -> tuple[str, int]:
    """What cannot be encoded as the escapes that TOML and JSON know, too."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    codes = (ord(letter) for letter in error.object[error.start : error.end])
    return "".join(f"\\u{c:04x}" if c < 0x10000 else f"\\U{c:08x}" for c in codes), error.end


codecs.register_error(_ESCAPED, _escape)


@dataclass
class LenientStream:
    """A text stream in front of another one: what that refuses is dropped.

    Attributes
    ----------
    stream : text stream or None
        Where to write; None where the program was started with the stream closed.
    name : str
        Its name in messages.
    fault : OSError, optional
        The first one that it raised; nothing more is written then.
    """

    stream: Any
    name: str
    fault: OSError | None = field(default=None, init=False)

    def write(self, text: str) -> int:
        """Write as much as can be written; pretend that it was all."""
        self._try(lambda: self.stream.write(text))
        return len(text)

    def flush(self) -> None:
        """Hand on what was written."""
        if self.stream is not None:
            self._try(lambda: self.stream.flush())

    def _try(self, act: Any) -> None:
        if self.stream is None and self.fault is None:
            self.fault = OSError(errno.EBADF, os.strerror(errno.EBADF))
        if self.fault is not None:
            return
        try:
            act()
        except OSError as error:
            self.fault = error
            self._forget()
        except ValueError:  # closed by someone else
            self.fault = OSError(errno.EBADF, os.strerror(errno.EBADF))

    def _forget(self) -> None:
        """Let what is still in the buffers go nowhere, or the interpreter complains at its exit."""
        with suppress(OSError, ValueError, AttributeError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self.stream.fileno())
            os.close(nowhere)

    @property
    def lost(self) -> str:
        """Why something that was printed is lost; empty where nothing is, or nobody reads it."""
        if self.fault is None or self.fault.errno == errno.EPIPE:
            return ""
        return f"{self.name}: {cause(self.fault)}"

    def isatty(self) -> bool:
        """Whether this is a terminal."""
        return self.stream is not None and self.fault is None and bool(self.stream.isatty())

    @property
    def encoding(self) -> str:
        """Encoding of the stream."""
        return getattr(self.stream, "encoding", None) or "utf-8"

    def __getattr__(self, name: str) -> Any:
        return getattr(self.stream, name)


@contextmanager
def lenient_streams() -> Iterator[tuple[LenientStream, LenientStream]]:
    """Put lenient streams in the place of standard output and standard error."""
    before: tuple[Any, Any] = (sys.stdout, sys.stderr)
    streams = (
        LenientStream(sys.stdout, "standard output"),
        LenientStream(sys.stderr, "standard error"),
    )
    errors = [getattr(stream, "errors", None) for stream in before]
    _encode_with(before, [_ESCAPED, _ESCAPED])
    sys.stdout, sys.stderr = streams
    try:
        yield streams
    finally:
        for lenient in streams:
            lenient.flush()
        sys.stdout, sys.stderr = before
        _encode_with(before, errors)


def _encode_with(streams: tuple[Any, Any], errors: list[str | None]) -> None:
    """Set what becomes of characters that a stream cannot encode, where it can be set."""
    for stream, way in zip(streams, errors, strict=True):
        with suppress(AttributeError, ValueError, OSError):
            stream.reconfigure(errors=way)


def open_standard_descriptors() -> None:
    """Open what the program was started without, or its files would take these numbers."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
