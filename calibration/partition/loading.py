"""The case of a measured slide: its pressure and speed in a single slide or in an event."""

from __future__ import annotations

from math import copysign
from typing import Any

from fem.case import Case, CaseError, describe


def refuse_event(case: Case) -> None:
    """Refuse an event whose pressure and speed a measured slide cannot stand for.

    Raises
    ------
    CaseError
        Of a record, or of phases with several pressures or speeds.
    """
    held: dict[str, float] = {}
    for number, phase in enumerate(case.loading.phase):
        key = f"loading.phase.{number}"
        if phase.kind == "record":
            expected = "press and slide, as the rig slid the block"
            raise CaseError(case.source, f"{key}.kind", '"record"', expected)
        name = {"press": "mean_pressure_N_per_mm2", "slide": "velocity_mm_per_s"}.get(phase.kind)
        value = abs(getattr(phase, name)) if name else 0.0
        if name is None or value == 0.0:
            continue
        if held.setdefault(name, value) != value:
            found = f"{describe(value)} after {describe(held[name])}"
            expected = "one pressure and one speed: those measured"
            raise CaseError(case.source, f"{key}.{name}", found, expected)


def loading_keys(case: Case, pressure: float, velocity: float) -> dict[str, Any]:
    """Keys that make the block of a case slide under a pressure on its top at a speed.

    Every phase of an event that presses or slides gets them; what comes after the last contact is
    left out, so that it ends as the surface is measured.
    """
    loading = case.loading
    if not loading.phase:
        return {
            "loading.mean_pressure_N_per_mm2": pressure,
            "loading.velocity_mm_per_s": velocity,
        }
    phases = [phase.model_dump(exclude_none=True) for phase in loading.phase * loading.repeat]
    while phases[-1]["kind"] == "lift":
        phases.pop()
    for phase in phases:
        if phase["kind"] == "press":
            phase["mean_pressure_N_per_mm2"] = pressure
        elif phase.get("velocity_mm_per_s"):
            phase["velocity_mm_per_s"] = copysign(velocity, phase["velocity_mm_per_s"])
    return {"loading.phase": phases, "loading.repeat": 1}
