"""The least-squares core: exact answers, uncertainty, identifiability."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import least_squares

from calibration.fitting.core import Problem, correlation_of, fit

X = np.linspace(0.0, 4.0, 60)


def line(observed, weights=None, linear=True, absolute=False):
    return Problem(
        absolute=absolute,
        names=("slope", "offset"),
        predict=lambda t: t[0] * X + t[1],
        jacobian=lambda t: np.stack([X, np.ones_like(X)], axis=1),
        observed=observed,
        weights=weights,
        lower=np.full(2, -np.inf),
        upper=np.full(2, np.inf),
        linear=linear,
    )


def decay(observed, jacobian=True):
    return Problem(
        names=("height", "rate"),
        predict=lambda t: t[0] * np.exp(-t[1] * X),
        jacobian=(lambda t: np.stack([np.exp(-t[1] * X), -t[0] * X * np.exp(-t[1] * X)], axis=1))
        if jacobian
        else None,
        observed=observed,
        lower=np.array([0.0, 0.0]),
        upper=np.array([10.0, 10.0]),
    )


def noise(sigma, seed=0):
    return np.random.default_rng(seed).normal(0.0, sigma, X.size)


@pytest.mark.parametrize("linear", [True, False])
def test_straight_line_matches_the_textbook(linear):
    y = 2.0 * X - 1.0 + noise(0.1)
    result = fit(line(y, linear=linear), np.zeros((1, 2)))
    slope, offset = np.polyfit(X, y, 1)
    assert result.values["slope"] == pytest.approx(slope, rel=1e-12)
    assert result.values["offset"] == pytest.approx(offset, rel=1e-12)
    s2 = np.sum((y - slope * X - offset) ** 2) / (X.size - 2)
    spread = np.sum((X - X.mean()) ** 2)
    assert result.stderr["slope"] == pytest.approx(np.sqrt(s2 / spread), rel=1e-10)
    covariance = -X.mean() * s2 / spread
    assert result.covariance[0, 1] == pytest.approx(covariance, rel=1e-10)
    assert result.r2 == pytest.approx(np.corrcoef(X, y)[0, 1] ** 2, rel=1e-12)


def test_known_deviations_alone_decide_the_uncertainty():
    y = 2.0 * X - 1.0 + noise(0.1)
    known = line(y, np.full(X.size, 1.0 / 0.3), absolute=True)
    result = fit(known, np.zeros((1, 2)))
    spread = np.sum((X - X.mean()) ** 2)
    assert result.stderr["slope"] == pytest.approx(0.3 / np.sqrt(spread), rel=1e-10)
    low, high = result.interval(0.95)["slope"]
    assert high - low == pytest.approx(2 * 1.959964 * result.stderr["slope"], rel=1e-6)
    assert result.profile("slope") == pytest.approx((low, high), rel=1e-6)


def test_known_deviations_give_errors_to_as_many_points_as_parameters():
    two = Problem(
        names=("slope", "offset"),
        predict=lambda t: t[0] * X[:2] + t[1],
        observed=np.array([1.0, 3.0]),
        weights=np.full(2, 2.0),
        lower=np.full(2, -np.inf),
        upper=np.full(2, np.inf),
        absolute=True,
    )
    result = fit(two, np.zeros((1, 2)))
    assert result.stderr["slope"] == pytest.approx(0.5 * np.sqrt(2.0) / X[1], rel=1e-5)


def test_student_interval_is_that_of_the_textbook():
    result = fit(line(2.0 * X + noise(0.1)), np.zeros((1, 2)))
    low, high = result.interval(0.95)["slope"]
    assert high - low == pytest.approx(2 * 2.001717 * result.stderr["slope"], rel=1e-6)


@pytest.mark.parametrize("jacobian", [True, False])
def test_nonlinear_parameters_come_back_without_noise(jacobian):
    y = 3.0 * np.exp(-0.7 * X)
    result = fit(decay(y, jacobian), np.array([[1.0, 0.1], [5.0, 5.0]]))
    assert result.values["height"] == pytest.approx(3.0, rel=1e-9)
    assert result.values["rate"] == pytest.approx(0.7, rel=1e-9)


def test_a_bad_start_does_not_hide_the_good_one():
    y = 3.0 * np.exp(-0.7 * X)
    starts = np.array([[np.nan, 1.0], [0.0, 10.0], [2.0, 0.5]])
    assert fit(decay(y), starts).values["rate"] == pytest.approx(0.7, rel=1e-9)


def test_profile_and_bootstrap_agree_with_the_covariance_of_a_linear_problem():
    result = fit(line(2.0 * X - 1.0 + noise(0.1)), np.zeros((1, 2)))
    wald = result.interval()["slope"]
    assert result.profile("slope") == pytest.approx(wald, rel=1e-6)
    boot = result.bootstrap(400)["slope"]
    width = wald[1] - wald[0]
    assert boot[0] == pytest.approx(wald[0], abs=0.2 * width)
    assert boot[1] == pytest.approx(wald[1], abs=0.2 * width)


def test_profile_of_a_curved_problem_is_lopsided_and_holds_the_truth():
    result = fit(decay(0.3 * np.exp(-0.7 * X) + noise(0.05)), np.array([[1.0, 0.5]]))
    low, high = result.profile("rate")
    assert low < 0.7 < high
    assert high - result.values["rate"] > 1.05 * (result.values["rate"] - low)


def test_standard_errors_that_a_tangent_does_not_justify_are_reported():
    def fitted(sigma):
        return fit(decay(0.3 * np.exp(-0.7 * X) + noise(sigma)), np.array([[1.0, 0.5]]))

    assert not [w for w in fitted(0.005).warnings if "tangent" in w]
    poor = fitted(0.1)
    assert [w for w in poor.warnings if "rate" in w and "tangent" in w]
    low, high = poor.profile("rate")
    wald = poor.interval()["rate"]
    assert high - poor.values["rate"] > 1.2 * (wald[1] - poor.values["rate"])
    assert low > wald[0]


def test_one_parameter_alone_is_fitted_and_judged():
    problem = decay(3.0 * np.exp(-0.7 * X) + noise(0.02))
    result = fit(problem, np.array([[1.0, 0.5]]), fixed={"height": 3.0})
    assert result.values["rate"] == pytest.approx(0.7, abs=4 * result.stderr["rate"])
    assert result.warnings == ()


def test_terms_that_may_change_places_come_out_in_one_order():
    def sum_of_decays(t):
        return t[0] * np.exp(-t[1] * X) + t[2] * np.exp(-t[3] * X)

    problem = Problem(
        names=("height1", "rate1", "height2", "rate2"),
        predict=sum_of_decays,
        observed=sum_of_decays([1.0, 0.3, 2.0, 3.0]) + noise(1e-4),
        lower=np.zeros(4),
        upper=np.full(4, 10.0),
        canonical=lambda t: t.reshape(2, 2)[np.argsort(-t[1::2])].ravel(),
    )
    for start in ([1.0, 0.1, 1.0, 5.0], [1.0, 5.0, 1.0, 0.1]):
        result = fit(problem, np.array([start]))
        assert result.theta == pytest.approx([2.0, 3.0, 1.0, 0.3], rel=1e-2)
        assert result.stderr["rate1"] > result.stderr["rate2"]


def test_singular_directions_are_named_and_have_no_finite_error():
    problem = Problem(
        names=("a", "b", "c"),
        predict=lambda t: (t[0] + t[1]) * X + t[2],
        jacobian=lambda t: np.stack([X, X, np.ones_like(X)], axis=1),
        observed=2.0 * X + noise(0.1),
        lower=np.full(3, -np.inf),
        upper=np.full(3, np.inf),
    )
    result = fit(problem, np.zeros((1, 3)))
    assert np.isinf(result.stderr["a"])
    assert np.isinf(result.stderr["b"])
    assert 0.0 < result.stderr["c"] < 0.1
    assert [w for w in result.warnings if "a is not determined" in w]


def test_strong_correlation_is_reported():
    x = X + 100.0
    problem = Problem(
        names=("slope", "offset"),
        predict=lambda t: t[0] * x + t[1],
        observed=x + noise(0.1),
        lower=np.full(2, -np.inf),
        upper=np.full(2, np.inf),
    )
    result = fit(problem, np.ones((1, 2)))
    assert [w for w in result.warnings if "slope and offset are correlated by -0.99" in w]
    assert result.correlation[0, 1] == pytest.approx(correlation_of(result.covariance)[0, 1])


def test_a_parameter_at_its_bound_is_reported_without_standard_error():
    result = fit(decay(np.full(X.size, 1.0) + 0.2 * X), np.array([[1.0, 0.5]]))
    assert result.values["rate"] == pytest.approx(0.0, abs=1e-6)
    assert np.isnan(result.stderr["rate"])
    assert np.isfinite(result.stderr["height"])
    assert [w for w in result.warnings if "rate" in w and "bound" in w]


def test_weights_act_like_repeated_points():
    y = 2.0 * X + noise(0.3)
    weights = np.ones_like(X)
    weights[:10] = np.sqrt(3.0)
    weighted = fit(line(y, weights), np.zeros((1, 2))).values
    slope, offset = np.polyfit(X, y, 1, w=weights)
    assert weighted == pytest.approx({"slope": slope, "offset": offset}, rel=1e-10)


def test_as_many_points_as_parameters_leave_no_standard_errors():
    problem = Problem(
        names=("slope", "offset"),
        predict=lambda t: t[0] * np.array([1.0, 2.0]) + t[1],
        observed=np.array([1.0, 3.0]),
        lower=np.full(2, -np.inf),
        upper=np.full(2, np.inf),
    )
    result = fit(problem, np.ones((1, 2)))
    assert np.all(np.isnan(result.covariance))
    assert [w for w in result.warnings if "leave nothing for standard errors" in w]


def test_fixing_everything_is_refused():
    with pytest.raises(ValueError, match="every parameter is fixed"):
        fit(line(X), np.zeros((1, 2)), fixed={"slope": 1.0, "offset": 0.0})


def many_points(n=30_000, seed=4):
    """An exponential with scatter on more points than the search and the stages look at."""
    t = np.linspace(0.0, 3.0, n)
    noise = np.random.default_rng(seed).normal(0.0, 0.05, n)

    def problem(rows):
        return Problem(
            names=("A", "k"),
            predict=lambda theta: theta[0] * np.exp(-theta[1] * t[rows]),
            jacobian=lambda theta: np.stack(
                [
                    np.exp(-theta[1] * t[rows]),
                    -theta[0] * t[rows] * np.exp(-theta[1] * t[rows]),
                ],
                axis=1,
            ),
            observed=(2.0 * np.exp(-0.7 * t) + noise)[rows],
            lower=np.array([1e-9, 0.0]),
            upper=np.array([np.inf, 10.0]),
            subset=problem,
        )

    return problem(np.arange(n))


def test_all_rows_of_a_large_table_count_to_the_last_digit():
    problem = many_points()
    found = fit(problem, np.array([[1.0, 0.1], [5.0, 3.0], [0.5, 2.0]]))
    other = least_squares(
        problem.residuals, [1.5, 0.5], jac=problem.slopes, xtol=1e-15, ftol=1e-15, gtol=1e-15
    )
    np.testing.assert_allclose(found.theta, other.x, rtol=1e-9)
    J = problem.slopes(found.theta)
    s2 = float(other.fun @ other.fun) / (len(other.fun) - 2)
    np.testing.assert_allclose(found.covariance, s2 * np.linalg.inv(J.T @ J), rtol=1e-6)
    assert found.warnings == ()


def test_a_bound_that_is_active_on_all_rows_stays_active():
    problem = replace(many_points(), lower=np.array([1e-9, 0.9]))  # the best k is 0.7
    found = fit(problem, np.array([[1.0, 1.1], [5.0, 3.0]]))
    assert found.values["k"] == pytest.approx(0.9, rel=1e-6)
    held = problem.fixed({"k": found.values["k"]})
    assert abs(float(held.slopes(found.theta[:1])[:, 0] @ held.residuals(found.theta[:1]))) < 1e-4


def test_looking_at_all_rows_takes_few_passes():
    problem, calls = many_points(), []
    counted = replace(
        problem,
        predict=lambda theta: calls.append(1) or problem.predict(theta),
        subset=problem.subset,
    )
    fit(counted, np.random.default_rng(2).uniform(0.1, 3.0, (20, 2)))
    assert len(calls) <= 12
