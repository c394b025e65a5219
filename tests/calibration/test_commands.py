"""The calibrate command: what it prints and writes."""

import argparse
import tomllib
from pathlib import Path

import pandas as pd
import pytest

import treadfem
from calibration import commands
from calibration.conductance.fit import synthetic_heating_record
from calibration.conductance.heating_rig import HeatingRig
from calibration.datasets import dataset_path
from calibration.synthetic import synthetic_bar_cycles, synthetic_friction
from contact import HuemerFriction
from fem import Case, simulate
from fem.sweeps import case as sweep_case
from materials import WLF
from tests.calibration.made_up_sweeps import synthetic_sweeps
from tests.calibration.memory import made_up_tests
from tests.calibration.partition.made_up_slides import RIGID


def run(words):
    parser = argparse.ArgumentParser(prog="treadfem")
    commands.add_arguments(parser.add_subparsers(required=True))
    arguments = parser.parse_args(["calibrate", *map(str, words)])
    return arguments.command(arguments)


def test_hyperelastic_writes_parameters_points_comparison_and_pictures(tmp_path, capsys):
    output = tmp_path / "out"
    data = dataset_path("meunier2008")
    assert run(["hyperelastic", data, "--model", "van-der-waals", "-o", output]) == 0
    printed = capsys.readouterr().out
    assert "van-der-waals" in printed
    assert "best AIC first" in printed
    names = {"parameters.toml", "fit.csv", "fit.png", "models.csv", "models.png"}
    assert {path.name for path in output.iterdir()} == names
    points = pd.read_csv(output / "fit.csv")
    assert len(points) == 66
    assert points["row"].iloc[0] == 7  # five lines of comment and the header come before
    difference = points["fit_N_per_mm2"] - points["nominal_stress_N_per_mm2"]
    assert difference.to_numpy() == pytest.approx(points["residual_N_per_mm2"].to_numpy())
    assert (output / "fit.png").read_bytes().startswith(b"\x89PNG")


def test_text_that_a_spreadsheet_would_run_is_quoted_in_the_tables(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rows = "".join(f"{s},{s - s**-2:.5f},uniaxial\n" for s in (1.1, 1.3, 1.6, 2.0))
    Path("=t.csv").write_text("stretch,nominal_stress_N_per_mm2,mode\n" + rows)
    assert run(["hyperelastic", "=t.csv", "--model", "neo-hooke", "-o", "out"]) == 0
    # Why a model with more parameters than points was not fitted begins with the file's name.
    assert "'=t.csv" in Path("out/models.csv").read_text()


def test_options_reach_the_fit(tmp_path):
    data = tmp_path / "bars.csv"
    synthetic_bar_cycles(1).to_csv(data, index=False)
    words = ["--branch", "load", "--window", "1", "2", "--fix", "C30=-0.0003", "--no-compare"]
    assert run(["hyperelastic", data, *words, "--quiet", "-o", tmp_path / "o"]) == 0
    fit = tomllib.loads((tmp_path / "o" / "parameters.toml").read_text())["fit"]
    assert fit["branch"] == "load"
    assert fit["window"] == [1.0, 2.0]
    assert fit["held"] == ["C30"]
    assert fit["values"]["C10"] == pytest.approx(0.3794, rel=1e-9)
    assert not (tmp_path / "o" / "models.csv").exists()


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("hyperelastic --noise -1", "--noise: found -1, expected a number above 0"),
        ("hyperelastic --noise 0", "--noise: found 0, expected a number above 0"),
        ("friction --noise nan", '--noise: found "nan", expected a finite number'),
        ("friction --T-ref nan", '--T-ref: found "nan", expected a finite number'),
        ("friction --T-ref -300", "--T-ref: found -300, expected a temperature above"),
        ("friction --d1 0", "--d1: found 0, expected a number above 0"),
        ("friction --fix n", '--fix: found "n", expected NAME=VALUE'),
        ("friction --fix n=x", '--fix: found "x", expected a finite number'),
        ("friction --starts 0", '--starts: found "0", expected a whole number, 1 or more'),
        ("friction --starts " + "9" * 5000, "expected a whole number, 1 or more"),
        ("partition --simulations 0", '--simulations: found "0", expected a whole number'),
        ("hyperelastic --cycle first", '--cycle: found "first", expected "last-full"'),
        ("hyperelastic --window 1 inf", '--window: found "inf", expected a finite number'),
        ("wlf --expansion -1", "--expansion: found -1, expected 0 or more"),
        ("wlf --T-tolerance 1K", '--T-tolerance: found "1K", expected a finite number'),
    ],
)
def test_options_that_cannot_be_meant_are_refused_in_one_line(words, expected, capsys):
    kind, *options = words.split()
    with pytest.raises(SystemExit) as stopped:
        treadfem.main(["calibrate", kind, "data.csv", *options])
    assert stopped.value.code == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert expected in line
    assert len(line) < 300


