"""How fine the mesh of a block is: cell counts and smallest cells, and the named meshes."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Grading:
    """Cell counts and the smallest cell sizes of a structured block mesh.

    Attributes
    ----------
    cells_x, cells_y : int
        Number of cells along the length and the height [-].
    smallest_x, smallest_y : float
        Size of the cell at the leading edge and of the cell at the bottom [mm].
    """

    cells_x: int
    cells_y: int
    smallest_x: float
    smallest_y: float


#: Named meshes for a block of about 20 x 8 mm. The bottom cells follow from the heated layer,
#: sqrt(alpha t) = 0.25 mm after 0.4 s; the cells at the leading edge from the radius of its roll.
NAMED_GRADINGS = {
    "coarse": Grading(cells_x=48, cells_y=20, smallest_x=0.20, smallest_y=0.08),
    "default": Grading(cells_x=80, cells_y=36, smallest_x=0.12, smallest_y=0.04),
    "fine": Grading(cells_x=120, cells_y=54, smallest_x=0.08, smallest_y=0.027),
}
