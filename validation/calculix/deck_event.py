"""What an input deck does to the block over its time: amplitudes, loads, and what is printed."""

import numpy as np

from fem.case import Case
from fem.mesh import BlockMesh
from validation.calculix.deck_material import numbers
from validation.calculix.deck_mesh import PLANE, Layers

#: Deck time of pressing [-].
PRESSING_TIME = 1.0
#: First, longest and shortest increment of the deck time while it lasts a few units.
FIRST, LONGEST, SHORTEST = 0.02, 0.1, 1e-6
#: A long slide may be taken in this many increments.
SLIDING_INCREMENTS = 200
#: Increments after which CalculiX gives up.
MOST_INCREMENTS = 100_000


def event_lines(case: Case, mesh: BlockMesh, *, bonded: bool, layers: Layers = PLANE) -> list[str]:
    """Amplitudes and the step: the force rises to time 1, then the platen moves (if not bonded)."""
    distance = 0.0 if bonded else case.loading.distance_mm
    end = PRESSING_TIME + distance
    longest = min(max(LONGEST, distance / SLIDING_INCREMENTS), case.solver.step_mm_max)
    return [
        *_amplitude("PRESSING", (0.0, PRESSING_TIME, end), (0.0, 1.0, 1.0)),
        *_amplitude("SLIDING", (0.0, PRESSING_TIME, end), (0.0, 0.0, distance)),
        f"*STEP, NLGEOM, INC={MOST_INCREMENTS}",
        "*STATIC",
        numbers(min(FIRST, longest), end, SHORTEST, longest),
        "*BOUNDARY, AMPLITUDE=SLIDING",
        f"HELD, 1, 1, {mesh.direction}.",
        "*CLOAD, AMPLITUDE=PRESSING",
        *top_loads(case, mesh, layers),
        *_requests("GLUED" if bonded else "ROAD", layers),
        "*END STEP",
    ]


def top_loads(case: Case, mesh: BlockMesh, layers: Layers = PLANE) -> list[str]:
    """Nodal forces of the mean pressure on the top; in plane strain the front has them all."""
    line_load = -case.loading.mean_pressure_N_per_mm2 * case.block.pressed_length_mm
    force = line_load * np.outer(layers.shares, mesh.top_shares)
    loaded = layers.through(mesh, mesh.top).reshape(force.shape)[layers.shares > 0.0] + 1
    pairs = zip(loaded.ravel().tolist(), force[layers.shares > 0.0].ravel().tolist(), strict=True)
    return [f"{node}, 2, {numbers(value)}" for node, value in pairs]


def _amplitude(name: str, times: tuple[float, ...], values: tuple[float, ...]) -> list[str]:
    """Amplitude through points; of equal times only the first counts."""
    kept = [i for i, t in enumerate(times) if i == 0 or t > times[i - 1]]
    points = [number for i in kept for number in (times[i], values[i])]
    return [f"*AMPLITUDE, NAME={name}", numbers(*points)]


def _requests(held: str, layers: Layers) -> list[str]:
    """Output into the .dat file after each increment: surface and platen, reaction of the base.

    Of a slab also all of the bottom and the free side.
    """
    moved = ["SURFACE", "TOP", *(["GLUED", "SIDE"] if layers.free else [])]
    return [
        *(line for name in moved for line in (f"*NODE PRINT, NSET={name}", "U")),
        f"*NODE PRINT, NSET={held}, TOTALS=ONLY",
        "RF",
    ]
