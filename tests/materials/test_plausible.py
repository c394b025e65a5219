"""Ranges of quantities: what is impossible, what is unusual, and which unit it looks like."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from materials import plausible
from materials.plausible import (
    BLOCK_SIZE,
    COLUMNS,
    FRICTION,
    POSITION,
    PRESSURE,
    SPEED,
    START_TEMPERATURE,
    TEMPERATURE,
    Quantity,
    judge,
)

QUANTITIES = {name: value for name, value in vars(plausible).items() if isinstance(value, Quantity)}


@pytest.mark.parametrize(
    "values, quantity, index, likely",
    [
        ([20.0, 293.15], TEMPERATURE, 1, "kelvin (20 deg C)"),
        ([273.15, 293.15], TEMPERATURE, 0, "kelvin (0 deg C)"),
        ([32.0, 140.0, 284.0], TEMPERATURE, 2, "Fahrenheit (140 deg C)"),
        ([293.0], START_TEMPERATURE, 0, "kelvin (19.85 deg C)"),
        ([0.1, 300.0], PRESSURE, 1, "kPa (0.3 N/mm^2)"),
        ([3e5], PRESSURE, 0, "Pa (0.3 N/mm^2)"),
        ([0.9, 92.0], FRICTION, 1, "per cent (0.92)"),
        ([-0.1, 0.9], FRICTION, 0, ""),
        ([3e5], SPEED, 0, ""),
    ],
)
def test_impossible_numbers_are_found_with_the_unit_they_look_like(values, quantity, index, likely):
    finding = judge(values, quantity)
    assert finding is not None
    assert finding.impossible
    assert (finding.index, finding.value) == (index, values[index])
    assert likely in finding.likely
    assert bool(finding.likely) == bool(likely)


@pytest.mark.parametrize(
    "values, quantity, count, likely",
    [
        ([213.15, 223.15, 248.15], TEMPERATURE, 3, "kelvin (-60 deg C)"),
        (68.0, START_TEMPERATURE, 1, "Fahrenheit (20 deg C)"),
        ([1.0, 2.0, 3.0], PRESSURE, 2, "bar (0.2 N/mm^2)"),
        ([0.01, 0.3], SPEED, 1, "m/s (300 mm/s)"),
        ([-0.3], SPEED, 1, "m/s (-300 mm/s)"),
        ([0.0, 0.01, 0.02], POSITION, 1, "metres (20 mm)"),
    ],
)
def test_unusual_numbers_are_possible_but_said(values, quantity, count, likely):
    finding = judge(values, quantity)
    assert finding is not None
    assert not finding.impossible
    assert finding.count == count
    assert likely in finding.sentence


def test_slow_speeds_beside_a_fast_one_are_usual():
    assert judge([0.01, 0.3, 10.0], SPEED) is None


def test_nothing_is_said_of_nothing():
    assert judge([], PRESSURE) is None
    assert judge([np.nan, 0.3], PRESSURE) is None
    assert judge(0.0, FRICTION) is None


@pytest.mark.parametrize("name", QUANTITIES)
def test_usual_numbers_are_possible(name):
    quantity = QUANTITIES[name]
    low, high = quantity.usual
    assert quantity.possible[0] <= low < high <= quantity.possible[1]
    middle = np.sqrt(low * high) if low > 0.0 else 0.5 * (max(low, 0.0) + high)
    assert judge([middle], quantity) is None


@pytest.mark.parametrize("name", QUANTITIES)
def test_infinite_numbers_are_impossible(name):
    for number in (np.inf, -np.inf):
        finding = judge([number], QUANTITIES[name])
        assert finding is not None
        assert finding.impossible


@pytest.mark.parametrize("column", COLUMNS)
def test_names_of_columns_end_in_the_unit_of_their_quantity(column):
    units = {"deg C": "_C", "N/mm^2": "_N_per_mm2", "mm/s": "_mm_per_s", "mm": "_mm", "s": "_s"}
    ending = units.get(COLUMNS[column].unit)
    assert ending is None or column.endswith(ending)


@pytest.mark.parametrize("value", [1e308, -1e308])
def test_numbers_near_the_largest_there_is_are_refused_without_a_warning(value):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        finding = judge(np.array([value]), BLOCK_SIZE)
    assert finding is not None
    assert finding.impossible
