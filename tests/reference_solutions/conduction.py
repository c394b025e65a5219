"""Closed forms of heat conduction in half-spaces.

References
----------
.. [1] H. S. Carslaw, J. C. Jaeger: Conduction of Heat in Solids, 2nd ed., Oxford University
   Press, 1959. Section 2.9 (constant flux), section 2.8 and 12.8 by Laplace transform (contact of
   two bodies), section 10.7 (moving sources).
.. [2] J. C. Jaeger: Moving sources of heat and the temperature at sliding contacts, Proc. Royal
   Society of New South Wales 76 (1942) 203-224.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.integrate import quad
from scipy.special import erfc, erfcx, k0e


def ierfc(x):
    """Integral of erfc from x to infinity."""
    return np.exp(-(x**2)) / np.sqrt(np.pi) - x * erfc(x)


def constant_flux(z, t, *, flux, k, rho_c):
    """Temperature rise at depth z after the time t of a constant surface flux [1]_ (2.9)."""
    length = np.sqrt(k / rho_c * t)
    return 2.0 * flux * length / k * ierfc(z / (2.0 * length))


def train_of_pulses(t, *, flux, effusivity, duration, period):
    """Surface temperature rise at the times t of pulses of constant flux, one every period [1]_.

    A pulse is a flux that starts and one of the other sign that starts when it ends; each raises
    the surface by 2 q/e sqrt(t/pi) (2.9). Between the pulses the surface is insulated.
    """

    def rise(since):
        return 2.0 * flux / effusivity * np.sqrt(np.maximum(since, 0.0) / np.pi)

    starts = period * np.arange(int(np.max(t) // period) + 1)[:, None]
    since = np.atleast_1d(t) - starts
    return (rise(since) - rise(since - duration)).sum(axis=0)


def contact_of_two_half_spaces(t, *, T_1, T_2, h, effusivity_1, effusivity_2):
    """Surface temperatures of two half-spaces joined by a conductance h at t = 0.

    By Laplace transform of dT = -/+ q/(e sqrt(s)) and q = h (T_1 - T_2):
    q = h (T_1 - T_2) exp(beta^2 t) erfc(beta sqrt t), beta = h (1/e_1 + 1/e_2).

    Returns
    -------
    T_1 surface, T_2 surface, flux from 1 to 2
    """
    beta = h * (1.0 / effusivity_1 + 1.0 / effusivity_2)
    decay = erfcx(beta * np.sqrt(t))
    change = h * (T_1 - T_2) / beta * (1.0 - decay)
    return T_1 - change / effusivity_1, T_2 + change / effusivity_2, h * (T_1 - T_2) * decay


def moving_band_surface(x, *, flux, half_width, velocity, k, rho_c):
    """Quasi-steady surface temperature of a half-space under Jaeger's band source [1]_, [2]_.

    The band -b < x < b with a uniform flux moves in +x with the given velocity; x moves with it.
    T = flux/(pi k) int_{x-b}^{x+b} exp(-a s) K0(a |s|) ds, a = velocity/(2 alpha).
    """
    a = velocity * rho_c / (2.0 * k)

    def kernel(s):
        return np.exp(-a * (s + abs(s))) * k0e(a * abs(s))

    def integral(low, high):
        parts = sorted({low, high, *(p for p in (-1e-3, 0.0, 1e-3) if low < p < high)})
        return sum(quad(kernel, p, q, limit=400)[0] for p, q in pairwise(parts))

    values = [integral(position - half_width, position + half_width) for position in x]
    return flux / (np.pi * k) * np.array(values)


def cooling_by_radiation(t, *, T_start_C, ambient_C, emissivity, sigma, surface_per_capacity):
    """Temperature of a body of uniform temperature that radiates, by fine Runge-Kutta steps.

    C dT/dt = -A eps sigma (T^4 - T_a^4); `surface_per_capacity` is A/C.
    """

    def rate(T):
        return (
            -surface_per_capacity
            * emissivity
            * sigma
            * ((T + 273.15) ** 4 - (ambient_C + 273.15) ** 4)
        )

    T, n = T_start_C, 2000
    for _ in range(n):
        dt = t / n
        a = rate(T)
        b = rate(T + 0.5 * dt * a)
        c = rate(T + 0.5 * dt * b)
        d = rate(T + dt * c)
        T += dt * (a + 2 * b + 2 * c + d) / 6.0
    return T
