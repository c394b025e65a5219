"""Parameter files: what a calibration hands to a case file.

A case file refers to one with ``parameters = "file.toml"`` in its ``[rubber]``, ``[friction]`` or
``[heat]`` section. The file has a table of that name with the keys of the section, and a table
``[fit]`` that says which data, selection, model and version made the numbers, and how sure they
are.
"""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from calibration.fitting.core import FitResult
from calibration.fitting.stability import Stability


def parameter_text(result: FitResult) -> str:
    """Text of the parameter file of a fit."""
    lines = []
    for name, content in result.section.items():
        lines += [f'# In a case file: [{name}] parameters = "this file"', *_table(name, content)]
    if not result.section:
        lines += ["# No case file takes this model: the numbers are for comparison only.", ""]
    lines += _table("fit", _provenance(result))
    lines += _table("fit.values", result.values)
    lines += _table("fit.stderr", result.stderr)
    matrix = np.asarray(result.covariance).tolist()
    lines += _table("fit.covariance", {"names": list(result.names), "matrix": matrix})
    return "\n".join(lines)


def _provenance(result: FitResult) -> dict[str, Any]:
    known = dict(result.metadata)
    stability = known.pop("stability", None)
    if isinstance(stability, Stability):
        known["stability"] = stability.text
    if "data_file" in known:
        known["data_file"] = Path(str(known["data_file"])).name
    return {
        **known,
        "n_data": result.n_data,
        "rmse": result.rmse,
        "r2": result.r2,
        "aic": result.aic,
        "message": result.message,
        "held": sorted(result.fixed),
        "warnings": list(result.warnings),
    }


def _table(name: str, content: Mapping[str, Any]) -> list[str]:
    """A TOML table; entries that are mappings become tables of their own behind it."""
    inner = {key: value for key, value in content.items() if isinstance(value, Mapping)}
    plain = {key: value for key, value in content.items() if key not in inner}
    lines = [f"[{name}]", *(f"{key} = {_toml(value)}" for key, value in plain.items()), ""]
    for key, value in inner.items():
        lines += _table(f"{name}.{key}", value)
    return lines


def _toml(value: Any) -> str:
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    if isinstance(value, int | np.integer):
        return str(int(value))
    if isinstance(value, float | np.floating):
        number = float(value)
        return repr(number) if math.isfinite(number) else str(number)
    if isinstance(value, list | tuple):
        return f"[{', '.join(_toml(entry) for entry in value)}]"
    # JSON strings are TOML basic strings, apart from the delete character
    return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007f")
