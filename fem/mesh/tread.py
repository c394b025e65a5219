"""Meshes of blocks with chamfers, sipes and grooves: quadrilaterals in rows and columns.

The rubber between two neighbouring slots (sipes or grooves) is a lamella. Its columns run from the
road to the platen and follow the walls of the slots; the columns of a slot begin at its base. Rows
lie at one height in all lamellae and rise over a chamfer and over the arc of a rounded base, from
which the columns beside it spread. Cells are small at the road, at the corners of lamellae and
chamfers and at the bases of slots, and grow away from them like those of the plain block.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fem.mesh.block import BlockMesh, graded_coordinates
from fem.mesh.grading import Grading
from fem.mesh.sizes import Fine, divided
from materials.arrays import BoolArray, FloatArray

#: Growth of the cells away from corners and bases that the plain block has not [-].
GROWTH = 0.25
#: Cells over the width of a sipe.
ACROSS = 4
#: Largest cell of the base of a wide slot, over the smallest cell at a leading edge [-].
BASE_CELL = 3.0
#: Smallest cells at the other end of a lamella, over those at its leading edge [-].
TRAILING_CELL = 2.0
#: Part of a lamella beside a slot that the columns spread over above its base [-].
SPREAD = 0.25
#: Height over which the rows sink back above a chamfer, over the chamfer [-].
CHAMFER_REACH = 5.0
#: Thinnest lamella, at any height, over the smallest cell at a leading edge [-].
THINNEST = 2.0


@dataclass(frozen=True, kw_only=True)
class Slot:
    """A sipe or a groove.

    Attributes
    ----------
    at : float
        Middle of its mouth, from the trailing end of the rubber [mm].
    width, depth : float
        Width along the road and height of its base over it [mm]; a slot as deep as the rubber is
        high cuts it in two.
    slope : float
        Tangent of its angle to the vertical, positive when its base lies ahead of its mouth [-].
    rounded : bool
        Whether the base is an arc.
    """

    at: float
    width: float
    depth: float
    slope: float = 0.0
    rounded: bool = False

    @property
    def rise(self) -> float:
        """Height of the arc of its base: half the distance of its walls, 0 if it is flat [mm]."""
        return float(self.rounded * 0.5 * self.width / np.hypot(1.0, self.slope))


@dataclass(frozen=True, kw_only=True)
class TreadShape:
    """Outline of one or several blocks.

    Attributes
    ----------
    length, height : float
        Of all the rubber, grooves included [mm].
    slots : tuple of Slot
        From the trailing to the leading one.
    chamfers : tuple of (float, float)
        Chamfer at the trailing and at the leading edge of each lamella [mm].
    breaks : tuple of float
        Where one block ends and the next begins, from the trailing end [mm].
    """

    length: float
    height: float
    slots: tuple[Slot, ...]
    chamfers: tuple[tuple[float, float], ...]
    breaks: tuple[float, ...] = ()


def tread_mesh(
    shape: TreadShape, grading: Grading, block_length: float, direction: int
) -> BlockMesh:
    """Mesh of a shape, its leading edge on the side of the motion.

    Parameters
    ----------
    shape : TreadShape
        The outline.
    grading : Grading
        Cells of the plain block of this length and height, which say how sizes grow.
    block_length : float
        Length of one block [mm].
    direction : {1, -1}
        Sense of sliding along x.

    Raises
    ------
    ValueError
        If a lamella is thinner than its cells at some height, saying where.
    """
    grid = _Grid(shape, _Sizes.of(grading, block_length, shape.height))
    x, y, there, cell_there = grid.nodes()
    number = np.cumsum(there.ravel()).reshape(there.shape) - 1
    corners = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
    top, breaks = number[:, -1][there[:, -1]], np.array(shape.breaks)
    if direction < 0:
        x, breaks = shape.length - x, shape.length - breaks
        corners = [corners[1], corners[0], corners[3], corners[2]]
    return BlockMesh(
        points=np.column_stack([x[there], y[there]]),
        cells=np.column_stack([corner[cell_there] for corner in corners]),
        top=top,
        direction=1 if direction > 0 else -1,
        breaks=tuple(breaks.tolist()),
    )


@dataclass(frozen=True, kw_only=True)
class _Sizes:
    """Smallest cells and growth along x and y, and the divisions of a plain block."""

    x: float
    y: float
    growth_x: float
    growth_y: float
    columns: FloatArray
    rows: FloatArray

    @classmethod
    def of(cls, grading: Grading, length: float, height: float) -> _Sizes:
        """Sizes that give the plain block the cells of its grading."""
        columns = graded_coordinates(length, grading.cells_x, grading.smallest_x)
        rows = graded_coordinates(height, grading.cells_y, grading.smallest_y)
        x, y = np.diff(columns), np.diff(rows)
        return cls(
            x=float(x[0]),
            y=float(y[0]),
            growth_x=float((x[-1] - x[0]) / length),
            growth_y=float((y[-1] - y[0]) / height),
            columns=length - columns[::-1],
            rows=rows,
        )


class _Grid:
    """Rows and columns of a shape."""

    def __init__(self, shape: TreadShape, sizes: _Sizes) -> None:
        self.shape, self.sizes = shape, sizes
        self.ends = [0.0]
        for slot in shape.slots:
            self.ends += [slot.at - 0.5 * slot.width, slot.at + 0.5 * slot.width]
        self.ends.append(shape.length)
        self.base = [self._base_height(slot) for slot in shape.slots]
        self.rows = self._rows()
        self.base_row = [int(np.argmin(np.abs(self.rows - y))) for y in self.base]
        self.walls = self._walls()

    def _base_height(self, slot: Slot) -> float:
        """Height at which the walls of a slot end and its base begins [mm]."""
        whole = slot.depth >= self.shape.height
        return self.shape.height if whole else slot.depth - slot.rise

    def _base_cell(self, slot: Slot) -> float:
        return min(slot.width / ACROSS, BASE_CELL * self.sizes.x)

    def _rows(self) -> FloatArray:
        """Heights of the rows, with one at each base [mm]."""
        height = self.shape.height
        fine = [Fine(at=0.0, size=self.sizes.y, growth=self.sizes.growth_y)]
        inner = []
        for slot, y in zip(self.shape.slots, self.base, strict=True):
            if y < height:
                inner.append(y)
                fine.append(Fine(at=y, size=self._base_cell(slot), growth=GROWTH))
        return divided([0.0, *sorted(set(inner)), height], fine) if inner else self.sizes.rows

    def _walls(self) -> list[FloatArray]:
        """x of the ends of all lamellae at each row, those of the rubber first and last [mm]."""
        walls = [np.zeros_like(self.rows)]
        for k, (slot, base) in enumerate(zip(self.shape.slots, self.base, strict=True)):
            above = np.maximum(self.rows - base, 0.0)
            reach = max(0.5 * (self.shape.height - base), 1e-9)
            # Over a flat base the columns bend up slowly; over an arc they have to spread at once.
            beyond = 0.0 if slot.rounded else -reach * np.expm1(-above / reach)
            lean = slot.slope * (np.minimum(self.rows, base) + beyond)
            thin = min(
                self.ends[2 * k + 1] - self.ends[2 * k], self.ends[2 * k + 3] - self.ends[2 * k + 2]
            )
            widest = min(slot.width, SPREAD * thin) * slot.rounded
            spread = widest * -np.expm1(-above / widest) if widest else 0.0
            walls += [
                slot.at + lean - 0.5 * slot.width - spread,
                slot.at + lean + 0.5 * slot.width + spread,
            ]
        walls.append(np.full_like(self.rows, self.shape.length))
        self._refuse_thin(walls)
        return walls

    def _refuse_thin(self, walls: list[FloatArray]) -> None:
        for k in range(0, len(walls), 2):
            width = (walls[k + 1] - walls[k]) * np.ones_like(self.rows)
            low = int(np.argmin(width))
            c = sum(self.shape.chamfers[k // 2])
            if width[low] < THINNEST * self.sizes.x + c:
                raise ValueError(
                    f"{width[low]:.3g} mm of rubber between {walls[k][low]:.4g} and "
                    f"{walls[k + 1][low]:.4g} mm from the trailing end, {self.rows[low]:.3g} mm "
                    f"above the road; expected at least {THINNEST * self.sizes.x + c:.3g} mm"
                )

    def nodes(self) -> tuple[FloatArray, FloatArray, BoolArray, BoolArray]:
        """x, y and presence of the nodes (columns, rows), and presence of the cells."""
        x, y, there, cells = [], [], [], []
        for k in range(len(self.walls) // 2):
            X, Y = self._lamella(k)
            x.append(X)
            y.append(Y)
            there.append(np.ones(X.shape, dtype=bool))
            cells.append(np.ones((len(X) - 1, len(self.rows) - 1), dtype=bool))
            if k == len(self.shape.slots):
                break
            X, Y = self._above_slot(k)
            row = np.arange(len(self.rows)) >= self.base_row[k]
            whole = self.base[k] >= self.shape.height
            x.append(X[1:-1])
            y.append(Y[1:-1])
            there.append(np.broadcast_to(row & (not whole), X[1:-1].shape))
            cells.append(np.broadcast_to(row[:-1], (len(X) - 1, len(self.rows) - 1)))
        return (np.concatenate(x), np.concatenate(y), np.concatenate(there), np.concatenate(cells))

    def _lamella(self, k: int) -> tuple[FloatArray, FloatArray]:
        """Columns of lamella k, from wall to wall, (columns, rows)."""
        start, stop = self.ends[2 * k], self.ends[2 * k + 1]
        trailing, leading = self.shape.chamfers[k]
        bottom = self._bottom(start, stop, trailing, leading, first=k == 0)
        share = ((bottom - start) / (stop - start))[:, None]
        left, right = self.walls[2 * k], self.walls[2 * k + 1]
        lift = np.maximum(np.maximum(start + trailing - bottom, bottom - stop + leading), 0.0)
        beside = [self.base[i] for i in (k - 1, k) if 0 <= i < len(self.base)]
        largest = max(trailing, leading)
        reach = min(CHAMFER_REACH * largest, self.shape.height, *beside) if largest else 1.0
        sinking = np.maximum(1.0 - self.rows / reach, 0.0)
        return left + share * (right - left), self.rows + lift[:, None] * sinking

    def _bottom(
        self, start: float, stop: float, trailing: float, leading: float, *, first: bool
    ) -> FloatArray:
        """Columns of a lamella at the road [mm]; those of the plain block if it is one."""
        columns, size, growth = self.sizes.columns, self.sizes.x, self.sizes.growth_x
        if not (trailing or leading) and np.isclose(stop - start, columns[-1], rtol=1e-12):
            return start + columns
        fine = [Fine(at=stop, size=size, growth=growth)]
        if leading:
            fine.append(Fine(at=stop - leading, size=size, growth=growth))
        if trailing:
            fine.append(Fine(at=start + trailing, size=TRAILING_CELL * size, growth=GROWTH))
        if trailing or not first:
            fine.append(Fine(at=start, size=TRAILING_CELL * size, growth=GROWTH))
        return divided(sorted({start, start + trailing, stop - leading, stop}), fine)

    def _above_slot(self, k: int) -> tuple[FloatArray, FloatArray]:
        """Columns from one wall of slot k to the other, (columns, rows)."""
        slot, base = self.shape.slots[k], self.base[k]
        cells = max(ACROSS, int(np.ceil(slot.width / self._base_cell(slot) - 1e-9)))
        t = (np.arange(cells + 1) / cells)[:, None]
        left, right = self.walls[2 * k + 1], self.walls[2 * k + 2]
        above = np.maximum(self.rows - base, 0.0)
        room = max(self.shape.height - base, 1e-9)
        arc = slot.rounded * np.exp(-above / slot.width) * np.maximum(1.0 - above / room, 0.0)
        across = arc * 0.5 * (1.0 - np.cos(np.pi * t)) + (1.0 - arc) * t
        rise = slot.rise * arc * np.sin(np.pi * t)
        return left + across * (right - left), self.rows + rise


def quality(mesh: BlockMesh) -> tuple[float, float]:
    """Smallest angle of the cells [degrees] and their largest ratio of longest to shortest edge."""
    corners = mesh.points[mesh.cells]
    edge = np.roll(corners, -1, axis=1) - corners
    length = np.linalg.norm(edge, axis=2)
    back = -np.roll(edge, 1, axis=1)
    cross = edge[..., 0] * back[..., 1] - edge[..., 1] * back[..., 0]
    angle = np.degrees(np.arctan2(cross, np.sum(edge * back, axis=2)))
    return float(angle.min()), float((length.max(axis=1) / length.min(axis=1)).max())


def shape_of_blocks(
    *,
    length: float,
    height: float,
    blocks: int,
    groove: float,
    base: float,
    chamfers: tuple[float, float],
    sipes: Sequence[Slot],
) -> TreadShape:
    """Outline of equal blocks in a row on one platen.

    Parameters
    ----------
    length, height : float
        Of one block; the height from the road to the platen [mm].
    blocks : int
        How many.
    groove, base : float
        Distance between them, and height of the rubber above the grooves [mm].
    chamfers : (float, float)
        At the trailing and the leading edge of each block [mm].
    sipes : sequence of Slot
        Of one block, places from its trailing corner.
    """
    slots, edges, breaks = [], [], []
    for number in range(blocks):
        start = number * (length + groove)
        own = sorted(sipes, key=lambda sipe: sipe.at)
        slots += [replace(sipe, at=sipe.at + start) for sipe in own]
        edges += [
            (chamfers[0] if i == 0 else 0.0, chamfers[1] if i == len(own) else 0.0)
            for i in range(len(own) + 1)
        ]
        if number + 1 < blocks:
            middle = start + length + 0.5 * groove
            breaks.append(middle)
            slots.append(Slot(at=middle, width=groove, depth=height - base))
    whole = blocks * length + (blocks - 1) * groove
    return TreadShape(
        length=whole, height=height, slots=tuple(slots), chamfers=tuple(edges), breaks=tuple(breaks)
    )
