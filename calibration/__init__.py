"""Calibration: from measured tables to parameters with their uncertainty."""

from typing import TYPE_CHECKING

from fem.files import face

if TYPE_CHECKING:
    from calibration.commands import add_arguments
    from calibration.data import DataError
    from calibration.fitting import FitResult
    from calibration.friction import compare_laws, fit_friction
    from calibration.memory import fit_mullins, fit_viscoelastic
    from calibration.paper_tables import write_table1, write_table2
    from calibration.rubber import compare_models, fit_hyperelastic
    from calibration.shifting import shift_sweeps
    from calibration.synthetic import synthetic_bar_cycles, synthetic_dumbbell_cycles
    from calibration.wlf import fit_wlf
else:
    __getattr__ = face(__name__, __file__)
