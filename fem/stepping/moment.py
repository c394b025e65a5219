"""An accepted step and where in the event it ended."""

from dataclasses import dataclass
from typing import Protocol

from fem.stepping.coupled_state import AcceptedStep
from fem.stepping.phases import Phase


@dataclass(frozen=True, kw_only=True)
class Moment:
    """What observers see.

    Attributes
    ----------
    step : AcceptedStep
        The step.
    phase : Phase
        The phase it belongs to.
    number : int
        Number of that phase, from 0 on.
    distance : float
        Distance slid over the road since the start of the event [mm].
    snaps : bool
        Whether the step had no solution with less damping.
    ends : bool
        Whether it ends the phase.
    """

    step: AcceptedStep
    phase: Phase
    number: int
    distance: float
    snaps: bool
    ends: bool


class Observer(Protocol):
    """Looks at accepted steps; it changes nothing but itself."""

    def see(self, moment: Moment) -> None:
        """Take note of an accepted step."""
