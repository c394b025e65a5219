"""Contact: friction laws, gap conductance, heat partition, contact with road and rubber."""

from contact.conductance import GapConductance
from contact.friction import (
    CoulombFriction,
    ExponentialFriction,
    FrictionLaw,
    HuemerFriction,
    ThermalFriction,
    shifted,
)
from contact.partition import HeatPartition
from contact.wear import EnergyWear

__all__ = [
    "CoulombFriction",
    "EnergyWear",
    "ExponentialFriction",
    "FrictionLaw",
    "GapConductance",
    "HeatPartition",
    "HuemerFriction",
    "ThermalFriction",
    "shifted",
]
