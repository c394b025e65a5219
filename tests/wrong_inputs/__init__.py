"""Everything a command refuses: a row per kind, with the command, its files and the line expected.

`tests/test_wrong_inputs.py` runs each row once.
"""

from tests.wrong_inputs.case_ranges import RANGES
from tests.wrong_inputs.cases import LOADING, SET_SYNTAX, WRONG_CASES
from tests.wrong_inputs.commands import EVENTS_OF_SLIDES, EXPORTS, RIGS, STUDIES
from tests.wrong_inputs.events import EVENTS
from tests.wrong_inputs.measured import MEASURED
from tests.wrong_inputs.memory import MEMORY
from tests.wrong_inputs.memory_tests import MEMORY_TESTS
from tests.wrong_inputs.mesh_files import MESH_FILES, OUTLINES
from tests.wrong_inputs.rows import WrongInput, of_case
from tests.wrong_inputs.signals import SIGNALS
from tests.wrong_inputs.texts import READING
from tests.wrong_inputs.units import UNITS
from tests.wrong_inputs.unusual import UNUSUAL_INPUTS

__all__ = ["LOADING", "UNUSUAL_INPUTS", "WRONG_INPUTS", "WrongInput"]

WRONG_INPUTS = [
    *map(of_case, [*WRONG_CASES, *RANGES, *EVENTS, *SIGNALS, *MEMORY, *SET_SYNTAX]),
    *(UNITS + MEASURED + READING + RIGS + STUDIES + EXPORTS + MEMORY_TESTS),
    *(MESH_FILES + OUTLINES + EVENTS_OF_SLIDES),
]
