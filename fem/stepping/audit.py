"""Energy audit of a run: work done against what was stored, dissipated and set in motion.

Forces are integrated over the steps by the trapezoidal rule, so that the audit's own error is of
second order; what backward Euler dissipates numerically shows up as an error. The end of a relaxed
step holds nothing of what its snap released (`fem.stepping.relaxation`): there the balance gives
it, so that an error of such a step shows as a large `snap_share` instead.
"""

from dataclasses import dataclass

import numpy as np

from fem.mechanics import platen_displacement
from fem.mesh import BlockMesh
from fem.stepping.balance import balance_error, share
from fem.stepping.coupled_state import AcceptedStep
from fem.stepping.moment import Moment


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
        Part of the viscous dissipation in steps that had no solution with less damping; in relaxed
        ones that is what their balance misses.
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
    audit: EnergyAudit,
    step: AcceptedStep,
    mesh: BlockMesh,
    *,
    snaps: bool = False,
    start_weight: float = 0.5,
) -> EnergyAudit:
    """Audit after one more accepted step.

    Parameters
    ----------
    audit : EnergyAudit
        That of the steps before.
    step : AcceptedStep
        The step.
    mesh : BlockMesh
        Reference mesh.
    snaps : bool
        Whether it had no solution with less damping.
    start_weight : float
        Weight of the forces at its start in their mean over it [-].
    """
    energies = step.energies
    force_x = float(step.evaluation.nodal[mesh.top, 0].sum())
    force_y = step.target.force
    if step.target.raised is not None:
        force_y = -float(step.evaluation.nodal[mesh.top, 1].sum())
    sunk, sunk_n = (platen_displacement(mesh, s.mechanics.u) for s in (step.after, step.before))
    end_weight = 1.0 - start_weight
    work = (start_weight * audit.platen_force_x + end_weight * force_x) * step.target.sweep
    work += (start_weight * audit.platen_force_y + end_weight * force_y) * (sunk - sunk_n)
    if not step.target.inertia:
        # The platen that stops the block takes what it had.
        work -= audit.kinetic
    dissipated, viscous = step.power * step.target.dt, energies.viscous
    friction = float(np.sum(dissipated)) + step.self_friction
    if step.relaxed:
        stored = energies.strain_energy + energies.kinetic - audit.strain_energy - audit.kinetic
        viscous = max(viscous, work - stored - friction - energies.rubber - energies.damage)
    return EnergyAudit(
        work_in=audit.work_in + work,
        friction=audit.friction + friction,
        viscous=audit.viscous + viscous,
        snaps=audit.snaps + viscous * (snaps or step.relaxed),
        rubber=audit.rubber + energies.rubber,
        damage=audit.damage + energies.damage,
        strain_energy=energies.strain_energy,
        kinetic=energies.kinetic,
        created=audit.created + max(-friction, 0.0) + max(-viscous, 0.0),
        capped=audit.capped + float(np.sum(dissipated[step.capped])),
        dissipated=audit.dissipated + float(np.sum(dissipated)),
        platen_force_x=force_x,
        platen_force_y=force_y,
    )


class EnergyAuditor:
    """Audits every accepted step of a run.

    Parameters
    ----------
    mesh : BlockMesh
        Reference mesh.
    start_weight : float
        See `audited`.
    """

    def __init__(self, mesh: BlockMesh, start_weight: float) -> None:
        self.mesh, self.start_weight = mesh, start_weight
        self.audit = EnergyAudit()

    def see(self, moment: Moment) -> None:
        """Add a step."""
        self.audit = audited(
            self.audit, moment.step, self.mesh, snaps=moment.snaps, start_weight=self.start_weight
        )
