"""Ranges, orders and correlations of numbers from several runs."""

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import ArrayLike
from scipy.stats import spearmanr

from fem.results import Result

#: Smallest of Spearman's rank correlations of six pairs that is significant at the 5 % level (two
#: sides, from all 720 orders, which a test counts), less what rounding may take.
CRITICAL_RANK_CORRELATION = 31.0 / 35.0 - 1e-9


def number(result: Result, key: str) -> float:
    """A number of a run's summary."""
    return float(result.summary[key])


def numbers(results: Iterable[Result], key: str) -> list[float]:
    """The same number of several runs."""
    return [number(result, key) for result in results]


def ends(values: Iterable[float]) -> tuple[float, float]:
    """Smallest and largest value.

    Examples
    --------
    >>> ends([3.0, 1.0, 2.0])
    (1.0, 3.0)
    """
    found = list(values)
    return min(found), max(found)


def names_at_ends(values: Mapping[str, float]) -> tuple[str, str]:
    """Names of the smallest and of the largest value."""
    return min(values, key=values.__getitem__), max(values, key=values.__getitem__)


def relative_range(values: Iterable[float]) -> float:
    """Largest minus smallest value over the mean of the sizes [-].

    Examples
    --------
    >>> relative_range([-3.0, -1.0])
    1.0
    """
    found = list(values)
    return (max(found) - min(found)) / (sum(abs(value) for value in found) / len(found))


def rank_correlation(a: ArrayLike, b: ArrayLike) -> float:
    """Spearman's rank correlation; 0 where one of the two does not vary.

    Examples
    --------
    >>> round(rank_correlation([1.0, 2.0, 5.0], [9.0, 4.0, 1.0]), 9)
    -1.0
    >>> rank_correlation([1.0, 2.0], [3.0, 3.0])
    0.0
    """
    if np.ptp(a) == 0.0 or np.ptp(b) == 0.0:
        return 0.0
    return float(spearmanr(a, b).statistic)
