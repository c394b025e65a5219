"""Friction coefficients as functions of contact pressure, sliding speed and temperature.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", eqs. (5)-(8), Table 2.
.. [2] Huemer, T. et al., Rubber friction on concrete and ice surfaces observed under different
   temperatures and surface conditions (2001).
.. [3] Dieterich, J. H., J. Geophys. Res. 84 (1979) 2161-2168: friction after a change of the speed.
.. [4] Ruina, A., J. Geophys. Res. 88 (1983) 10359-10370: state of the contact, its stability.
.. [5] Persson, B. N. J., J. Phys.: Condens. Matter 18 (2006) 7789-7823: rubber, contact regions of
   0.1 to 1 mm on asphalt.
.. [6] Persson, B. N. J., J. Phys.: Condens. Matter 23 (2011) 015003: rubber friction and tire
   dynamics, cold and hot branch.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from contact.interface import InterfaceState
from contact.registry import friction_law, parameter
from materials.arrays import FloatArray
from materials.checks import require_finite, require_not_negative, require_positive
from materials.wlf import WLF


@dataclass(frozen=True, kw_only=True)
class FrictionLaw(ABC):
    """Base of the laws of the friction coefficient.

    Parameters
    ----------
    p_min : float
        Floor of the pressure [N/mm^2]: below it the coefficient keeps its value at the floor.
    v_min : float
        Floor of the speed [mm/s]; the coefficient there is the limit of stick.

    Notes
    -----
    Both laws of the paper diverge weakly for p -> 0 and vanish for v -> 0, neither of which is
    meant; hence the floors. A law of one's own is a class below this with `_mu`, registered by
    `contact.registry.friction_law`.
    """

    p_min: float = 1e-3
    v_min: float = 1.0

    def __post_init__(self) -> None:
        require_positive(p_min=self.p_min, v_min=self.v_min)

    @abstractmethod
    def _mu(self, at: InterfaceState) -> FloatArray:
        """Coefficient [-] at pressures and speeds (arrays) that are at or above the floors."""

    def coefficient(self, p: ArrayLike, v: ArrayLike) -> FloatArray:
        """Friction coefficient [-] at pressure p [N/mm^2] and velocity v [mm/s] (broadcast)."""
        return self.at(InterfaceState(p=p, v=v))

    def at(self, state: InterfaceState) -> FloatArray:
        """Friction coefficient [-] at a state of the interface; the sign of v does not matter."""
        p, v = np.broadcast_arrays(
            np.asarray(state.p, dtype=float), np.asarray(state.v, dtype=float)
        )
        p, v = np.maximum(p, self.p_min), np.maximum(np.abs(v), self.v_min)
        return np.asarray(self._mu(replace(state, p=p, v=v)))


@friction_law("coulomb", label="Coulomb's law", fitted=False)
@dataclass(frozen=True, kw_only=True)
class CoulombFriction(FrictionLaw):
    """Constant coefficient, ``mu = constant``.

    Parameters
    ----------
    mu : float
        Friction coefficient [-].

    Examples
    --------
    >>> float(CoulombFriction(mu=0.3).coefficient(0.2, 50.0))
    0.3
    """

    mu: float = parameter("Coulomb's constant friction coefficient [-]", low=0.0)

    def __post_init__(self) -> None:
        super().__post_init__()
        require_not_negative(mu=self.mu)

    def _mu(self, at: InterfaceState) -> FloatArray:
        return np.full(np.shape(at.p), self.mu)


@friction_law("exponential", label="Exponential law (5)")
@dataclass(frozen=True, kw_only=True)
class ExponentialFriction(FrictionLaw):
    """Power law ``mu = A p^B v^C``, eq. (5).

    Parameters
    ----------
    A, B, C : float
        Constants for p in N/mm^2 and v in mm/s, with the paper's values for a winter tread
        compound on asphalt as defaults (Table 2).

    Examples
    --------
    >>> round(float(ExponentialFriction().coefficient(0.3, 300.0)), 3)
    0.973
    """

    A: float = parameter("exponential law, factor", 0.7064, low=1e-9)
    B: float = parameter(
        "exponential law, exponent of the pressure [-]", -0.0645, low=-5.0, high=5.0
    )
    C: float = parameter(
        "exponential law, exponent of the velocity [-]", 0.0425, low=-5.0, high=5.0
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        require_positive(A=self.A)
        require_finite(B=self.B, C=self.C)

    def _mu(self, at: InterfaceState) -> FloatArray:
        p, v = np.asarray(at.p), np.asarray(at.v)
        return self.A * p**self.B * v**self.C


@friction_law("huemer", label="Law by Huemer (6)")
@dataclass(frozen=True, kw_only=True)
class HuemerFriction(FrictionLaw):
    """Law of Huemer et al. [2]_, eq. (6), with a peak over the sliding speed.

    ``mu = (alpha p^(n-1) + beta)/(a + b v^(-1/m) + c v^(-2/m))``

    Parameters
    ----------
    alpha, beta, n, a, b, c : float
        Constants for p in N/mm^2 and v in mm/s (Table 2 as defaults).
    inverse_m : float
        The exponent 1/m [-].

    Notes
    -----
    Multiplying alpha, beta, a, b, c by one number changes nothing. For b < 0 < c the peak is at
    ``v = (-2 c/b)^m`` (26.5 mm/s for Table 2).

    Examples
    --------
    >>> round(float(HuemerFriction().coefficient(0.3, 300.0)), 3)
    0.906
    >>> round(HuemerFriction().peak_velocity, 1)  # mm/s
    26.5
    """

    alpha: float = parameter("Huemer, factor of p^(n-1)", 0.1399)
    beta: float = parameter("Huemer, pressure-independent part [-]", 0.4091)
    n: float = parameter(
        "Huemer, exponent of the pressure plus one [-]", 0.8680, low=-5.0, high=5.0
    )
    a: float = parameter("Huemer, denominator, constant [-]", 0.9203)
    b: float = parameter("Huemer, denominator, factor of v^(-1/m)", -1.1188)
    c: float = parameter("Huemer, denominator, factor of v^(-2/m)", 0.9677)
    inverse_m: float = parameter(
        "Huemer, 1/m, exponent of the velocity [-]", 0.1672, low=-5.0, high=5.0
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        require_finite(alpha=self.alpha, beta=self.beta, n=self.n, a=self.a, b=self.b, c=self.c)
        require_positive(inverse_m=self.inverse_m)
        if self._smallest_denominator() <= 0.0:
            raise ValueError(
                f"a = {self.a:g}, b = {self.b:g}, c = {self.c:g} make the denominator of Huemer's "
                "law vanish at some speed; expected a + b s + c s^2 > 0 for s = v^(-1/m)"
            )

    @property
    def peak_velocity(self) -> float:
        """Speed of the largest friction coefficient [mm/s]; NaN when there is none."""
        if self.b < 0.0 < self.c:
            return float((-2.0 * self.c / self.b) ** (1.0 / self.inverse_m))
        return float("nan")

    def _smallest_denominator(self) -> float:
        last = self.v_min**-self.inverse_m
        at = [0.0, last]
        if self.c > 0.0 and 0.0 < -self.b / (2.0 * self.c) < last:
            at.append(-self.b / (2.0 * self.c))
        # s = 0 is reached only for infinite speed, so a = 0 is refused as well
        return min(self.a + self.b * s + self.c * s * s for s in at)

    def _mu(self, at: InterfaceState) -> FloatArray:
        p, v = np.asarray(at.p), np.asarray(at.v)
        s = v**-self.inverse_m
        pressure_part = self.alpha * p ** (self.n - 1.0)
        numerator = pressure_part + self.beta
        inverse = 1.0 / (self.a + s * (self.b + s * self.c))
        return np.asarray(numerator * inverse)


@dataclass(frozen=True, kw_only=True)
class ThermalFriction:
    """A law mu(p, v) whose velocity is shifted by the temperature, eqs. (7)-(8).

    Parameters
    ----------
    law : FrictionLaw
        Law at the reference temperature.
    wlf : WLF or None
        Shift of the velocity; None leaves the law independent of temperature.
    T_ref_C : float
        Temperature at which the law was measured [deg C].
    memory_mm : float
        Slip over which the coefficient follows a change of the speed [mm]; 0: at once.
    heating_slip_mm : float
        Slip s_0 since touch-down over which contact spots become as hot as the surface [mm];
        0: they are so at once.

    Notes
    -----
    ``v_equ = v a_T(T)/a_T(T_ref)`` with T the rubber's local surface temperature: a hotter surface
    acts like a slower one. The law's floor of the speed applies to v_equ.

    With s_0, ``mu = mu_cold exp(-s/s_0) + mu_hot (1 - exp(-s/s_0))`` of the slip s since
    touch-down [6]_: the law at the temperature that the surface had then, and at the present one.
    Where slip or that temperature are not known, the coefficient is the hot one.

    Examples
    --------
    >>> from materials import WLF
    >>> law = ThermalFriction(law=HuemerFriction(), wlf=WLF())
    >>> [round(float(mu), 3) for mu in law.coefficient(0.3, 300.0, [20.0, 50.0])]
    [0.906, 0.769]
    """

    law: FrictionLaw
    wlf: WLF | None = None
    T_ref_C: float = 20.0
    memory_mm: float = 0.0
    heating_slip_mm: float = 0.0

    def __post_init__(self) -> None:
        require_finite(T_ref_C=self.T_ref_C)
        require_not_negative(memory_mm=self.memory_mm, heating_slip_mm=self.heating_slip_mm)

    def remembered(self, v_before: ArrayLike, v: ArrayLike, slip: ArrayLike) -> FloatArray:
        """Speed that the coefficient knows of after a slip at the speed v [mm/s].

        A law mu(v) is measured at constant speed. After a change of the speed the coefficient
        follows while the contact spots are renewed, over a slip D of their size [3]_, [4]_, [5]_:
        ``dv_m/ds = (v - v_m)/D``, solved exactly for the speed of the step.

        Parameters
        ----------
        v_before, v : array_like
            Remembered speed before the slip, and the speed of the slip [mm/s].
        slip : array_like
            Slip, whose sign does not matter [mm].
        """
        v_before, v = np.asarray(v_before, dtype=float), np.asarray(v, dtype=float)
        if self.memory_mm == 0.0:
            return v
        return v + (v_before - v) * np.exp(-np.abs(slip) / self.memory_mm)

    def coefficient(self, p: ArrayLike, v: ArrayLike, T_C: ArrayLike) -> FloatArray:
        """Friction coefficient [-] at p [N/mm^2], v [mm/s] and T_C [deg C] (broadcast)."""
        return self.at(InterfaceState(p=p, v=v, T_C=T_C))

    def at(self, state: InterfaceState) -> FloatArray:
        """Friction coefficient [-] at a state of the interface."""
        hot = self._shifted(state)
        if self.heating_slip_mm == 0.0:
            return hot
        cold = self._shifted(replace(state, T_C=state.T_before_C))
        left = np.exp(-np.asarray(state.slip, dtype=float) / self.heating_slip_mm)
        known = np.isfinite(left) & np.isfinite(np.asarray(state.T_before_C, dtype=float))
        return np.asarray(np.where(known, hot + (cold - hot) * left, hot))

    def _shifted(self, state: InterfaceState) -> FloatArray:
        """The law at the velocity that the temperature of the rubber makes of that of the state."""
        p, v, T = np.broadcast_arrays(
            np.asarray(state.p, dtype=float),
            np.asarray(state.v, dtype=float),
            np.asarray(state.T_C, dtype=float),
        )
        if self.wlf is not None:
            v = v * self.wlf.equivalent_velocity(1.0, T, self.T_ref_C)
        return self.law.at(replace(state, p=p, v=v))


def shifted(law: FrictionLaw, wlf: WLF | None, T_ref_C: float = 20.0) -> ThermalFriction:
    """Law with its velocity shifted by the temperature (see `ThermalFriction`).

    Examples
    --------
    >>> from materials import WLF
    >>> round(float(shifted(ExponentialFriction(), WLF()).coefficient(0.3, 300.0, 50.0)), 3)
    0.769
    """
    return ThermalFriction(law=law, wlf=wlf, T_ref_C=T_ref_C)
