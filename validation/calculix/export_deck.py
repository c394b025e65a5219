"""Input deck of a case for CalculiX, in keywords it shares with ABAQUS.

Exported: the mesh as one layer of bricks in plane strain, or as several of half a slab with free
sides, the rubber, a rigid road, Coulomb friction, pressing and sliding. Not exported: heat,
inertia, the Kelvin-Voigt regularisation and contact of the block with itself. The deck says so in
its heading.

The time of the deck runs from 0 to 1 while the block is pressed, and then goes on with the sliding
distance in mm. Both are in one step, driven by amplitudes: with a step of its own for the sliding,
CalculiX 2.20 broke off in the first sliding increment, however small, in five of six variants of
contact formulation and stiffness; in one step all seven variants tried went through.

Bricks and contact were chosen by measurement (version 2.20, tread block of the tests):

- A bonded block of 40 x 20 (80 x 40) cells is pressed in 0.7 % (0.1 %) less with C3D8R than with
  the Q1P0 elements used here, 0.6 % (0.8 %) more with C3D8I, which takes up to nine times as long,
  and 14 % (8 %) less with C3D8, which locks.
- With node-to-surface contact the platen agrees to 0.5 % at all distances. With surface-to-surface
  contact it sinks 1.5 to 2 % deeper from the first slip on, and comes back at the end of the slide.
"""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from contact.friction import CoulombFriction
from fem.case import Case, CaseError, describe
from fem.files import write_text
from fem.mesh import BlockMesh
from fem.stepping import mesh_of, sized
from validation.calculix.deck_event import PRESSING_TIME, event_lines
from validation.calculix.deck_material import hyperelastic_card, numbers
from validation.calculix.deck_mesh import (
    PLANE,
    Layers,
    block_lines,
    free_surface_lines,
    half_slab,
    held_lines,
    road_lines,
    tie_lines,
)

#: Bricks of a slab: a deck of 20 MB. CalculiX takes three minutes for 3200.
MOST_BRICKS = 200_000


@dataclass(frozen=True, kw_only=True)
class DeckOptions:
    """What a deck needs beyond the case.

    Attributes
    ----------
    element : {"C3D8R", "C3D8I", "C3D8"}
        Brick of the block.
    contact : {"NODE TO SURFACE", "SURFACE TO SURFACE"}
        Contact formulation.
    penetration : float
        Depth the mean pressure presses the surface into the road, over the block's height [-]. It
        sets the normal stiffness of the penalty contact.
    elastic_slip : float
        Slip before friction is fully mobilised at the mean pressure, over the height [-]. It sets
        the tangential stiffness.
    bonded : bool
        The bottom is glued to the road, and the block is only pressed.
    layers : Layers
        One in plane strain, or `half_slab`.
    """

    element: Literal["C3D8R", "C3D8I", "C3D8"] = "C3D8R"
    contact: Literal["NODE TO SURFACE", "SURFACE TO SURFACE"] = "NODE TO SURFACE"
    penetration: float = 5e-5
    elastic_slip: float = 2e-4
    bonded: bool = False
    layers: Layers = PLANE


def input_deck(case: Case, options: DeckOptions | None = None) -> str:
    """Input deck of a case.

    Parameters
    ----------
    case : Case
        The case; its rubber must have a Yeoh, Mooney-Rivlin, neo-Hookean or Ogden energy.
    options : DeckOptions, optional

    Returns
    -------
    str
        Text of the deck.

    Raises
    ------
    CaseError
        If CalculiX has no such rubber, the block is rigid, the case is an event of phases, or a
        slab has too many bricks or another friction law than Coulomb's.
    """
    options = options or DeckOptions()
    _refuse_what_no_deck_has(case, options)
    case = sized(case)
    mesh, layers = mesh_of(case), options.layers
    most = MOST_BRICKS // len(mesh.cells)
    if layers.free and layers.cells > most:
        expected = f"at most {most} layers of {len(mesh.cells)} cells ({MOST_BRICKS} bricks)"
        raise CaseError(case.source, "--cells-z", describe(layers.cells), expected)
    bonded, platen = options.bonded, case.loading.top == "platen"
    lines = [
        *_heading(case, options),
        *block_lines(mesh, options.element, layers),
        "*MATERIAL, NAME=RUBBER",
        *hyperelastic_card(case),
        "*SOLID SECTION, ELSET=RUBBER, MATERIAL=RUBBER",
        *tie_lines(mesh, platen=platen, bonded=bonded, layers=layers),
        *([] if bonded else _road_and_contact(case, mesh, options)),
        *held_lines(bonded=bonded, layers=layers),
        *event_lines(case, mesh, bonded=bonded, layers=layers),
    ]
    return "\n".join(lines) + "\n"


def write_deck(case: Case, path: str | Path, options: DeckOptions | None = None) -> Path:
    """Write the input deck of a case into a file."""
    write_text(path, input_deck(case, options))
    return Path(path)


