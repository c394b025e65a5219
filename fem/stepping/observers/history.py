"""The history of a run, a row per accepted step, and the table of its boundary."""

from typing import Any

import numpy as np
import pandas as pd

from fem.case import Case
from fem.mechanics import Strains, platen_displacement
from fem.mesh import BlockMesh
from fem.results import BoundaryContact, boundary_table, contact_columns, rubber_columns
from fem.stepping.audit import EnergyAudit, EnergyAuditor
from fem.stepping.coupled_state import AcceptedStep, CoupledState
from fem.stepping.coupled_step import CoupledModel
from fem.stepping.moment import Moment
from fem.stepping.observers.wear import WearRecorder
from fem.stepping.per_block import block_columns, temperature_columns
from materials.arrays import FloatArray


class HistoryRecorder:
    """A row per accepted step, and the table of the boundary.

    Parameters
    ----------
    case : Case
        For the ambient temperature and the windows of fitted laws.
    model : CoupledModel
        For mesh and strains.
    audit : EnergyAuditor
    wear : WearRecorder
        See each step before.
    """

    def __init__(
        self, case: Case, model: CoupledModel, audit: EnergyAuditor, wear: WearRecorder
    ) -> None:
        self.case, self.model, self.audit, self.wear = case, model, audit, wear
        self.rows: list[dict[str, Any]] = []
        self.smallest_J = np.inf

    @property
    def mesh(self) -> BlockMesh:
        """Reference mesh."""
        return self.model.mechanics.mesh

    def see(self, moment: Moment) -> None:
        """Append the row of an accepted step."""
        step = moment.step
        strains = self.model.mechanics.strains(step.evaluation)
        smallest_J, status = float(strains.J.min()), step.after.contact.status
        self.smallest_J = min(self.smallest_J, smallest_J)
        row = self._contact_columns(step)
        row |= {"sliding_distance_mm": moment.distance}
        T_C, ambient_C = step.after.heat.T, self.case.heat.ambient_C
        row |= temperature_columns(self.mesh, T_C, ambient_C)
        row |= {"newton_iterations": step.iterations}
        row |= energy_columns(self.audit.audit, step.after)
        row |= {"friction_lag_error": step.lag_error}
        row |= {"min_J": smallest_J}
        row |= {"self_contact_penetration": step.penetration}
        row |= {"sticking_nodes": int(status.sticking.sum())}
        row |= {"slipping_nodes": int(status.slipping.sum())}
        row |= self._window_columns(step, strains)
        row |= block_columns(self.mesh, step.after.contact, T_C, ambient_C)
        self.rows.append(row | self._event_columns(moment))

    def _event_columns(self, moment: Moment) -> dict[str, float]:
        """Where in an event of phases the step is, and what wore off."""
        row: dict[str, float] = {}
        if self.case.loading.phase:
            row |= {"phase": moment.phase.number, "contact": moment.phase.contact}
            pressure = moment.step.target.force / self.case.block.pressed_length_mm
            row |= {"mean_pressure_N_per_mm2": pressure}
        if self.wear.law.coefficient > 0.0:
            row |= {"wear_volume_mm3_per_mm": self.wear.volume}
        return row

    def _window_columns(self, step: AcceptedStep, strains: Strains) -> dict[str, float]:
        """Shares outside the ranges that the laws of the case were fitted to."""
        contact, active = step.after.contact, step.after.contact.status.active
        return contact_columns(
            self.case,
            p=contact.pressure[active],
            v=contact.slip_velocity[active],
            T=step.after.heat.T[self.model.mechanics.candidates][active],
            length=contact.length[active],
            slipping=contact.status.slipping[active],
        ) | rubber_columns(self.case, strains.I1, strains.J, strains.weights)

    def _contact_columns(self, step: AcceptedStep) -> dict[str, Any]:
        contact, direction = step.after.contact, self.mesh.direction
        normal, length = contact.normal_force, contact.contact_length
        friction = direction * contact.friction_force
        return {
            "time_s": step.after.time,
            "sliding_distance_mm": 0.0,
            "velocity_mm_per_s": step.target.sweep / step.target.dt,
            "normal_force_N_per_mm": normal,
            "friction_force_N_per_mm": friction,
            "friction_coefficient": friction / normal if normal > 0.0 else 0.0,
            "contact_length_mm": length,
            "mean_contact_pressure_N_per_mm2": normal / length if length > 0.0 else 0.0,
            "max_contact_pressure_N_per_mm2": float(contact.pressure.max()),
            "mean_slip_velocity_mm_per_s": direction * contact.mean_slip_velocity,
            "platen_displacement_mm": platen_displacement(self.mesh, step.after.mechanics.u),
        }

    def boundary(self, state: CoupledState) -> pd.DataFrame:
        """Table of the free boundary of an accepted state."""
        contact = state.contact
        # The length of an open node is 0, and so is its shear force.
        shear = contact.shear / np.maximum(contact.length, 1e-300)
        table = boundary_table(
            self.mesh,
            state.mechanics.u,
            state.heat.T,
            BoundaryContact(
                kind=contact.status.kind,
                pressure=contact.pressure,
                shear=shear,
                slip_velocity=contact.slip_velocity,
            ),
        )
        table = table.assign(self_contact_pressure_N_per_mm2=self._self_pressure(state))
        if self.wear.law.coefficient == 0.0:
            return table
        wear = self.wear.wear
        return table.assign(wear_energy_mJ_per_mm2=wear.energy, wear_depth_um=1e3 * wear.depth)

    def _self_pressure(self, state: CoupledState) -> FloatArray:
        """Pressure of the block on itself at the candidates, per undeformed length [N/mm^2]."""
        normal = state.mechanics.self_normal
        if normal is None:
            return np.zeros(self.mesh.candidates.size)
        x = self.mesh.points[self.mesh.boundary]
        half = 0.5 * self.mesh.joined * np.hypot(*np.diff(x, axis=0).T)
        length = np.append(half, 0.0) + np.append(0.0, half)
        return np.asarray((normal / length)[self.mesh.is_free])


def energy_columns(audit: EnergyAudit, state: CoupledState) -> dict[str, float]:
    """Columns of the energy and the heat audit."""
    heat = state.heat
    return {
        "work_in_mJ_per_mm": audit.work_in,
        "strain_energy_mJ_per_mm": audit.strain_energy,
        "friction_dissipation_mJ_per_mm": audit.friction,
        "viscous_dissipation_mJ_per_mm": audit.viscous + audit.rubber,
        "rubber_dissipation_mJ_per_mm": audit.rubber,
        "damage_energy_mJ_per_mm": audit.damage,
        "snap_dissipation_mJ_per_mm": audit.snaps,
        "kinetic_energy_mJ_per_mm": audit.kinetic,
        "frictional_heat_mJ_per_mm": heat.generated - heat.in_bulk,
        "bulk_heat_mJ_per_mm": heat.in_bulk,
        "heat_in_rubber_mJ_per_mm": heat.in_block,
        "heat_in_road_mJ_per_mm": heat.in_road + heat.left,
        "radiated_mJ_per_mm": heat.radiated,
        "convected_mJ_per_mm": heat.convected,
    }
