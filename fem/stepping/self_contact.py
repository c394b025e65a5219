"""The contact of a block with itself over a step; a rigid block has none."""

from dataclasses import dataclass

import numpy as np

from contact.overlap import crossing_depth
from contact.pair_search import find_pairs, followed, pair_penetration
from contact.self_contact import Pairs, dissipation, heat_sources
from fem.mechanics import BlockMechanics, MechanicalState, RigidMechanics, StepEvaluation
from materials.arrays import FloatArray, IntArray

#: Deepest penetration of the block into itself in an accepted step, over the local element size.
PENETRATION_MAX = 0.01

Mechanics = BlockMechanics | RigidMechanics


@dataclass(frozen=True, kw_only=True)
class SelfContact:
    """Settings of the contact of the block with itself.

    Attributes
    ----------
    mu : float
        Friction coefficient of rubber on rubber [-].
    stiffness : float
        Contact modulus [N/mm^2]: force per penetration relative to the local element size.
    reach : float
        Search distance [mm].
    """

    mu: float
    stiffness: float
    reach: float

    def pairs(self, mechanics: Mechanics, state: MechanicalState, u: FloatArray) -> Pairs | None:
        """Pairs between an accepted state and displacements `u`."""
        if isinstance(mechanics, RigidMechanics):
            return None
        shear, points = state.self_shear, mechanics.mesh.points
        return find_pairs(
            mechanics.boundary,
            points + state.u,
            points + u,
            reach=self.reach,
            stiffness=self.stiffness,
            mu=self.mu,
            shear_n=np.zeros(mechanics.boundary.nodes.size) if shear is None else shear,
        )

    def followed(
        self, mechanics: Mechanics, state: MechanicalState, pairs: Pairs | None, u: FloatArray
    ) -> Pairs | None:
        """Pairs to go on with at displacements `u`; the same object if they still hold."""
        found = self.pairs(mechanics, state, u)
        if found is None or pairs is None or isinstance(mechanics, RigidMechanics):
            return pairs
        return followed(pairs, found, mechanics.mesh.points + u, mechanics.boundary)


def friction_heat(pairs: Pairs | None, evaluation: StepEvaluation) -> tuple[IntArray, FloatArray]:
    """Nodes and friction work of self-contact [mJ/mm]; all of it becomes heat in the rubber."""
    forces = evaluation.pairs
    if pairs is None or forces is None:
        return np.empty(0, dtype=np.int64), np.empty(0)
    return heat_sources(pairs, forces, dissipation(pairs, forces))


def penetration(mechanics: Mechanics, pairs: Pairs | None, u: FloatArray) -> float:
    """Largest penetration relative to the local element size, of pairs and of others [-]."""
    if isinstance(mechanics, RigidMechanics):
        return 0.0
    x, boundary = mechanics.mesh.points + u, mechanics.boundary
    depth = crossing_depth(x[boundary.nodes], boundary.size, boundary.joined)
    return depth if pairs is None else max(depth, pair_penetration(pairs, x, boundary))


def boundary_forces(
    mechanics: Mechanics, pairs: Pairs | None, evaluation: StepEvaluation
) -> tuple[FloatArray | None, FloatArray | None]:
    """Tangential and normal forces of self-contact by boundary node, (mb,) [N/mm]."""
    forces = evaluation.pairs
    if pairs is None or forces is None or isinstance(mechanics, RigidMechanics):
        return None, None
    shear = np.zeros(mechanics.boundary.nodes.size)
    np.add.at(shear, pairs.place, forces.shear)
    on_nodes = np.zeros(len(mechanics.mesh.points))
    np.add.at(on_nodes, pairs.nodes, forces.normal[:, None] * forces.geometry.shares)
    return shear, on_nodes[mechanics.boundary.nodes]
