"""Contact of a long elastic cylinder with a rigid half-space: Hertz, Cattaneo and Mindlin.

Forces are per unit length of the contact line.

References
----------
.. [1] Johnson, K. L., Contact Mechanics (1985), section 4.2(c), eqs. (4.43)-(4.46).
.. [2] Johnson, K. L., Contact Mechanics (1985), section 7.2(a), eqs. (7.24)-(7.28), after
   Cattaneo (1938) and Mindlin (1949). Exact where normal and tangential tractions are uncoupled,
   which holds for an incompressible body on a rigid one.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True)
class LineContact:
    """Contact of a cylinder of radius R [mm] under the force P [N/mm].

    `E` [N/mm^2] and `nu` are those of the cylinder; the other body is rigid and flat.
    """

    radius: float
    force: float
    E: float
    nu: float

    @property
    def modulus(self) -> float:
        """E* = E / (1 - nu^2) [N/mm^2]."""
        return self.E / (1.0 - self.nu**2)

    @property
    def half_width(self) -> float:
        """a [mm], eq. (4.43)."""
        return float(np.sqrt(4.0 * self.force * self.radius / (np.pi * self.modulus)))

    @property
    def peak_pressure(self) -> float:
        """p0 [N/mm^2], eq. (4.45)."""
        return 2.0 * self.force / (np.pi * self.half_width)

    def pressure(self, x):
        """p(x) [N/mm^2], eq. (4.44)."""
        return self.peak_pressure * np.sqrt(np.maximum(1.0 - (x / self.half_width) ** 2, 0.0))

    def stick_half_width(self, tangential, mu):
        """c [mm] under a tangential force Q < mu P [N/mm], eq. (7.28)."""
        return self.half_width * np.sqrt(1.0 - tangential / (mu * self.force))

    def partial_slip_traction(self, x, tangential, mu):
        """q(x) [N/mm^2], eqs. (7.25)-(7.27)."""
        c = self.stick_half_width(tangential, mu)
        inner = np.sqrt(np.maximum(1.0 - (x / c) ** 2, 0.0))
        return mu * (self.pressure(x) - self.peak_pressure * c / self.half_width * inner)


def lame_constants(G, K_bulk):
    """Young's modulus [N/mm^2] and Poisson's ratio from shear and bulk modulus."""
    return 9.0 * K_bulk * G / (3.0 * K_bulk + G), (3.0 * K_bulk - 2.0 * G) / (
        6.0 * K_bulk + 2.0 * G
    )
