"""Stationary heat flow through layers in series (any textbook of heat transfer, e.g. F. P.
Incropera, D. P. DeWitt: Fundamentals of Heat and Mass Transfer, section 3.1)."""

from __future__ import annotations

import numpy as np


def interface_temperatures(hot, cold, resistances):
    """Temperatures at the ends of the layers, from hot to cold; resistances per unit area."""
    flux = (hot - cold) / np.sum(resistances)
    return hot - flux * np.concatenate([[0.0], np.cumsum(resistances)]), flux
