"""How well a grid and its time steps resolve the thin layer that a hot contact heats.

A half-space with the flux q through its surface warms by T = 2 q sqrt(t/pi)/e there (e: thermal
effusivity) [1]_. On a grid of cells of thickness d with lumped capacities the surface's admittance
in the Laplace domain is e sqrt(s) sqrt(1 + s d^2/(4 alpha)) instead of e sqrt(s) (the recurrence
T_(j+1) - 2 T_j + T_(j-1) = (s d^2/alpha) T_j has the solution exp(-j theta), 2 sinh(theta/2) =
d sqrt(s/alpha)). Transformed back, with x = 2 alpha t/d^2, the surface reaches the share

    sqrt(pi x/2) exp(-x) (I_0(x) + I_1(x)) = 1 - d^2/(16 alpha t) + ...

of its exact rise. Backward Euler with n equal steps reaches the share
Gamma(n + 1/2)/(Gamma(n) sqrt(n)) = 1 - 1/(8 n) + ... (from the coefficients of (1 - z)^(-3/2)).

References
----------
.. [1] H. S. Carslaw, J. C. Jaeger: Conduction of Heat in Solids, 2nd ed., Oxford, 1959, 2.9.
"""

import numpy as np
from scipy.special import gammaln, ive

#: Value of x beyond which the error, 1/(8 x), is below rounding that matters (and I_0 overflows).
RESOLVED = 1e9


def grid_error(cell: float, diffusivity: float, time: float) -> float:
    """Share of the surface's rise that a grid misses [-], constant flux, exact in time.

    Parameters
    ----------
    cell : float
        Thickness of the cells below the surface [mm].
    diffusivity : float
        Thermal diffusivity [mm^2/s].
    time : float
        Duration of heating [s]; 0 is no error.
    """
    if time <= 0.0:
        return 0.0
    x = min(2.0 * diffusivity * time / cell**2, RESOLVED)
    return 1.0 - float(np.sqrt(0.5 * np.pi * x) * (ive(0, x) + ive(1, x)))


def step_error(steps: float) -> float:
    """Share of the surface's rise that backward Euler misses in a number of equal steps [-]."""
    n = max(steps, 1.0)
    return 1.0 - float(np.exp(gammaln(n + 0.5) - gammaln(n)) / np.sqrt(n))


def layer_error(cell: float, diffusivity: float, time: float, steps: float) -> float:
    """Share of the surface's rise that grid and time steps miss together [-], 0 without heating.

    The product of what either reaches, which is their sum where they are small.
    """
    if time <= 0.0:
        return 0.0
    reached = (1.0 - grid_error(cell, diffusivity, time)) * (1.0 - step_error(steps))
    return 1.0 - reached
