"""What goes into the heat of a step, and what comes out of it."""

from dataclasses import dataclass, field

import numpy as np

from fem.heat.road import RoadState
from materials.arrays import FloatArray, IntArray


def _no_nodes() -> IntArray:
    return np.empty(0, dtype=np.int64)


def _no_values() -> FloatArray:
    return np.empty(0)


@dataclass(frozen=True, kw_only=True)
class HeatLoad:
    """What one accepted mechanics step means for the heat.

    Attributes
    ----------
    dt : float
        Duration of the step [s].
    sweep : float
        Displacement of the platen over the road during the step, signed [mm].
    displacement : (n, 2) float array
        Nodal displacement at the end of the step in the platen's frame [mm].
    contact_nodes : (m,) int array
        Nodes in contact with the road.
    power : (m,) float array
        Frictional heat of each contact node per mm depth, kappa mu lambda |w| [mJ/s].
    conductance : (m,) float array
        Gap conductance times tributary length of each contact node [N/(s K)].
    surface_nodes, surface_power : (k,) int array, (k,) float array
        Further heat sources on surfaces that something covers, so that they do not radiate
        (friction of the block on itself) [mJ/s].
    bulk_power : (n,) float array or None
        Heat made inside the block, by node [mJ/s].
    convection : float
        Film coefficient of the block's free surfaces [N/(mm s K)].
    parts : int
        Sub-steps it has at least.
    """

    dt: float
    sweep: float
    displacement: FloatArray
    contact_nodes: IntArray
    power: FloatArray
    conductance: FloatArray
    surface_nodes: IntArray = field(default_factory=_no_nodes)
    surface_power: FloatArray = field(default_factory=_no_values)
    bulk_power: FloatArray | None = None
    convection: float = 0.0
    parts: int = 1

    def __post_init__(self) -> None:
        if not self.dt > 0.0:
            raise ValueError(f"heat step of dt = {self.dt} s, expected above 0")
        m = len(self.contact_nodes)
        if len(self.power) != m or len(self.conductance) != m:
            raise ValueError(
                f"{m} contact nodes with {len(self.power)} powers and "
                f"{len(self.conductance)} conductances, expected as many"
            )
        if len(self.surface_nodes) != len(self.surface_power):
            raise ValueError(
                f"{len(self.surface_nodes)} surface nodes with {len(self.surface_power)} powers, "
                "expected as many"
            )


@dataclass(frozen=True, kw_only=True)
class HeatState:
    """Temperatures of block and road, and the heat balance since the start.

    Attributes
    ----------
    T : (n,) float array
        Temperature of the block's nodes [C].
    road : RoadState
        Temperature of the road's window.
    displacement : (n, 2) float array
        Nodal displacement at the end of the last step [mm].
    conduction_displacement : (n, 2) float array
        Displacement for which the conduction matrix in use was made [mm].
    flow : (n,) float array
        Heat flow from the block's nodes to the road in the last sub-step [mJ/s] per mm depth.
    generated, in_bulk, radiated, convected, left : float
        Heat made, the part of it made inside the block, heat lost by radiation of block and
        road, by convection from the block, and heat in the road that was left behind [mJ/mm].
    in_block, in_road : float
        Heat stored above the initial temperature [mJ/mm].
    sub_steps, exchange_iterations : int
        Totals since the start.
    """

    T: FloatArray
    road: RoadState
    displacement: FloatArray
    conduction_displacement: FloatArray
    flow: FloatArray
    generated: float = 0.0
    in_bulk: float = 0.0
    in_block: float = 0.0
    in_road: float = 0.0
    radiated: float = 0.0
    convected: float = 0.0
    left: float = 0.0
    sub_steps: int = 0
    exchange_iterations: int = 0


@dataclass(frozen=True, kw_only=True)
class RoadField:
    """Road temperatures for output.

    Attributes
    ----------
    points : (nr, 2) float array
        Nodes in the platen's frame [mm].
    cells : (ner, 4) int array
        Counter-clockwise corner nodes.
    temperature : (nr,) float array
        Temperature of the nodes [C].
    """

    points: FloatArray
    cells: IntArray
    temperature: FloatArray
