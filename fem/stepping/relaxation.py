"""Relaxation of a damped step at the onset of sliding, until as little damping as can be is left.

A snap that damping carries takes as long as the damping: at the leading edge, millimetres of
sliding. Late in a slide that is little; in the first millimetres the force would be that of the
damping. There the damped step is solved once more with half the damping from its own solution, and
so on: a continuation to the equilibrium that the snap leads to, within the same step. What the snap
releases on the way is not in the forces at the end of the step: the audit shows it as missing
energy, some tenths of a per cent of the work of the first 3 mm.
"""

from __future__ import annotations

from dataclasses import replace

from fem.stepping.coupled_step import AcceptedStep, CoupledModel

#: Distance slid up to which damped steps are relaxed [mm]. A block of 8 mm slides in full after
#: 2.8 mm.
RELAXED_ONSET = 3.0
#: Factor of the damping from one solution to the next; with a third some end earlier.
EASING = 0.5
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
    iterations = step.iterations
    while level > 0.0:
        lower = EASING * level if EASING * level >= LAST_LEVEL else 0.0
        attempt = model.advance(step.before, step.target, lower, guess=step)
        iterations += attempt.iterations
        if not isinstance(attempt, AcceptedStep):
            break
        step, level = attempt, lower
    return replace(step, iterations=iterations), level
