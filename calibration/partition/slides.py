"""Simulated slides of one condition, and what they predict for other heat partitions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from calibration.partition.data import Condition
from calibration.partition.loading import loading_keys
from calibration.partition.simulation_store import SimulationStore, Slide
from contact.interface import InterfaceState
from contact.partition import HeatPartition
from fem.case import Case
from fem.results import EDGE_ZONE, interior_peak
from materials.arrays import FloatArray, IndexArray

#: Smallest partition that is tried.
SMALLEST = 0.01
#: First guess of the share of the bottom that is in contact while the block slides.
CONTACT_SHARE = 0.75
#: Partitions of the two rigid blocks, as shares of the cap.
_RIGID = (0.25, 0.75)


def constant(kappa: float, like: HeatPartition) -> HeatPartition:
    """The same partition at every pressure, with the cap of another."""
    return replace(like, prefactor=kappa, exponent=0.0)


def power(theta: FloatArray, like: HeatPartition) -> HeatPartition:
    """Power law of eq. (14) from prefactor and exponent; cap and kind of pressure of another."""
    return replace(like, prefactor=float(theta[0]), exponent=float(theta[1]))


@dataclass(frozen=True, kw_only=True)
class Conditioned:
    """A simulated slide with the condition it stands for.

    Attributes
    ----------
    condition : Condition
    slide : Slide
        Bottom surface at the end.
    law : HeatPartition
        Partition it was simulated with.
    platen : float
        Pressure on the top of the block [N/mm^2].
    ambient : float
        Temperature at the start [deg C].
    m : float
        Exponent of the temperature rise over the partition [-].
    number : int
        How many simulations of the condition it took.
    """

    condition: Condition
    slide: Slide
    law: HeatPartition
    platen: float
    ambient: float
    m: float
    number: int

    @property
    def cap(self) -> float:
        """Largest partition [-]."""
        return self.law.cap

    @property
    def contact_pressure(self) -> float:
        """Mean contact pressure [N/mm^2]."""
        return self.slide.mean_contact_pressure

    @property
    def share(self) -> float:
        """Pressure on the top over mean contact pressure [-]."""
        return self.platen / self.contact_pressure

    @property
    def pressure_scale(self) -> float:
        """Stated over simulated mean contact pressure; one where the top's pressure is stated."""
        stated = self.condition.pressure
        return stated / self.contact_pressure if self.condition.of_contact else 1.0

    @property
    def next_platen(self) -> float:
        """Pressure on the top for which the mean contact pressure should be as stated."""
        if abs(self.pressure_scale - 1.0) < 1e-3:
            return self.platen
        return self.platen * self.pressure_scale

    @property
    def simulated(self) -> FloatArray:
        """Temperatures of the simulation where the observations are (n,) [deg C]."""
        return self._observations(np.ones_like(self.slide.T))

    def predicted(self, law: HeatPartition, scale: float | None = None) -> FloatArray:
        """Observations (n,) [deg C] to be expected with another law.

        Every point's rise changes by the m-th power of its partition, and of the pressure where
        the stated mean contact pressure was missed by a little (`scale`).
        """
        scale = self.pressure_scale if scale is None else scale
        p, touching = self.slide.pressure, self.slide.pressure > 0.0
        ratio = np.ones_like(p)
        mean = self.contact_pressure
        stated = InterfaceState(p=scale * p[touching], mean_pressure=scale * mean)
        simulated = InterfaceState(p=p[touching], mean_pressure=mean)
        ratio[touching] = scale * law.at(stated) / self.law.at(simulated)
        # Points that have left the road since then: as the others, on average.
        ratio[~touching] = ratio[touching].mean() if touching.any() else 1.0
        return self._observations(ratio)

    def misfit_ratio(self) -> float:
        """Factor of the partition for which the observations fit best in the mean square."""
        weights = self.condition.weights
        measured = weights * (self.condition.observed - self.ambient)
        made = weights * (self.predicted(self.law) - self.ambient)
        ratio = float(measured @ made) / max(float(made @ made), 1e-12)
        return max(ratio, SMALLEST) ** (1.0 / self.m)

    def largest_change(self, law: HeatPartition) -> float:
        """Largest change of an observation that another law makes at the same pressure [K]."""
        return float(np.abs(self.predicted(law, 1.0) - self.simulated).max())

    def kappa_error(self, kappa: float, noise: float | None) -> float:
        """Standard error of a constant partition [-]; `noise` [K] where no deviation is known."""
        slope = self.m * (self.predicted(constant(kappa, self.law)) - self.ambient) / kappa
        if noise is not None:
            return noise / float(np.linalg.norm(slope))
        return float(1.0 / np.linalg.norm(self.condition.weights * slope))

    def capped_share(self, law: HeatPartition) -> float:
        """Share of the contact force where the law is capped [-]."""
        p = self.slide.pressure
        capped = law.capped(InterfaceState(p=p, mean_pressure=self.contact_pressure))
        return float(p[capped].sum() / max(float(p.sum()), 1e-12))

    def _observations(self, ratio: FloatArray) -> FloatArray:
        """Observations when the partition of every point changes by a factor (m,)."""
        slide, place = self.slide, self.condition.X
        T = self.ambient + (slide.T - self.ambient) * ratio**self.m
        if place is not None:
            return np.asarray(np.interp(place, slide.X, T))
        return np.full(self.condition.observed.size, T[self._interior].max())

    @property
    def _interior(self) -> IndexArray:
        """Points that may be the hottest of the interior with another law."""
        X, T = self.slide.X, self.slide.T
        behind = X / X[-1] <= 1.0 - EDGE_ZONE
        if self.law.exponent == 0.0 and self.law.pressure == "local":
            # A constant partition heats the crushed leading edge far more than the power law
            # does, and its peak may hide the valley behind it: the leading fifth is left out.
            # Its hottest point stands for the others, since the law has heated those at the rear
            # before they were as lightly pressed as they are at the end.
            return np.array([np.argmax(np.where(behind, T, -np.inf))])
        peak = interior_peak(X, T)
        behind |= peak.X_of_peak_mm >= X
        return np.flatnonzero(behind & (peak.T_max_C >= T))


