"""The one error a case file can raise, and the words it uses for what it found."""

import difflib
import json
import math
from collections.abc import Iterable
from typing import Any

_LONGEST = 80


class CaseError(ValueError):
    """Something in a case file (or in what it refers to) that cannot be used.

    Its text is always one line: file, key, what was found, what was expected.

    Parameters
    ----------
    file : str
        The file the fault stands in.
    key : str
        Dotted key, e.g. ``loading.velocity_mm_per_s``.
    found, expected : str
        What the file says and what it should say.
    """

    def __init__(self, file: str, key: str, found: str, expected: str) -> None:
        self.file, self.key, self.found, self.expected = (
            _one_line(text) for text in (str(file), key, found, expected)
        )
        super().__init__(f"{self.file}: {self.key}: found {self.found}, expected {self.expected}")


def _one_line(text: str) -> str:
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())


def describe(value: Any) -> str:
    """Say in a few words what a TOML value is."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return "nan" if math.isnan(value) else repr(value)
    if isinstance(value, int):
        # Python refuses to write out whole numbers of more than 4300 digits.
        digits = int(abs(value).bit_length() * math.log10(2.0)) + 1
        return f"a whole number of {digits} digits" if digits > _LONGEST else str(value)
    if isinstance(value, str):
        return _shortened(json.dumps(value, ensure_ascii=False))
    if isinstance(value, dict):
        return "a table" + (f" with {_shortened(', '.join(map(str, value)))}" if value else "")
    if isinstance(value, (list, tuple)):
        return f"an array of {len(value)} values"
    return f"a {type(value).__name__} ({_shortened(str(value))})"


def _shortened(text: str) -> str:
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."


def nearest(name: str, valid: Iterable[str]) -> str | None:
    """The valid name that looks most like `name`, or None when none does."""
    matches = difflib.get_close_matches(name.lower(), list(valid), n=1, cutoff=0.55)
    return matches[0] if matches else None


def one_of(names: Iterable[str]) -> str:
    """List names for an error message: ``"a", "b" or "c"``."""
    quoted = [f'"{name}"' for name in names]
    return quoted[0] if len(quoted) == 1 else ", ".join(quoted[:-1]) + " or " + quoted[-1]


def suggestion(name: str, valid: Iterable[str]) -> str:
    """``"nearest" (or "b", "c")`` for a misspelt name among a closed list."""
    names = list(valid)
    best = nearest(name, names)
    if best is None:
        return one_of(names)
    others = [other for other in names if other != best]
    return f'"{best}"' + (f" (or {one_of(others)})" if others else "")
