"""Every way measured data can be wrong ends in one line, exit code 2, and nothing written."""

import argparse

import numpy as np
import pandas as pd
import pytest

import treadfem
from calibration import DataError, commands, fit_friction, fit_hyperelastic

STRESS = "stretch,nominal_stress_N_per_mm2,mode\n"
GOOD = "1.1,0.2,uniaxial\n1.3,0.5,uniaxial\n1.6,0.8,uniaxial\n2.0,1.1,uniaxial\n"
FRICTION = "p_N_per_mm2,v_mm_per_s,mu\n"
SLIDES = "".join(f"{p},{v},0.9\n" for p in (0.1, 0.3, 0.5) for v in (1, 30, 300))
YEOH = ["hyperelastic"]
HUEMER = ["friction"]
WLF = ["wlf"]
KAPPA = ["partition", "--case", "block.toml"]
BLOCK = """
[loading]
mean_pressure_N_per_mm2 = 0.3
velocity_mm_per_s = 300.0
distance_mm = 1.0
"""
PEAKS = "mean_pressure_N_per_mm2,v_mm_per_s,T_max_C\n0.2,300,35\n0.4,300,36\n"
PROFILE = "p_N_per_mm2,v_mm_per_s,X_mm,T_C\n"
PROFILES = "".join(f"{p},300,{x},{30 + x}\n" for p in (0.2, 0.4) for x in (1, 4, 8, 12, 16))

