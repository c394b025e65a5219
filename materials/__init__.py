"""Materials: hyperelastic energies, memory, thermal data, time-temperature shift, compounds."""

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
from materials.prony import Prony
from materials.rubber import Rubber
from materials.softening import OgdenRoxburgh
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
    "OgdenRoxburgh",
    "Prony",
    "Rubber",
    "ThermalProperties",
    "VanDerWaals",
    "Yeoh",
    "compound",
]
