"""The case: what a simulation needs to know, read from TOML, checked, frozen, written again."""

from typing import TYPE_CHECKING

from fem.files import face

if TYPE_CHECKING:
    from fem.case.block import LARGEST_MESH, Block, MeshSpec, Sipe
    from fem.case.case import Case, Solver
    from fem.case.errors import CaseError, describe, suggestion
    from fem.case.reading import parse_override, read_toml
    from fem.case.rubber import CONSTANTS, DEFAULT_COMPOUND
    from fem.case.sections import MOST_PASSES
    from fem.case.signals import Signal
    from fem.case.template import case_template, study_template
    from fem.case.window import ContactWindow
else:
    __getattr__ = face(__name__, __file__)
