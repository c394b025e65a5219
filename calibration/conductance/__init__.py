"""Identification of the gap conductance from the static heating test."""