class Trial(NamedTuple):
    """A block that is to slide; its attributes are those of `Conditioned`."""

    condition: Condition
    law: HeatPartition
    platen: float
    m: float

    @property
    def rounded(self) -> Trial:
        """With seven digits: the name of its folder then does not hang on the last bits."""
        prefactor, exponent = _rounded(self.law.prefactor), _rounded(self.law.exponent)
        law = replace(self.law, prefactor=prefactor, exponent=exponent)
        return self._replace(law=law, platen=_rounded(self.platen))


@dataclass(frozen=True, kw_only=True)
class RigidEstimate:
    """Partition that a rigid block needs, and how its temperature rise depends on it."""

    kappa: float
    m: float


@dataclass(frozen=True, kw_only=True)
class Simulated:
    """Discrete estimate of one condition.

    Attributes
    ----------
    slide : Conditioned
        Last simulation.
    kappa : float
        Constant partition that fits the observations [-].
    rigid_kappa, m : float
        From the rigid block [-].
    platen : float
        Pressure on the top to go on with [N/mm^2].
    confirmed : bool
        Whether the simulation with its partition would hardly differ.
    """

    slide: Conditioned
    kappa: float
    rigid_kappa: float
    m: float
    platen: float
    confirmed: bool


@dataclass(frozen=True)
class PartitionModel:
    """The simulations of a calibration.

    Attributes
    ----------
    case : Case
        The block that slid.
    store : SimulationStore
        Where simulations are kept.
    counts : dict
        Simulations so far by condition, rigid blocks left out.
    """

    case: Case
    store: SimulationStore
    counts: dict[str, int] = field(default_factory=dict)

    @property
    def like(self) -> HeatPartition:
        """Partition of the case, whose cap and kind of pressure the fitted one has."""
        return self.case.heat.partition_object()

    def clipped(self, kappa: float) -> float:
        """The partition inside what can be simulated, with the digits that matter."""
        return _rounded(float(np.clip(kappa, SMALLEST, self.like.cap)))

    def rigid_estimates(self, conditions: Sequence[Condition]) -> list[RigidEstimate]:
        """Partitions of rigid blocks with the stated pressures, from two blocks each."""
        low, high = (self.clipped(share * self.like.cap) for share in _RIGID)
        blocks = self._run(
            [
                Trial(condition, constant(kappa, self.like), condition.pressure, 1.0)
                for condition in conditions
                for kappa in (low, high)
            ],
            rigid=True,
        )
        estimates = []
        for pair in zip(blocks[::2], blocks[1::2], strict=True):
            rises = [float(np.mean(block.simulated)) - block.ambient for block in pair]
            m = float(np.log(rises[1] / rises[0]) / np.log(high / low))
            last = replace(pair[1], m=m)
            estimates.append(RigidEstimate(kappa=high * last.misfit_ratio(), m=m))
        return estimates

    def simulated(self, trials: Sequence[Trial]) -> list[Conditioned]:
        """Simulate (or read) the block at conditions with partition laws, side by side."""
        for trial in trials:
            name = trial.condition.name
            self.counts[name] = self.counts.get(name, 0) + 1
        return self._run(trials, rigid=self.case.block.rigid)

    def _run(self, trials: Sequence[Trial], *, rigid: bool) -> list[Conditioned]:
        trials = [trial.rounded for trial in trials]
        kind = "rigid block, " if rigid else ""
        slides = self.store.slides(
            [
                (self._case(trial, rigid), f"{kind}{trial.condition.name}, {_described(trial.law)}")
                for trial in trials
            ]
        )
        return [
            Conditioned(
                condition=trial.condition,
                slide=slide,
                law=trial.law,
                platen=trial.platen,
                ambient=self.case.heat.ambient_C,
                m=trial.m,
                number=self.counts.get(trial.condition.name, 0),
            )
            for trial, slide in zip(trials, slides, strict=True)
        ]

    def _case(self, trial: Trial, rigid: bool) -> Case:
        return self.case.with_overrides(
            {
                "block.rigid": rigid,
                **loading_keys(self.case, trial.platen, trial.condition.velocity),
                "heat.partition": partition_table(trial.law),
                "output.snapshots": 1,
                "output.vtu": False,
                "output.figures": False,
            }
        )


def _rounded(value: float) -> float:
    return float(f"{value:.7g}")


def partition_table(law: HeatPartition) -> dict[str, str | float]:
    """The law as the table `heat.partition` of a case."""
    table: dict[str, str | float] = {"law": "constant", "prefactor": law.prefactor}
    if law.exponent != 0.0:
        table |= {"law": "power", "exponent": law.exponent}
    return table | {"cap": law.cap, "pressure": law.pressure}


def _described(law: HeatPartition) -> str:
    if law.exponent == 0.0:
        return f"kappa = {law.prefactor:.4g}"
    return f"kappa = {law.prefactor:.4g} p^{law.exponent:.4g}"
