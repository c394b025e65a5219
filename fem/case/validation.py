"""Turns what pydantic finds wrong with a case into one `CaseError`."""

import re
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from fem.case.errors import CaseError, describe, nearest, one_of, suggestion
from fem.case.reading import REFERRING_SECTIONS, Source

#: What of a location is a key; the rest is how pydantic calls the kinds it may be.
_KEY = re.compile(r"\w+")
_KINDS = {
    "float_type": "a number",
    "float_parsing": "a number",
    "finite_number": "a finite number",
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "bool_type": "true or false",
    "string_type": "a text in quotes",
    "greater_than": "a number greater than {gt:.6g}",
    "greater_than_equal": "a number of at least {ge:.6g}",
    "less_than": "a number less than {lt:.6g}",
    "less_than_equal": "a number of at most {le:.6g}",
    "model_type": "a table of keys",
    "list_type": "an array of numbers",
    "tuple_type": "an array of tables",
    "too_short": "an array of at least {min_length} numbers",
    "too_long": "an array of at most {max_length} numbers",
    "dict_type": "a table of keys",
}


def refuse_unknown_keys(source: Source, model: type[BaseModel]) -> None:
    """Raise for the first key that the case does not know, naming the nearest it knows."""
    _walk(source, source.tables, model, (), model)


def _walk(
    source: Source,
    table: dict[str, Any],
    model: type[BaseModel],
    location: tuple[str, ...],
    root: type[BaseModel],
) -> None:
    fields = {info.alias or name: info for name, info in model.model_fields.items()}
    for key, value in table.items():
        here = (*location, key)
        if key not in fields:
            raise CaseError(
                source.file_of(here),
                ".".join(here),
                "an unknown key" if location else "an unknown section",
                _advice(key, fields, location, root),
            )
        inner = _table_model(fields[key].annotation)
        if inner is None:
            continue
        if isinstance(value, dict):
            _walk(source, value, inner, here, root)
        for number, item in enumerate(value if isinstance(value, list | tuple) else ()):
            kind = _kind_model(fields[key].annotation, item)
            if kind is not None:
                _walk(source, item, kind, (*here, str(number)), root)


def _table_model(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type):
        return annotation if issubclass(annotation, BaseModel) else None
    return next(filter(None, map(_table_model, get_args(annotation))), None)


def _kind_model(annotation: Any, item: Any) -> type[BaseModel] | None:
    """The model of a table in an array, told by its `kind` where there are several."""
    if not isinstance(item, dict):
        return None
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        kind = annotation.model_fields.get("kind")
        return annotation if kind is None or kind.default == item.get("kind") else None
    return next(filter(None, (_kind_model(part, item) for part in get_args(annotation))), None)


def _advice(
    key: str, fields: dict[str, Any], location: tuple[str, ...], root: type[BaseModel]
) -> str:
    names = list(fields)
    if len(location) == 1 and location[0] in REFERRING_SECTIONS:
        names.append("parameters")
    best = nearest(key, names)
    if best is not None:
        return best if location else f"[{best}]"
    for section, info in root.model_fields.items():
        model = _table_model(info.annotation)
        known = {i.alias or n for n, i in model.model_fields.items()} if model else set()
        if key in known and section not in location:
            return f"{key} in [{section}]"
    return f"one of {', '.join(names)}"


def case_error(error: ValidationError, source: Source) -> CaseError:
    """Turn the first fault of a pydantic error into a `CaseError`."""
    fault = _telling(error.errors(include_url=False))
    location = tuple(str(part) for part in fault["loc"] if _KEY.fullmatch(str(part)))
    context = fault.get("ctx", {})
    if fault["type"] == "case":
        location += tuple(part for part in context["key"].split(".") if part)
        found, expected = context["found"], context["expected"]
    elif fault["type"] == "union_tag_invalid":
        found = describe(fault["input"])
        if isinstance(fault["input"], dict):
            location, found = (*location, "kind"), describe(fault["input"].get("kind"))
        expected = one_of(re.findall(r"<(\w+)>", context["expected_tags"]))
    else:
        found, expected = _found(fault), _expected(fault, context)
    return CaseError(source.file_of(location), ".".join(location) or "case", found, expected)


def _telling(faults: list[ErrorDetails]) -> ErrorDetails:
    """The first fault; of a key that takes a name or a number that of the kind that was given."""
    first = faults[0]
    if first["type"] == "literal_error" and not isinstance(first["input"], str):
        same = [fault for fault in faults[1:] if fault["input"] == first["input"]]
        return (same or faults)[0]
    return first


def _found(fault: ErrorDetails) -> str:
    if fault["type"] == "missing":
        return "nothing"
    shown = describe(fault["input"])
    wrong_type = fault["type"].endswith("_type") and isinstance(fault["input"], str)
    return f"the text {shown}" if wrong_type else shown


def _expected(fault: ErrorDetails, context: dict[str, Any]) -> str:
    kind = fault["type"]
    if kind == "missing":
        return "this key: it has no default"
    if kind == "literal_error":
        names = [name.strip().strip("'") for name in _literal_names(context["expected"])]
        value = fault["input"]
        return suggestion(value, names) if isinstance(value, str) else one_of(names)
    if kind in _KINDS:
        return _KINDS[kind].format(**context)
    return fault["msg"]


def _literal_names(expected: str) -> list[str]:
    return expected.replace(" or ", ", ").split(",")
