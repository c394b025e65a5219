"""Fits of hyperelastic energies to stress-stretch tests."""

from calibration.rubber.cycles import last_full_cycle
from calibration.rubber.hyperelastic import (
    CHOICES,
    compare_models,
    completed_rubber,
    fit_hyperelastic,
)
from calibration.rubber.stress_checks import (
    STRESS,
    check_modulus,
    check_points,
    check_sign,
    check_zero,
    fitted_energy,
)
from calibration.rubber.stress_data import (
    StressData,
    read_stress_table,
    select_data,
    stress_points,
)
from calibration.rubber.stress_models import STRESS_MODELS, Kinematics, StressModel
from calibration.rubber.stress_zero import Zero
