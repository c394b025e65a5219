"""Thermal properties of the bodies in contact (Table 3 of the paper).

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications", Table 3.
"""

from dataclasses import dataclass

from materials.checks import require_positive
from materials.units import KG_PER_M3, KJ_PER_KG_K


@dataclass(frozen=True, kw_only=True)
class ThermalProperties:
    """Thermal properties in the internal units (N, mm, s, tonne, K).

    Parameters
    ----------
    conductivity : float
        Thermal conductivity k [N/(s K)]; equal in number to W/(m K).
    density : float
        Density rho [t/mm^3]; 1 kg/m^3 = 1e-12 t/mm^3.
    specific_heat : float
        Specific heat c [mJ/(t K)]; 1 kJ/(kg K) = 1e9 mJ/(t K).

    Examples
    --------
    >>> from materials import RUBBER
    >>> round(RUBBER.diffusivity, 4)  # mm²/s
    0.1623
    """

    conductivity: float
    density: float
    specific_heat: float

    def __post_init__(self) -> None:
        require_positive(
            conductivity=self.conductivity,
            density=self.density,
            specific_heat=self.specific_heat,
        )

    @classmethod
    def from_paper_units(
        cls,
        conductivity_W_per_mK: float,
        density_kg_per_m3: float,
        specific_heat_kJ_per_kgK: float,
    ) -> "ThermalProperties":
        """Properties from the units of Table 3."""
        return cls(
            conductivity=conductivity_W_per_mK,
            density=density_kg_per_m3 * KG_PER_M3,
            specific_heat=specific_heat_kJ_per_kgK * KJ_PER_KG_K,
        )

    @property
    def heat_capacity(self) -> float:
        """Volumetric heat capacity rho c [N/(mm^2 K)]."""
        return self.density * self.specific_heat

    @property
    def diffusivity(self) -> float:
        """Thermal diffusivity k/(rho c) [mm^2/s]."""
        return self.conductivity / self.heat_capacity

    @property
    def effusivity(self) -> float:
        """Thermal effusivity sqrt(k rho c) [N/(mm s^0.5 K)]."""
        return float((self.conductivity * self.heat_capacity) ** 0.5)


RUBBER = ThermalProperties.from_paper_units(0.284, 1207.0, 1.45)
ASPHALT = ThermalProperties.from_paper_units(0.70, 2000.0, 0.92)
