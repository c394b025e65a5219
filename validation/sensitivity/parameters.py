"""What is varied, what it is called, and why over this range.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications".
.. [2] Hentschke, R., Plagge, J., Scientific Reports 11 (2021), doi:10.1038/s41598-021-97921-0,
   Fig. 1: the storage modulus of a tread rubber far from its glass transition grows with the
   frequency to the power of 0.05.
"""

from __future__ import annotations

from dataclasses import dataclass

PHYSICS, NUMERICS = "physics", "numerics"


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A case key that is varied.

    Attributes
    ----------
    label : str
        What a reader calls it.
    unit : str
        Unit of its values; empty where they are words or pure numbers.
    group : str
        `PHYSICS`: the paper leaves it open, or what it does is not obvious. `NUMERICS`: the
        results should not depend on it.
    why : str
        Where the range comes from.
    """

    label: str
    unit: str = ""
    group: str
    why: str


#: By the case key that a case of the study names first.
PARAMETERS = {
    "rubber.bulk_ratio": Parameter(
        label="bulk over shear modulus",
        group=PHYSICS,
        why="not published; 20 is what ABAQUS/Explicit takes when it is given none, filled rubber "
        "has 50 to 200, and 1000 is as good as incompressible",
    ),
    "block.height_mm": Parameter(
        label="block height",
        unit="mm",
        group=PHYSICS,
        why="the figure with the dimensions is lost; from flat to a deep tread",
    ),
    "loading.top": Parameter(
        label="top pressed by",
        group=PHYSICS,
        why="the paper presses uniformly and then moves the block, and does not say whether its "
        "top may tilt; a rigid platen does not let it. Free to tilt, the block tips over and "
        "slides on its leading edge at several times the paper's contact pressure, so that the "
        "paper can only mean something like the platen",
    ),
    "friction.T_ref_C": Parameter(
        label="reference temperature of friction",
        unit="°C",
        group=PHYSICS,
        why="not published; friction is usually measured at 10 to 30 °C (assumption)",
    ),
    "friction.wlf": Parameter(
        label="temperature shift of friction (WLF)",
        group=PHYSICS,
        why="without it friction does not feel the heat it makes",
    ),
    "heat.modulus_exponent": Parameter(
        label="exponent m of E₁ ~ (1 + v/1 mm/s)ᵐ",
        group=PHYSICS,
        why="E1(v) of eq. (13) is not published; 0.05 is the slope of log E' over log frequency of "
        "a tread rubber (Hentschke and Plagge, doi:10.1038/s41598-021-97921-0, Fig. 1), its double "
        "and v_ref = 1 mm/s are assumptions",
    ),
    "heat.conductance_W_per_m2K": Parameter(
        label="gap conductance at 0.3 N/mm²",
        unit="W/(m² K)",
        group=PHYSICS,
        why="identified by resimulating one static experiment; -25 % and +25 % (assumption)",
    ),
    "heat.partition.cap": Parameter(
        label="largest heat partition",
        group=PHYSICS,
        why="eq. (14) exceeds 1 below 0.184 N/mm^2; a cap above 1 would create energy and is "
        "refused, so only the other direction can be shown",
    ),
    "heat.partition.pressure": Parameter(
        label="pressure of the heat partition",
        unit="N/mm²",
        group=PHYSICS,
        why="eq. (14) was identified from the mean pressures of tests; here with the pressure of "
        "each point, and with the paper's 0.3 N/mm^2, instead of the mean contact pressure",
    ),
    "friction.v_min_mm_per_s": Parameter(
        label="velocity floor of friction",
        unit="mm/s",
        group=PHYSICS,
        why="Huemer's law falls to zero at rest, the paper gives no floor; rubber of 48 °C at "
        "300 mm/s counts as rubber of 20 °C at 1.7 mm/s, so that a floor above that stops the "
        "fall of friction; a tenth and five times",
    ),
    "friction.memory_mm": Parameter(
        label="slip that friction remembers",
        unit="mm",
        group=PHYSICS,
        why="not in the paper, whose law is measured at constant speed; of the size of the contact "
        "spots, a third and about three times",
    ),
    "solver.self_contact": Parameter(
        label="contact of the block with itself",
        group=PHYSICS,
        why="the paper has it, with a coefficient of 1.0; without it the folded front edge passes "
        "through the block",
    ),
    "block.mesh": Parameter(label="mesh", group=NUMERICS, why="the two other named meshes"),
    "solver.steps_scale": Parameter(
        label="step size", unit="×", group=NUMERICS, why="all steps halved"
    ),
    "solver.inertia": Parameter(
        label="inertia", group=NUMERICS, why="300 mm/s is slow against waves in rubber"
    ),
    "solver.viscous_distance_mm": Parameter(
        label="damping of snaps, block",
        unit="mm",
        group=NUMERICS,
        why="a tenth and ten times; only steps without a solution have it",
    ),
    "solver.edge_viscous_distance_mm": Parameter(
        label="damping of snaps, leading corner",
        unit="mm",
        group=NUMERICS,
        why="a tenth and ten times; validation/convergence.csv goes to a hundredth of both",
    ),
    "friction.p_min_N_per_mm2": Parameter(
        label="pressure floor of friction",
        unit="N/mm²",
        group=NUMERICS,
        why="a tenth and ten times; the laws diverge at zero pressure",
    ),
}

#: Between the keys of a case that changes more than one.
AND = " and "


def first_key(parameter: str) -> str:
    """Key of `PARAMETERS` for a cell of the table's column ``parameter``."""
    return parameter.split(AND)[0]
