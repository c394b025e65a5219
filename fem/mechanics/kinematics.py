"""Deformation of quadrilateral elements."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from materials.arrays import FloatArray
from materials.material import InPlane


@dataclass(frozen=True, kw_only=True)
class Kinematics:
    """Deformation of the elements.

    Attributes
    ----------
    F11, F12, F21, F22 : (ne, 4) float arrays
        Deformation gradient at the Gauss points [-].
    Jbar : (ne,) float array
        Ratio of deformed to reference area [-].
    area_gradient : (ne, 4, 2) float array
        Gradient of the deformed area with respect to the corners [mm].
    x : (ne, 4, 2) float array
        Coordinates of the corners [mm].
    """

    F11: FloatArray
    F12: FloatArray
    F21: FloatArray
    F22: FloatArray
    Jbar: FloatArray
    area_gradient: FloatArray
    x: FloatArray

    @cached_property
    def J(self) -> FloatArray:
        """Determinant of F at the Gauss points, (ne, 4) [-]."""
        return self.F11 * self.F22 - self.F12 * self.F21

    @cached_property
    def I1(self) -> FloatArray:
        """First invariant F:F + 1, (ne, 4) [-]."""
        return self.F11**2 + self.F12**2 + self.F21**2 + self.F22**2 + 1.0

    @cached_property
    def C(self) -> InPlane:
        """Right Cauchy-Green tensor F^T F, each component (ne, 4) [-]."""
        return InPlane(
            self.F11**2 + self.F21**2,
            self.F12**2 + self.F22**2,
            self.F11 * self.F12 + self.F21 * self.F22,
        )

    @cached_property
    def green_lagrange(self) -> InPlane:
        """Green-Lagrange strains, each component (ne, 4) [-]."""
        C = self.C
        return InPlane(0.5 * (C.xx - 1.0), 0.5 * (C.yy - 1.0), 0.5 * C.xy)

    def part(self, cells: slice) -> Kinematics:
        """Kinematics of some of the elements."""
        return Kinematics(
            **{field.name: getattr(self, field.name)[cells] for field in fields(self)}
        )

    @property
    def matrix(self) -> FloatArray:
        """F as (ne, 4, 2, 2)."""
        rows = [np.stack([self.F11, self.F12], -1), np.stack([self.F21, self.F22], -1)]
        return np.stack(rows, axis=-2)


def area_gradient(x: FloatArray) -> FloatArray:
    """Gradient of the area of quadrilaterals with corners `x` (ne, 4, 2), same shape [mm]."""
    # Written out, because np.roll copies cost as much as the rest.
    b = np.empty_like(x)
    after, before = [1, 2, 3, 0], [3, 0, 1, 2]
    b[..., 0] = 0.5 * (x[:, after, 1] - x[:, before, 1])
    b[..., 1] = 0.5 * (x[:, before, 0] - x[:, after, 0])
    return b
