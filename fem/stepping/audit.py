"""Energy audit of a run: work done against what was stored, dissipated and set in motion.

Forces are integrated over the steps by the trapezoidal rule, so that the audit's own error is of
second order; what backward Euler dissipates numerically (in snaps) shows up as an error.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fem.mechanics.step import BlockMechanics, platen_displacement
from fem.stepping.balance import balance_error, share
from fem.stepping.coupled_step import AcceptedStep


@dataclass(frozen=True, kw_only=True)
class EnergyAudit:
    """Energies since the start, per depth [mJ/mm]; the forces are those of the last step [N/mm].

    Attributes
    ----------
    work_in, friction, viscous : float
        Work of the platen, friction (on the road and on itself), Kelvin-Voigt dissipation.
    rubber, damage : float
        What the rubber's own viscosity dissipated, and what its damage consumed.
    strain_energy, kinetic : float
        Stored now.
    snaps : float
        Part of the viscous dissipation in steps that had no solution with less damping.
    created : float
        Energy that friction or viscosity gave in steps in which they should have taken it.
    capped, dissipated : float
        Friction work on the road where the heat partition was capped, and all of it.
    """

    work_in: float = 0.0
    friction: float = 0.0
    viscous: float = 0.0
    snaps: float = 0.0
    rubber: float = 0.0
    damage: float = 0.0
    strain_energy: float = 0.0
    kinetic: float = 0.0
    created: float = 0.0
    capped: float = 0.0
    dissipated: float = 0.0
    platen_force_x: float = 0.0
    platen_force_y: float = 0.0

    @property
    def error(self) -> float:
        """Work in minus stored, dissipated and kinetic energy, and what was created [-].

        Relative to the energy turned over, so that it means something whatever its sign: friction
        that drives the block instead of braking it balances, but creates all of the energy.
        """
        stored, dissipated = self.strain_energy, self.viscous + self.rubber
        found = (stored, self.friction, dissipated, self.damage, self.kinetic)
        return balance_error(self.work_in, *found, created=self.created)

    @property
    def regularisation_share(self) -> float:
        """Damping outside of snaps, relative to the work in [-]."""
        return share(self.viscous - self.snaps, self.work_in)

    @property
    def rubber_share(self) -> float:
        """What the rubber's own viscosity dissipated, relative to the work in [-]."""
        return share(self.rubber, self.work_in)

    @property
    def damage_share(self) -> float:
        """What the rubber's damage consumed, relative to the work in [-]."""
        return share(self.damage, self.work_in)

    @property
    def snap_share(self) -> float:
        """What snaps released, relative to the work in [-]."""
        return share(self.snaps, self.work_in)

    @property
    def capped_share(self) -> float:
        """Share of the friction work whose heat partition was capped [-]."""
        return share(self.capped, self.dissipated)


def audited(
    audit: EnergyAudit, step: AcceptedStep, mechanics: BlockMechanics, *, snaps: bool = False
) -> EnergyAudit:
    """Audit after one more accepted step; one that `snaps` had no solution with less damping."""
    before, after = step.before, step.after
    forces, elements = step.evaluation.elements, mechanics.elements
    assert forces is not None
    force_x = float(step.evaluation.nodal[mechanics.mesh.top, 0].sum())
    lowered = platen_displacement(mechanics.mesh, after.mechanics.u) - platen_displacement(
        mechanics.mesh, before.mechanics.u
    )
    work = 0.5 * (audit.platen_force_x + force_x) * step.target.sweep
    work += 0.5 * (audit.platen_force_y + step.target.force) * lowered
    dissipated = step.power * step.target.dt
    kinetic = 0.5 * float(np.sum(mechanics.mass[:, None] * after.mechanics.velocity**2))
    friction = float(np.sum(dissipated)) + step.self_friction
    viscous = viscous_work(step, mechanics)
    return EnergyAudit(
        work_in=audit.work_in + work,
        friction=audit.friction + friction,
        viscous=audit.viscous + viscous,
        snaps=audit.snaps + viscous * snaps,
        rubber=audit.rubber + elements.integral(step.rubber.viscous),
        damage=audit.damage + elements.integral(step.rubber.damage),
        strain_energy=elements.strain_energy(forces.kinematics, step.rubber.stored),
        kinetic=kinetic,
        created=audit.created + max(-friction, 0.0) + max(-viscous, 0.0),
        capped=audit.capped + float(np.sum(dissipated[step.capped])),
        dissipated=audit.dissipated + float(np.sum(dissipated)),
        platen_force_x=force_x,
        platen_force_y=step.target.force,
    )


def viscous_work(step: AcceptedStep, mechanics: BlockMechanics) -> float:
    """Kelvin-Voigt dissipation of a step, S:(E - E_n) [mJ/mm]."""
    viscosity, elements = step.problem.past.viscosity, step.evaluation.elements
    if viscosity is None or elements is None:
        return 0.0
    S11, S22, S12 = viscosity.stress(elements.kinematics)
    density = (S11**2 + S22**2 + 2.0 * S12**2) / viscosity.rate
    return float(np.sum(mechanics.elements.weights * density))
