"""Contact of the block's candidates with the road at the end of a step."""

from dataclasses import dataclass

import numpy as np

from contact.active_set import ContactStatus
from materials.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class RoadContact:
    """Contact of the candidates with the road at the end of a step, arrays (m,).

    Attributes
    ----------
    status : ContactStatus
        Open, stick or slip.
    length : float array
        Contact length of each node [mm].
    normal, shear : float arrays
        Force of the road on the block per depth, upwards and along x [N/mm]; 0 where open.
    pressure : float array
        Normal force per contact length, 0 where open [N/mm^2].
    slip_velocity : float array
        Velocity over the road, signed [mm/s].
    remembered_velocity : float array
        Speed that the friction coefficient knows of, which follows the slip velocity [mm/s].
    slip : float array
        Way slid since touch-down [mm]; 0 where open.
    T_before : float array
        Temperature of the rubber at touch-down [deg C]; of open nodes, the present one.
    mu : float array
        Friction coefficient the step was solved with [-].
    """

    status: ContactStatus
    length: FloatArray
    normal: FloatArray
    shear: FloatArray
    pressure: FloatArray
    slip_velocity: FloatArray
    remembered_velocity: FloatArray
    slip: FloatArray
    T_before: FloatArray
    mu: FloatArray

    @property
    def contact_length(self) -> float:
        """Total contact length [mm]."""
        return float(self.length[self.status.active].sum())

    @property
    def mean_slip_velocity(self) -> float:
        """Slip velocity, signed, weighted by the normal force [mm/s]; 0 without contact."""
        total = self.normal_force
        return float(np.sum(self.normal * self.slip_velocity) / total) if total > 0.0 else 0.0

    @property
    def normal_force(self) -> float:
        """Normal force on the road [N/mm]."""
        return float(self.normal.sum())

    @property
    def mean_pressure(self) -> float:
        """Normal force over contact length [N/mm^2]; 0 without contact."""
        length = self.contact_length
        return max(self.normal_force, 0.0) / length if length > 0.0 else 0.0

    @property
    def friction_force(self) -> float:
        """Force of the block on the road along x, positive to the right [N/mm]."""
        return float(-self.shear.sum())


def friction_power(
    before: RoadContact, after: RoadContact, start_weight: float = 0.5
) -> FloatArray:
    """Frictional power of the candidates, mean over a step, (m,) [mJ/s].

    The shear forces at both ends of the step times the slip in it, half each: the trapezoidal
    rule, by which the work of the platen is audited too (those of a rigid block jump, and their
    `start_weight` is 0). A node that closes or opens in the step
    moves with its force only for a part of it, which this counts as half.
    """
    shear = start_weight * before.shear + (1.0 - start_weight) * after.shear
    return np.asarray(-shear * after.slip_velocity)


def lag_error(contact: RoadContact, mu_next: FloatArray) -> float:
    """Relative change of the slip force between two friction coefficients [-]."""
    weight = np.where(contact.status.slipping, np.abs(contact.normal), 0.0)
    total = float(np.sum(weight * contact.mu))
    return float(np.sum(weight * np.abs(mu_next - contact.mu))) / total if total > 0.0 else 0.0
