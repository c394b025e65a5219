"""Heat conduction in the road, on a window of material columns under the block.

The road is at rest in its own frame: the heat of the contact goes to the columns that lie under
the block, and nothing is convected through the grid, so nothing is smeared along x whatever the
Peclet number. The window follows the block: cold columns are added, and columns far behind are
dropped and their heat is booked, so that the cost does not grow with the sliding distance.

The grid is a product of uniform columns (width dx) and graded layers. With bilinear
quadrilaterals and nodal quadrature the matrices are Kronecker products,
M + dt K = M_x M_y + dt alpha (K_x M_y + M_x K_y), and the generalised eigenvectors of (K_x, M_x)
are the cosines of the DCT-I. A time step is solved exactly by fast diagonalisation [1]_ for any
dt and any number of columns: two cosine transforms and two small matrix products.

References
----------
.. [1] R. E. Lynch, J. R. Rice, D. H. Thomas: Direct solution of partial difference equations by
   tensor product methods, Numerische Mathematik 6 (1964) 185-199.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.fft import dct, idct
from scipy.linalg import eigh

from materials.arrays import FloatArray, IntArray
from materials.thermal import ThermalProperties

#: Columns are added and dropped in groups of this size.
COLUMN_GROUP = 8


@dataclass(frozen=True, kw_only=True)
class RoadGrid:
    """Division of the road.

    Attributes
    ----------
    column : float
        Width of a column [mm]; rounded so that the block is a whole number of columns long.
    surface_layer : float
        Thickness of the top layer [mm].
    growth : float
        Ratio of the thicknesses of neighbouring layers [-].
    depth : float
        Depth of the road model [mm]. The default is more than four diffusion lengths
        sqrt(alpha t) of asphalt for 17 s (120 mm at 7 mm/s).
    behind : float
        Length of road kept behind the block, in block lengths [-].
    """

    column: float = 0.2
    surface_layer: float = 0.01
    growth: float = 1.25
    depth: float = 12.0
    behind: float = 1.0

    def __post_init__(self) -> None:
        for name in ("column", "surface_layer", "depth"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"road grid: {name} = {getattr(self, name)}, expected above 0")
        if self.growth < 1.0:
            raise ValueError(f"road grid: growth = {self.growth}, expected at least 1")
        if self.behind < 0.0:
            raise ValueError(f"road grid: behind = {self.behind}, expected at least 0")

    @classmethod
    def for_duration(
        cls, road: ThermalProperties, duration: float, *, keeps_all: bool = False
    ) -> RoadGrid:
        """Default grid, at least five diffusion lengths sqrt(alpha t) of the event [s] deep.

        One that `keeps_all` drops nothing behind the block, which comes back to it.
        """
        depth = 5.0 * float(np.sqrt(road.diffusivity * duration))
        return cls(depth=max(depth, 5.0), behind=np.inf if keeps_all else cls.behind)

    def layers(self) -> FloatArray:
        """Depth of the node rows below the surface, (nd,) [mm], from 0 to `depth`."""
        sizes = [self.surface_layer]
        while sum(sizes) < self.depth:
            sizes.append(sizes[-1] * self.growth)
        depths = np.concatenate([[0.0], np.cumsum(sizes)])
        return np.asarray(depths * (self.depth / depths[-1]))


@dataclass(frozen=True, kw_only=True)
class RoadState:
    """Temperature of the road columns inside the window.

    Attributes
    ----------
    first : int
        Number of the first column; column j stands at x = j dx in the road's frame.
    excess : (nc, nd) float array
        Temperature above the initial one at the nodes of column i, layer l [K].
    """

    first: int
    excess: FloatArray

    @property
    def surface(self) -> FloatArray:
        """Excess temperature of the surface nodes, (nc,) [K]."""
        return self.excess[:, 0]


@dataclass(frozen=True, kw_only=True)
class RoadStep:
    """A time step of the road whose surface heat is still to be found.

    Attributes
    ----------
    modes : (nc, nd) float array
        Modes of the temperature at the end of the step without surface heat [K].
    damping : (nc, nd) float array
        1 / (1 + dt alpha (lambda_x + lambda_y)) for each mode [-].
    vectors : (nd, nd) float array
        Eigenvectors V of the depth problem [mm^-1/2].
    surface_volume : (nc,) float array
        rho c times the width of each surface node [N/(mm K)].
    """

    modes: FloatArray
    damping: FloatArray
    vectors: FloatArray
    surface_volume: FloatArray

    @cached_property
    def cold_surface(self) -> FloatArray:
        """Surface temperature at the end of the step without surface heat, (nc,) [K]."""
        return np.asarray(idct(self.modes @ self.vectors[0], type=1))

    @cached_property
    def _response(self) -> FloatArray:
        return np.asarray(self.damping @ self.vectors[0] ** 2)

    def surface_change(self, heat: FloatArray) -> FloatArray:
        """Change of the surface temperature by heat (nc,) [mJ/mm] during the step, (nc,) [K]."""
        source = dct(heat / self.surface_volume, type=1)
        return np.asarray(idct(self._response * source, type=1))

    def finish(self, heat: FloatArray) -> FloatArray:
        """Temperature at the end of the step with the heat (nc,) [mJ/mm], (nc, nd) [K]."""
        source = dct(heat / self.surface_volume, type=1)
        modes = self.modes + self.damping * (source[:, None] * self.vectors[0])
        return np.asarray(idct(modes, type=1, axis=0) @ self.vectors.T)


class RoadConduction:
    """Conduction in the road columns.

    Parameters
    ----------
    road : ThermalProperties
        Conductivity, density and specific heat in internal units.
    grid : RoadGrid
        Division of the road.
    block_length : float
        Length of the block [mm].
    """

    def __init__(self, road: ThermalProperties, grid: RoadGrid, block_length: float) -> None:
        self.road = road
        self.grid = grid
        self.block_length = block_length
        self.dx = block_length / np.ceil(block_length / grid.column - 1e-9)
        self.depths = grid.layers()
        self.heat_per_volume = road.heat_capacity
        self._diagonalise_depth()

    def _diagonalise_depth(self) -> None:
        """Eigenvectors V of (K_y, M_y) with V^T M_y V = 1, and the eigenvalues [1/mm^2]."""
        thickness = np.diff(self.depths)
        self.layer_weight = 0.5 * np.concatenate([thickness, [0.0]])
        self.layer_weight[1:] += 0.5 * thickness
        K = np.diag(np.concatenate([1.0 / thickness, [0.0]]))
        K[1:, 1:] += np.diag(1.0 / thickness)
        K -= np.diag(1.0 / thickness, 1) + np.diag(1.0 / thickness, -1)
        self._lambda_y, self._V = eigh(K, np.diag(self.layer_weight))
        self._to_modes = self.layer_weight[:, None] * self._V

    def _damping(self, columns: int, dt: float) -> FloatArray:
        """1 / (1 + dt alpha (lambda_x + lambda_y)) for each mode, (nc, nd) [-]."""
        angle = np.pi * np.arange(columns) / (columns - 1)
        lambda_x = (2.0 - 2.0 * np.cos(angle)) / self.dx**2
        rate = self.road.diffusivity * (lambda_x[:, None] + self._lambda_y)
        return np.asarray(1.0 / (1.0 + dt * rate))

    def column_widths(self, columns: int) -> FloatArray:
        """Width of road each node of the surface stands for, (nc,) [mm]."""
        widths = np.full(columns, self.dx)
        widths[[0, -1]] *= 0.5
        return widths

    def begin_step(self, excess: FloatArray, dt: float) -> RoadStep:
        """Backward Euler step of dt [s] from the temperatures (nc, nd) [K], open for the heat."""
        damping = self._damping(len(excess), dt)
        modes = dct(excess @ self._to_modes, type=1, axis=0) * damping
        volume = self.heat_per_volume * self.column_widths(len(excess))
        return RoadStep(modes=modes, damping=damping, vectors=self._V, surface_volume=volume)

    def step(self, excess: FloatArray, surface_heat: FloatArray, dt: float) -> FloatArray:
        """One backward Euler step with a given heat input, (nc, nd) [K].

        Parameters
        ----------
        excess : (nc, nd) float array
            Temperatures at the start of the step [K].
        surface_heat : (nc,) float array
            Heat into each surface node during the step per mm depth [mJ/mm].
        dt : float
            Time increment [s].
        """
        return self.begin_step(excess, dt).finish(surface_heat)

    def heat_content(self, excess: FloatArray) -> float:
        """Heat stored above the initial temperature per mm depth [mJ/mm]."""
        widths = self.column_widths(len(excess))
        return float(self.heat_per_volume * (widths @ excess @ self.layer_weight))

    def initial_state(self) -> RoadState:
        """A cold window below the block at rest."""
        margin = int(np.ceil(0.5 * self.block_length / self.dx))
        columns = round(self.block_length / self.dx) + 2 * margin + 1
        return RoadState(first=-margin, excess=np.zeros((columns, len(self.depths))))

    def cover(self, state: RoadState, low: float, high: float) -> RoadState:
        """Window extended by cold columns until it holds low <= x <= high [mm].

        The border columns of a window count half; they are cold up to rounding, because the
        window reaches half a block length beyond the contact.
        """
        before = max(0, state.first - int(np.floor(low / self.dx + 1e-9)) + 1)
        last = state.first + len(state.excess) - 1
        behind = max(0, int(np.ceil(high / self.dx - 1e-9)) + 1 - last)
        if before == 0 and behind == 0:
            return state
        rows = [-(-count // COLUMN_GROUP) * COLUMN_GROUP for count in (before, behind)]
        layers = state.excess.shape[1]
        parts = [np.zeros((rows[0], layers)), state.excess, np.zeros((rows[1], layers))]
        return RoadState(first=state.first - rows[0], excess=np.concatenate(parts))

    def drop_behind(self, state: RoadState, position: float, sweep: float) -> RoadState:
        """Window without the columns further behind the block than the grid keeps.

        Parameters
        ----------
        state : RoadState
        position : float
            Platen displacement over the road [mm].
        sweep : float
            Signed displacement of the coming step; its sign says where "behind" is.
        """
        margin = self.block_length * (0.5 + self.grid.behind)
        last = state.first + len(state.excess) - 1
        if np.isinf(margin):
            return state
        if sweep > 0.0:
            spare = int(np.floor((position - margin) / self.dx + 1e-9)) - state.first
        else:
            spare = last - int(np.ceil((position + self.block_length + margin) / self.dx - 1e-9))
        count = COLUMN_GROUP * (spare // COLUMN_GROUP)
        if sweep == 0.0 or count <= 0:
            return state
        if sweep > 0.0:
            return RoadState(first=state.first + count, excess=state.excess[count:])
        return RoadState(first=state.first, excess=state.excess[:-count])

    def points(self, state: RoadState, position: float) -> FloatArray:
        """Nodes of the window in the platen's frame, (nc nd, 2) [mm]; column by column."""
        x = (state.first + np.arange(len(state.excess))) * self.dx - position
        grid = np.meshgrid(x, -self.depths, indexing="ij")
        return np.column_stack([axis.ravel() for axis in grid])

    def cells(self, state: RoadState) -> IntArray:
        """Counter-clockwise corner nodes of each road cell, (ner, 4)."""
        columns, layers = state.excess.shape
        number = np.arange(columns * layers).reshape(columns, layers)
        corners = [number[:-1, 1:], number[1:, 1:], number[1:, :-1], number[:-1, :-1]]
        return np.column_stack([corner.ravel() for corner in corners])
