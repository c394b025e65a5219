"""Identification of the gap conductance from the static heating test."""

from calibration.conductance.fit import (
    ALSO,
    CONDUCTANCE,
    HeatingRecord,
    RigPrediction,
    conductance_constant,
    fit_conductance,
    read_heating_record,
    synthetic_heating_record,
)
from calibration.conductance.heating_rig import HeatingRig, RigModel
from calibration.conductance.rig_file import read_contact_surface, read_heating_rig