@pytest.mark.parametrize("kind", ["student", "profile", "bootstrap"])
def test_intervals_can_be_asked_for(kind, tmp_path, capsys):
    words = ["--model", "van-der-waals", "--intervals", kind, "--no-compare"]
    assert run(["hyperelastic", dataset_path("kawabata1981"), *words, "-o", tmp_path / "o"]) == 0
    assert f"95 % intervals ({kind})" in capsys.readouterr().out
    fit = tomllib.loads((tmp_path / "o" / "parameters.toml").read_text())["fit"]
    low, high = fit["interval_95"]["lambda_m"]
    assert low < fit["values"]["lambda_m"] < high


def test_friction_writes_a_comparison_of_the_curves(tmp_path, capsys):
    data = tmp_path / "friction.csv"
    synthetic_friction(HuemerFriction(), repeats=1).to_csv(data, index=False)
    assert run(["friction", data, "-o", tmp_path / "o"]) == 0
    assert "mu_largest_difference" in capsys.readouterr().out
    names = {"parameters.toml", "fit.csv", "fit.png", "laws.csv"}
    assert {path.name for path in (tmp_path / "o").iterdir()} == names


def test_friction_with_many_pressures_and_temperatures_is_drawn(tmp_path):
    data = tmp_path / "friction.csv"
    table = synthetic_friction(
        HuemerFriction(v_min=1e-9),
        pressures_N_per_mm2=[0.05 * i for i in range(1, 13)],
        temperatures_C=(10.0, 30.0),
        wlf=WLF(),
        repeats=1,
    )
    table.to_csv(data, index=False)
    words = ["--wlf", "given", "--d1", "43.1", "--d2", "509.4", "--no-compare", "--quiet"]
    assert run(["friction", data, *words, "-o", tmp_path / "o"]) == 0
    content = tomllib.loads((tmp_path / "o" / "parameters.toml").read_text())
    assert content["friction"]["wlf"] is True
    assert content["friction"]["d1"] == 43.1


def test_sweeps_leave_a_master_curve(tmp_path, capsys):
    data = tmp_path / "sweeps.csv"
    synthetic_sweeps(WLF(d1=17.0, d2_K=150.0), (0.0, 15.0, 30.0, 45.0)).to_csv(data, index=False)
    assert run(["wlf", data, "--T-ref", "20", "-o", tmp_path / "o"]) == 0
    printed = capsys.readouterr().out
    assert "overlap error" in printed
    assert "no sweep at 20 deg C" in printed
    names = {"shift_factors.csv", "master_curve.csv", "master_curve.png"}
    assert names <= {path.name for path in (tmp_path / "o").iterdir()}
    content = tomllib.loads((tmp_path / "o" / "parameters.toml").read_text())
    assert content["friction"]["wlf_T_ref_C"] == 20.0
    assert "T_ref_C" not in content["friction"]
    assert content["friction"]["d1"] == pytest.approx(17.0, rel=0.02)


def test_conductance_is_found_and_c_of_eq_11_follows(tmp_path, capsys):
    data, rig = tmp_path / "heating.csv", tmp_path / "rig.toml"
    rig.write_text(
        "[rig]\nambient_C = 20.0\n[surface]\nmean_conductivity_W_per_mK = 0.404\n"
        "effective_modulus_N_per_mm2 = 8.0\nrms_roughness_um = 300.0\nmean_slope = 0.3\n"
    )
    synthetic_heating_record(HeatingRig(ambient_C=20.0), h_W_per_m2K=1600.0).to_csv(
        data, index=False
    )
    assert run(["conductance", data, "--rig", rig, "-o", tmp_path / "o"]) == 0
    assert "C of eq. (11)" in capsys.readouterr().out
    content = tomllib.loads((tmp_path / "o" / "parameters.toml").read_text())
    assert content["heat"]["conductance_W_per_m2K"] == pytest.approx(1600.0, rel=0.05)
    assert content["fit"]["C_of_eq_11"] > 0.0
    names = {"parameters.toml", "fit.csv", "fit.png"}
    assert {path.name for path in (tmp_path / "o").iterdir()} == names


SLIDES = """mean_pressure_N_per_mm2,v_mm_per_s,T_max_C,sigma_K
0.2,300,23.5,0.5
0.3,300,23.6,0.5
0.4,300,23.4,0.5
"""


def partition_files(tmp_path):
    data, case = tmp_path / "slides.csv", tmp_path / "block.toml"
    data.write_text(SLIDES)
    case.write_text(RIGID)
    return ["partition", data, "--workers", "1", "--case", case, "-o", tmp_path / "o"]