BAD = {
    "percent_strain": (YEOH, STRESS + "0,0,uniaxial\n50,0.5,uniaxial\n", 2, "stretch", "0"),
    "percent_stretch": (YEOH, STRESS + "110,0.1,uniaxial\n150,0.5,uniaxial\n", 2, "stretch", "110"),
    "strain": (
        YEOH,
        STRESS + "0.1,0.1,uniaxial\n0.2,0.2,uniaxial\n0.5,0.5,uniaxial\n0.9,0.6,uniaxial\n",
        2,
        "stretch",
        "these look like strains",
    ),
    "missing_column": (YEOH, "stretch,stress,mode\n" + GOOD, 1, "nominal_stress", "stress, mode"),
    "missing_mode": (YEOH, "stretch,nominal_stress_N_per_mm2\n1.1,0.2\n", 1, "mode", "column"),
    "unknown_mode": (YEOH, STRESS + GOOD + "2.1,1.2,shear\n", 6, "mode", "'shear'"),
    "nan": (YEOH, STRESS + GOOD + "2.1,nan,uniaxial\n", 6, "nominal_stress", "'nan'"),
    "infinite": (YEOH, STRESS + GOOD + "inf,1.2,uniaxial\n", 6, "stretch", "'inf'"),
    "text": (YEOH, STRESS + GOOD + "two,1.2,uniaxial\n", 6, "stretch", "'two'"),
    "decimal_comma": (YEOH, STRESS + GOOD + '"2,1",1.2,uniaxial\n', 6, "stretch", "'2,1'"),
    "empty_entry": (YEOH, STRESS + GOOD + ",1.2,uniaxial\n", 6, "stretch", "nothing"),
    "short_row": (YEOH, STRESS + GOOD + "2.1,1.2\n", 6, "", "2 comma-separated entries"),
    "comment_and_gap": (YEOH, "# rig 7\n\n" + STRESS + "0,1,uniaxial\n", 4, "stretch", "0"),
    "two_points": (YEOH, STRESS + "1.1,0.2,uniaxial\n1.5,0.6,uniaxial\n", 3, "stretch", "2 diff"),
    "one_point_thrice": (YEOH, STRESS + "1.1,0.2,uniaxial\n" * 3, 4, "stretch", "1 different"),
    "zero_stress": (
        YEOH,
        STRESS + "".join(f"{s},0,uniaxial\n" for s in (1.1, 1.2, 1.3, 1.4)),
        2,
        "nominal_stress",
        "zero in every row",
    ),
    "wrong_sign": (
        YEOH,
        STRESS + "".join(f"{s},{1 - s},uniaxial\n" for s in (1.1, 1.2, 1.3, 1.4)),
        2,
        "nominal_stress",
        "expected a positive stress",
    ),
    "compression_in_a_tension_window": (
        [*YEOH, "--window", "1", "2"],
        STRESS + GOOD + "0.9,-0.2,uniaxial\n",
        6,
        "stretch",
        "tension only",
    ),
    "nothing_in_the_window": (
        [*YEOH, "--window", "3", "4"],
        STRESS + GOOD,
        None,
        "",
        "no row that the selection keeps",
    ),
    "mode_without_data": ([*YEOH, "--mode", "planar"], STRESS + GOOD, None, "", "no row"),
    "unknown_branch": (
        YEOH,
        "stretch,nominal_stress_N_per_mm2,mode,branch\n1.1,0.2,uniaxial,up\n",
        2,
        "branch",
        "'up'",
    ),
    "half_a_cycle": (
        YEOH,
        "stretch,nominal_stress_N_per_mm2,mode,cycle\n1.1,0.2,uniaxial,1.5\n",
        2,
        "cycle",
        "1.5",
    ),
    "header_only": (YEOH, STRESS, None, "", "no rows of data"),
    "column_twice": (YEOH, "stretch,stretch,mode\n1,1,uniaxial\n", 1, "stretch", "the name twice"),
    "empty": (YEOH, "", None, "", "no header line"),
    "negative_friction": (HUEMER, FRICTION + SLIDES + "0.3,50,-0.9\n", 11, "mu", "-0.9"),
    "friction_in_percent": (HUEMER, FRICTION + SLIDES + "0.3,50,90\n", 11, "mu", "90"),
    "no_friction": (HUEMER, FRICTION + SLIDES.replace("0.9\n", "0\n"), 2, "mu", "zero in every"),
    "zero_speed": (HUEMER, FRICTION + SLIDES + "0.3,0,0.9\n", 11, "v_mm_per_s", "0"),
    "negative_pressure": (HUEMER, FRICTION + SLIDES + "-0.3,50,0.9\n", 11, "p_N_per_mm2", "-0.3"),
    "below_absolute_zero": (
        HUEMER,
        "p_N_per_mm2,v_mm_per_s,mu,T_C\n0.3,30,0.9,20\n0.3,50,0.9,-280\n",
        3,
        "T_C",
        "-280",
    ),
    "few_slides": (HUEMER, FRICTION + "0.3,30,0.9\n0.3,50,0.9\n", 3, "", "2 usable points"),
    "no_temperatures": ([*HUEMER, "--wlf", "fit"], FRICTION + SLIDES, 1, "T_C", "the columns"),
    "one_temperature": (
        [*HUEMER, "--wlf", "fit"],
        "p_N_per_mm2,v_mm_per_s,mu,T_C\n" + SLIDES.replace("0.9\n", "0.9,20\n"),
        None,
        "T_C",
        "one temperature",
    ),
    "peaks_without_pressure": (
        KAPPA,
        "v_mm_per_s,T_max_C\n300,35\n",
        1,
        "p_N_per_mm2",
        "the columns",
    ),
    "peaks_without_temperature": (
        KAPPA,
        "p_N_per_mm2,v_mm_per_s,T_C_max\n0.2,300,35\n",
        1,
        "T_max_C",
        "the columns",
    ),
    "profile_without_place": (
        KAPPA,
        "p_N_per_mm2,v_mm_per_s,T_C\n0.2,300,35\n",
        1,
        "X_mm",
        "the columns",
    ),
    "one_pressure": (KAPPA, PEAKS.replace("0.4", "0.2"), 3, "mean_pressure", "1 pressure"),
    "pressure_in_kPa": (KAPPA, PEAKS + "300,300,35\n", 4, "mean_pressure", "kPa (0.3 N/mm^2)"),
    "zero_pressure": (KAPPA, PEAKS + "0,300,35\n", 4, "mean_pressure", "from 1e-06 to 20"),
    "block_at_rest": (KAPPA, PEAKS + "0.3,0,35\n", 4, "v_mm_per_s", "0"),
    "colder_than_at_the_start": (KAPPA, PEAKS + "0.3,300,19\n", 4, "T_max_C", "ambient_C = 20"),
    "peak_below_absolute_zero": (KAPPA, PEAKS + "0.3,300,-300\n", 4, "T_max_C", "-300"),
    "peak_in_kelvin": (KAPPA, PEAKS + "0.3,300,309\n", 4, "T_max_C", "309"),
    "no_peak": (KAPPA, PEAKS + "0.3,300,nan\n", 4, "T_max_C", "'nan'"),
    "sigma_of_zero": (
        KAPPA,
        PEAKS.replace("_C\n", "_C,sigma_K\n").replace("35\n", "35,0.5\n").replace("36\n", "36,0\n"),
        3,
        "sigma_K",
        "above 0 K",
    ),
    "place_off_the_block": (KAPPA, PROFILE + PROFILES + "0.4,300,21,50\n", 12, "X_mm", "21"),
    "place_backwards": (KAPPA, PROFILE + PROFILES + "0.4,300,3,50\n", 12, "X_mm", "ahead"),
    "short_profile": (
        KAPPA,
        PROFILE + PROFILES + "0.5,300,3,50\n",
        12,
        "X_mm",
        "1 points of a profile",
    ),
    "cold_profile": (
        KAPPA,
        PROFILE + "".join(f"{p},300,{x},15\n" for p in (0.2, 0.4) for x in range(5)),
        2,
        "T_C",
        "at most 15 in 5 rows",
    ),
    "shift_factor_of_zero": (WLF, "T_C,aT\n0,1\n10,0\n20,0.1\n", 3, "aT", "0"),
    "frozen_sweeps": (WLF, "T_C,log10_aT\n0,1\n-273.15,0\n20,2\n", 3, "T_C", "-273.15"),
}


