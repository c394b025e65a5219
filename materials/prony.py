"""Spectrum of relaxation times of a rubber.

References
----------
.. [1] Ferry, J. D., Viscoelastic Properties of Polymers, 3rd ed. (1980), chapters 3 and 11.
"""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import FloatArray
from materials.checks import require_finite, require_positive
from materials.wlf import WLF

Moduli = Literal["long-term", "instantaneous"]
MODULI: tuple[str, ...] = get_args(Moduli)


@dataclass(frozen=True, kw_only=True)
class Prony:
    """Branches of a generalised Maxwell model beside an elastic law of shear modulus G_0.

    Parameters
    ----------
    g : sequence of float
        Moduli of the branches over G_0 [-].
    tau_s : sequence of float
        Relaxation times [s], at the reference temperature.
    moduli : {"long-term", "instantaneous"}
        What the constants of the elastic law come from: slow tests, so that the branches come on
        top of it, or very fast ones, so that the slow part is ``1 - sum g`` of it.
    shift : WLF or None
        Shift of the relaxation times with temperature; None without.
    T_ref_C : float
        Temperature of the relaxation times [deg C], with a shift.

    Examples
    --------
    >>> spectrum = Prony(g=[0.5, 0.25], tau_s=[0.01, 1.0])
    >>> float(spectrum.relaxation(0.0)), round(float(spectrum.relaxation(100.0)), 6)
    (1.75, 1.0)
    """

    g: tuple[float, ...]
    tau_s: tuple[float, ...]
    moduli: Moduli = "long-term"
    shift: WLF | None = None
    T_ref_C: float = 20.0

    def __post_init__(self) -> None:
        for name in ("g", "tau_s"):
            values = getattr(self, name)
            if isinstance(values, str) or not np.iterable(values):
                raise ValueError(f"{name} is {values!r}; expected a list of numbers")
            object.__setattr__(self, name, tuple(_plain(value) for value in values))
        if len(self.g) != len(self.tau_s) or not self.g:
            raise ValueError(
                f"g has {len(self.g)} and tau_s {len(self.tau_s)} entries; "
                "expected as many of each, and one at least"
            )
        for name in ("g", "tau_s"):
            for i, value in enumerate(getattr(self, name), 1):
                require_positive(**{f"{name}[{i}]": value})
        require_finite(T_ref_C=self.T_ref_C)
        if self.moduli not in MODULI:
            raise ValueError(f"moduli is {self.moduli!r}; expected one of {', '.join(MODULI)}")
        if self.moduli == "instantaneous" and sum(self.g) >= 1.0:
            raise ValueError(
                f"the sum of g is {sum(self.g):g}; expected less than 1 of instantaneous moduli"
            )

    @property
    def slow_share(self) -> float:
        """Share of the elastic law that is left after an infinite time [-]."""
        return 1.0 if self.moduli == "long-term" else 1.0 - sum(self.g)

    def shift_factor(self, T_C: ArrayLike | None) -> FloatArray:
        """Factor a_T of the relaxation times [-]; 1 where no temperature or no shift is given."""
        if T_C is None or self.shift is None:
            return np.array(1.0)
        return np.asarray(10.0 ** self.shift.log10_shift_factor(T_C, self.T_ref_C))

    def relaxation(self, time_s: ArrayLike) -> FloatArray:
        """Shear modulus over G_0 at a time after a small step of strain [-] [1]_."""
        t = np.asarray(time_s, dtype=float)[..., None]
        return np.asarray(self.slow_share + np.sum(self.g * np.exp(-t / self.tau_s), axis=-1))

    def harmonic_moduli(self, omega_rad_per_s: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Storage and loss modulus over G_0 at small harmonic strains [-] [1]_.

        Parameters
        ----------
        omega_rad_per_s : array_like
            Angular frequency [rad/s].
        """
        x = np.asarray(omega_rad_per_s, dtype=float)[..., None] * np.asarray(self.tau_s)
        share = self.g / (1.0 + x * x)
        return self.slow_share + np.sum(share * x * x, axis=-1), np.sum(share * x, axis=-1)


def _plain(value: object) -> object:
    """A number of numpy as one of Python, so that it is checked and written as such."""
    return value.item() if isinstance(value, np.generic) else value
