"""What a run will cost: steps, time and memory, estimated from the case before anything is built.

The factors are of the introductory example on one core of a server of 2024; another machine is
faster or slower by a factor of two or so. What the estimate is for is to tell a minute from a week,
and to refuse what would never end or never fit.
"""

import os
from dataclasses import dataclass

from fem.case import Case, CaseError, MeshSpec
from fem.mesh import NAMED_GRADINGS

#: Elements of the mesh that the factors were measured with.
_REFERENCE = 2880
#: Newton iterations per step with two passes over the friction coefficient: of a step of the onset,
#: with its snaps and their relaxation, and of the others.
_ONSET_ITERATIONS, _ITERATIONS = 15.0, 6.0
_ITERATION_S, _HEAT_STEP_S = 0.019, 0.002
#: Steps of pressing and of the onset of sliding, which are shorter than the longest step.
_SHORT_STEPS = 35
#: Steps of lifting off and of a rest in air, which follow the heat.
_REST_STEPS = 70
#: The program itself, the factors per element, a snapshot per element, a step of the history [GB].
_PROGRAM_GB, _ELEMENT_GB, _SNAPSHOT_GB, _STEP_GB = 0.25, 4e-5, 2e-7, 3e-6
#: Beyond a month nobody waits for a run.
LONGEST_S = 30 * 86_400.0


@dataclass(frozen=True, kw_only=True)
class Cost:
    """Estimate of what a run takes.

    Attributes
    ----------
    elements, steps, heat_steps : int
        Of the block, of its mechanics (none for a rigid one), and of conduction.
    mechanics_s, heat_s : float
        Time on one core [s].
    gigabytes : float
        Memory.
    """

    elements: int
    steps: int
    heat_steps: int
    mechanics_s: float
    heat_s: float
    gigabytes: float

    @property
    def seconds(self) -> float:
        """Time of the whole run on one core [s]."""
        return self.mechanics_s + self.heat_s

    def __str__(self) -> str:
        return (
            f"about {self.elements} elements, {max(self.steps, self.heat_steps)} steps, "
            f"{duration(self.seconds)} on one core, {self.gigabytes:.1f} GB"
        )


def _elements(case: Case) -> int:
    """Number of elements; the mesh of a block that is no rectangle is made to count them."""
    mesh = case.block.mesh
    if not case.block.plain:
        from fem.stepping.model_parts import mesh_of

        return len(mesh_of(case).cells)
    if isinstance(mesh, MeshSpec):
        return mesh.cells_x * mesh.cells_y
    return NAMED_GRADINGS[mesh].cells_x * NAMED_GRADINGS[mesh].cells_y


def estimated_cost(case: Case) -> Cost:
    """Estimate steps, time and memory of a run.

    Examples
    --------
    >>> from fem import Case
    >>> loading = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300, "distance_mm": 120.0}
    >>> str(estimated_cost(Case.from_dict({"loading": loading})))
    'about 2880 elements, 240 steps, 17 s on one core, 0.4 GB'
    """
    solver, elements = case.solver, _elements(case)
    size, distance = elements / _REFERENCE, case.loading.distance_mm
    longest = max(solver.step_mm_max * solver.steps_scale, solver.step_mm_min)
    scale, kinds = min(solver.steps_scale, 1.0), [p.kind for p in case.loading.phases]
    at_rest = _REST_STEPS * case.loading.repeat * kinds.count("lift") / scale
    steps, iterations = 0, 0.0
    if not case.block.rigid:
        short = _SHORT_STEPS * case.loading.repeat * kinds.count("slide") / scale
        steps = round(short + distance / longest + at_rest)
        iterations = short * _ONSET_ITERATIONS + (steps - short) * _ITERATIONS
    heat_steps = max(steps, round(distance / (solver.heat_step_mm * solver.steps_scale) + at_rest))
    passes = max(solver.friction_passes, 1) / 2.0
    return Cost(
        elements=elements,
        steps=steps,
        heat_steps=heat_steps,
        mechanics_s=iterations * passes * _ITERATION_S * size**1.15,
        heat_s=heat_steps * _HEAT_STEP_S * size,
        gigabytes=_PROGRAM_GB
        + elements * (_ELEMENT_GB + min(case.output.snapshots, heat_steps) * _SNAPSHOT_GB)
        + steps * _STEP_GB,
    )


def refuse_unaffordable(case: Case) -> Cost:
    """Refuse a run that takes more than a month or more memory than the machine has.

    Raises
    ------
    CaseError
        Naming the key that costs most, and the estimate.
    """
    cost = estimated_cost(case)
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9
    if cost.seconds > LONGEST_S:
        key = _slowest(case, cost)
        expected = f"a run that ends within {LONGEST_S / 86_400.0:.0f} days"
    elif cost.gigabytes > memory:
        snapshots = case.output.snapshots * _SNAPSHOT_GB > _ELEMENT_GB
        key = "output.snapshots" if snapshots else "block.mesh"
        expected = f"a run that fits into the {memory:.1f} GB of this machine"
    else:
        return cost
    raise CaseError(case.source, key, str(cost), expected)


def _slowest(case: Case, cost: Cost) -> str:
    """The key behind the time: a step much shorter than usual, or the distance."""
    usual = type(case.solver)()
    if cost.heat_s > cost.mechanics_s:
        short = case.solver.heat_step_mm < usual.heat_step_mm
        key = "heat_step_mm"
    else:
        short = case.solver.step_mm_max < usual.step_mm_max
        key = "step_mm_max"
    if case.solver.steps_scale < usual.steps_scale:
        short, key = True, "steps_scale"
    return f"solver.{key}" if short else "loading.distance_mm"


def duration(seconds: float) -> str:
    for unit, length in (("days", 86_400.0), ("h", 3_600.0), ("min", 60.0)):
        if seconds >= 2.0 * length:
            return f"{seconds / length:.0f} {unit}"
    return f"{max(seconds, 1.0):.0f} s"
