"""Mechanics of the block: elements, one implicit step with the road, damping of snaps."""

from typing import TYPE_CHECKING

from fem.files import face

if TYPE_CHECKING:
    from fem.mechanics.account import StepEnergies, Strains
    from fem.mechanics.block import BlockMechanics, platen_displacement
    from fem.mechanics.elements import Past, Q1P0Elements
    from fem.mechanics.iterate import Iterate, StepEvaluation, StepLoad
    from fem.mechanics.regularisation import SnapDamping, damping_lines, snap_damping
    from fem.mechanics.rigid import RigidMechanics, RigidProblem
    from fem.mechanics.state import MechanicalState
    from fem.mechanics.step import StepProblem
else:
    __getattr__ = face(__name__, __file__)
