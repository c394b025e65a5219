"""From measured tables to a simulation: fitted parameter files go straight into a run."""

import json
import tomllib

import numpy as np
import pytest

import treadfem
from calibration.conductance.fit import synthetic_heating_record
from calibration.conductance.heating_rig import HeatingRig
from calibration.synthetic import synthetic_bar_cycles, synthetic_friction
from contact import HuemerFriction
from fem import Case, simulate
from materials import WLF

CASE = """
[block]
mesh = "coarse"

[rubber]
parameters = "rubber/parameters.toml"

[friction]
parameters = "friction/parameters.toml"

[heat]
parameters = "heat/parameters.toml"

[loading]
mean_pressure_N_per_mm2 = 0.1
velocity_mm_per_s = 300.0
distance_mm = 0.05

[output]
vtu = false
figures = false
"""


@pytest.mark.slow
def test_three_calibrations_feed_one_run(tmp_path):
    synthetic_bar_cycles(1, noise_N_per_mm2=0.01).to_csv(tmp_path / "bars.csv", index=False)
    slides = synthetic_friction(
        HuemerFriction(v_min=1e-9), temperatures_C=(5.0, 35.0), wlf=WLF(), repeats=1
    )
    slides.to_csv(tmp_path / "slides.csv", index=False)
    synthetic_heating_record(HeatingRig(ambient_C=20.0), h_W_per_m2K=1600.0).to_csv(
        tmp_path / "heating.csv", index=False
    )
    common = ["--no-compare", "--quiet"]
    for words in (
        ["hyperelastic", "bars.csv", "--branch", "load", *common, "rubber"],
        ["friction", "slides.csv", "--wlf", "fit", *common, "friction"],
        ["conductance", "heating.csv", "--quiet", "heat"],
    ):
        kind, data, *options, folder = words
        paths = [str(tmp_path / data), *options, "-o", str(tmp_path / folder)]
        assert treadfem.main(["calibrate", kind, *paths]) == 0

    case = tmp_path / "case.toml"
    case.write_text(CASE)
    assert treadfem.main(["run", str(case), "-o", str(tmp_path / "run"), "--quiet"]) == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["friction_force_N_per_mm"] > 0.0
    resolved = (tmp_path / "run" / "case.toml").read_text()
    assert 'model = "yeoh"' in resolved
    assert "C10_N_per_mm2 = 0.37" in resolved


def test_ogden_of_exponents_two_and_minus_two_slides_like_mooney_rivlin():
    # the same energy written in the two ways, through contact, heat and snaps of the edge
    mooney = {"model": "mooney-rivlin", "C10_N_per_mm2": 0.258, "C01_N_per_mm2": 0.4587}
    ogden = {"model": "ogden", "mu_N_per_mm2": [0.516, 0.9174], "alpha": [2.0, -2.0]}
    slides = [
        simulate(
            Case.from_dict(
                {
                    "block": {"mesh": "coarse"},
                    "rubber": rubber,
                    "loading": {
                        "mean_pressure_N_per_mm2": 0.25,
                        "velocity_mm_per_s": 300.0,
                        "distance_mm": 0.5,
                    },
                }
            )
        ).history
        for rubber in (mooney, ogden)
    ]
    for column in ("friction_force_N_per_mm", "platen_displacement_mm", "T_max_C"):
        np.testing.assert_allclose(slides[0][column], slides[1][column], rtol=1e-6)


def test_a_fitted_heat_partition_goes_straight_into_a_run(tmp_path, capsys):
    block = """
        [block]
        mesh = "coarse"
        rigid = true
        [loading]
        mean_pressure_N_per_mm2 = 0.3
        velocity_mm_per_s = 300.0
        distance_mm = 1.0
        [output]
        vtu = false
        figures = false
        """
    (tmp_path / "block.toml").write_text(block)
    data, T_max = tmp_path / "slides.csv", {}
    for p in (0.2, 0.3, 0.4):
        words = ["--set", f"loading.mean_pressure_N_per_mm2={p}", "-o", str(tmp_path / f"{p}")]
        assert treadfem.main(["run", str(tmp_path / "block.toml"), *words, "--quiet"]) == 0
        T_max[p] = json.loads((tmp_path / f"{p}" / "summary.json").read_text())["T_max_C"]
    rows = "".join(f"{p},300,{T}\n" for p, T in T_max.items())
    data.write_text("mean_pressure_N_per_mm2,v_mm_per_s,T_max_C\n" + rows)

    words = [str(data), "--case", str(tmp_path / "block.toml"), "-o", str(tmp_path / "heat")]
    words += ["--workers", "1", "--quiet"]
    assert treadfem.main(["calibrate", "partition", *words]) == 0
    fitted = tomllib.loads((tmp_path / "heat" / "parameters.toml").read_text())["heat"]
    assert fitted["partition"]["prefactor"] == pytest.approx(0.3146, rel=0.01)
    assert fitted["partition"]["exponent"] == pytest.approx(-0.6833, rel=0.01)

    case = tmp_path / "case.toml"
    case.write_text(block + '\n[heat]\nparameters = "heat/parameters.toml"\n')
    assert treadfem.main(["run", str(case), "-o", str(tmp_path / "run"), "--quiet"]) == 0
    resolved = tomllib.loads((tmp_path / "run" / "case.toml").read_text())
    assert resolved["heat"]["partition"] == fitted["partition"]
    T = json.loads((tmp_path / "run" / "summary.json").read_text())["T_max_C"]
    assert pytest.approx(T_max[0.3], abs=0.05) == T
