"""A rigid-block case recorded with the same tables as a deformable one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from fem.case import Case
from fem.results import Result


def simulate_rigid(case: Case, progress: Callable[[Any], None] | None = None) -> Result:
    raise NotImplementedError
