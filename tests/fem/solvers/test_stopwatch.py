"""Time of the blocks it runs in, and of nothing else."""

import time

import pytest

from fem.solvers.stopwatch import Stopwatch

PAUSE_S = 0.02


def test_only_the_time_inside_the_blocks_is_added_up():
    watch = Stopwatch()
    for _ in range(2):
        with watch:
            time.sleep(PAUSE_S)
    inside = watch.seconds
    time.sleep(PAUSE_S)
    assert watch.seconds == inside
    assert inside >= 2.0 * PAUSE_S


def test_a_block_that_an_error_ends_counts_and_the_error_goes_on():
    watch = Stopwatch()

    def failing():
        with watch:
            time.sleep(PAUSE_S)
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        failing()
    assert watch.seconds >= PAUSE_S
