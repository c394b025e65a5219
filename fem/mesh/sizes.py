"""Divisions of a line whose cells are small at some places and grow away from them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from materials.arrays import FloatArray

#: Samples of an interval for the integral of the number of cells.
SAMPLES = 400


@dataclass(frozen=True, kw_only=True)
class Fine:
    """A place with small cells.

    Attributes
    ----------
    at : float
        Coordinate [mm].
    size : float
        Size of the cells there [mm].
    growth : float
        Growth of the size per distance from there [-].
    """

    at: float
    size: float
    growth: float


def divided(fixed: Sequence[float], fine: Sequence[Fine]) -> FloatArray:
    """Coordinates that hold all fixed ones, with cells of the size that `fine` asks for between.

    Parameters
    ----------
    fixed : sequence of float
        Increasing coordinates, the ends among them [mm].
    fine : sequence of Fine
        Of several sizes at one place the smallest counts.

    Examples
    --------
    >>> divided([0.0, 1.0, 4.0], [Fine(at=0.0, size=0.5, growth=0.0)]).tolist()
    [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]
    """
    coordinates = [np.array([fixed[0]])]
    for start, stop in pairwise(fixed):
        x = np.linspace(start, stop, SAMPLES + 1)
        size = np.min([f.size + f.growth * np.abs(x - f.at) for f in fine], axis=0)
        rate = 1.0 / size
        steps = 0.5 * (rate[1:] + rate[:-1]) * np.diff(x)
        passed = np.concatenate([[0.0], np.cumsum(steps)])
        cells = max(1, round(passed[-1]))
        inner = np.interp(passed[-1] * np.arange(1, cells) / cells, passed, x)
        coordinates += [inner, np.array([stop])]
    return np.concatenate(coordinates)
