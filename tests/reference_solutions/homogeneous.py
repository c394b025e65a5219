"""Homogeneous deformations of incompressible rubber, from work conjugacy alone.

The energies are written out in the principal stretches, straight from the definitions, and the
nominal stress is the derivative of the energy along the loading path: one force does work in the
uniaxial and in the planar test, two equal forces in the equibiaxial one. The derivative is taken by
a complex step (error below 1e-15), so nothing of the product's chain rule is shared.

References
----------
.. [1] Treloar, L. R. G., The Physics of Rubber Elasticity, 3rd ed. (1975), chapters 4-5.
.. [2] Squire, W., Trapp, G., SIAM Review 40 (1998) 110-112 (complex-step derivative).
"""

import numpy as np

STEP = 1e-100


def isochoric_energy(name, constants, l1, l2, l3):
    """Energy [N/mm^2] of the isochoric part of the principal stretches (complex allowed)."""
    cube = (l1 * l2 * l3) ** (1 / 3)
    l1, l2, l3 = l1 / cube, l2 / cube, l3 / cube
    if name in STRETCH_ENERGIES:
        return STRETCH_ENERGIES[name](l1, l2, l3, **constants)
    first = l1**2 + l2**2 + l3**2
    second = (l1 * l2) ** 2 + (l2 * l3) ** 2 + (l3 * l1) ** 2
    return ENERGIES[name](first, second, **constants)


def neo_hooke(first, second, *, G):
    return G / 2 * (first - 3)


def mooney_rivlin(first, second, *, C10, C01):
    return C10 * (first - 3) + C01 * (second - 3)


def yeoh(first, second, *, C10, C20, C30):
    return C10 * (first - 3) + C20 * (first - 3) ** 2 + C30 * (first - 3) ** 3


def van_der_waals(first, second, *, G, lambda_m, a, beta=0.0):
    mixed = (1 - beta) * first + beta * second
    locking = lambda_m**2 - 3
    eta = np.sqrt((mixed - 3) / locking)
    attraction = 2 * a / 3 * ((mixed - 3) / 2) ** 1.5
    return G * (-locking * (np.log(1 - eta) + eta) - attraction)


def arruda_boyce(first, second, *, C1, lambda_m):
    chain = [1 / 2, 1 / 20, 11 / 1050, 19 / 7000, 519 / 673750]
    return C1 * sum(
        c / lambda_m ** (2 * i) * (first ** (i + 1) - 3 ** (i + 1)) for i, c in enumerate(chain)
    )


def ogden(l1, l2, l3, *, mu, alpha):
    terms = zip(mu, alpha, strict=True)
    return sum(2 * m / a**2 * (l1**a + l2**a + l3**a - 3) for m, a in terms)


#: Energies of the isochoric invariants, and those of the isochoric stretches.
ENERGIES = {
    "NeoHooke": neo_hooke,
    "MooneyRivlin": mooney_rivlin,
    "Yeoh": yeoh,
    "VanDerWaals": van_der_waals,
    "ArrudaBoyce": arruda_boyce,
}

STRETCH_ENERGIES = {"Ogden": ogden}

PATHS = {
    "uniaxial": (lambda lam: (lam, lam**-0.5, lam**-0.5), 1),
    "equibiaxial": (lambda lam: (lam, lam, lam**-2), 2),
    "planar": (lambda lam: (lam, 1.0, 1 / lam), 1),
}


def nominal_stress(name, constants, stretch, mode):
    """Nominal stress [N/mm^2] of the model `name` in a homogeneous test."""
    path, forces = PATHS[mode]
    stretches = path(np.asarray(stretch, dtype=complex) + 1j * STEP)
    return isochoric_energy(name, constants, *stretches).imag / STEP / forces


def plane_strain_energy(name, constants, F, F33=1.0):
    """Isochoric energy [N/mm^2] of deformation gradients (..., 2, 2) and F33 (complex allowed)."""
    trace = np.sum(F * F, axis=(-2, -1)) + F33**2
    J = (F[..., 0, 0] * F[..., 1, 1] - F[..., 0, 1] * F[..., 1, 0]) * F33
    if name in STRETCH_ENERGIES:
        # squared stretches are the roots of x^2 - tr(C) x + det(C) in the plane
        half, area = (trace - F33**2) / 2, J / F33
        root = np.sqrt(half**2 - area**2)
        return isochoric_energy(name, constants, (half + root) ** 0.5, (half - root) ** 0.5, F33)
    # I2 from its definition with C = F^T F, not from the shortcut of plane strain
    C = np.swapaxes(F, -1, -2) @ F
    trace_C2 = np.sum(C * np.swapaxes(C, -1, -2), axis=(-2, -1)) + F33**4
    second = (trace**2 - trace_C2) / 2
    return ENERGIES[name](trace * J ** (-2 / 3), second * J ** (-4 / 3), **constants)


def plane_strain_stress(name, constants, F):
    """First Piola-Kirchhoff stress dW/dF [N/mm^2] by complex steps, shape of F (..., 2, 2)."""
    P = np.empty(F.shape)
    for i in range(2):
        for j in range(2):
            shifted = F.astype(complex)
            shifted[..., i, j] += 1j * STEP
            P[..., i, j] = plane_strain_energy(name, constants, shifted).imag / STEP
    return P


def out_of_plane_stress(name, constants, F):
    """Cauchy stress sigma_zz = dW/dF33 / J [N/mm^2] at F33 = 1 of the isochoric energy."""
    W = plane_strain_energy(name, constants, F.astype(complex), 1.0 + 1j * STEP)
    return W.imag / STEP / np.linalg.det(F)
