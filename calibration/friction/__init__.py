"""Fits of friction laws to measured coefficients."""
