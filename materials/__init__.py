"""Materials: hyperelastic energies, thermal data, time-temperature shift, named compounds."""

from materials.compounds import COMPOUNDS, compound
from materials.hyperelastic import (
    MODES,
    ArrudaBoyce,
    EnergyDerivatives,
    Hyperelastic,
    MooneyRivlin,
    NeoHooke,
    VanDerWaals,
    Yeoh,
)
from materials.ogden import Ogden
from materials.thermal import ASPHALT, RUBBER, ThermalProperties
from materials.wlf import WLF

__all__ = [
    "ASPHALT",
    "COMPOUNDS",
    "MODES",
    "RUBBER",
    "WLF",
    "ArrudaBoyce",
    "EnergyDerivatives",
    "Hyperelastic",
    "MooneyRivlin",
    "NeoHooke",
    "Ogden",
    "ThermalProperties",
    "VanDerWaals",
    "Yeoh",
    "compound",
]
