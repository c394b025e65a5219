"""How a run ended: named outcomes, each with its reason and what to try."""

from collections.abc import Callable
from dataclasses import dataclass

from fem.files import OUT_OF_MEMORY, at_step_ends
from fem.newton import Failure

OK = "ok"
NOT_CONVERGED = "not converged"
INTERRUPTED = "interrupted"
#: The machine could not go on: with more memory the same run may.
STOPPED = "stopped"

ADVICE = {
    Failure.ITERATIONS: (
        "a finer mesh at the leading edge, a smaller [solver] step_mm_max, or a larger "
        "edge_viscous_distance_mm often helps"
    ),
    Failure.INADMISSIBLE: (
        "the rubber is strained beyond what its model or mesh can follow: check the pressure and "
        "the locking stretch, or refine the mesh at the leading edge"
    ),
    Failure.SINGULAR: (
        "the block has lost its support or buckles: switch [solver] inertia on, or use a smaller "
        "pressure"
    ),
    Failure.CYCLING: (
        "the leading edge snaps; a larger [solver] edge_viscous_distance_mm carries it through "
        "more gently, a finer mesh in smaller steps"
    ),
    Failure.STALLED: (
        "a smaller [solver] step_mm_max, a finer mesh at the leading edge, or a larger "
        "edge_viscous_distance_mm often helps"
    ),
    Failure.PENETRATION: (
        "the crease is too coarse or closes too fast: use a finer mesh at the leading edge or a "
        "smaller [solver] step_mm_max"
    ),
    Failure.DIVERGED: "use smaller steps ([solver] step_mm_max) or a finer mesh",
}


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """Status of a run with reason and advice where it did not finish."""

    status: str
    reason: str = ""
    advice: str = ""


def failed(failure: Failure, detail: str, where: str) -> Outcome:
    """Outcome of a run that could not go on."""
    reason = f"{failure.value} at {where}" + (f" ({detail})" if detail else "")
    return Outcome(status=NOT_CONVERGED, reason=reason, advice=ADVICE[failure])


def stoppable(steps: Callable[[], Outcome]) -> Outcome:
    """Outcome of the steps of a run, which the user or the machine may end between them."""
    try:
        with at_step_ends():
            return steps()
    except KeyboardInterrupt:
        return Outcome(status=INTERRUPTED, reason="interrupted by the user")
    except MemoryError:
        return Outcome(status=STOPPED, reason="out of memory", advice=OUT_OF_MEMORY)
