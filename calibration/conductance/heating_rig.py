"""Heat model of the static conductance test: heater, copper, rubber, asphalt (Fig. 6).

A heater warms a copper block on the top of a rubber block that is pressed on a wider asphalt
block; thermocouples record the temperatures while the rig heats up and cools down. Half of the
plane cross-section is meshed with bilinear quadrilaterals (the centre line is a symmetry plane).
Copper and rubber share their nodes; rubber and asphalt are joined by the gap conductance h.

With losses proportional to the temperature above ambient the model is linear,
M dT/dt + (K + h K_gap) T = b u(t), with u the heater's power or its temperature. It is integrated
by the L-stable diagonally implicit Runge-Kutta method of order two with gamma = 1 - 1/sqrt(2)
[1]_: both stages use one matrix, and a switched heater does not make it ring.

The dimensions in the figure of the paper are not available; the defaults are those of the sliding
block of this project on an asphalt block of stated, plausible size. Give the real ones.

References
----------
.. [1] R. Alexander: Diagonally implicit Runge-Kutta methods for stiff O.D.E.'s, SIAM Journal on
   Numerical Analysis 14 (1977) 1006-1021.
"""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix, diags
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementQuad1, MeshQuad

from materials.arrays import BoolArray, FloatArray, IntArray
from materials.thermal import ASPHALT, RUBBER, ThermalProperties
from materials.units import W_PER_M2_K, WATT

Heater = Literal["power", "temperature"]

#: Pure copper at room temperature: 398 W/(m K), 8930 kg/m^3, 0.385 kJ/(kg K) (CRC Handbook).
COPPER = ThermalProperties.from_paper_units(398.0, 8930.0, 0.385)

#: Coefficient of Alexander's method.
GAMMA = 1.0 - np.sqrt(0.5)


@dataclass(frozen=True, kw_only=True)
class Thermocouple:
    """Position of a thermocouple.

    Attributes
    ----------
    x_mm : float
        Distance from the centre line.
    y_mm : float
        Height above the contact (positive: in the rubber) or below it (negative: in the asphalt).
    """

    x_mm: float
    y_mm: float


def default_thermocouples() -> dict[str, Thermocouple]:
    """C1-C3 in the rubber, D1, D2 below its centre, E1, E2 15 mm beside it.

    The paper gives the 15 mm; the heights are assumed.
    """
    return {
        "C1": Thermocouple(x_mm=0.0, y_mm=7.0),
        "C2": Thermocouple(x_mm=0.0, y_mm=4.0),
        "C3": Thermocouple(x_mm=0.0, y_mm=1.0),
        "D1": Thermocouple(x_mm=0.0, y_mm=-2.0),
        "D2": Thermocouple(x_mm=0.0, y_mm=-10.0),
        "E1": Thermocouple(x_mm=15.0, y_mm=-2.0),
        "E2": Thermocouple(x_mm=15.0, y_mm=-10.0),
    }


