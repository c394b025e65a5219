"""Heat in the block and in the road over one accepted mechanics step.

The mechanics hands over a `HeatLoad`; `HeatModel.advance` returns the new `HeatState` and changes
nothing else. A step is divided into sub-steps in which the block moves by a given distance at
most. Each sub-step is backward Euler on both sides: contact switches on and off within a sub-step
at the edges of the contact zone, and backward Euler is the scheme that does not undershoot there
for any time step (the matrices are M-matrices on rectangles). Being of first order costs little:
on a rigid block (300 mm/s, 0.3 N/mm^2, 40 mm) the default sub-step of 0.5 mm gives a T_max that
is 0.05 K below that of sub-steps eight times shorter, for a rise of 22 K.

The heat flow between block and road is implicit in both temperatures, and so is the convection of
a block at rest, whose steps are long. Radiation, and convection while it slides, use the
temperature at the start of the sub-step: their coefficients, about 6 and 100 W/(m^2 K), are far
below the thermal inertia of the top layers.

Balance to rounding: generated = in_block + in_road + radiated + convected + left.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise

import numpy as np

from fem.case import Case
from fem.heat.block import BlockConduction, Factorisation, relative_change
from fem.heat.exchange import ExchangeResult, Passage, passage, solve_exchange
from fem.heat.radiation import radiated_flux, radiating_length
from fem.heat.road import RoadConduction, RoadGrid, RoadState, RoadStep
from fem.heat.state import HeatLoad, HeatState, RoadField
from fem.mesh import BlockMesh
from materials.arrays import BoolArray, FloatArray, IntArray
from materials.thermal import ThermalProperties

#: Matrices of conduction that are kept at least and at most, and the nodes of all of them together.
FEWEST_KEPT, MOST_KEPT, KEPT_NODES = 3, 16, 200_000


@dataclass(frozen=True, kw_only=True)
class _Interval:
    """The constant data of the sub-steps of one load."""

    dt: float
    factor: Factorisation
    source: FloatArray
    radiating: FloatArray
    piece: FloatArray
    film: FloatArray | None
    implicit: bool


@dataclass(frozen=True, kw_only=True)
class _SubStep:
    """End of a sub-step: temperatures, flow to the road, heat lost, iterations of the exchange."""

    T: FloatArray
    road: RoadState
    flow: FloatArray
    radiated: float
    convected: float
    iterations: int


class HeatModel:
    """Heat conduction in block and road with frictional heat, gap conductance and radiation.

    Parameters
    ----------
    mesh : BlockMesh
        Reference mesh of the block.
    rubber, road : ThermalProperties
        Thermal properties in internal units.
    emissivity : float, optional
        Emissivity of the free surfaces of block and road [-].
    ambient_C : float, optional
        Ambient temperature, also the initial one [C].
    heat_step_mm : float, optional
        Largest displacement over the road in a sub-step [mm].
    road_grid : RoadGrid, optional
        Division of the road.
    reuse_tolerance : float, optional
        The conduction matrix of an earlier step is used again as long as the pull-back
        conductivity has changed by less than this fraction at every point [-]. Heat is conserved
        whatever the value.
    exchange_tolerance_K : float, optional
        Allowed mismatch of flow and temperature difference at the interface [K].
    """

    def __init__(
        self,
        mesh: BlockMesh,
        rubber: ThermalProperties,
        road: ThermalProperties,
        *,
        emissivity: float = 0.9,
        ambient_C: float = 20.0,
        heat_step_mm: float = 0.5,
        road_grid: RoadGrid | None = None,
        reuse_tolerance: float = 0.02,
        exchange_tolerance_K: float = 1e-5,
    ) -> None:
        if not heat_step_mm > 0.0:
            raise ValueError(f"heat_step_mm = {heat_step_mm}, expected above 0")
        if not 0.0 <= emissivity <= 1.0:
            raise ValueError(f"emissivity = {emissivity}, expected between 0 and 1")
        self.mesh = mesh
        self.block = BlockConduction(mesh, rubber)
        self.road = RoadConduction(road, road_grid or RoadGrid(), mesh.length)
        self.emissivity = emissivity
        self.ambient_C = ambient_C
        self.heat_step_mm = heat_step_mm
        self.reuse_tolerance = reuse_tolerance
        self.exchange_tolerance_K = exchange_tolerance_K
        # Only a cache: which matrix a step uses is decided by the state and the load alone.
        self._factors: OrderedDict[tuple[bytes, float, bytes], Factorisation] = OrderedDict()
        self._conductivities: OrderedDict[bytes, FloatArray] = OrderedDict()
        self._kept = min(max(KEPT_NODES // len(mesh.points), FEWEST_KEPT), MOST_KEPT)
        self.factorisations = 0

    @classmethod
    def from_case(cls, case: Case, mesh: BlockMesh) -> HeatModel:
        """Heat model of a case on its mesh."""
        return cls(
            mesh,
            case.rubber.thermal,
            case.road.thermal,
            emissivity=case.heat.emissivity,
            ambient_C=case.heat.ambient_C,
            heat_step_mm=case.solver.heat_step_mm * case.solver.steps_scale,
            road_grid=RoadGrid.for_duration(
                case.road.thermal, case.loading.duration_s, keeps_all=case.loading.road == "same"
            ),
        )

    def initial_state(self) -> HeatState:
        """Block and road at the ambient temperature."""
        n = len(self.mesh.points)
        zero = np.zeros((n, 2))
        return HeatState(
            T=np.full(n, self.ambient_C),
            road=self.road.initial_state(),
            displacement=zero,
            conduction_displacement=zero,
            flow=np.zeros(n),
        )

    def advance(self, state: HeatState, load: HeatLoad, position: float) -> HeatState:
        """Heat state at the end of a mechanics step.

        Parameters
        ----------
        state : HeatState
            State at the start of the step; it is not changed.
        load : HeatLoad
            The step.
        position : float
            Displacement of the platen over the road at the start of the step [mm].

        Returns
        -------
        HeatState
        """
        count = self.sub_steps(load)
        track = self._track(state, load, position, count)
        reference = self._conduction_displacement(state, load)
        interval = self._interval(load, reference, load.dt / count)
        road = self._window(state.road, load, position, track)
        left = self.road.heat_content(state.road.excess) - self.road.heat_content(road.excess)

        T, flow, iterations = state.T, state.flow[load.contact_nodes], 0
        radiated = convected = 0.0
        for start, end in pairwise(track):
            step = self._sub_step(T, road, flow, load, interval, start, end)
            T, road, flow = step.T, step.road, step.flow
            radiated += step.radiated
            convected += step.convected
            iterations += step.iterations

        flow_at_nodes = np.zeros(self.block.n)
        flow_at_nodes[load.contact_nodes] = flow
        heat = load.dt * (float(np.sum(load.power)) + float(np.sum(load.surface_power)))
        in_bulk = 0.0 if load.bulk_power is None else load.dt * float(np.sum(load.bulk_power))
        return HeatState(
            T=T,
            road=road,
            displacement=load.displacement,
            conduction_displacement=reference,
            flow=flow_at_nodes,
            generated=state.generated + heat + in_bulk,
            in_bulk=state.in_bulk + in_bulk,
            in_block=self.block.heat_content(T, self.ambient_C),
            in_road=self.road.heat_content(road.excess),
            radiated=state.radiated + radiated,
            convected=state.convected + convected,
            left=state.left + left,
            sub_steps=state.sub_steps + count,
            exchange_iterations=state.exchange_iterations + iterations,
        )

    def touched_down(self, state: HeatState, displacement: FloatArray, fresh: bool) -> HeatState:
        """State of a block that comes down again, on fresh road or where it was before.

        Parameters
        ----------
        state : HeatState
            State in the air.
        displacement : (n, 2) float array
            Displacement with which the block touches [mm].
        fresh : bool
            Whether the road is at its initial temperature; what the old one holds is left behind.
        """
        touched = replace(state, displacement=displacement, flow=np.zeros_like(state.flow))
        if not fresh:
            return touched
        left = state.left + self.road.heat_content(state.road.excess)
        return replace(touched, road=self.road.initial_state(), in_road=0.0, left=left)

    def sub_steps(self, load: HeatLoad) -> int:
        """Number of sub-steps of a load."""
        return max(load.parts, int(np.ceil(abs(load.sweep) / self.heat_step_mm - 1e-9)))

    def road_field(self, state: HeatState, position: float) -> RoadField:
        """Road window at a platen displacement [mm], for pictures and field files."""
        return RoadField(
            points=self.road.points(state.road, position),
            cells=self.road.cells(state.road),
            temperature=self.ambient_C + state.road.excess.ravel(),
        )

    def road_below(self, state: HeatState, nodes: IntArray, position: float) -> FloatArray:
        """Surface temperature of the road below nodes, at a platen displacement [mm], (m,) [C]."""
        x = self.mesh.points[nodes, 0] + state.displacement[nodes, 0] + position
        columns = self.road.dx * (state.road.first + np.arange(len(state.road.excess)))
        return self.ambient_C + np.interp(x, columns, state.road.surface, left=0.0, right=0.0)

    # ------------------------------------------------------------------ preparation of a step

    def _track(self, state: HeatState, load: HeatLoad, position: float, count: int) -> FloatArray:
        """Road coordinates of the contact nodes at the ends of the sub-steps, (count + 1, m)."""
        nodes = load.contact_nodes
        x = self.mesh.points[nodes, 0]
        start = x + state.displacement[nodes, 0] + position
        end = x + load.displacement[nodes, 0] + position + load.sweep
        part = np.arange(count + 1)[:, None] / count
        return np.asarray(start + part * (end - start))

    def _window(
        self, road: RoadState, load: HeatLoad, position: float, track: FloatArray
    ) -> RoadState:
        """Road window that holds everything the step touches."""
        margin = 0.5 * self.mesh.length
        reach = 4.0 * self.road.dx
        ends = position + np.array([0.0, load.sweep])
        low = min(ends.min() - margin, track.min(initial=np.inf) - reach)
        high = max(ends.max() + self.mesh.length + margin, track.max(initial=-np.inf) + reach)
        kept = self.road.drop_behind(road, position, load.sweep)
        return self.road.cover(kept, low, high)

    def _conduction_displacement(self, state: HeatState, load: HeatLoad) -> FloatArray:
        """Displacement whose conduction matrix serves the step: an earlier or the new one."""
        reference = state.conduction_displacement
        new = self.block.conductivity(load.displacement)
        change = relative_change(new, self._conductivity(reference))
        return reference if change <= self.reuse_tolerance else load.displacement

    def _conductivity(self, displacement: FloatArray) -> FloatArray:
        key = displacement.tobytes()
        if key not in self._conductivities:
            self._conductivities[key] = self.block.conductivity(displacement)
            if len(self._conductivities) > FEWEST_KEPT:
                self._conductivities.popitem(last=False)
        return self._conductivities[key]

    def _factor(
        self, displacement: FloatArray, dt: float, film: FloatArray | None = None
    ) -> Factorisation:
        # Increments that differ by rounding share a matrix, made of the rounded value: otherwise
        # the result would depend on which of them came first.
        dt = float(f"{dt:.12g}")
        key = (displacement.tobytes(), dt, b"" if film is None else film.tobytes())
        if key not in self._factors:
            self._factors[key] = self.block.factorise(displacement, dt, film)
            self.factorisations += 1
            if len(self._factors) > self._kept:
                self._factors.popitem(last=False)
        self._factors.move_to_end(key)
        return self._factors[key]

    def _interval(self, load: HeatLoad, reference: FloatArray, dt: float) -> _Interval:
        positions = self.mesh.points + load.displacement
        covered = np.zeros(self.block.n, dtype=bool)
        covered[load.contact_nodes] = True
        piece = self._pieces(positions, covered)[load.contact_nodes]
        covered[load.surface_nodes] = True
        source = np.zeros(self.block.n)
        np.add.at(source, load.contact_nodes, load.power)
        np.add.at(source, load.surface_nodes, load.surface_power)
        if load.bulk_power is not None:
            source += load.bulk_power
        radiating = radiating_length(positions, self.mesh.boundary_edges, covered)
        film = load.convection * radiating if load.convection else None
        # While the block slides what is free changes in each step, and with it the matrix would.
        implicit = film is not None and load.sweep == 0.0
        return _Interval(
            dt=dt,
            factor=self._factor(reference, dt, film if implicit else None),
            source=source,
            radiating=radiating,
            piece=piece,
            film=film,
            implicit=implicit,
        )

    def _pieces(self, positions: FloatArray, covered: BoolArray) -> FloatArray:
        """Ends of the contact surface of each node relative to it along x, (n, 2) [mm].

        Half of each boundary edge whose two nodes are in contact.
        """
        edges = self.mesh.boundary_edges
        half = 0.5 * (positions[edges[:, 1], 0] - positions[edges[:, 0], 0])
        half = np.where(covered[edges].all(axis=1), half, 0.0)
        reach = np.concatenate([half, -half])
        nodes = edges.T.ravel()
        piece = np.zeros((self.block.n, 2))
        np.minimum.at(piece[:, 0], nodes, reach)
        np.maximum.at(piece[:, 1], nodes, reach)
        return piece

    # ----------------------------------------------------------------------------- a sub-step

    def _sub_step(
        self,
        T: FloatArray,
        road: RoadState,
        flow: FloatArray,
        load: HeatLoad,
        interval: _Interval,
        start: FloatArray,
        end: FloatArray,
    ) -> _SubStep:
        dt, nodes = interval.dt, load.contact_nodes
        solve = partial(self.block.solve, interval.factor)
        radiation = interval.radiating * radiated_flux(T, self.ambient_C, self.emissivity)
        film = np.zeros(self.block.n) if interval.film is None else interval.film
        convection = np.zeros_like(film) if interval.implicit else film * (T - self.ambient_C)
        way = self._passage(road, interval.piece, start, end)
        road_loss = self._road_loss(road, way, interval.piece)
        road_step = self.road.begin_step(road.excess, dt)

        rates = interval.source - radiation - convection
        rates[nodes] -= flow
        excess = solve(self.block.capacity * (T - self.ambient_C) + dt * rates)
        change = road_step.surface_change(dt * (way.distributed(flow) - road_loss))
        difference = excess[nodes] - way.seen(road_step.cold_surface + change)
        result = self._exchange(flow, load, difference, solve, road_step, way, dt)
        new_road = RoadState(
            first=road.first,
            excess=road_step.finish(dt * (way.distributed(result.flow) - road_loss)),
        )
        T = self.ambient_C + excess + result.block_change
        if interval.implicit:
            convection = film * (T - self.ambient_C)
        return _SubStep(
            T=T,
            road=new_road,
            flow=result.flow,
            radiated=dt * float(radiation.sum() + road_loss.sum()),
            convected=dt * float(convection.sum()),
            iterations=result.iterations,
        )

    def _exchange(
        self,
        flow: FloatArray,
        load: HeatLoad,
        difference: FloatArray,
        solve: Callable[[FloatArray], FloatArray],
        road_step: RoadStep,
        way: Passage,
        dt: float,
    ) -> ExchangeResult:
        """Flow through the contact, from that before and the difference of temperature it gives."""
        nodes = load.contact_nodes

        def block_response(q: FloatArray) -> FloatArray:
            rhs = np.zeros(self.block.n)
            rhs[nodes] = dt * q
            return solve(rhs)

        def difference_response(q: FloatArray, drop: FloatArray) -> FloatArray:
            return drop[nodes] + way.seen(road_step.surface_change(dt * way.distributed(q)))

        return solve_exchange(
            flow,
            load.conductance,
            difference,
            block_response,
            difference_response,
            tolerance_K=self.exchange_tolerance_K,
        )

    def _passage(
        self, road: RoadState, piece: FloatArray, start: FloatArray, end: FloatArray
    ) -> Passage:
        return passage(start, end, piece, first=road.first, dx=self.road.dx, count=len(road.excess))

    def _road_loss(self, road: RoadState, way: Passage, piece: FloatArray) -> FloatArray:
        """Heat flow radiated by the part of the road that is not below a contact, (nc,) [mJ/s]."""
        widths = self.road.column_widths(len(road.excess))
        covered = way.distributed(piece[:, 1] - piece[:, 0])
        free = np.maximum(widths - covered, 0.0)
        T = self.ambient_C + road.surface
        return np.asarray(free * radiated_flux(T, self.ambient_C, self.emissivity))
