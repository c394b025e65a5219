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
from contact.interface import InterfaceState
from contact.partition import HeatPartition
from contact.registry import FRICTION_LAWS, friction_law, parameter
from contact.wear import EnergyWear

__all__ = [
    "FRICTION_LAWS",
    "CoulombFriction",
    "EnergyWear",
    "ExponentialFriction",
    "FrictionLaw",
    "GapConductance",
    "HeatPartition",
    "HuemerFriction",
    "InterfaceState",
    "ThermalFriction",
    "friction_law",
    "parameter",
    "shifted",
]
