"""The T_max rule and A_T on made-up profiles with known answers."""

from __future__ import annotations

import numpy as np
import pytest

from fem.results.surface_profile import excess_area, interior_peak

X = np.linspace(0.0, 20.0, 401)
HUMP = 20.0 + 28.0 * np.exp(-(((X - 9.0) / 5.0) ** 2))
EDGE = 60.0 * np.exp(-(((X - 19.6) / 0.6) ** 2))


def plateau(ramp: float = 2.0) -> np.ndarray:
    """45 C with a ramp down to 20 C at both ends."""
    return 20.0 + 25.0 * np.clip(np.minimum(X, 20.0 - X) / ramp, 0.0, 1.0)


def test_front_edge_peak_is_left_out_and_reported():
    found = interior_peak(X, HUMP + EDGE)
    assert found.T_max_C == pytest.approx(48.0, abs=1e-3)
    assert found.X_of_peak_mm == pytest.approx(9.0, abs=0.05)
    assert found.T_edge_C == pytest.approx((HUMP + EDGE)[392], abs=0.2)


def test_without_front_edge_peak_the_whole_surface_counts():
    found = interior_peak(X, HUMP)
    assert found.T_max_C == HUMP.max()
    assert found.T_edge_C == HUMP[-1]


def test_low_front_edge_peak_is_reported_although_the_interior_is_hotter():
    low = 15.0 * np.exp(-(((X - 19.6) / 0.6) ** 2))
    found = interior_peak(X, HUMP + low)
    assert found.T_max_C == pytest.approx(48.0, abs=1e-3)
    assert found.T_edge_C == pytest.approx((HUMP + low)[X > 18].max())


def test_profile_that_falls_towards_the_front_has_its_maximum_at_the_rear():
    falling = 50.0 - X
    found = interior_peak(X, falling)
    assert found == (50.0, 30.0, 0.0)


def test_profile_that_rises_towards_the_front_leaves_out_the_leading_fifth():
    rising = 20.0 + X
    found = interior_peak(X, rising)
    assert found.T_edge_C == 40.0
    assert found.T_max_C == pytest.approx(36.0, abs=0.1)


def test_peak_that_runs_out_into_a_plateau_gives_the_plateau():
    profile = np.where(X < 2.0, 20.0 + 12.5 * X, 45.0) + EDGE
    found = interior_peak(X, profile)
    assert found.T_max_C == pytest.approx(45.0, abs=1e-6)
    assert found.T_edge_C > 100.0


def test_plateau_without_edge_peak_gives_the_plateau():
    assert interior_peak(X, plateau()).T_max_C == 45.0


def test_detached_valley_separates_a_wide_front_peak():
    # Interior contact up to X = 11, detached and cool to 17, rolled front edge beyond.
    profile = np.interp(X, [0, 3, 9, 11, 13, 16, 18, 20], [25, 40, 44, 48, 30, 31, 90, 140])
    found = interior_peak(X, profile)
    assert found.T_max_C == pytest.approx(48.0)
    assert found.X_of_peak_mm == pytest.approx(11.0)
    assert found.T_edge_C == 140.0


def test_interior_maximum_inside_the_leading_fifth_is_kept_when_a_valley_follows():
    profile = np.interp(X, [0, 16.5, 18, 20], [25, 45, 30, 80])
    assert interior_peak(X, profile).T_max_C == pytest.approx(45.0)


def test_low_edge_peak_beside_a_hotter_flank_of_the_interior_is_found():
    # As in the first millimetres of a slide: the interior reaches into the leading fifth.
    profile = np.interp(X, [0, 4, 6, 18.2, 19.2, 19.6, 20], [20, 21, 32, 30.7, 25, 29, 26.5])
    found = interior_peak(X, profile)
    assert found.T_max_C == 32.0
    assert found.T_edge_C == pytest.approx(29.0, abs=0.1)


