"""What a pyrometer behind the end of the road reads while the block runs off it.

A point of the bottom leaves the road at the end of the road and is free from then on. It crosses
the gap at the speed of the block: the heat spreads into the rubber, radiates and goes into the
air, and a broad spot averages over points that have been free for different times.

Every point leaves with the temperature it has at the end of the last contact: what the rear of the
bottom would be heated while the front is off the road already is left out, as is the change of the
pressure meanwhile. Free rubber has its undeformed shape.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fem.heat import HeatLoad, HeatModel, HeatState
from fem.mesh import BlockMesh
from fem.stepping.phases import Rest, resting_steps
from materials.arrays import FloatArray

#: Parts of the spot.
SPOT_PARTS = 64
#: Play of positions at the ends of a bottom [mm].
_PLAY = 1e-9


@dataclass(frozen=True, kw_only=True)
class Reading:
    """Temperatures along the bottom, in the order of `BlockMesh.bottom`.

    Attributes
    ----------
    T : (m,) float array
        At the end of the last contact [C].
    seen : (m,) float array
        What the pyrometer reads with the middle of its spot there [C].
    covered : (m,) float array
        Share of the spot that lies on the bottom; it reads that part alone [-].
    speed : float
        Of the block as it runs off [mm/s].
    """

    T: FloatArray
    seen: FloatArray
    covered: FloatArray
    speed: float


@dataclass(frozen=True, kw_only=True)
class Spot:
    """Where a pyrometer looks.

    Attributes
    ----------
    gap, width : float
        From the end of the road to the near edge of the spot, and its width [mm].
    parts : int
        Of the spot, each of which is read in its middle; of second order.
    """

    gap: float
    width: float
    parts: int = SPOT_PARTS

    def read(
        self, heat: HeatModel, state: HeatState, position: float, velocity: float, film: float
    ) -> Reading:
        """Reading of a block that runs off the road from an accepted state on.

        Parameters
        ----------
        heat : HeatModel
        state : HeatState
            At the end of the last contact.
        position, velocity : float
            Displacement of the platen [mm] and its velocity [mm/s], signed.
        film : float
            Film coefficient of the free surfaces [N/(mm s K)].
        """
        speed, mesh = abs(velocity), heat.mesh
        times, surfaces = set_free(heat, state, position, (self.gap + self.width) / speed, film)
        ahead = mesh.direction * float(np.sign(velocity))
        seen, covered = self._average(mesh, times, surfaces, speed, ahead)
        return Reading(T=surfaces[0], seen=seen, covered=covered, speed=speed)

    def _average(
        self, mesh: BlockMesh, times: FloatArray, surfaces: FloatArray, speed: float, ahead: float
    ) -> tuple[FloatArray, FloatArray]:
        """Mean over what of the spot lies on the bottom, and its share, by place of the middle."""
        X = mesh.from_trailing(mesh.bottom)
        ends = [mesh.from_trailing(chain.nodes[[0, -1]]) for chain in mesh.bottoms]
        parts = self.parts if self.width > 0.0 else 1
        total, count = np.zeros(X.size), np.zeros(X.size)
        for beyond in self.width * (np.arange(parts) + 0.5) / parts:
            T = _surface_at((self.gap + beyond) / speed, times, surfaces)
            # What is farther from the road is ahead of the middle.
            at = X + ahead * (beyond - 0.5 * self.width)
            on = np.any([(at >= a - _PLAY) & (at <= b + _PLAY) for a, b in ends], axis=0)
            total += np.where(on, np.interp(at, X, T), 0.0)
            count += on
        return total / count, count / parts


def set_free(
    heat: HeatModel, state: HeatState, position: float, duration: float, film: float
) -> tuple[FloatArray, FloatArray]:
    """Temperatures of the bottom of a block that nothing touches any more.

    Returns
    -------
    times : (k,) float array
        From 0 to the duration [s].
    surfaces : (k, m) float array
        Temperatures of the bottom nodes then [C].
    """
    bottom, none, nowhere = heat.mesh.bottom, np.empty(0), np.empty(0, dtype=np.int64)
    times, surfaces = [0.0], [state.T[bottom]]
    air = Rest(end=duration, convection=film, **resting_steps(duration))
    while times[-1] < duration:
        at = times[-1]
        stop = min(at + air.longest(at), duration)
        target = air.target(at, stop)
        load = HeatLoad(
            dt=target.dt,
            sweep=0.0,
            displacement=np.zeros_like(heat.mesh.points),
            contact_nodes=nowhere,
            power=none,
            conductance=none,
            convection=target.convection,
            parts=target.heat_parts,
        )
        state = heat.advance(state, load, position)
        times.append(stop)
        surfaces.append(state.T[bottom])
    return np.array(times), np.array(surfaces)


def _surface_at(free: float, times: FloatArray, surfaces: FloatArray) -> FloatArray:
    """Temperatures after a time, linear in its square root: so does a heated surface cool."""
    row = float(np.interp(np.sqrt(free), np.sqrt(times), np.arange(times.size)))
    before = int(row)
    after = min(before + 1, times.size - 1)
    return np.asarray(surfaces[before] + (row - before) * (surfaces[after] - surfaces[before]))
