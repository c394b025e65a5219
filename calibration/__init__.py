"""Calibration: from measured tables to parameters with their uncertainty."""

from calibration.data.errors import DataError
from calibration.fitting.core import FitResult
from calibration.friction.fit import compare_laws, fit_friction
from calibration.memory.fit import fit_viscoelastic
from calibration.memory.mullins import fit_mullins
from calibration.rubber.hyperelastic import compare_models, fit_hyperelastic
from calibration.shifting.master_curve import shift_sweeps
from calibration.wlf import fit_wlf

__all__ = [
    "DataError",
    "FitResult",
    "compare_laws",
    "compare_models",
    "fit_friction",
    "fit_hyperelastic",
    "fit_mullins",
    "fit_viscoelastic",
    "fit_wlf",
    "shift_sweeps",
]
