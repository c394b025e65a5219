"""What every isochoric strain energy offers: plane strain, homogeneous tests, stability.

In plane strain (F33 = 1) every isotropic isochoric energy is a function of ``I1 = F:F + 1`` and
``J = det F`` alone, because the third principal stretch is 1 and the other two follow from them.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import BoolArray, FloatArray
from materials.material import (
    Deformation,
    EnergyDerivatives,
    MaterialStep,
    Response,
    StepEnd,
    Stiffness,
)

Mode = Literal["uniaxial", "equibiaxial", "planar"]
MODES: tuple[str, ...] = get_args(Mode)

#: Exponent t of the transverse stretch lam^-t of the homogeneous incompressible tests, by mode.
TRANSVERSE = {"uniaxial": 0.5, "equibiaxial": 2.0, "planar": 1.0}


@dataclass(frozen=True, kw_only=True)
class Hyperelastic(ABC):
    """Base of the isochoric energies."""

    @property
    @abstractmethod
    def initial_shear_modulus(self) -> float:
        """Shear modulus G of the undeformed state [N/mm^2]."""

    @abstractmethod
    def derivatives(self, I1: ArrayLike, J: ArrayLike) -> EnergyDerivatives:
        """Isochoric energy and its derivatives with respect to the plane-strain invariants.

        Parameters
        ----------
        I1, J : array_like
            First invariant F:F + 1 and determinant of F [-], any common shape. The state must be
            admissible; elsewhere the values are not meaningful (NaN, or of no physical use).

        Returns
        -------
        EnergyDerivatives
            Arrays of the common shape [N/mm^2].
        """

    @abstractmethod
    def log_derivatives(self, e1: FloatArray, e2: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Gradient (n, 2) and Hessian (n, 2, 2) of W [N/mm^2] in the logarithmic stretches (n,).

        The third stretch follows from incompressibility, ``e3 = -e1 - e2``. NaN beyond a locking
        stretch.
        """

    @abstractmethod
    def nominal_stress(self, stretch: ArrayLike, mode: Mode = "uniaxial") -> FloatArray:
        """Nominal stress of the incompressible material in a homogeneous test.

        Parameters
        ----------
        stretch : array_like
            Stretch in the loading direction [-], above zero.
        mode : {"uniaxial", "equibiaxial", "planar"}
            Kind of test; planar is also called pure shear.

        Returns
        -------
        ndarray
            Force per undeformed area [N/mm^2], NaN beyond a locking stretch.
        """

    @abstractmethod
    def strain_energy(self, stretch: ArrayLike, mode: Mode = "uniaxial") -> FloatArray:
        """Energy per volume [N/mm^2] of the same tests (see `nominal_stress`)."""

    def virgin(self, points: tuple[int, ...]) -> FloatArray | None:
        """No state variables: a hyperelastic law remembers nothing (see `materials.material`)."""
        return None

    def step(self, state: FloatArray | None, dt: float, T_C: FloatArray | None) -> MaterialStep:
        """The law itself: all steps are alike."""
        return self

    def respond(self, deformation: Deformation) -> Response:
        """Response of the invariants alone."""
        return Response(self.derivatives(deformation.I1, deformation.J))

    def stiffness(
        self, deformation: Deformation, response: Response, cells: slice
    ) -> Stiffness | None:
        """No stresses besides those of the invariants."""
        return None

    def end(self, deformation: Deformation) -> StepEnd:
        """The energy."""
        return StepEnd(stored=self.derivatives(deformation.I1, deformation.J).W)

    def admissible(self, I1: ArrayLike, J: ArrayLike) -> BoolArray:
        """Whether the energy exists at the state (J > 0, finite, below a locking stretch).

        Parameters
        ----------
        I1, J : array_like
            First invariant F:F + 1 and determinant of F [-], any common shape.
        """
        I1, J = np.asarray(I1, dtype=float), np.asarray(J, dtype=float)
        with np.errstate(all="ignore"):
            valid = (J > 0.0) & np.isfinite(I1) & np.isfinite(J)
            return valid & self._below_locking(I1, np.where(J > 0.0, J, 1.0))

    def _below_locking(self, I1: FloatArray, J: FloatArray) -> BoolArray | np.bool_:
        return np.True_


def checked_stretch(stretch: ArrayLike) -> FloatArray:
    """Stretches as an array, refused at or below zero."""
    lam = np.asarray(stretch, dtype=float)
    if not np.all(lam > 0.0):
        raise ValueError(f"stretch holds {np.min(lam):g}; expected values above zero")
    return lam
