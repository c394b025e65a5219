"""One-dimensional conduction columns of a rigid block that slides over a road.

Every material column of the block conducts along its depth only, and so does every column of the
road. The block column at distance s behind the leading edge meets road that has been below the
block for the time s/v. In steady motion along x nothing else couples the columns, so the road
below station s at time t is what the columns ahead of it left there at t - dt.

Written for checking only: cell-centred finite volumes on graded cells, backward Euler, the
interface solved exactly per station (two scalar responses), stations in steps of v dt. It shares
no code with the heat model. The start-up is included: at t = 0 the road below the block is cold
everywhere.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_banded


def graded_cells(first: float, ratio: float, depth: float) -> np.ndarray:
    """Cell sizes that grow from the surface to a depth [mm]."""
    sizes = [first]
    while sum(sizes) < depth:
        sizes.append(sizes[-1] * ratio)
    return np.array(sizes)


class Column:
    """Backward Euler finite volumes of a column; the surface flux enters linearly.

    T(new) = step(T) + response * (heat flux into the surface) holds exactly.
    """

    def __init__(self, k: float, rho_c: float, cells: np.ndarray, dt: float) -> None:
        conductance = k / (0.5 * (cells[:-1] + cells[1:]))
        diagonal = rho_c * cells / dt
        self.inertia = diagonal.copy()
        diagonal[:-1] += conductance
        diagonal[1:] += conductance
        self.bands = np.zeros((3, len(cells)))
        self.bands[0, 1:] = -conductance
        self.bands[1] = diagonal
        self.bands[2, :-1] = -conductance
        unit = np.zeros(len(cells))
        unit[0] = 1.0
        self.response = solve_banded((1, 1), self.bands, unit)
        # from the centre of the first cell to its surface
        self.half_cell = 0.5 * cells[0] / k

    def step(self, T: np.ndarray) -> np.ndarray:
        """Temperatures (cells, stations) after dt without surface flux."""
        return solve_banded((1, 1), self.bands, self.inertia[:, None] * T)


@dataclass(frozen=True, kw_only=True)
class ColumnsResult:
    """Bottom surface temperature (stations,) at the distance s behind the leading edge."""

    s_mm: np.ndarray
    T_C: np.ndarray

    @property
    def T_max_C(self) -> float:
        return float(self.T_C.max())

    def excess_area(self, T_0_C: float, length: float) -> float:
        """Integral of T - T_0 over the bottom [K mm]; each station stands for its cell."""
        return float(np.mean(self.T_C - T_0_C) * length)


def sliding_columns(
    *,
    velocity: float,
    distance: float,
    length: float,
    pressure: float,
    friction: Callable[[np.ndarray], np.ndarray],
    kappa: float,
    conductance: float,
    block: tuple[float, float],
    road: tuple[float, float],
    T_0_C: float = 20.0,
    stations: int = 80,
    first_cell: float = 0.01,
    ratio: float = 1.12,
) -> ColumnsResult:
    """Slide block columns over road columns.

    Parameters
    ----------
    velocity, distance, length : float
        [mm/s], [mm], [mm]
    pressure : float
        Uniform [N/mm^2].
    friction : callable
        mu of the surface temperatures at the start of the step, (stations,) [C].
    kappa : float
        Share of the friction work that becomes heat of the block.
    conductance : float
        [N/(mm s K)]
    block, road : tuple of float
        Conductivity [N/(s K)] and heat capacity per volume [N/(mm^2 K)].
    stations : int
        Columns along the block; the time step is length / stations / velocity.
    """
    sliding = Contacts(
        velocity=velocity,
        distance=distance,
        length=length,
        pressure=pressure,
        friction=friction,
        kappa=kappa,
        conductance=conductance,
        block=block,
        road=road,
        T_0_C=T_0_C,
        stations=stations,
        first_cell=first_cell,
        ratio=ratio,
    )
    return sliding.contact()


class Contacts:
    """Block columns over road columns in one contact after another; see `sliding_columns`.

    `pause` is the longest time in air [s]. Several blocks stand `groove` mm apart on one track; the
    stations of the leading one come first.
    """

    def __init__(
        self,
        *,
        velocity,
        distance,
        length,
        pressure,
        friction,
        kappa,
        conductance,
        block,
        road,
        T_0_C=20.0,
        stations=80,
        first_cell=0.01,
        ratio=1.12,
        pause=0.0,
        count=1,
        blocks=1,
        groove=0.0,
    ):
        self.velocity, self.length, self.stations, self.T_0_C = velocity, length, stations, T_0_C
        self.load = kappa * pressure * velocity
        self.friction, self.conductance = friction, conductance
        self.dt = length / stations / velocity
        self.steps = round(distance / velocity / self.dt)
        self.sides = (block, road)
        duration = count * (self.steps * self.dt + pause)
        reach = 6.0 * np.sqrt(np.array([block[0] / block[1], road[0] / road[1]]) * duration)
        self.cells = [graded_cells(first_cell, ratio, depth) for depth in reach]
        self.columns = self._columns(self.dt)
        # The road columns of the whole track, the first ones below the rear of the block at first.
        behind = round((length + groove) / length * stations) * np.arange(blocks)
        self.behind = (behind[:, None] + np.arange(stations)).ravel()
        self.T_b = np.zeros((len(self.cells[0]), self.behind.size))
        self.T_r = np.zeros((len(self.cells[1]), self.behind[-1] + 1 + self.steps))

    def _columns(self, dt):
        return [
            Column(*side, cells, dt) for side, cells in zip(self.sides, self.cells, strict=True)
        ]

    def contact(self):
        """Slide once over the track from its start on."""
        rubber, asphalt = self.columns
        surface = self.T_b[0].copy()
        for step in range(self.steps):
            # The block moves one station on; station 0 is the leading one.
            below = self.behind[-1] + 1 + step - self.behind
            heat = self.load * self.friction(self.T_0_C + surface)
            self.T_b, self.T_r = rubber.step(self.T_b), asphalt.step(self.T_r)
            block_rise = rubber.response[0] + rubber.half_cell
            road_rise = asphalt.response[0] + asphalt.half_cell
            # surface block = T_b + block_rise (heat - q), surface road = T_r + road_rise q
            gap = self.T_b[0] + block_rise * heat - self.T_r[0, below]
            q = gap / (1.0 / self.conductance + block_rise + road_rise)
            surface = self.T_b[0] + block_rise * (heat - q)
            self.T_b += rubber.response[:, None] * (heat - q)
            self.T_r[:, below] += asphalt.response[:, None] * q
        s = (self.behind + 0.5) * self.length / self.stations
        return ColumnsResult(s_mm=s, T_C=self.T_0_C + surface)

    def in_air(self, duration, *, fresh, steps=400):
        """Let block and road conduct on their own, insulated; a fresh road is cold after it."""
        times = duration * np.linspace(0.0, 1.0, steps + 1) ** 2
        for dt in np.diff(times):
            rubber, asphalt = self._columns(dt)
            self.T_b, self.T_r = rubber.step(self.T_b), asphalt.step(self.T_r)
        if fresh:
            self.T_r[:] = 0.0
