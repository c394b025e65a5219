"""The least-squares core that all fits share, and the parameter file they write."""

from calibration.fitting.core import FitResult, Loss, fit, refuse_no_fit
from calibration.fitting.minimum import column_sizes, evenly_spread, minimise
from calibration.fitting.parameter_file import parameter_text
from calibration.fitting.problem import Problem
from calibration.fitting.progress import stage, watched
from calibration.fitting.stability import Stability, check_stability
