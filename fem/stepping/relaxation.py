"""Relaxation of a damped step, until as little damping as can be is left.

A snap that damping carries takes as long as the damping: at the leading edge, millimetres of
sliding, in which forces are those of the damping. So a damped step is solved again and again, each
time with a quarter of the damping and from its last solution, from which the strains of the damping
count too: a continuation in pseudo-time to the equilibrium that the snap leads to, within the same
step. Where a quarter has no
solution, the same damping once more takes the block on its way, and leaves the rest to the next
step. What the snap releases on the way is in none of the forces at the end of the step; the audit
takes it from the balance of the step (`snap_share`).

References
----------
.. [1] C. T. Kelley, D. E. Keyes, "Convergence analysis of pseudo-transient continuation", SIAM
   Journal on Numerical Analysis 35 (1998), 508-523.
"""

from __future__ import annotations

from dataclasses import replace

from fem.stepping.coupled_state import AcceptedStep
from fem.stepping.coupled_step import CoupledModel

#: Factor of the damping from one solution to the next; with a half it takes a third more of them.
EASING = 0.25
#: Level below which the next solution is without damping.
LAST_LEVEL = 0.01


def relaxed(model: CoupledModel, step: AcceptedStep, level: float) -> tuple[AcceptedStep, float]:
    """A step that was solved with damping, with the least of it that still has a solution.

    Parameters
    ----------
    model : CoupledModel
        The model that solved it.
    step : AcceptedStep
        The damped step.
    level : float
        Level of its damping [-].

    Returns
    -------
    step : AcceptedStep
        The same step with less damping; its iterations are those of all solutions, found or not.
    level : float
        Level of its damping, 0 for none.
    """
    iterations, eases = step.iterations, True
    while level > 0.0:
        other = _eased(level) if eases else level
        attempt = model.advance(step.before, step.target, other, guess=step)
        iterations += attempt.iterations
        if isinstance(attempt, AcceptedStep):
            step, level = attempt, other
        elif eases:
            eases = False
            continue
        if not eases:
            break
    return replace(step, iterations=iterations, relaxed=True), level


def _eased(level: float) -> float:
    """Next lower level of damping."""
    return EASING * level if EASING * level >= LAST_LEVEL else 0.0