@dataclass(frozen=True, kw_only=True)
class HeatingRig:
    """Dimensions, materials and losses of the test rig; every default is a stated assumption.

    Attributes
    ----------
    block_length_mm, block_height_mm, copper_height_mm : float
        Rubber block and the copper block of the same length on it.
    asphalt_length_mm, asphalt_height_mm : float
        Asphalt block; at least as long as the rubber.
    depth_mm : float
        Extent of the rig normal to the cross-section; turns the heater's watts into a plane model.
    pressure_N_per_mm2 : float
        Nominal contact pressure (0.3 in the paper).
    ambient_C : float or None
        Temperature of the surroundings; None takes the mean of the first row of a record.
    loss_W_per_m2K : float
        Convection and linearised radiation on all free surfaces.
    base_W_per_m2K : float
        From the bottom of the asphalt to the table it stands on, which is at ambient temperature.
    rubber, copper, asphalt : ThermalProperties
    thermocouples : dict of Thermocouple
    cells_mm : float
        Size of the cells next to the contact.
    """

    block_length_mm: float = 20.0
    block_height_mm: float = 8.0
    copper_height_mm: float = 20.0
    asphalt_length_mm: float = 150.0
    asphalt_height_mm: float = 50.0
    depth_mm: float = 60.0
    pressure_N_per_mm2: float = 0.3
    ambient_C: float | None = None
    loss_W_per_m2K: float = 10.0
    base_W_per_m2K: float = 100.0
    rubber: ThermalProperties = RUBBER
    copper: ThermalProperties = COPPER
    asphalt: ThermalProperties = ASPHALT
    thermocouples: dict[str, Thermocouple] = field(default_factory=default_thermocouples)
    cells_mm: float = 0.5

    def __post_init__(self) -> None:
        for name in (
            "block_length_mm",
            "block_height_mm",
            "copper_height_mm",
            "asphalt_length_mm",
            "asphalt_height_mm",
            "depth_mm",
            "pressure_N_per_mm2",
            "cells_mm",
        ):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0.0):
                raise ValueError(f"rig: {name} = {value}, expected a number above 0")
        for name in ("loss_W_per_m2K", "base_W_per_m2K"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0.0):
                raise ValueError(f"rig: {name} = {value}, expected a number of at least 0")
        if self.asphalt_length_mm < self.block_length_mm:
            raise ValueError(
                f"rig: asphalt_length_mm = {self.asphalt_length_mm}, expected at least the "
                f"length of the block, {self.block_length_mm}"
            )
        for name, place in self.thermocouples.items():
            self._check_place(name, place)

    def _check_place(self, name: str, place: Thermocouple) -> None:
        in_rubber = place.y_mm >= 0.0
        length = self.block_length_mm if in_rubber else self.asphalt_length_mm
        low, high = (0.0, self.block_height_mm) if in_rubber else (-self.asphalt_height_mm, 0.0)
        if not (abs(place.x_mm) <= 0.5 * length and low <= place.y_mm <= high):
            body = "rubber" if in_rubber else "asphalt"
            raise ValueError(
                f"rig: thermocouple {name} at x = {place.x_mm}, y = {place.y_mm} mm, expected a "
                f"place in the {body}: |x| <= {0.5 * length}, {low} <= y <= {high}"
            )


@BilinearForm
def conduction(T, w, parameters):  # type: ignore[no-untyped-def]
    """Conduction k grad T . grad w with k per cell."""
    gradients = T.grad[0] * w.grad[0] + T.grad[1] * w.grad[1]
    return parameters["k"] * gradients


def graded(start: float, end: float, smallest: float, *, ratio: float = 1.25) -> FloatArray:
    """Coordinates from start to end whose cells grow away from the start, at most to 1/8 [mm]."""
    length = abs(end - start)
    largest = max(length / 8.0, smallest)
    sizes = [min(smallest, length)]
    while sum(sizes) < length * (1.0 - 1e-12):
        sizes.append(min(sizes[-1] * ratio, largest))
    distances = np.concatenate([[0.0], np.cumsum(sizes)])
    return np.asarray(start + (end - start) * distances / distances[-1])


