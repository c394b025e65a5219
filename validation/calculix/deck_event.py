"""What an input deck does to the block over its time: amplitudes, loads, and what is printed."""

from fem.case import Case
from fem.mesh import BlockMesh
from validation.calculix.deck_material import numbers

#: Deck time of pressing [-].
PRESSING_TIME = 1.0
#: First, longest and shortest increment of the deck time while it lasts a few units.
FIRST, LONGEST, SHORTEST = 0.02, 0.1, 1e-6
#: A long slide may be taken in this many increments.
SLIDING_INCREMENTS = 200
#: Increments after which CalculiX gives up.
MOST_INCREMENTS = 100_000


def event_lines(case: Case, mesh: BlockMesh, *, bonded: bool) -> list[str]:
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
        *top_loads(case, mesh),
        *_requests("GLUED" if bonded else "ROAD"),
        "*END STEP",
    ]


def top_loads(case: Case, mesh: BlockMesh) -> list[str]:
    """Nodal forces of the mean pressure on the front layer, which carries the back layer along."""
    length = case.block.pressed_length_mm
    force = -case.loading.mean_pressure_N_per_mm2 * length * mesh.top_shares
    pairs = zip((mesh.top + 1).tolist(), force.tolist(), strict=True)
    return [f"{node}, 2, {numbers(value)}" for node, value in pairs]


def _amplitude(name: str, times: tuple[float, ...], values: tuple[float, ...]) -> list[str]:
    """Amplitude through points; of equal times only the first counts."""
    kept = [i for i, t in enumerate(times) if i == 0 or t > times[i - 1]]
    return [
        f"*AMPLITUDE, NAME={name}",
        numbers(*(number for i in kept for number in (times[i], values[i]))),
    ]


def _requests(held: str) -> list[str]:
    """Output into the .dat file after each increment: surface and platen, reaction of the base."""
    return [
        "*NODE PRINT, NSET=SURFACE",
        "U",
        "*NODE PRINT, NSET=TOP",
        "U",
        f"*NODE PRINT, NSET={held}, TOTALS=ONLY",
        "RF",
    ]
