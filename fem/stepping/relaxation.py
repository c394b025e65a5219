"""Relaxation of a damped step, until as little damping as can be is left.

A snap that damping carries takes as long as the damping: at the leading edge, millimetres of
sliding, in which forces are those of the damping. So a damped step is solved again without, from
its damped solution: that is next to the equilibrium that the snap leads to. Where there is none,
the same damping once more, counted from the last solution, takes the block on its way (a step of a
continuation in pseudo-time), and leaves the rest to the next steps; the first few of these do not
try without again. What the snap releases on the way is in none of the forces at the end of the
step; the audit takes it from the balance of the step (`snap_share`).

Damping that dissipates a thousandth of the work of a step is left alone: forces are as good as
without, and the step that follows gets through. To relax to a ten-thousandth, and in quarters of
the damping, takes a quarter more iterations and gives the same results.

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
#: Share of it up to which a step may keep its damping without a try without [-].
TOLERABLE = 2e-2
#: Factor of the level from one step to the next where its damping is negligible.
FADING = 0.85
#: Level below which the next step is not damped.
LAST_LEVEL = 0.01
#: Steps that keep the damping after one that found no solution without.
REST = 4
#: How often a step keeps its damping for another solution: while the road moves on the next steps
#: take what is left; a block that is lifted off would leave the road before its shear is released.
HOLDS, HOLDS_AT_REST = 1, 4


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
    tries = damping.rest == 0 or not _takes_at_most(TOLERABLE, step)
    iterations = step.iterations
    for _ in range(HOLDS if step.target.sweep else HOLDS_AT_REST):
        if tries:
            attempt = model.advance(step.before, step.target, 0.0, guess=step)
            iterations += attempt.iterations
            if isinstance(attempt, AcceptedStep):
                return replace(attempt, iterations=iterations, relaxed=True), Damping(0.0, rest)
            rest = REST
        attempt = model.advance(step.before, step.target, level, guess=step)
        iterations += attempt.iterations
        if isinstance(attempt, RejectedStep):
            break
        step, tries = attempt, True
    return replace(step, iterations=iterations, relaxed=True), Damping(level, rest)


def _takes_at_most(share: float, step: AcceptedStep) -> bool:
    """Whether the damping dissipates at most that share of the work of a step."""
    work = step.after.contact.friction_force * step.target.sweep
    return step.energies.viscous <= share * abs(work)


def _faded(level: float, rest: int) -> Damping:
    """Damping of the step after one whose damping was negligible; none if it is weak."""
    return Damping(FADING * level if FADING * level >= LAST_LEVEL else 0.0, rest)
