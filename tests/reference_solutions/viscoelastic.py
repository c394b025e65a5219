"""Maxwell branches at finite strain by a general integrator, and closed forms at small strain.

The evolution equation is integrated in all nine components of Ci by an explicit Runge-Kutta method
of order eight with error control; nothing of the product's closed-form update is used.

References
----------
.. [1] Shutov, A. V., Landgraf, R., Ihlemann, J., Comput. Methods Appl. Mech. Eng. 265 (2013)
   213-225, eqs. of the continuous model.
.. [2] Ferry, J. D., Viscoelastic Properties of Polymers, 3rd ed. (1980), chapter 3.
"""

from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp


def branch(deformation, times, *, G, tau, breaks=()):
    """Kirchhoff stresses of a branch [N/mm^2] and the energy it has dissipated [N/mm^2].

    Parameters
    ----------
    deformation : callable
        Isochoric F (3, 3) at a time.
    times : array
        When to report, rising from above 0; the branch is at rest at 0.
    breaks : sequence of float
        Kinks of the deformation; the integration stops and starts anew there.

    Returns
    -------
    tau : (n, 3, 3) array
    dissipated : (n,) array
    """

    def slope(t, y):
        Ci = y[:9].reshape(3, 3)
        F = deformation(t)
        M = F.T @ F @ np.linalg.inv(Ci)
        dev = M - np.trace(M) / 3 * np.eye(3)
        return np.append((dev @ Ci / tau).ravel(), G / (2 * tau) * np.trace(dev @ dev))

    stops = np.unique(np.concatenate([[0.0], breaks, times]))
    y, found = np.append(np.eye(3).ravel(), 0.0), {}
    for start, end in pairwise(stops):
        y = solve_ivp(slope, (start, end), y, method="DOP853", rtol=1e-11, atol=1e-12).y[:, -1]
        found[end] = y
    stresses = []
    for t in times:
        F = deformation(t)
        be = F @ np.linalg.inv(found[t][:9].reshape(3, 3)) @ F.T
        stresses.append(G * (be - np.trace(be) / 3 * np.eye(3)))
    return np.array(stresses), np.array([found[t][9] for t in times])


def creep_of_a_rod(time, *, E_slow, E_fast, tau, stress):
    """Strain of a rod of one branch under a stress put on at 0 and held [2]_."""
    share = E_slow / E_fast
    return stress / E_slow * (1 - (1 - share) * np.exp(-share * time / tau))
