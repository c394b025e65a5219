"""Frequency sweeps and the master curve that they are shifted onto."""
