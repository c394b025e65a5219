"""Measurements: reading them, comparing the simulation with them."""

from validation.measured.compare_command import write_comparison
from validation.measured.comparison_figures import draw_measured_profile
from validation.measured.measured_points import (
    MEASURED_MARK,
    draw_measured_points,
    measured_profiles,
    shared_legend,
)
from validation.measured.measurements import Measurements, read_measurements
