"""From measured tables to a simulation: fitted parameter files go straight into a run."""

import json

import pytest

import treadfem
from calibration.conductance import synthetic_heating_record
from calibration.heating_rig import HeatingRig
from calibration.synthetic import synthetic_bar_cycles, synthetic_friction
from contact import HuemerFriction
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