@pytest.fixture(autouse=True)
def beside_a_case(tmp_path, monkeypatch):
    (tmp_path / "block.toml").write_text(BLOCK)
    monkeypatch.chdir(tmp_path)


def run(words):
    parser = argparse.ArgumentParser(prog="treadfem")
    commands.add_arguments(parser.add_subparsers(required=True))
    arguments = parser.parse_args(["calibrate", *words])
    return arguments.command(arguments)


@pytest.mark.parametrize("name", BAD)
def test_bad_data_end_in_one_line_and_leave_no_trace(name, tmp_path, capsys):
    words, text, row, column, part = BAD[name]
    path, output = tmp_path / "data.csv", tmp_path / "out"
    path.write_text(text)
    code = run([words[0], str(path), *words[1:], "-o", str(output)])
    printed = capsys.readouterr()
    assert code == 2
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    assert str(path) in printed.err
    assert part in printed.err
    assert "found" in printed.err
    assert "expected" in printed.err
    assert row is None or f"row {row}" in printed.err
    assert f"column {column}" in printed.err or not column
    assert not output.exists()


def test_files_that_cannot_be_read_are_named(tmp_path, capsys):
    assert run(["hyperelastic", str(tmp_path / "none.csv")]) == 2
    assert "none.csv: found No such file or directory, expected" in capsys.readouterr().err
    assert run(["hyperelastic", str(tmp_path)]) == 2
    assert "found Is a directory" in capsys.readouterr().err
    binary = tmp_path / "binary.csv"
    binary.write_bytes(b"\x00\x01\x80\x81")
    assert run(["hyperelastic", str(binary)]) == 2
    assert "found bytes that are no text" in capsys.readouterr().err


def test_wrong_options_end_in_one_line(tmp_path, capsys):
    path = tmp_path / "data.csv"
    path.write_text(STRESS + GOOD)
    for words in (["--window", "2", "1"], ["--fix", "C11=1"], ["--cycle", "7"]):
        assert run(["hyperelastic", str(path), *words]) == 2
        printed = capsys.readouterr().err
        assert printed.count("\n") == 1
        assert "expected" in printed


def test_an_output_folder_that_is_a_file_is_refused(tmp_path, capsys):
    path = tmp_path / "data.csv"
    path.write_text(STRESS + GOOD)
    assert treadfem.main(["calibrate", "hyperelastic", str(path), "-o", str(path)]) == 2
    assert "expected a writable folder" in capsys.readouterr().err


def test_rows_of_a_data_frame_are_counted_from_one():
    table = pd.DataFrame(
        {"stretch": [1.1, np.nan], "nominal_stress_N_per_mm2": 0.2, "mode": "planar"}
    )
    with pytest.raises(DataError, match=r"^table, row 2, column stretch: found 'nan', expected a"):
        fit_hyperelastic(table)
    table = pd.DataFrame({"p_N_per_mm2": [0.3], "v_mm_per_s": [10.0], "mu": [-1.0]})
    with pytest.raises(DataError, match=r"^table, row 1, column mu: found -1.0, expected"):
        fit_friction(table)
