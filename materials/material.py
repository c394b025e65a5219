"""What the finite elements ask of a material in plane strain, and what a material remembers.

Hyperelastic laws give a response of the invariants alone (`materials.hyperelastic_base`). What
depends on the past adds second Piola-Kirchhoff stresses and their tangent, and returns the new
state of its memory. Asking changes nothing: the caller keeps the state of the steps it accepts.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

from numpy.typing import ArrayLike

from materials.arrays import BoolArray, FloatArray


class EnergyDerivatives(NamedTuple):
    """Isochoric energy per reference volume and its partial derivatives [N/mm^2].

    ``W_1`` is dW/dI1 at constant J, ``W_J`` is dW/dJ at constant I1, and so on.

    Examples
    --------
    >>> from materials import NeoHooke
    >>> float(NeoHooke(G=0.8).derivatives(3.0, 1.0).W_1)
    0.4
    """

    W: FloatArray
    W_1: FloatArray
    W_J: FloatArray
    W_11: FloatArray
    W_1J: FloatArray
    W_JJ: FloatArray


class InPlane(NamedTuple):
    """Components 11, 22 and 12 of a symmetric tensor in the plane."""

    xx: FloatArray
    yy: FloatArray
    xy: FloatArray


class Stiffness(NamedTuple):
    """Symmetric tangent of stresses S11, S22, S12 by the strains E11, E22, 2 E12 [N/mm^2]."""

    D11: FloatArray
    D22: FloatArray
    D33: FloatArray
    D12: FloatArray
    D13: FloatArray
    D23: FloatArray


class Deformation(Protocol):
    """Deformation at points, arrays of one shape (..., q)."""

    @property
    def I1(self) -> FloatArray:
        """First invariant F:F + 1 [-]."""

    @property
    def J(self) -> FloatArray:
        """Determinant of F [-]."""

    @property
    def C(self) -> InPlane:
        """Right Cauchy-Green tensor F^T F [-]."""


class Response(NamedTuple):
    """Stress of a material: what depends on the invariants, and what does not.

    Attributes
    ----------
    energy : EnergyDerivatives
        Part of the stress and of its tangent that depends on the invariants.
    S : InPlane or None
        Second Piola-Kirchhoff stresses besides [N/mm^2].
    inner : Any
        What the material itself needs for the tangent of S.
    """

    energy: EnergyDerivatives
    S: InPlane | None = None
    inner: Any = None


@dataclass(frozen=True, kw_only=True)
class StepEnd:
    """What a material is left with at the end of a step, arrays of the points.

    Attributes
    ----------
    stored : float array
        Energy per reference volume that it can give back [N/mm^2].
    state : (k, ...) float array or None
        Its state variables; None where it has none.
    viscous, damage : float array or None
        Energy per reference volume dissipated by its viscosity and consumed by its damage in the
        step [N/mm^2].
    softening : float array or None
        Factor of its elastic stress [-].
    """

    stored: FloatArray
    state: FloatArray | None = None
    viscous: FloatArray | None = None
    damage: FloatArray | None = None
    softening: FloatArray | None = None

    def heat(self, *, viscous: bool = True, damage: bool = True) -> FloatArray | None:
        """Energy per reference volume that became heat in the step [N/mm^2]; None without.

        Parameters
        ----------
        viscous, damage : bool
            Whether what viscosity dissipated, and what damage consumed, counts.
        """
        parts = (self.viscous if viscous else None, self.damage if damage else None)
        found = [part for part in parts if part is not None]
        return sum(found[1:], found[0]) if found else None


class MaterialStep(Protocol):
    """A material in a time step from an accepted state; asking changes nothing."""

    def respond(self, deformation: Deformation) -> Response:
        """Stress at a deformation."""

    def stiffness(
        self, deformation: Deformation, response: Response, cells: slice
    ) -> Stiffness | None:
        """Tangent of the stresses ``S`` of a response in some cells (the first axis).

        The deformation is that of these cells, the response that of all.
        """

    def end(self, deformation: Deformation) -> StepEnd:
        """What the step leaves behind if it ends at a deformation."""


class Material(Protocol):
    """A material as the elements see it."""

    @property
    def initial_shear_modulus(self) -> float:
        """Shear modulus G of the undeformed state in slow tests [N/mm^2]."""

    def admissible(self, I1: ArrayLike, J: ArrayLike) -> BoolArray:
        """Whether the energy exists at the state."""

    def virgin(self, points: tuple[int, ...]) -> FloatArray | None:
        """State variables (k, *points) before the first step; None for a material without."""

    def step(self, state: FloatArray | None, dt: float, T_C: FloatArray | None) -> MaterialStep:
        """A time step from an accepted state.

        Parameters
        ----------
        state : (k, *points) float array or None
            State variables of the last accepted step.
        dt : float
            Length of the step [s]; 0 asks for the response of the state itself.
        T_C : float array or None
            Temperature of the last accepted step, broadcast to the points [C].
        """
