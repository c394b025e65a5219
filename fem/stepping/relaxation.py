"""Relaxation of a damped step, until as little damping as can be is left.

A snap that damping carries takes as long as the damping: at the leading edge, millimetres of
sliding, in which forces are those of the damping. So a damped step is solved again and again, each
time with a quarter of the damping and from its last solution, from which the strains of the damping
count too: a continuation in pseudo-time to the equilibrium that the snap leads to, within the same
step. Where a quarter has no solution, the same damping once more takes the block on its way, and
leaves the rest to the next steps; the first few of these do not try a quarter again. What the snap
releases on the way is in none of the forces at the end of the step; the audit takes it from the
balance of the step (`snap_share`).

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

#: Factor of the damping from one solution to the next; with a half it takes a third more of them.
#: With 0 the 108 cases of `make robustness` take 0.63 of the iterations, but the force at the onset
#: of a block with a coefficient of 0.6 is 3.4 % of full slip off its limit instead of 0.2 %.
EASING = 0.25
#: Level below which the next solution is without damping.
LAST_LEVEL = 0.01
#: Share of the work of a step that its damping may dissipate without being relaxed [-]; with 1e-3
#: the introductory example takes 7 % fewer iterations (mean of nine runs).
NEGLIGIBLE = 1e-4
#: Share of it up to which a step may keep its damping without a try with less [-].
TOLERABLE = 2e-3
#: Factor of the level from one step to the next where its damping is negligible.
FADING = 0.85
#: Steps that keep the damping after one that found no solution with less.
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
    level, rest, holds = damping.level, max(damping.rest - 1, 0), 0
    holds_max = HOLDS if step.target.sweep else HOLDS_AT_REST
    eases = damping.rest == 0 or not _takes_at_most(TOLERABLE, step)
    iterations, again = step.iterations, False
    while level > 0.0 and not _takes_at_most(NEGLIGIBLE, step):
        other = _lowered(level, EASING) if eases else level
        attempt = model.advance(step.before, step.target, other, guess=step)
        iterations, again = iterations + attempt.iterations, True
        if isinstance(attempt, AcceptedStep):
            step, level = attempt, other
        elif eases:
            eases, rest = False, REST
            continue
        if not eases:
            holds, eases = holds + 1, True
            if holds == holds_max or isinstance(attempt, RejectedStep):
                return replace(step, iterations=iterations, relaxed=again), Damping(level, rest)
    left = Damping(_lowered(level, FADING), rest)
    return replace(step, iterations=iterations, relaxed=again), left


def _takes_at_most(share: float, step: AcceptedStep) -> bool:
    """Whether the damping dissipates at most that share of the work of a step."""
    work = step.after.contact.friction_force * step.target.sweep
    return step.energies.viscous <= share * abs(work)


def _lowered(level: float, factor: float) -> float:
    """Level of damping times a factor, 0 for none."""
    return factor * level if factor * level >= LAST_LEVEL else 0.0
