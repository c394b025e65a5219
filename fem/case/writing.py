"""From a case to TOML text, every key with its meaning and unit."""

import json
from typing import Any

from pydantic import BaseModel

_COMMENT_COLUMN = 44


def section_lines(name: str, section: BaseModel) -> list[str]:
    """Lines of one table of the case file, keys without a value left out."""
    lines, inner = [f"[{name}]"], []
    for field, info in type(section).model_fields.items():
        value = getattr(section, field)
        if isinstance(value, tuple) and value:
            for part in value:
                inner += ["", *section_lines(f"[{name}.{field}]", part)]
        elif value is not None and field not in getattr(section, "hidden", ()):
            entry = f"{info.alias or field} = {toml_value(value)}"
            comment = f"  # {info.description}" if info.description else ""
            lines.append(f"{entry:<{_COMMENT_COLUMN}}{comment}".rstrip())
    return lines + inner


def toml_value(value: Any) -> str:
    """Write one value as TOML; nested tables inline."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, BaseModel):
        value = value.model_dump(exclude_none=True, by_alias=True)
    if isinstance(value, list):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml_value(v)}" for key, v in value.items()) + "}"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return repr(value)
