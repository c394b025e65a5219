"""Changes of one thing at a time that show why a claim and our result differ."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from fem.results.result import Result
from validation.claims.evidence import Evidence, UnfinishedError

Changes = Mapping[str, Mapping[str, Any]]

#: Changes of the introductory example by how a reader calls them, to the case keys.
LOWER_BLOCK: Changes = {"a block 5 mm high": {"block.height_mm": 5.0}}
FREE_TOP: Changes = {"a free top under uniform pressure": {"loading.top": "pressure"}}
#: Which pressure governs the heat of the contact: heat made at the local instead of the mean one,
#: heat conducted at the nominal instead of the local one.
CONTACT_PRESSURE: Changes = {
    "the heat partition of the local pressure": {"heat.partition.pressure": "local"},
    "the gap conductance of 0.3 N/mm² everywhere": {"heat.exponent": 0.0},
    "both": {"heat.partition.pressure": "local", "heat.exponent": 0.0},
}
#: Friction that does not feel the temperature.
NO_SHIFT: Changes = {"no shift of friction with temperature": {"friction.wlf": False}}
#: No stiffening, and as stiff at first as "Yeoh, bars, series 1, load".
NEO_HOOKE = {"rubber.model": "neo-hooke", "rubber.G_N_per_mm2": 0.7588}


def rigid_block(law: str, pressure: float) -> dict[str, Any]:
    """A rigid block at 50 mm/s: the same pressure [N/mm^2] everywhere, nothing deforms."""
    return {
        "block.rigid": True,
        "loading.velocity_mm_per_s": 50.0,
        "loading.mean_pressure_N_per_mm2": pressure,
        "friction.law": law,
    }


def tried(
    evidence: Evidence,
    changes: Changes,
    quantity: Callable[[Result], float],
    meets: Callable[[Result], bool],
    unit: str,
) -> str:
    """What came out with each change of the introductory example, and whether it is enough.

    Parameters
    ----------
    evidence : Evidence
        Has the runs.
    changes : mapping
        Words for the change to the case keys.
    quantity, meets : callable
        The number shown, and whether the run meets the claim's criterion.
    unit : str
        Of the number.
    """
    parts = []
    for words, overrides in changes.items():
        try:
            result = evidence.changed(overrides)
        except UnfinishedError as error:
            parts.append(f"{words}: no result ({error})")
            continue
        verdict = "meets the criterion" if meets(result) else "does not meet it"
        parts.append(f"{words}: {quantity(result):.3g} {unit}, {verdict}")
    return "With " + "; ".join(parts) + "."
