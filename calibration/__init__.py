"""Calibration: from measured tables to parameters with their uncertainty."""

from calibration.errors import DataError
from calibration.fit_core import FitResult
from calibration.friction import compare_laws, fit_friction
from calibration.hyperelastic import compare_models, fit_hyperelastic
from calibration.master_curve import shift_sweeps
from calibration.wlf import fit_wlf

__all__ = [
    "DataError",
    "FitResult",
    "compare_laws",
    "compare_models",
    "fit_friction",
    "fit_hyperelastic",
    "fit_wlf",
    "shift_sweeps",
]