class RigModel:
    """Semi-discrete heat model of the rig, linear in the gap conductance.

    Temperatures inside are above ambient. The nodes of the block come first, then the asphalt's.

    Parameters
    ----------
    rig : HeatingRig
    heater : {"power", "temperature"}
        What drives the rig: the power into the top of the copper [W], or its top temperature.
    """

    def __init__(self, rig: HeatingRig, heater: Heater) -> None:
        self.rig = rig
        self.heater = heater
        self._mesh_bodies()
        self._assemble()
        self._sensors = {
            name: self._interpolation(place) for name, place in rig.thermocouples.items()
        }

    # ------------------------------------------------------------------------------- the mesh

    def _mesh_bodies(self) -> None:
        rig = self.rig
        half = 0.5 * rig.block_length_mm
        x_block = half - graded(0.0, half, 2.0 * rig.cells_mm)[::-1]
        x_beyond = np.empty(0)
        if rig.asphalt_length_mm > rig.block_length_mm:
            x_beyond = graded(half, 0.5 * rig.asphalt_length_mm, 2.0 * rig.cells_mm)[1:]
        y_rubber = graded(0.0, rig.block_height_mm, rig.cells_mm)
        y_copper = rig.block_height_mm + np.linspace(0.0, rig.copper_height_mm, 5)[1:]
        y_asphalt = graded(0.0, -rig.asphalt_height_mm, rig.cells_mm)[::-1]
        self._lines = {
            "block": (x_block, np.append(y_rubber, y_copper)),
            "asphalt": (np.append(x_block, x_beyond), y_asphalt),
        }
        self.block = MeshQuad.init_tensor(*self._lines["block"])
        self.asphalt = MeshQuad.init_tensor(*self._lines["asphalt"])
        self._offset = {"block": 0, "asphalt": self.block.nvertices}
        self.n = self.block.nvertices + self.asphalt.nvertices

    def _nodes(self, body: str, axis: int, value: float) -> IntArray:
        """Nodes of a body on a line x = value or y = value, ordered along it."""
        p = (self.block if body == "block" else self.asphalt).p
        found = np.flatnonzero(np.isclose(p[axis], value, atol=1e-9))
        return np.asarray(self._offset[body] + found[np.argsort(p[1 - axis][found])])

    def _coordinate(self, nodes: IntArray, axis: int) -> FloatArray:
        return np.asarray(np.concatenate([self.block.p[axis], self.asphalt.p[axis]])[nodes])

    def _lengths(self, nodes: IntArray, axis: int) -> FloatArray:
        """Length of boundary each of the ordered nodes stands for [mm]."""
        halves = 0.5 * np.diff(self._coordinate(nodes, axis))
        return np.asarray(np.append(halves, 0.0) + np.append(0.0, halves))

    # --------------------------------------------------------------------------- the matrices

    def _assemble(self) -> None:
        rig = self.rig
        y_cells = self.block.p[1][self.block.t].mean(axis=0)
        in_copper = y_cells > rig.block_height_mm
        K_block, C_block = _body_matrices(self.block, rig.rubber, rig.copper, in_copper)
        none = np.zeros(self.asphalt.nelements, dtype=bool)
        K_asphalt, C_asphalt = _body_matrices(self.asphalt, rig.asphalt, rig.asphalt, none)
        self.capacity = np.concatenate([C_block, C_asphalt])
        rows = np.concatenate([K_block.row, K_asphalt.row + self._offset["asphalt"]])
        columns = np.concatenate([K_block.col, K_asphalt.col + self._offset["asphalt"]])
        data = np.concatenate([K_block.data, K_asphalt.data])
        self.conduction = coo_matrix((data, (rows, columns)), shape=(self.n, self.n)).tocsc()
        self.gap = self._gap_matrix()
        self._find_surfaces()

    def _gap_matrix(self) -> csc_matrix:
        """Matrix of the gap for a unit conductance, so that K = K_0 + h K_gap."""
        upper = self._nodes("block", 1, 0.0)
        lower = self._nodes("asphalt", 1, 0.0)[: len(upper)]
        length = self._lengths(upper, 0)
        rows = np.concatenate([upper, lower, upper, lower])
        columns = np.concatenate([upper, lower, lower, upper])
        data = np.concatenate([length, length, -length, -length])
        return coo_matrix((data, (rows, columns)), shape=(self.n, self.n)).tocsc()

    def _find_surfaces(self) -> None:
        rig = self.rig
        half, wide = 0.5 * rig.block_length_mm, 0.5 * rig.asphalt_length_mm
        top = rig.block_height_mm + rig.copper_height_mm
        free = np.zeros(self.n)
        side = self._nodes("block", 0, half)
        free[side] += self._lengths(side, 1)
        side = self._nodes("asphalt", 0, wide)
        free[side] += self._lengths(side, 1)
        road = self._nodes("asphalt", 1, 0.0)
        beyond = road[len(self._nodes("block", 1, 0.0)) - 1 :]
        if len(beyond) > 1:
            free[beyond] += self._lengths(beyond, 0)
        base = np.zeros(self.n)
        bottom = self._nodes("asphalt", 1, -rig.asphalt_height_mm)
        base[bottom] = self._lengths(bottom, 0)
        self.free_length, self.base_length = free, base
        self.top = self._nodes("block", 1, top)
        self.top_length = self._lengths(self.top, 0)

    def matrix(self, h: float, loss: float, base: float) -> csc_matrix:
        """Conduction, gap and losses, n x n [N/(s K)] per mm depth; coefficients in W/(m^2 K)."""
        surface = loss * self.free_length + base * self.base_length
        return (self.conduction + W_PER_M2_K * (h * self.gap + diags(surface))).tocsc()

    # ------------------------------------------------------------------------------- the sensors

    def _interpolation(self, place: Thermocouple) -> tuple[IntArray, FloatArray]:
        """Nodes and weights of the bilinear interpolation at a thermocouple."""
        body = "block" if place.y_mm >= 0.0 else "asphalt"
        mesh = self.block if body == "block" else self.asphalt
        x_lines, y_lines = self._lines[body]
        i, s = _interval(x_lines, abs(place.x_mm))
        j, t = _interval(y_lines, place.y_mm)
        corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
        nodes = [
            np.flatnonzero(
                np.isclose(mesh.p[0], x_lines[a], atol=1e-9)
                & np.isclose(mesh.p[1], y_lines[b], atol=1e-9)
            )[0]
            for a, b in corners
        ]
        weights = np.array([(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t])
        return np.asarray(nodes, dtype=np.int64) + self._offset[body], weights

    def read(self, T: FloatArray, names: tuple[str, ...]) -> FloatArray:
        """Readings (..., sensors) of nodal temperatures (..., n)."""
        sensors = [self._sensors[name] for name in names]
        return np.stack([T[..., nodes] @ weights for nodes, weights in sensors], axis=-1)

    # ------------------------------------------------------------------------------- solutions

    def steady(self, drive: float, h: float, loss: float, base: float) -> FloatArray:
        """Stationary temperature above ambient for a constant heater, (n,) [K].

        Parameters
        ----------
        drive : float
            Power [W] or heater temperature above ambient [K].
        h, loss, base : float
            Gap conductance and loss coefficients [W/(m^2 K)].
        """
        K = self.matrix(h, loss, base)
        free, source = self._free_part(K)
        T = np.zeros(self.n)
        T[free] = splu(K[free][:, free].tocsc()).solve(source * drive)
        if self.heater == "temperature":
            T[self.top] = drive
        return T

    def record(
        self,
        drive: FloatArray,
        dt: float,
        names: tuple[str, ...],
        *,
        h: float,
        loss: float,
        base: float,
    ) -> FloatArray:
        """Readings above ambient at equidistant times, from a start at ambient temperature.

        Parameters
        ----------
        drive : (steps + 1,) float array
            Power [W] or heater temperature above ambient [K] at the times; linear in between.
        dt : float
            Time step [s].
        names : tuple of str
            Thermocouples.
        h, loss, base : float
            Gap conductance and loss coefficients [W/(m^2 K)].

        Returns
        -------
        (steps + 1, sensors) float array [K]
        """
        K = self.matrix(h, loss, base)
        free, source = self._free_part(K)
        A = (diags(self.capacity[free]) + GAMMA * dt * K[free][:, free]).tocsc()
        solve = splu(A).solve
        C = self.capacity[free]
        stage_drive = drive[:-1] + GAMMA * np.diff(drive)
        pick = self._pick(free, names)
        T = np.zeros(free.size)
        readings = np.zeros((len(drive), len(names)))
        for step, (first, last) in enumerate(zip(stage_drive, drive[1:], strict=True), 1):
            stage = solve(C * T + GAMMA * dt * first * source)
            start = T + (1.0 - GAMMA) / GAMMA * (stage - T)
            T = solve(C * start + GAMMA * dt * last * source)
            readings[step] = pick @ T
        if self.heater == "temperature":
            # the prescribed nodes have a share in the readings
            readings += np.outer(drive, self._pick(self.top, names).sum(axis=1))
        return readings

    def _free_part(self, K: csc_matrix) -> tuple[IntArray, FloatArray]:
        """Unknown nodes, and the load on them for a unit of the heater's drive."""
        if self.heater == "power":
            source = np.zeros(self.n)
            # half of the cross-section carries half of the power
            share = 0.5 * WATT / self.rig.depth_mm
            source[self.top] = share * self.top_length / self.top_length.sum()
            return np.arange(self.n), source
        free = np.setdiff1d(np.arange(self.n), self.top)
        return free, -np.asarray(K[free][:, self.top].sum(axis=1)).ravel()

    def _pick(self, free: IntArray, names: tuple[str, ...]) -> FloatArray:
        weights = np.zeros((len(names), self.n))
        for row, name in enumerate(names):
            nodes, values = self._sensors[name]
            weights[row, nodes] = values
        return weights[:, free]


def _body_matrices(
    mesh: MeshQuad, lower: ThermalProperties, upper: ThermalProperties, in_upper: BoolArray
) -> tuple[coo_matrix, FloatArray]:
    """Conduction matrix and lumped capacity of a mesh of two materials."""
    basis = Basis(mesh, ElementQuad1())
    k = np.where(in_upper, upper.conductivity, lower.conductivity)
    capacity = np.where(in_upper, upper.heat_capacity, lower.heat_capacity)
    K = conduction.assemble(basis, k=k[:, None] * np.ones_like(basis.dx))
    quarter = 0.25 * capacity * basis.dx.sum(axis=1)
    C = np.bincount(mesh.t.ravel(), weights=np.tile(quarter, 4), minlength=mesh.nvertices)
    return K.tocoo(), C.astype(np.float64, copy=False)


def _interval(lines: FloatArray, value: float) -> tuple[int, float]:
    i = int(np.clip(np.searchsorted(lines, value) - 1, 0, len(lines) - 2))
    return i, float((value - lines[i]) / (lines[i + 1] - lines[i]))
