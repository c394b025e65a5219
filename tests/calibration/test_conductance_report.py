"""Text and files of the identification of a gap conductance."""

import io
import tomllib

import pandas as pd
import pytest

from calibration.conductance import synthetic_heating_record
from calibration.conductance_report import conductance_report
from calibration.errors import DataError
from contact.conductance import ContactSurface, mikic_constant
from fem.case import Case

RIG = """
[rig]
ambient_C = 20.0
[surface]
mean_conductivity_W_per_mK = 0.404
effective_modulus_N_per_mm2 = 8.0
rms_roughness_um = 80.0
mean_slope = 0.4
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    directory = tmp_path_factory.mktemp("heating")
    record = synthetic_heating_record(heating_s=2400.0, cooling_s=1200.0, every_s=60.0)
    record.to_csv(directory / "heating.csv", index=False)
    (directory / "rig.toml").write_text(RIG)
    return directory


@pytest.fixture(scope="module")
def report(folder):
    return conductance_report(folder / "heating.csv", rig_file=folder / "rig.toml")


def test_text_states_value_interval_and_constant(report):
    text, files = report
    h = tomllib.loads(files["parameters.toml"].decode())["heat"]["conductance_W_per_m2K"]
    surface = ContactSurface(
        mean_conductivity_W_per_mK=0.404,
        effective_modulus_N_per_mm2=8.0,
        rms_roughness_um=80.0,
        mean_slope=0.4,
    )
    assert f"{h:.6g}" in text
    assert "95 % interval of h" in text
    assert f"C of eq. (11): {mikic_constant(h, 0.3, surface):.5g}" in text


def test_files_are_parameters_readings_and_picture(report):
    _, files = report
    assert sorted(files) == ["fit.csv", "fit.png", "parameters.toml"]
    table = pd.read_csv(io.BytesIO(files["fit.csv"]))
    assert (table.C1_C - table.C1_fit_C).std() == pytest.approx(0.3, rel=0.35)
    assert files["fit.png"].startswith(b"\x89PNG")


def test_a_case_takes_the_parameter_file(report, tmp_path):
    _, files = report
    (tmp_path / "h.toml").write_bytes(files["parameters.toml"])
    case = Case.from_dict(
        {
            "loading": {
                "mean_pressure_N_per_mm2": 0.25,
                "velocity_mm_per_s": 300.0,
                "distance_mm": 120.0,
            },
            "heat": {"parameters": "h.toml"},
        },
        folder=tmp_path,
    )
    h = tomllib.loads(files["parameters.toml"].decode())["heat"]["conductance_W_per_m2K"]
    assert float(case.heat.conductance_object().conductance(0.3)) == pytest.approx(h)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("[rigg]\n", ["the key rigg", "expected rig"]),
        ("[rig]\n[surface]\nmean_slope = 0.4", ["mean_conductivity_W_per_mK", "a number"]),
        (RIG.replace("mean_slope = 0.4", "mean_slope = -0.4"), ["[surface]", "mean_slope"]),
    ],
)
def test_bad_rig_files_are_refused_in_one_line(folder, tmp_path, text, parts):
    path = tmp_path / "rig.toml"
    path.write_text(text)
    with pytest.raises(DataError) as caught:
        conductance_report(folder / "heating.csv", rig_file=path)
    assert "\n" not in str(caught.value)
    for part in parts:
        assert part in str(caught.value)
