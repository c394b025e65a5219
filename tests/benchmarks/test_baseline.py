"""Work and cost of short runs against the committed baseline."""

import pytest

from tests.benchmarks.baseline import (
    count_margin,
    different_counts,
    measured_counts,
    read_baseline,
    worse_costs,
)
from tests.benchmarks.costs import measured_costs

ADVICE = "; if that is meant, `make bench-update` and commit the new baseline"
#: Measurements that all have to be worse. Other users of the machine disturb one of them; a slower
#: program all of them.
ATTEMPTS = 3


def test_counts_are_those_of_the_baseline(benchmark):
    baseline = read_baseline()
    found = benchmark.pedantic(measured_counts, rounds=1)
    different = different_counts(baseline["counts"], found, count_margin(baseline))
    assert not different, "\n".join(different) + ADVICE


def test_costs_are_no_worse_than_the_baseline(benchmark):
    expected = read_baseline()["costs"]

    def best():
        costs = measured_costs()
        for _ in range(ATTEMPTS - 1):
            if not worse_costs(expected, costs):
                break
            again = measured_costs()
            costs = {name: min(value, again[name]) for name, value in costs.items()}
        return costs

    found = benchmark.pedantic(best, rounds=1)
    benchmark.extra_info["costs"] = found
    assert not worse_costs(expected, found), "\n".join(worse_costs(expected, found)) + ADVICE


def test_one_iteration_more_or_less_is_reported():
    expected = {"run": {"newton_iterations": 100, "steps": 10}}
    assert not different_counts(expected, expected)
    for iterations in (99, 101):
        found = {"run": {"newton_iterations": iterations, "steps": 10}}
        assert different_counts(expected, found) == [f"run: newton_iterations 100 -> {iterations}"]
        assert not different_counts(expected, found, margin=0.1)


def test_a_missing_run_or_cost_is_reported():
    assert different_counts({"run": {"steps": 1}}, {}) == ["run: steps 1 -> None"]
    assert different_counts({}, {"run": {"steps": 1}}) == ["run: steps None -> 1"]
    assert worse_costs({"assembly": 0.4}, {}) == ["assembly 0.400 -> none"]
    assert worse_costs({}, {"assembly": 0.4}) == ["assembly none -> 0.400"]


@pytest.mark.parametrize(("cost", "worse"), [(0.1, False), (1.29, False), (1.31, True)])
def test_only_a_cost_above_its_margin_is_reported(cost, worse):
    assert bool(worse_costs({"assembly": 1.0}, {"assembly": cost}, margin=0.3)) is worse


def test_cost_that_is_not_a_number_is_reported():
    assert worse_costs({"assembly": 1.0}, {"assembly": float("nan")})
