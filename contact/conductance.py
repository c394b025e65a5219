"""Thermal conductance of the contact interface.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", eqs. (10)-(13) and section 3.4.
.. [2] Mikic, B. B., Int. J. Heat Mass Transfer 17 (1974) 205-214.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contact.interface import InterfaceState
from materials.arrays import FloatArray
from materials.checks import require_finite, require_not_negative, require_positive


@dataclass(frozen=True, kw_only=True)
class GapConductance:
    """Conductance ``h = h_ref (p/p_ref)^e (E1(0)/E1(v))^e`` with the exponent e = 0.94.

    Parameters
    ----------
    h_ref : float
        Conductance at p_ref and rest [W/(m^2 K)]; 1600 was identified at 0.3 N/mm^2 [1]_.
    p_ref : float
        Reference pressure [N/mm^2].
    exponent : float
        Exponent of the pressure [-].
    modulus_exponent : float
        Exponent m of the stated stiffening ``E1(v)/E1(0) = (1 + |v|/v_ref)^m`` [-]; E1(v) has not
        been published, the default 0 leaves it constant.
    v_ref : float
        Reference speed of the stiffening [mm/s].

    Examples
    --------
    >>> round(float(GapConductance(h_ref=1600.0).conductance(0.15)))  # half the pressure
    834
    """

    h_ref: float = 1600.0
    p_ref: float = 0.3
    exponent: float = 0.94
    modulus_exponent: float = 0.0
    v_ref: float = 1.0

    def __post_init__(self) -> None:
        require_not_negative(h_ref=self.h_ref, exponent=self.exponent)
        require_positive(p_ref=self.p_ref, v_ref=self.v_ref)
        require_finite(modulus_exponent=self.modulus_exponent)

    def conductance(self, p: ArrayLike, v: ArrayLike = 0.0) -> FloatArray:
        """Conductance h [W/(m^2 K)] at pressure p [N/mm^2] and speed v [mm/s] (broadcast).

        Zero where p is zero or negative (no contact).
        """
        pressure = np.maximum(np.asarray(p, dtype=float), 0.0) / self.p_ref
        h = np.where(pressure > 0.0, self.h_ref * pressure**self.exponent, 0.0)
        return h * self.stiffening(v) ** -self.exponent

    def at(self, state: InterfaceState) -> FloatArray:
        """Conductance h [W/(m^2 K)] at a state of the interface."""
        return self.conductance(state.p, state.v)

    def stiffening(self, v: ArrayLike) -> FloatArray:
        """Ratio ``E1(v)/E1(0)`` [-] at speed v [mm/s]."""
        return (1.0 + np.abs(np.asarray(v, dtype=float)) / self.v_ref) ** self.modulus_exponent


@dataclass(frozen=True, kw_only=True)
class ContactSurface:
    """What eq. (11) needs to know of the two solids and their sum surface.

    Parameters
    ----------
    mean_conductivity_W_per_mK : float
        Harmonic mean conductivity kbar, eq. (12): ``1/kbar = (1/k1 + 1/k2)/2``.
    effective_modulus_N_per_mm2 : float
        Effective modulus Ebar, eq. (13): ``1/Ebar = (1 - nu1^2)/E1 + (1 - nu2^2)/E2``.
    rms_roughness_um : float
        RMS roughness sigma of the sum surface [um].
    mean_slope : float
        Mean absolute slope |zeta| of the sum surface [-].

    Notes
    -----
    The sentence below eq. (11) swaps the names of roughness and slope; the dimensions settle it:
    only ``kbar |zeta|/sigma`` with sigma a length gives W/(m^2 K).
    """

    mean_conductivity_W_per_mK: float
    effective_modulus_N_per_mm2: float
    rms_roughness_um: float
    mean_slope: float

    def __post_init__(self) -> None:
        require_positive(
            mean_conductivity_W_per_mK=self.mean_conductivity_W_per_mK,
            effective_modulus_N_per_mm2=self.effective_modulus_N_per_mm2,
            rms_roughness_um=self.rms_roughness_um,
            mean_slope=self.mean_slope,
        )


def mikic_conductance(p: ArrayLike, surface: ContactSurface, *, C: float = 1.0) -> FloatArray:
    """Conductance of eq. (11) [W/(m^2 K)].

    ``h = C kbar |zeta|/sigma (p sqrt(2)/(Ebar |zeta|))^0.94``

    Parameters
    ----------
    p : array_like
        Contact pressure [N/mm^2], not negative.
    surface : ContactSurface
    C : float
        Constant [-], to be identified by experiment.
    """
    slope = surface.mean_slope
    per_length = surface.mean_conductivity_W_per_mK * slope / (surface.rms_roughness_um * 1e-6)
    load = np.asarray(p, dtype=float) * np.sqrt(2.0) / (surface.effective_modulus_N_per_mm2 * slope)
    return C * per_length * np.maximum(load, 0.0) ** 0.94


def mikic_constant(h: float, p: float, surface: ContactSurface) -> float:
    """Constant C of eq. (11) [-] from a conductance h [W/(m^2 K)] identified at p [N/mm^2]."""
    require_positive(h=h, p=p)
    return float(h / mikic_conductance(p, surface))
