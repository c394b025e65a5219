"""Sliding of a rigid block: uniform pressure, the whole bottom in contact, no deformation.

The same heat model as for the deformable block, with a load that one-dimensional conduction
columns can follow. It serves as a check of the heat, and as a fast estimate of T_max.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.conductance import GapConductance
from contact.friction import ThermalFriction
from contact.partition import HeatPartition
from fem.case.case import Case
from fem.heat.model import HeatModel
from fem.heat.state import HeatLoad, HeatState
from materials.arrays import FloatArray
from materials.units import W_PER_M2_K


@dataclass(frozen=True, kw_only=True)
class RigidSliding:
    """Loading and contact laws of a rigid sliding block.

    Attributes
    ----------
    pressure : float
        Uniform contact pressure p [N/mm^2].
    velocity : float
        Sliding velocity, negative to the left [mm/s].
    distance : float
        Sliding distance [mm].
    friction : ThermalFriction
        mu(p, v, T), evaluated at the temperature of the node at the start of each step.
    partition : HeatPartition
        kappa(p).
    conductance : GapConductance
        h(p, v).
    step_mm : float
        Largest sliding distance of a step [mm].
    """

    pressure: float
    velocity: float
    distance: float
    friction: ThermalFriction
    partition: HeatPartition
    conductance: GapConductance
    step_mm: float = 0.5

    def __post_init__(self) -> None:
        for name in ("pressure", "distance", "step_mm"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"rigid sliding: {name} = {getattr(self, name)}, expected above 0")
        if self.velocity == 0.0:
            raise ValueError("rigid sliding: velocity = 0, expected a sliding block")

    @classmethod
    def from_case(cls, case: Case) -> RigidSliding:
        """Sliding as a case file states it; the mean pressure on the top is that of the contact."""
        return cls(
            pressure=case.loading.mean_pressure_N_per_mm2,
            velocity=case.loading.velocity_mm_per_s,
            distance=case.loading.distance_mm,
            friction=case.friction.law_object(),
            partition=case.heat.partition_object(),
            conductance=case.heat.conductance_object(),
            step_mm=case.solver.heat_step_mm * case.solver.steps_scale,
        )


@dataclass(frozen=True, kw_only=True)
class RigidStep:
    """One accepted step of the rigid block; forces and heat per mm depth.

    Attributes
    ----------
    time_s, distance_mm : float
        Time and sliding distance (positive) at the end of the step.
    position_mm : float
        Signed platen displacement over the road at the end of the step.
    heat : HeatState
        Temperatures and heat balance at the end of the step.
    nodes : (m,) int array
        Bottom nodes, from the trailing to the leading corner.
    tributary_mm : (m,) float array
        Length of bottom each node stands for.
    pressure, mu : (m,) float array
        Contact pressure [N/mm^2] and friction coefficient [-] of the nodes during the step.
    power : (m,) float array
        Frictional heat of the nodes, kappa mu p v times length [mJ/s].
    dissipation : float
        Friction work during the step [mJ/mm].
    capped_dissipation : float
        Part of it where the heat partition was capped [mJ/mm].
    """

    time_s: float
    distance_mm: float
    position_mm: float
    heat: HeatState
    nodes: NDArray[np.int64]
    tributary_mm: FloatArray
    pressure: FloatArray
    mu: FloatArray
    power: FloatArray
    dissipation: float
    capped_dissipation: float

    @property
    def friction_force(self) -> float:
        """Friction force [N/mm]."""
        return float(np.sum(self.mu * self.pressure * self.tributary_mm))

    @property
    def normal_force(self) -> float:
        """Normal force [N/mm]."""
        return float(np.sum(self.pressure * self.tributary_mm))


def slide_rigid_block(
    model: HeatModel, sliding: RigidSliding, heat: HeatState | None = None, done: int = 0
) -> Iterator[RigidStep]:
    """Slide a rigid block over the road at constant velocity.

    Parameters
    ----------
    model : HeatModel
        Heat of block and road.
    sliding : RigidSliding
        Loading and laws.
    heat : HeatState, optional
        State to go on from after `done` steps.
    done : int, optional
        Steps that are made already.

    Yields
    ------
    RigidStep
        After each step.
    """
    mesh, speed = model.mesh, abs(sliding.velocity)
    lengths = mesh.bottom_lengths
    p = np.full(len(lengths), sliding.pressure)
    h = W_PER_M2_K * sliding.conductance.conductance(p, speed)
    governing = sliding.partition.governing(p, sliding.pressure)
    kappa = sliding.partition(governing)
    capped = sliding.partition.uncapped(governing) > sliding.partition.cap
    steps = max(1, int(np.ceil(sliding.distance / sliding.step_mm - 1e-9)))
    dt = sliding.distance / steps / speed
    at_rest = np.zeros_like(mesh.points)
    heat = heat or model.initial_state()
    for step in range(done + 1, steps + 1):
        mu = sliding.friction.coefficient(p, speed, heat.T[mesh.bottom])
        dissipated = mu * p * speed * lengths
        load = HeatLoad(
            dt=dt,
            sweep=sliding.velocity * dt,
            displacement=at_rest,
            contact_nodes=mesh.bottom,
            power=kappa * dissipated,
            conductance=h * lengths,
        )
        heat = model.advance(heat, load, sliding.velocity * dt * (step - 1))
        yield RigidStep(
            time_s=dt * step,
            distance_mm=speed * dt * step,
            position_mm=sliding.velocity * dt * step,
            heat=heat,
            nodes=mesh.bottom,
            tributary_mm=lengths,
            pressure=p,
            mu=mu,
            power=load.power,
            dissipation=dt * float(np.sum(dissipated)),
            capped_dissipation=dt * float(np.sum(dissipated[capped])),
        )
