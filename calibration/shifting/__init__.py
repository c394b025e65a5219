"""Frequency sweeps and the master curve that they are shifted onto."""

from calibration.shifting.frequency_sweeps import (
    LOSS,
    MODULUS,
    TAN_DELTA,
    is_sweep_table,
    one_sweep,
)
from calibration.shifting.master_curve import MasterCurve, Vertical, shift_sweeps
