"""Shear stiffness of a slender strip that is clamped at one end and free to turn at the other.

Timoshenko's beam: S. Timoshenko, J. Goodier, Theory of Elasticity, 3rd ed. (1970), section 21; the
shear correction of a rectangle is 5/6. In plane strain the modulus of bending is E/(1 - nu^2),
4 G for an incompressible material.
"""

from __future__ import annotations


def cantilever_stiffness(width, height, G):
    """Force per deflection of the free end, per depth [N/mm^2], of an incompressible strip."""
    bending = height**3 / (3.0 * 4.0 * G * width**3 / 12.0)
    return 1.0 / (height / (G * 5.0 / 6.0 * width) + bending)
