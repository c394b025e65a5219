"""Step lengths after easy, hard and failed steps, and landing on the end."""

import pytest

from fem.step_control import StepController, landed

CONTROL = StepController(step_max=1.0, step_min=1e-3)


def test_an_easy_step_is_followed_by_a_longer_one():
    assert CONTROL.accepted(0.1, CONTROL.easy) == pytest.approx(0.1 * CONTROL.growth)


def test_a_hard_step_is_followed_by_a_shorter_one():
    assert CONTROL.accepted(0.1, CONTROL.hard + 1) == pytest.approx(0.1 * CONTROL.shrink)


def test_a_step_in_between_is_kept():
    assert CONTROL.accepted(0.1, CONTROL.easy + 1) == 0.1


def test_steps_stay_within_their_bounds():
    assert CONTROL.accepted(0.9, 1) == 1.0
    assert CONTROL.accepted(1.1e-3, CONTROL.hard + 1) == 1e-3


def test_a_failed_step_is_cut_until_it_is_exhausted():
    step, cuts = 1.0, 0
    while not CONTROL.exhausted(step):
        step, cuts = CONTROL.rejected(step), cuts + 1
    assert step < 1e-3
    assert 3 < cuts < 20


def test_repeated_growth_after_a_cut_recovers_the_step():
    step = CONTROL.rejected(1.0)
    for _ in range(10):
        step = CONTROL.accepted(step, 3)
    assert step == 1.0


def test_a_failed_step_bounds_the_next_ones():
    bound = CONTROL.caution * 1.0
    assert CONTROL.accepted(0.5, 3, bound) == bound
    assert CONTROL.accepted(0.1, 3, bound) == pytest.approx(0.1 * CONTROL.growth)
    assert CONTROL.accepted(1e-3, 3, 1e-4) == CONTROL.step_min


def test_the_bound_of_a_failed_step_is_outgrown():
    step, bound, lengths = CONTROL.rejected(1.0), CONTROL.caution * 1.0, []
    while step < 1.0:
        bound *= CONTROL.recovery
        step = CONTROL.accepted(step, 3, bound)
        lengths.append(step)
    assert lengths == sorted(lengths)
    assert 2 < len(lengths) < 10


@pytest.mark.parametrize("step", [0.3, 0.17, 1.0, 0.0999])
def test_landing_reaches_the_end_without_a_sliver(step):
    at, lengths = 0.0, []
    while at < 1.0:
        length = landed(at, step, 1.0)
        lengths.append(length)
        at = 1.0 if length == 1.0 - at else at + length
    assert at == 1.0
    assert sum(lengths) == pytest.approx(1.0, rel=1e-12)
    assert max(lengths) <= step * (1.0 + 1e-9)
    assert min(lengths) >= 0.5 * step * (1.0 - 1e-9)


def test_a_remainder_equal_to_the_step_up_to_rounding_is_done_in_one():
    assert landed(0.9, 0.1 * (1.0 - 1e-12), 1.0) == 1.0 - 0.9
