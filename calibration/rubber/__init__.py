"""Fits of hyperelastic energies to stress-stretch tests."""
