"""Active set of frictional contact with a rigid plane: open, stick or slip at every candidate node.

Complementarity is resolved by a primal-dual active set, which is a semismooth Newton method [1]_:
a node is in contact while its reaction exceeds what its gap allows, and slips while the tangential
reaction exceeds the friction limit. Evaluation is a pure function of gap, reactions and slip.

References
----------
.. [1] Hueber, S., Stadler, G., Wohlmuth, B. I., SIAM J. Sci. Comput. 30 (2008) 572-596.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from materials.arrays import BoolArray, FloatArray, IntArray

OPEN, STICK, SLIP = 0, 1, 2


@dataclass(frozen=True, kw_only=True)
class ContactStatus:
    """Status of the candidate nodes.

    Attributes
    ----------
    kind : (m,) int array
        `OPEN`, `STICK` or `SLIP`.
    sense : (m,) float array
        Sign of the slip over the road (+1, -1); friction acts against it. Kept for nodes that do
        not slip, where it has no effect.
    """

    kind: IntArray
    sense: FloatArray

    @classmethod
    def all_open(cls, count: int) -> ContactStatus:
        """Every candidate open."""
        return cls(kind=np.full(count, OPEN), sense=np.ones(count))

    @property
    def active(self) -> BoolArray:
        """Nodes in contact, (m,)."""
        return self.kind != OPEN

    @property
    def slipping(self) -> BoolArray:
        """Nodes in contact that slip, (m,)."""
        return self.kind == SLIP

    @property
    def sticking(self) -> BoolArray:
        """Nodes in contact that stick, (m,)."""
        return self.kind == STICK

    def same_as(self, other: ContactStatus) -> bool:
        """Whether both statuses lead to the same equations."""
        if not np.array_equal(self.kind, other.kind):
            return False
        slipping = self.slipping
        return np.array_equal(self.sense[slipping], other.sense[slipping])


@dataclass(frozen=True, kw_only=True)
class ContactForces:
    """What the status of the candidates is judged by, arrays (m,).

    Attributes
    ----------
    gap : float array
        Distance from the road, open positive [mm].
    normal, tangential : float arrays
        Force of the road on the block per depth: upwards, and along x [N/mm].
    slip : float array
        Displacement over the road in this step [mm].
    """

    gap: FloatArray
    normal: FloatArray
    tangential: FloatArray
    slip: FloatArray


def next_status(
    status: ContactStatus,
    forces: ContactForces,
    mu: FloatArray,
    *,
    force_tolerance: float = 0.0,
    slip_tolerance: float = 0.0,
) -> ContactStatus:
    """Status that the gaps, reactions and slips of an iterate ask for.

    Parameters
    ----------
    status : ContactStatus
        Status the iterate was computed with.
    forces : ContactForces
        Gaps, reactions and slips of the iterate.
    mu : (m,) float array
        Friction coefficient of each candidate [-].
    force_tolerance, slip_tolerance : float
        Violations up to these values [N/mm], [mm] do not change the status, so that rounding
        does not toggle a node at a switch.

    Returns
    -------
    ContactStatus
        An open node that penetrates closes (and slips along its present motion), a node that
        pulls opens, a sticking node above the friction limit slips against its reaction, a
        slipping node that moves against its sense sticks.
    """
    closes = ~status.active & (forces.gap < 0.0)
    opens = status.active & (forces.normal < -force_tolerance)
    limit = mu * np.maximum(forces.normal, 0.0)
    breaks = status.sticking & (np.abs(forces.tangential) > limit + force_tolerance)
    returns = status.slipping & (status.sense * forces.slip < -slip_tolerance)
    kind = status.kind.copy()
    sense = status.sense.copy()
    kind[breaks] = SLIP
    sense[breaks] = -np.sign(forces.tangential[breaks])
    kind[returns] = STICK
    kind[closes] = np.where(np.abs(forces.slip[closes]) > 0.0, SLIP, STICK)
    sense[closes] = np.where(forces.slip[closes] < 0.0, -1.0, 1.0)
    kind[opens] = OPEN
    return ContactStatus(kind=kind, sense=sense)