def friction_coefficient(case: Case) -> float:
    """Coefficient of the deck: the law at mean pressure, final speed, reference temperature."""
    law = case.friction.plain_law()
    pressure, speed = case.loading.mean_pressure_N_per_mm2, abs(case.loading.velocity_mm_per_s)
    return float(law.coefficient(pressure, speed))


def friction_remark(case: Case) -> str:
    """Sentence that says what a law other than Coulomb's was replaced with, or nothing."""
    if isinstance(case.friction.plain_law(), CoulombFriction):
        return ""
    return (
        f"friction law {case.friction.law} replaced by a constant coefficient "
        f"{friction_coefficient(case):.6g}, its value at "
        f"{case.loading.mean_pressure_N_per_mm2:g} N/mm^2, "
        f"{abs(case.loading.velocity_mm_per_s):g} mm/s and the reference temperature"
    )


def slab_layers(source: str, depth_mm: float | None, cells: int | None) -> Layers:
    """Layers of a deck from the options ``--depth-mm`` and ``--cells-z``; plane without both.

    Raises
    ------
    CaseError
        If one is missing, or is no depth or number of layers.
    """
    if depth_mm is None and cells is None:
        return PLANE
    if depth_mm is None:
        raise CaseError(source, "--depth-mm", "nothing", "a depth in mm with --cells-z")
    if cells is None:
        raise CaseError(source, "--cells-z", "nothing", "a number of layers with --depth-mm")
    if not (math.isfinite(depth_mm) and depth_mm > 0.0):
        raise CaseError(source, "--depth-mm", f"{depth_mm:g}", "a depth above 0 in mm")
    if cells < 1:
        raise CaseError(source, "--cells-z", describe(cells), "at least 1 layer")
    return half_slab(depth_mm, cells)


def _refuse_what_no_deck_has(case: Case, options: DeckOptions) -> None:
    if case.loading.phase:
        found = f"an event of {len(case.loading.phase)} phases"
        expected = "one slide (mean_pressure_N_per_mm2, velocity_mm_per_s, distance_mm)"
        raise CaseError(case.source, "loading.phase", found, expected)
    if case.block.rigid:
        expected = "false: a rigid block has nothing to export"
        raise CaseError(case.source, "block.rigid", "true", expected)
    if options.layers.free and friction_remark(case):
        found, expected = describe(case.friction.law), '"coulomb" and a mu for a slab'
        raise CaseError(case.source, "friction.law", found, expected)


def _heading(case: Case, options: DeckOptions) -> list[str]:
    layers = options.layers
    depth = f"{2.0 * layers.depth:g} mm deep with free sides" if layers.free else "1 mm deep"
    kind = "slab" if layers.free else "plane strain"
    lines = [
        f"treadfem: pressed and sliding tread block, {kind}, {depth}; N, mm",
        f"case {' '.join(Path(case.source).name.split())}, content {case.hash()[:16]}",
        f"time 0 to {PRESSING_TIME:g}: pressing; then {PRESSING_TIME:g} + sliding distance [mm]",
        "left out: heat, inertia, Kelvin-Voigt regularisation, contact of the block with itself",
        "written for CalculiX. ABAQUS reads the second number of *FRICTION otherwise (leave it",
        "out) and wants TOTALS=YES where TOTALS=ONLY stands; the deck was not run with ABAQUS",
    ]
    if layers.free:
        lines += [
            f"half of it, z = 0 is a plane of symmetry, z = {layers.depth:g} is free; "
            "forces are of the half",
            "the platen holds the top along z, too",
            "left out: contact of the free side with the road, but at its edge",
        ]
    if options.bonded:
        lines.append("the bottom is glued to the road; nothing slides")
    elif remark := friction_remark(case):
        lines.append(remark)
    return ["*HEADING", lines[0], *(f"** {line}" for line in lines[1:])]


def normal_stiffness(case: Case, mesh: BlockMesh, options: DeckOptions) -> float:
    """Contact pressure over depth below the road [N/mm^3]."""
    return case.loading.mean_pressure_N_per_mm2 / (options.penetration * mesh.height)


def _road_and_contact(case: Case, mesh: BlockMesh, options: DeckOptions) -> list[str]:
    pressure, mu = case.loading.mean_pressure_N_per_mm2, friction_coefficient(case)
    behaviour = [normal_stiffness(case, mesh, options)]
    if options.contact == "NODE TO SURFACE":
        # Tension at a large gap: how sharply the law bends at first touch.
        behaviour.append(1e-3 * pressure)
    lines = [
        *road_lines(mesh, case.loading.distance_mm, options.layers),
        "*MATERIAL, NAME=ROAD",
        "*ELASTIC",
        "210000., 0.3",
        "*SOLID SECTION, ELSET=ROADBODY, MATERIAL=ROAD",
        *free_surface_lines(mesh, options.layers),
        f"*CONTACT PAIR, INTERACTION=ROADCONTACT, TYPE={options.contact}",
        "FREE, ROADTOP",
        "*SURFACE INTERACTION, NAME=ROADCONTACT",
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
        numbers(*behaviour),
    ]
    if mu > 0.0:
        lines += ["*FRICTION", numbers(mu, mu * pressure / (options.elastic_slip * mesh.height))]
    return lines
