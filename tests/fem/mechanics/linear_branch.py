"""A material with a state for the tests: an energy and one linear spring with a dashpot."""

from dataclasses import dataclass, field

import numpy as np

from materials import NeoHooke
from materials.material import InPlane, Response, StepEnd, Stiffness


@dataclass(frozen=True, kw_only=True)
class LinearBranch:
    """``S = 2 G_b (E - E_v)``, ``tau dE_v/dt = E - E_v`` by backward Euler, beside an energy.

    Written in Green-Lagrange strains, so that it is objective. tau falls by `per_kelvin` with the
    temperature. The state is E_v.
    """

    elastic: NeoHooke = field(default_factory=lambda: NeoHooke(G=0.8))
    G_b: float = 0.5
    tau: float = 0.02
    per_kelvin: float = 0.0

    @property
    def initial_shear_modulus(self):
        return self.elastic.initial_shear_modulus

    def virgin(self, points):
        return np.zeros((3, *points))

    def admissible(self, I1, J):
        return self.elastic.admissible(I1, J)

    def step(self, state, dt, T_C):
        slower = 1.0 if T_C is None else np.exp(-self.per_kelvin * (T_C - 20.0))
        return BranchStep(self, state, dt / (self.tau * slower) * np.ones((len(state[0]), 1)))


class BranchStep:
    """A step of it of length `ratio` tau, (ne, 1)."""

    def __init__(self, material, state, ratio):
        self.material, self.state, self.ratio = material, state, ratio

    def _strains(self, deformation):
        C = deformation.C
        E = np.array([0.5 * (C.xx - 1.0), 0.5 * (C.yy - 1.0), 0.5 * C.xy])
        E_v = (self.state + self.ratio * E) / (1.0 + self.ratio)
        return E - E_v, E_v

    def respond(self, deformation):
        elastic, _ = self._strains(deformation)
        energy = self.material.elastic.derivatives(deformation.I1, deformation.J)
        return Response(energy, InPlane(*(2.0 * self.material.G_b * elastic)))

    def stiffness(self, deformation, response, cells):
        modulus = 2.0 * self.material.G_b / (1.0 + self.ratio[cells])
        zero = np.zeros_like(modulus)
        return Stiffness(modulus, modulus, 0.5 * modulus, zero, zero, zero)

    def end(self, deformation):
        elastic, state = self._strains(deformation)
        squares = elastic[0] ** 2 + elastic[1] ** 2 + 2.0 * elastic[2] ** 2
        W = self.material.elastic.derivatives(deformation.I1, deformation.J).W
        G_b = self.material.G_b
        return StepEnd(
            stored=W + G_b * squares, state=state, viscous=2.0 * G_b * self.ratio * squares
        )
