"""Measurements: reading them, comparing the simulation with them."""
