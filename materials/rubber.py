"""Rubber that remembers: an elastic law with Maxwell branches and softening, in plane strain.

The isochoric energy is ``eta-softened W_elastic(I1, J) + sum of branches(q_i, J)``, where
``q_i = B_i:C`` with a B_i that the step begins with (`materials.maxwell`). Stress and tangent are
those of an elastic law with a few more invariants, and the tangent is symmetric.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import BoolArray, FloatArray
from materials.homogeneous import HomogeneousTest, homogeneous_test
from materials.hyperelastic_base import EnergyDerivatives, Hyperelastic, Mode
from materials.material import Deformation, InPlane, Response, StepEnd, Stiffness
from materials.maxwell import (
    BranchDerivatives,
    PlaneDrive,
    plane_derivatives,
    plane_dissipated,
    plane_drive,
    plane_elastic,
    plane_internal,
    plane_stiffness,
    plane_stress,
)
from materials.prony import Prony
from materials.softening import OgdenRoxburgh


@dataclass(frozen=True, kw_only=True)
class Rubber:
    """Elastic law with viscous branches and softening, either of which may be missing.

    Parameters
    ----------
    elastic : Hyperelastic
        Isochoric energy; its shear modulus G_0 is what the branches' moduli are relative to.
    viscous : Prony or None
        Maxwell branches.
    damage : OgdenRoxburgh or None
        Softening of the elastic stress.

    Examples
    --------
    A step of stretch relaxes:

    >>> from materials import NeoHooke
    >>> rubber = Rubber(elastic=NeoHooke(G=1.0), viscous=Prony(g=[1.0], tau_s=[0.1]))
    >>> stress = rubber.nominal_stress([0.0, 0.0, 10.0], [1.0, 1.01, 1.01], "uniaxial")
    >>> [round(float(value), 4) for value in stress]
    [0.0, 0.0594, 0.0297]
    """

    elastic: Hyperelastic
    viscous: Prony | None = None
    damage: OgdenRoxburgh | None = None

    @property
    def initial_shear_modulus(self) -> float:
        """Shear modulus of the undeformed state in slow tests [N/mm^2]."""
        return self._elastic_factor * self.elastic.initial_shear_modulus

    @property
    def branch_moduli(self) -> FloatArray:
        """Shear moduli of the branches [N/mm^2]."""
        g = self.viscous.g if self.viscous else ()
        return np.asarray(g, dtype=float) * self.elastic.initial_shear_modulus

    def admissible(self, I1: ArrayLike, J: ArrayLike) -> BoolArray:
        """Whether the energy exists at the state (see `Hyperelastic.admissible`)."""
        return self.elastic.admissible(I1, J)

    def nominal_stress(
        self,
        time_s: ArrayLike,
        stretch: ArrayLike,
        mode: Mode = "uniaxial",
        T_C: ArrayLike | None = None,
    ) -> FloatArray:
        """Nominal stress over the history of a homogeneous incompressible test.

        Parameters
        ----------
        time_s : array_like, shape (n,)
            Times [s], not falling; two rows at one time are a jump. The rubber is at rest and
            virgin before the first.
        stretch : array_like, shape (n,)
            Stretch in the loading direction [-], above zero, straight between the rows.
        mode : {"uniaxial", "equibiaxial", "planar"}
        T_C : array_like or None
            Temperature [deg C], one or a row each; needs branches with a shift.

        Returns
        -------
        ndarray, shape (n,)
            Force per undeformed area [N/mm^2]. The error is second order in the time step.
        """
        return self.test(time_s, stretch, mode, T_C).nominal_stress

    def test(
        self,
        time_s: ArrayLike,
        stretch: ArrayLike,
        mode: Mode = "uniaxial",
        T_C: ArrayLike | None = None,
    ) -> HomogeneousTest:
        """The same history (see `nominal_stress`) with its energies."""
        return homogeneous_test(
            self.elastic,
            self.viscous,
            self.damage,
            time_s=time_s,
            stretch=stretch,
            mode=mode,
            T_C=T_C,
        )

    @cached_property
    def _elastic_factor(self) -> float:
        return self.viscous.slow_share if self.viscous else 1.0

    def virgin(self, points: tuple[int, ...]) -> FloatArray:
        """State variables (k, *points) of rubber that nothing has happened to.

        In this order: W_max of the softening [N/mm^2], if there is one; with branches the isochoric
        C of the last accepted step and Ci of each branch, components 11, 22, 12 [-].
        """
        unit = [1.0, 1.0, 0.0]
        values = [0.0] * bool(self.damage)
        if self.viscous:
            values += unit * (1 + len(self.viscous.g))
        return np.broadcast_to(
            np.reshape(values, (-1,) + (1,) * len(points)), (len(values), *points)
        ).copy()

    def step(self, state: FloatArray | None, dt: float, T_C: ArrayLike | None = None) -> PlaneStep:
        """A time step from the state (k, *points) of the last accepted one.

        Parameters
        ----------
        state : ndarray, shape (k, *points)
            See `virgin`.
        dt : float
            Length of the step [s]; 0 asks for the response of that state.
        T_C : array_like or None
            Temperature of the last accepted step [deg C], broadcast to the points.
        """
        assert state is not None
        return PlaneStep(self, state, dt, T_C)


class PlaneStep:
    """A `Rubber` over one time step (see `materials.material`); evaluating changes nothing."""

    def __init__(self, rubber: Rubber, state: FloatArray, dt: float, T_C: ArrayLike | None) -> None:
        self.rubber, self.state = rubber, state
        n = 0 if rubber.viscous is None else len(rubber.viscous.g)
        shape = (-1,) + (1,) * (state.ndim - 1)
        self._W_max = state[0] if rubber.damage else np.zeros(())
        self._G = rubber.branch_moduli.reshape(shape)
        if rubber.viscous is not None:
            first = int(rubber.damage is not None)
            self._X_n = state[first : first + 3]
            inner = state[first + 3 :].reshape(n, 3, *state.shape[1:])
            self._Ci_n = np.moveaxis(inner, 1, 0)
            rate = dt / np.reshape(rubber.viscous.tau_s, shape)
            self._h = rate / rubber.viscous.shift_factor(T_C)

    @cached_property
    def drive(self) -> PlaneDrive:
        """What the branches bring into the step."""
        return plane_drive(self._X_n, self._Ci_n, self._h)

    def respond(self, deformation: Deformation) -> Response:
        """Stress at a deformation; what the branches give by J alone is in the energy."""
        energy, damage = self._unsoftened(deformation), self.rubber.damage
        if damage is not None:
            energy = damage.softened(energy, self._W_max)
        if self.rubber.viscous is None:
            return Response(energy)
        d = plane_derivatives(self.drive, self._G, deformation.C, deformation.J)
        W_J, W_JJ = energy.W_J + np.sum(d.J, axis=0), energy.W_JJ + np.sum(d.JJ, axis=0)
        S = InPlane(*plane_stress(self.drive, d))
        return Response(energy._replace(W_J=W_J, W_JJ=W_JJ), S, d)

    def stiffness(
        self, deformation: Deformation, response: Response, cells: slice
    ) -> Stiffness | None:
        """Consistent tangent of the branches' stresses (see `MaterialStep`)."""
        if response.inner is None:
            return None
        drive = PlaneDrive(*(part[:, cells] for part in self.drive))
        d = BranchDerivatives(*(part[:, cells] for part in response.inner))
        return Stiffness(*plane_stiffness(drive, d, deformation.C, deformation.J))

    def end(self, deformation: Deformation) -> StepEnd:
        """Energies and state variables of a step that ends at a deformation."""
        stored = W = self._unsoftened(deformation).W
        parts, damage = [], self.rubber.damage
        consumed = softening = viscous = None
        if damage is not None:
            largest = np.maximum(W, self._W_max)
            softening, stored = damage.factor(W, largest)[0], damage.recoverable(W, largest)
            consumed = damage.consumed(largest) - damage.consumed(self._W_max)
            parts.append(largest[None])
        if self.rubber.viscous is not None:
            X = np.stack(deformation.C) * np.cbrt(deformation.J) ** -2
            Ci = plane_internal(self.drive, X)
            stored = stored + np.sum(0.5 * self._G * (plane_elastic(X, Ci)[0] - 3.0), axis=0)
            lost = plane_dissipated(self._X_n, self._Ci_n, X, Ci, self._h)
            viscous = np.sum(0.5 * self._G * lost, axis=0)
            parts += [X, np.moveaxis(Ci, 0, 1).reshape(-1, *X.shape[1:])]
        state = np.concatenate(parts) if parts else self.state
        return StepEnd(
            stored=stored, state=state, viscous=viscous, damage=consumed, softening=softening
        )

    def _unsoftened(self, deformation: Deformation) -> EnergyDerivatives:
        energy = self.rubber.elastic.derivatives(deformation.I1, deformation.J)
        factor = self.rubber._elastic_factor
        return energy if factor == 1.0 else EnergyDerivatives(*(factor * W for W in energy))
