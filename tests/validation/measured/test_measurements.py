"""Measured files: T_max and A_T of made-up profiles with known answers, and refusals."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from calibration.data.errors import DataError
from fem.results.surface_profile import excess_area, interior_peak
from validation.measured.measurements import QUANTITIES, evaluated, read_measurements

EXAMPLES = Path(__file__).parents[3] / "examples" / "measurements"
X = np.linspace(0.0, 20.0, 401)
#: A triangle of 26 K height over 10 mm: T_max 46 C, A_T 130 K mm.
TRIANGLE = 20.0 + 26.0 * np.clip(1.0 - np.abs(X - 8.0) / 5.0, 0.0, None)
#: A front-edge peak of 60 K height over the last millimetre: 30 K mm.
EDGE = 60.0 * np.clip(X - 19.0, 0.0, None)


def profile_file(folder: Path, profiles: dict[str, np.ndarray], head: str = "", tail: str = ""):
    """Write profiles, each with the same extra entries."""
    lines = [f"run,x_mm,T_C{head}"]
    for run, T in profiles.items():
        lines += [f"{run},{x!r},{t!r}{tail}" for x, t in zip(X.tolist(), T.tolist(), strict=True)]
    path = folder / "profiles.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


def write(folder: Path, text: str) -> Path:
    path = folder / "measured.csv"
    path.write_text(text)
    return path


# -- profiles --------------------------------------------------------------------------------------


def test_T_max_and_A_T_of_a_triangle_are_exact(tmp_path):
    point = read_measurements(profile_file(tmp_path, {"a": TRIANGLE})).points.iloc[0]
    assert point["T_max_C"] == pytest.approx(46.0, rel=1e-12)
    assert point["A_T_K_mm"] == pytest.approx(130.0, rel=1e-12)


def test_front_edge_peak_counts_for_A_T_but_not_for_T_max(tmp_path):
    point = read_measurements(profile_file(tmp_path, {"a": TRIANGLE + EDGE})).points.iloc[0]
    assert (TRIANGLE + EDGE).max() == 80.0
    assert point["T_max_C"] == pytest.approx(46.0, rel=1e-12)
    assert point["A_T_K_mm"] == pytest.approx(130.0 + 30.0, rel=1e-12)


def test_starting_temperature_of_the_file_is_the_zero_of_A_T(tmp_path):
    path = profile_file(tmp_path, {"a": TRIANGLE}, ",T_0_C", ",18.0")
    point = read_measurements(path).points.iloc[0]
    assert point["A_T_K_mm"] == pytest.approx(130.0 + 2.0 * 20.0, rel=1e-12)
    assert point["T_max_C"] == pytest.approx(46.0, rel=1e-12)


def test_measured_and_simulated_profiles_are_judged_by_the_same_functions(tmp_path):
    profile = read_measurements(profile_file(tmp_path, {"a": TRIANGLE + EDGE})).profiles[0]
    assert evaluated(profile) == {
        "T_max_C": interior_peak(X, TRIANGLE + EDGE).T_max_C,
        "A_T_K_mm": excess_area(X, TRIANGLE + EDGE, 20.0),
    }


@pytest.mark.parametrize("seed", range(5))
def test_noise_of_the_pyrometer_moves_the_results_no_further_than_itself(seed, tmp_path):
    noise = np.random.default_rng(seed).normal(0.0, 0.3, X.size)
    point = read_measurements(profile_file(tmp_path, {"a": TRIANGLE + EDGE + noise})).points.iloc[0]
    assert point["T_max_C"] == pytest.approx(46.0, abs=1.0)
    assert point["A_T_K_mm"] == pytest.approx(160.0, abs=2.0)


def test_runs_are_told_apart_and_keep_their_order(tmp_path):
    path = profile_file(tmp_path, {"b": TRIANGLE, "a": 40.0 - TRIANGLE})
    measured = read_measurements(path)
    assert list(measured.points["run"]) == ["b", "a"]
    assert [profile.run for profile in measured.profiles] == ["b", "a"]
    assert measured.points["A_T_K_mm"].to_numpy() == pytest.approx([130.0, -130.0])


def test_conditions_of_a_profile_are_kept(tmp_path):
    head, tail = ",p_N_per_mm2,v_mm_per_s,compound,law", ",0.3,50,mine,"
    point = read_measurements(profile_file(tmp_path, {"a": TRIANGLE}, head, tail)).points.iloc[0]
    assert (point["p_N_per_mm2"], point["v_mm_per_s"]) == (0.3, 50.0)
    assert (point["compound"], point["law"]) == ("mine", "")


# -- rows per test ---------------------------------------------------------------------------------


def test_quantities_that_were_not_measured_are_missing(tmp_path):
    text = "p_N_per_mm2,v_mm_per_s,T_max_C,friction_coefficient\n0.3,50,31.5,\n0.4,50,,0.8\n"
    points = read_measurements(write(tmp_path, text)).points
    assert points["T_max_C"].to_numpy() == pytest.approx([31.5, np.nan], nan_ok=True)
    assert points["friction_coefficient"].to_numpy() == pytest.approx([np.nan, 0.8], nan_ok=True)
    assert points["A_T_K_mm"].isna().all()
    assert list(points["run"]) == ["row 2", "row 3"]


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.csv")), ids=lambda path: path.stem)
def test_templates_and_examples_can_be_read(path):
    measured = read_measurements(path)
    assert measured.points[list(QUANTITIES)].notna().to_numpy().any(axis=1).all()
    assert bool(measured.profiles) == path.stem.endswith("profiles")


def test_what_is_no_measurement_says_so_in_its_name_and_its_first_line():
    made_up = [path for path in EXAMPLES.glob("*.csv") if not path.stem.startswith("template")]
    assert made_up
    for path in made_up:
        assert path.stem.startswith("synthetic")
        assert path.read_text().startswith("# SYNTHETIC")


# -- refusals --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text, parts",
    [
        ("", ["no header line"]),
        ("run,x_mm,T_C\n", ["no rows of data"]),
        ("run,v_mm_per_s\na,50\n", ["columns run, v_mm_per_s", "x_mm and T_C"]),
        ("run,x_mm,T_K\na,0,20\na,1,21\n", ["row 1", "column T_C", "rename T_K?"]),
        ("x_mm,T_C\n0,20\n1,21\n", ["row 1", "column run"]),
        ("run,x_mm,T_C\na,0,20\na,1,hot\n", ["row 3", "column T_C", "'hot'", "a finite number"]),
        ("run,x_mm,T_C\na,0,20\na,,21\n", ["row 3", "column x_mm", "nothing"]),
        ("run,x_mm,T_C\na,0,20\na,1,-300\n", ["row 3", "column T_C", "-300", "from -200 to 250"]),
        ("run,x_mm,T_C\na,0,20\na,2,21\na,1,22\n", ["row 4", "x_mm", "1 after 2", "increase"]),
        ("run,x_mm,T_C\na,0,20\na,0,21\n", ["row 3", "0 after 0", "increase"]),
        ("run,x_mm,T_C\na,0,20\nb,0,21\nb,1,21\n", ["row 2", "1 point of run a", "at least 2"]),
        ("run,x_mm,T_C\n,0,20\na,1,21\n", ["row 2", "column run", "nothing"]),
        (
            "run,x_mm,T_C,v_mm_per_s\na,0,20,7\na,1,21,50\n",
            ["row 3", "v_mm_per_s", "50.0 after 7.0", "one value per run"],
        ),
        ("run,x_mm,T_C,compound\na,0,20,A\na,1,21,\n", ["row 3", "compound", "one value per run"]),
        ("run,x_mm,T_C,T_max_C\na,0,20,30\na,1,21,30\n", ["T_max_C", "computed from"]),
        ("T_max_C,v_mm_per_s\n30,fast\n", ["row 2", "column v_mm_per_s", "'fast'"]),
        ("T_max_C,v_mm_per_s\n30,-50\n", ["row 2", "column v_mm_per_s", "-50", "above 0"]),
        ("T_max_C,p_N_per_mm2\n30,0\n", ["row 2", "column p_N_per_mm2", "0", "from 1e-06 to 20"]),
        (
            "T_max_C,A_T_K_mm,run\n30,200,a\n,,b\n",
            ["row 3", "column T_max_C", "nothing", "at least one"],
        ),
        ("T_max_C,law\n30,hümer\n", ["row 2", "column law", "'hümer'", "huemer"]),
        ("T_max_C,law\n30,huemer,7\n", ["row 2", "3 comma-separated", "2 as in the header"]),
        ("# note\n\nT_max_C\nwarm\n", ["row 4", "column T_max_C", "'warm'"]),
    ],
)
def test_wrong_file_is_refused_with_row_column_found_and_expected(text, parts, tmp_path):
    path = write(tmp_path, text)
    with pytest.raises(DataError) as error:
        read_measurements(path)
    message = str(error.value)
    assert "\n" not in message
    assert message.startswith(str(path))
    assert "found" in message
    assert "expected" in message
    for part in parts:
        assert part in message


def test_missing_file_is_refused(tmp_path):
    with pytest.raises(DataError, match="No such file"):
        read_measurements(tmp_path / "nowhere.csv")
