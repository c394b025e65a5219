"""Templates of `statements.toml` filled in: numbers, per cent, tables, texts within texts."""

import string
from collections.abc import Mapping, Sequence
from typing import Any

from validation.claims.statements import LIMITS, TEXTS


def say(template: str, names: Mapping[str, Any]) -> str:
    """Fill in a template.

    Parameters
    ----------
    template : str
        ``{name:spec}``: a number with the kind p is said in per cent, a mapping entry by entry
        with a % format of ``name`` and ``value`` (or the entry's own names), joined by what stands
        before a bar, else by a comma. With ``text`` the value is the name of a text.
    names : mapping
        Values by name; a function without arguments stands for what it returns.

    Examples
    --------
    >>> say("{share:.1p} % in {found:%(name)s %(value).1f K}", {"share": 0.5, "found": {"a": 1}})
    '50.0 % in a 1.0 K'
    """
    return _Phrases({**LIMITS, **names}).said(template)


class _Phrases(string.Formatter):
    """Looks names up in the texts too, and calls what is computed only when it is said."""

    def __init__(self, names: dict[str, Any]) -> None:
        self.names = names

    def said(self, template: str) -> str:
        return self.vformat(template, (), self.names)

    def get_value(self, key: int | str, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        if key not in self.names:
            return self.said(TEXTS[str(key)])
        value = self.names[str(key)]
        if callable(value):
            value = self.names[str(key)] = value()
        return value

    def format_field(self, value: Any, format_spec: str) -> str:
        if format_spec == "text":
            return self.said(TEXTS[value]) if value else ""
        if isinstance(value, Mapping):
            joint, _, entry = format_spec.rpartition("|")
            return (joint or ", ").join(entry % _entry(name, v) for name, v in value.items())
        if format_spec.endswith("p"):
            return format(100.0 * value, format_spec[:-1] + "f")
        return str(format(value, format_spec))


def _entry(name: str, value: Any) -> dict[str, Any]:
    if isinstance(value, Mapping):
        return {"name": name, **value}
    return {"name": name, "value": value, "percent": 100.0 * value}