@pytest.mark.parametrize("peaks", [(90.0, 100.0), (100.0, 90.0)])
def test_front_edge_with_two_peaks_is_left_out_as_a_whole(peaks):
    profile = np.interp(X, [0, 3, 14, 16, 18.5, 19.2, 20], [25, 44, 45, 30, peaks[0], 60, peaks[1]])
    found = interior_peak(X, profile)
    assert found.T_max_C == pytest.approx(45.0)
    assert found.T_edge_C == 100.0


def test_two_interior_humps_are_no_front_edge_peak():
    profile = np.interp(X, [0, 5, 12.5, 15, 20], [25, 44, 38, 47, 21])
    assert interior_peak(X, profile) == (47.0, 21.0, 15.0)


@pytest.mark.parametrize("seed", range(20))
def test_measuring_noise_shifts_the_maximum_by_no_more_than_the_noise(seed):
    noise = np.random.default_rng(seed).normal(0.0, 0.4, X.size)
    for clean in (HUMP, HUMP + EDGE, plateau()):
        exact = interior_peak(X, clean).T_max_C
        assert interior_peak(X, clean + noise).T_max_C == pytest.approx(exact, abs=1.6)


@pytest.mark.parametrize("offset, scale", [(0.0, 0.1), (-15.0, 1.0), (100.0, 3.0)])
def test_rule_does_not_depend_on_level_and_scale_of_the_temperatures(offset, scale):
    base = interior_peak(X, HUMP + EDGE)
    moved = interior_peak(X, offset + scale * (HUMP + EDGE))
    assert moved.T_max_C == pytest.approx(offset + scale * base.T_max_C)
    assert moved.X_of_peak_mm == base.X_of_peak_mm


def test_uniform_temperature_is_its_own_maximum():
    assert interior_peak(X, np.full_like(X, 20.0))[:2] == (20.0, 20.0)


def test_unequally_spaced_points_give_the_same_peak():
    graded = 20.0 * (1.0 - np.linspace(1.0, 0.0, 200) ** 2)
    profile = np.interp(graded, X, HUMP + EDGE)
    assert interior_peak(graded, profile).T_max_C == pytest.approx(48.0, abs=0.1)


def test_excess_area_of_a_triangle():
    triangle = 20.0 + 10.0 * np.clip(1.0 - np.abs(X - 10.0) / 5.0, 0.0, None)
    assert excess_area(X, triangle, 20.0) == pytest.approx(50.0, rel=1e-12)


def test_excess_area_counts_cooling_as_negative():
    assert excess_area([0.0, 4.0, 20.0], [18.0, 18.0, 18.0], 20.0) == pytest.approx(-40.0)


@pytest.mark.parametrize(
    "X_mm, T_C, words",
    [
        ([0.0, 1.0, 1.0], [1.0, 2.0, 3.0], "must increase"),
        ([2.0, 1.0, 0.0], [1.0, 2.0, 3.0], "must increase"),
        ([0.0, 1.0], [1.0, 2.0, 3.0], "same length"),
        ([0.0], [1.0], "at least 2"),
        ([0.0, 1.0, 2.0], [1.0, float("nan"), 3.0], "finite"),
    ],
)
def test_a_profile_that_is_none_is_refused_in_words(X_mm, T_C, words):
    with pytest.raises(ValueError, match=words):
        interior_peak(X_mm, T_C)
    with pytest.raises(ValueError, match=words):
        excess_area(X_mm, T_C, 20.0)


def test_a_cold_corner_in_front_of_the_front_peak_does_not_hide_the_valley_behind_it():
    X = np.array([0.0, 4.0, 6.0, 10.0, 14.0, 16.0, 17.0, 18.0, 18.6, 19.2, 20.0])
    T = np.array([20.0, 22.0, 26.0, 26.1, 26.0, 25.8, 24.0, 28.4, 27.0, 20.5, 24.0])
    peak = interior_peak(X, T)
    assert peak.T_max_C == 26.1
    assert peak.X_of_peak_mm == 10.0
    assert peak.T_edge_C == 28.4