def test_partition_writes_law_points_and_discrete_estimates(tmp_path, capsys):
    words = partition_files(tmp_path)
    assert run(words) == 0
    printed = capsys.readouterr().out
    assert "simulation 1, rigid block" in printed
    assert "constant kappa at each pressure" in printed
    names = {"parameters.toml", "fit.csv", "fit.png", "kappas.csv", "simulations"}
    assert {path.name for path in (tmp_path / "o").iterdir()} == names
    content = tomllib.loads((tmp_path / "o" / "parameters.toml").read_text())
    assert content["heat"]["partition"]["law"] == "power"
    assert content["fit"]["standard_errors_from"] == "sigma of the data"
    assert content["fit"]["case_file"] == "block.toml"
    assert pd.read_csv(tmp_path / "o" / "fit.csv")["row"].to_list() == [2, 3, 4]

    before = {p.name: p.read_bytes() for p in (tmp_path / "o").glob("*.*")}
    assert run(words) == 0
    assert "none of the simulations had to be made" in capsys.readouterr().out
    assert {p.name: p.read_bytes() for p in (tmp_path / "o").glob("*.*")} == before


def test_partition_goes_on_after_an_interruption(tmp_path, monkeypatch, capsys):
    words, made = partition_files(tmp_path), []

    def interrupted(case, **options):
        if len(made) == 4:
            raise KeyboardInterrupt
        made.append(case)
        return simulate(case, **options)

    monkeypatch.setattr(sweep_case, "simulate", interrupted)
    with pytest.raises(KeyboardInterrupt):
        run(words)
    assert not (tmp_path / "o" / "parameters.toml").exists()
    monkeypatch.setattr(sweep_case, "simulate", simulate)
    capsys.readouterr()
    assert run(words) == 0
    rest = capsys.readouterr().out.count("simulation ")
    whole = tmp_path / "whole"
    assert run([*words[:-1], whole]) == 0
    assert capsys.readouterr().out.count("simulation ") == rest + 4
    for name in ("parameters.toml", "kappas.csv"):
        assert (whole / name).read_bytes() == (tmp_path / "o" / name).read_bytes()


def test_a_simulation_that_stops_is_said_with_exit_code_3(tmp_path, capsys):
    words = partition_files(tmp_path)
    words[5].write_text(RIGID.replace("rigid = true", ""))
    options = ["--set", "solver.newton_iterations_max=1", "--set", "solver.step_mm_min=0.01"]
    assert run([*words, *options, "--quiet"]) == 3
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    assert "p = 0.2 N/mm^2, v = 300 mm/s, kappa = " in printed.err
    assert "is not converged" in printed.err
    assert not (tmp_path / "o" / "parameters.toml").exists()


def test_the_same_data_give_the_same_bytes(tmp_path):
    for name in ("a", "b"):
        run(["hyperelastic", dataset_path("kawabata1981"), "--quiet", "-o", tmp_path / name])
    for path in (tmp_path / "a").iterdir():
        assert path.read_bytes() == (tmp_path / "b" / path.name).read_bytes()


@pytest.mark.parametrize("kind", ["histories", "sweeps", "softening"])
def test_memory_writes_parameters_that_a_case_takes(kind, tmp_path, capsys):
    make = {
        "histories": made_up_tests.stepwise_relaxation,
        "sweeps": made_up_tests.sweeps,
        "softening": made_up_tests.softening_cycles,
    }[kind]
    make(1).to_csv(tmp_path / "t.csv", index=False)
    output, command = tmp_path / "out", "mullins" if kind == "softening" else "viscoelastic"
    assert run([command, tmp_path / "t.csv", "-o", output]) == 0
    printed = capsys.readouterr().out
    names = {"parameters.toml", "fit.csv", "fit.png"}
    if command == "viscoelastic":
        names.add("branches.csv")
        assert "tau2_s" in printed
    assert {path.name for path in output.iterdir()} == names
    written = tomllib.loads((output / "parameters.toml").read_text())
    points = pd.read_csv(output / "fit.csv")
    assert len(points) == written["fit"]["n_data"]
    (tmp_path / "case.toml").write_text(
        '[rubber]\nparameters = "out/parameters.toml"\n[loading]\nmean_pressure_N_per_mm2 = 0.2\n'
        "velocity_mm_per_s = 50.0\ndistance_mm = 1.0\n"
    )
    rubber = Case.from_toml(tmp_path / "case.toml").rubber.material()
    if command == "mullins":
        assert rubber.damage.m == written["fit"]["values"]["m"]
    else:
        assert rubber.viscous.g[0] == written["fit"]["values"]["g1"]
        assert (rubber.viscous.shift is None) == (kind == "histories")
