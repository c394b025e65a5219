"""Step lengths after easy, hard and failed steps, and landing on the end."""

from dataclasses import replace

import pytest

from fem.stepping.step_control import StepController, StepPlan, landed

CONTROL = StepController(step_max=1.0, step_min=1e-3)


def after(length, iterations, **plan):
    """Plan after an accepted step."""
    return CONTROL.accepted(StepPlan(step=length, **plan), length, iterations)


def without_more_help(length, **plan):
    """Plan after a failed step that has all the help there is."""
    return CONTROL.rejected(StepPlan(step=length, help=CONTROL.enough_help, **plan), length)


def test_an_easy_step_is_followed_by_a_longer_one():
    assert after(0.1, CONTROL.easy).step == pytest.approx(0.1 * CONTROL.growth)


def test_a_hard_step_is_followed_by_a_shorter_one():
    assert after(0.1, CONTROL.hard + 1).step == pytest.approx(0.1 * CONTROL.shrink)


def test_a_step_in_between_is_kept():
    assert after(0.1, CONTROL.easy + 1).step == 0.1


def test_steps_stay_within_their_bounds():
    assert after(0.9, 1).step == 1.0
    assert after(1.1e-3, CONTROL.hard + 1).step == 1e-3


def test_a_failed_step_gets_more_help_before_it_is_cut():
    plan, levels = StepPlan(step=0.5), []
    while plan.step == 0.5:
        levels.append(plan.help)
        plan = CONTROL.rejected(plan, 0.5)
    assert levels[:3] == [0.0, CONTROL.first_help, CONTROL.first_help * CONTROL.more_help]
    assert levels == sorted(levels)
    assert levels[-1] >= CONTROL.enough_help
    assert plan.step == 0.5 * CONTROL.cut
    assert plan.help == levels[-1] * CONTROL.more_help


def test_help_has_an_end_and_cuts_have_none():
    plan = StepPlan(step=1.0, help=CONTROL.most_help)
    assert CONTROL.rejected(plan, 1.0).help == CONTROL.most_help
    assert CONTROL.rejected(plan, 1.0).step == CONTROL.cut


def test_the_next_step_gets_the_help_that_is_left():
    plan = StepPlan(step=0.1, help=4.0)
    following = CONTROL.accepted(plan, 0.1, 3, help_left=0.5, rest=2)
    assert (following.help, following.rest) == (0.5, 2)
    assert CONTROL.accepted(plan, 0.1, 3).help == 0.0


def test_a_step_that_needed_none_gets_no_help():
    assert after(0.1, 3).help == 0.0


def test_a_failed_step_is_cut_until_it_is_exhausted():
    plan, cuts = StepPlan(step=1.0, help=CONTROL.enough_help), 0
    while not CONTROL.exhausted(plan):
        plan, cuts = CONTROL.rejected(plan, plan.step), cuts + 1
    assert plan.step < 1e-3
    assert 3 < cuts < 20


def test_repeated_growth_after_a_cut_recovers_the_step():
    plan = without_more_help(1.0)
    for _ in range(10):
        plan = CONTROL.accepted(plan, plan.step, 3)
    assert plan.step == 1.0


def test_a_cut_step_bounds_the_next_one_and_is_outgrown():
    plan, lengths = without_more_help(1.0), []
    assert plan.bound == CONTROL.caution
    while plan.step < 1.0:
        bound = plan.bound * CONTROL.recovery
        plan = CONTROL.accepted(plan, plan.step, 3)
        assert plan.step <= max(bound, CONTROL.step_min)
        lengths.append(plan.step)
    assert lengths == sorted(lengths)
    assert len(lengths) < 10


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


def test_help_where_cuts_have_led_nowhere_begins_at_the_first_length():
    control = replace(CONTROL, enough_help=0.0)  # cuts come before help
    plan = StepPlan(step=0.5)
    while not control.exhausted(plan):
        plan = control.rejected(plan, plan.step)
        assert plan.help == 0.0
    helped = control.helped(plan, 0.5)
    assert (helped.step, helped.help) == (0.5, control.first_help)
    assert control.rejected(helped, 0.5).help > helped.help
