"""Case, mesh, mechanics, heat, stepping and results of the sliding tread block.

Examples
--------
>>> from fem import Case
>>> Case.from_toml("examples/introductory.toml").loading.velocity_mm_per_s
300.0
"""

from typing import TYPE_CHECKING

from fem.files import face

if TYPE_CHECKING:
    from fem.case import Case
    from fem.results import Result
    from fem.simulation import simulate
else:
    __getattr__ = face(__name__, __file__)
