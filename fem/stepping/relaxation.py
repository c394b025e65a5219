"""Relaxation of a damped step, until as little damping as can be is left.

A snap that damping carries takes as long as the damping: at the leading edge, millimetres of
sliding, in which forces are those of the damping. So a damped step is solved again without, from
its damped solution. Where that has no neighbour without, the snap is still on its way: the same
damping again and again, counted from the last solution each time, takes the block along it (a
continuation in pseudo-time), until the damping dissipates little of the step's work. What is left
after some of these is left to the next steps; after a try without in vain the first few of them do
not try again. What the snap releases on the way is in none of the forces at the end of the step;
the audit takes it from the balance of the step (`snap_share`).

Both limits are a price: of six hard cases (0.25 and 0.5 N/mm^2, coefficients of about 0.9) the
temperatures differ from those in steps of a tenth by 0.4 K in the mean, A_T by 2 %. One try
and one solution more takes a quarter fewer iterations and errs by up to 13 % in A_T.

References
----------
.. [1] C. T. Kelley, D. E. Keyes, "Convergence analysis of pseudo-transient continuation", SIAM
   Journal on Numerical Analysis 35 (1998), 508-523.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from fem.stepping.coupled_state import AcceptedStep, RejectedStep
from fem.stepping.coupled_step import CoupledModel

#: Share of the work of a step that its damping may dissipate without being relaxed [-].
NEGLIGIBLE = 1e-3
#: Share of it at which the same damping is not repeated, nor a try without [-].
TOLERABLE = 3e-3
#: Factor of the level from one step to the next where its damping is negligible.
FADING = 0.85
#: Level below which the next step is not damped.
LAST_LEVEL = 0.01
#: Steps that keep the damping after one that found no solution without.
REST = 4
#: How often the same damping is repeated in a step. At rest, too, where no work is done: a block
#: that is lifted off would leave the road before its shear is released.
HOLDS = 6


class Damping(NamedTuple):
    """Level of the damping of a step, and how many steps are still to keep it."""

    level: float = 0.0
    rest: int = 0


def relaxed(
    model: CoupledModel, step: AcceptedStep, damping: Damping
) -> tuple[AcceptedStep, Damping]:
    """A step that was solved with damping, with the least of it that still has a solution.

    Parameters
    ----------
    model : CoupledModel
        The model that solved it.
    step : AcceptedStep
        The damped step.
    damping : Damping
        Its damping.

    Returns
    -------
    step : AcceptedStep
        The same step with less damping; its iterations are those of all solutions, found or not.
    damping : Damping
        That of the next step.
    """
    level, rest = damping.level, max(damping.rest - 1, 0)
    if _takes_at_most(NEGLIGIBLE, step):
        return step, _faded(level, rest)
    iterations = step.iterations
    if damping.rest == 0 or not _takes_at_most(TOLERABLE, step):
        attempt = model.advance(step.before, step.target, 0.0, guess=step)
        iterations += attempt.iterations
        if isinstance(attempt, AcceptedStep):
            return replace(attempt, iterations=iterations, relaxed=True), Damping(0.0, rest)
        rest = REST
    for _ in range(HOLDS):
        attempt = model.advance(step.before, step.target, level, guess=step)
        iterations += attempt.iterations
        if isinstance(attempt, RejectedStep):
            break
        step = attempt
        if _takes_at_most(TOLERABLE, step):
            break
    return replace(step, iterations=iterations, relaxed=True), Damping(level, rest)


def _takes_at_most(share: float, step: AcceptedStep) -> bool:
    """Whether the damping dissipates at most that share of the work of a step."""
    work = step.after.contact.friction_force * step.target.sweep
    return step.energies.viscous <= share * abs(work)


def _faded(level: float, rest: int) -> Damping:
    """Damping of the step after one whose damping was negligible; none if it is weak."""
    return Damping(FADING * level if FADING * level >= LAST_LEVEL else 0.0, rest)
