"""What the rubber models do in homogeneous tests, as far as the claims ask."""

import numpy as np

from materials.arrays import FloatArray
from materials.hyperelastic import Hyperelastic

#: Largest stretch of the paper's tests: 300 % of strain in the second series of bars.
TESTED_STRETCH = 4.0
_POINTS = 1201


def tangent_modulus(
    model: Hyperelastic, largest_stretch: float = TESTED_STRETCH
) -> tuple[FloatArray, FloatArray]:
    """Stretch and slope of the nominal uniaxial stress in tension [-], [N/mm^2].

    Up to the largest stretch, or to where the model locks.
    """
    stretch = np.linspace(1.0, largest_stretch, _POINTS)
    stress = np.asarray(model.nominal_stress(stretch, "uniaxial"))
    # One point before the locking stretch, the difference would reach across it.
    good = np.isfinite(stress)
    stretch, stress = stretch[good], stress[good]
    return 0.5 * (stretch[1:] + stretch[:-1]), np.diff(stress) / np.diff(stretch)


def stiffening(model: Hyperelastic) -> float:
    """Largest later slope over the smallest slope of the uniaxial curve [-]; 1: never stiffens."""
    _, slope = tangent_modulus(model)
    lowest = int(np.argmin(slope))
    return float(slope[lowest:].max() / slope[lowest])


def upturn_stretch(model: Hyperelastic) -> float:
    """Stretch at which the slope is twice its lowest value [-]; infinite if it never is."""
    stretch, slope = tangent_modulus(model)
    lowest = int(np.argmin(slope))
    doubled = np.flatnonzero(slope[lowest:] >= 2.0 * slope[lowest])
    return float(stretch[lowest + doubled[0]]) if doubled.size else float("inf")


def secant_shear_modulus(model: Hyperelastic, shear: float) -> float:
    """Shear stress over amount of shear in simple shear [N/mm^2], 2 dW/dI1 at J = 1."""
    return float(2.0 * model.derivatives(3.0 + shear**2, 1.0).W_1)


def stiffer_ranges(
    one: Hyperelastic, other: Hyperelastic, largest_shear: float = 2.0
) -> list[tuple[float, float]]:
    """Ranges of the amount of shear in which one model has the higher secant shear modulus [-]."""
    shears = np.linspace(0.0, largest_shear, 401)[1:]
    moduli = [[secant_shear_modulus(model, x) for x in shears] for model in (one, other)]
    # Beyond a locking stretch there is no modulus: nothing is compared.
    higher = np.array(moduli[0]) > np.array(moduli[1])
    edges = np.flatnonzero(np.diff(np.concatenate([[False], higher, [False]]).astype(int)))
    ends = [(shears[a], shears[b - 1]) for a, b in edges.reshape(-1, 2)]
    return [(0.0 if low == shears[0] else float(low), float(high)) for low, high in ends]
