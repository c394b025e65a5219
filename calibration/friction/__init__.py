"""Fits of friction laws to measured coefficients."""

from calibration.friction.curves import forms
from calibration.friction.data import FrictionData, read_friction
from calibration.friction.fit import compare_laws, fit_friction
