"""Errors and shares of balances, whatever the sign of what was put in."""

import pytest

from fem.stepping.balance import balance_error, share


@pytest.mark.parametrize(
    ("put_in", "found", "created", "error"),
    [
        (10.0, (6.0, 3.9), 0.0, 0.01),
        (-10.0, (-6.0, -3.9), 0.0, 0.01),
        (0.0, (2.0, 0.0), 0.0, 1.0),  # found without being put in
        (2.0, (0.0,), 0.0, 1.0),
        (-5.0, (-5.0,), 5.0, 1.0),  # balanced, but of nothing
        (1.0, (50.0, 49.0), 0.0, 98.0 / 99.0),
        (0.0, (), 0.0, 0.0),
    ],
)
def test_the_error_is_relative_to_what_was_turned_over(put_in, found, created, error):
    assert balance_error(put_in, *found, created=created) == pytest.approx(error)


@pytest.mark.parametrize(
    ("part", "whole", "expected"), [(1.0, 4.0, 0.25), (1.0, -4.0, 0.25), (1.0, 0.0, 1.0), (0, 0, 0)]
)
def test_a_share_is_of_the_size_of_the_whole(part, whole, expected):
    assert share(part, whole) == expected
