"""Fits of what rubber remembers: relaxation times and softening."""

from calibration.memory.fit import fit_viscoelastic, read_memory
from calibration.memory.histories import Histories, read_histories
from calibration.memory.mullins import fit_mullins
from calibration.memory.sweeps import Moduli
