"""Identification of the gap conductance from heating tests."""

import tomllib
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from calibration.conductance.fit import (
    conductance_constant,
    fit_conductance,
    read_heating_record,
    synthetic_heating_record,
)
from calibration.conductance.heating_rig import HeatingRig, default_thermocouples
from calibration.conductance.rig_file import read_contact_surface, read_heating_rig
from calibration.data.errors import DataError
from calibration.fitting.core import FitResult
from contact.conductance import ContactSurface, mikic_conductance
from fem.case.case import Case

KNOWN = HeatingRig(ambient_C=20.0)
SURFACE = ContactSurface(
    mean_conductivity_W_per_mK=0.404,
    effective_modulus_N_per_mm2=8.0,
    rms_roughness_um=80.0,
    mean_slope=0.4,
)


def short_record(**options):
    """A record of an hour with a row every half minute."""
    schedule = {"heating_s": 2400.0, "cooling_s": 1200.0, "every_s": 30.0} | options
    return synthetic_heating_record(**schedule)


@pytest.mark.parametrize("heater", ["power", "temperature"])
def test_conductance_comes_back_from_a_record_without_noise(heater):
    record = short_record(heater=heater, noise_K=0.0, every_s=10.0)
    result = fit_conductance(record, KNOWN)
    assert result.values["h_W_per_m2K"] == pytest.approx(1600.0, rel=2e-3)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_conductance_comes_back_within_five_per_cent_from_noisy_records(seed):
    """0.3 K on every reading; the ambient temperature is fitted as well."""
    result = fit_conductance(synthetic_heating_record(seed=seed, every_s=20.0))
    low, high = result.interval()["h_W_per_m2K"]
    assert result.values["h_W_per_m2K"] == pytest.approx(1600.0, rel=0.05)
    assert low < 1600.0 < high
    assert result.stderr["h_W_per_m2K"] < 0.02 * 1600.0
    assert result.values["ambient_C"] == pytest.approx(20.0, abs=0.05)
    assert result.rmse == pytest.approx(0.3, rel=0.05)


@pytest.mark.slow
def test_intervals_cover_the_truth_as_often_as_they_say():
    """95 % intervals over 20 records: at least 16 hits (binomial, 99.7 %)."""
    hits = 0
    for seed in range(20):
        result = fit_conductance(short_record(seed=seed), KNOWN)
        low, high = result.interval()["h_W_per_m2K"]
        hits += low < 1600.0 < high
    assert hits >= 16


def test_another_conductance_and_unknown_losses_come_back_too():
    rig = HeatingRig(loss_W_per_m2K=14.0)
    record = short_record(rig=rig, h_W_per_m2K=700.0, noise_K=0.02)
    result = fit_conductance(record, KNOWN, also=("loss_W_per_m2K",))
    assert result.values["h_W_per_m2K"] == pytest.approx(700.0, rel=0.02)
    assert result.values["loss_W_per_m2K"] == pytest.approx(14.0, rel=0.01)


def test_wrong_losses_that_are_not_fitted_show_in_the_residuals():
    record = short_record(rig=HeatingRig(loss_W_per_m2K=14.0), noise_K=0.02)
    assert fit_conductance(record, KNOWN).rmse > 0.5


def test_rows_at_uneven_times_are_as_good():
    record = short_record(every_s=10.0, noise_K=0.0)
    keep = np.sort(np.random.default_rng(0).choice(np.arange(1, len(record)), 200, replace=False))
    uneven = record.iloc[np.concatenate([[0], keep])]
    # the switch of the heater must not fall into a gap of the rows
    switch = record[(record.time_s >= 2390.0) & (record.time_s <= 2420.0)]
    uneven = pd.concat([uneven, switch]).drop_duplicates("time_s").sort_values("time_s")
    result = fit_conductance(uneven, KNOWN)
    assert result.values["h_W_per_m2K"] == pytest.approx(1600.0, rel=0.02)


@pytest.fixture(scope="module")
def fitted():
    return fit_conductance(short_record(noise_K=0.05), KNOWN)


def test_result_carries_law_provenance_and_case_section(fitted):
    h = fitted.values["h_W_per_m2K"]
    assert float(fitted.model.conductance(0.3)) == pytest.approx(h)
    assert fitted.metadata["kind"] == "conductance"
    assert len(fitted.metadata["data_sha256"]) == 64
    assert 0.0 < fitted.metadata["reading_change_for_5_percent_K"] < 1.0
    assert fitted.section["heat"]["conductance_W_per_m2K"] == h


def test_parameter_file_has_the_keys_of_the_heat_section(fitted, tmp_path):
    content = tomllib.loads(fitted.to_toml(tmp_path / "h.toml").read_text())
    assert content["heat"] == {
        "conductance_W_per_m2K": fitted.values["h_W_per_m2K"],
        "pressure_N_per_mm2": 0.3,
        "exponent": 0.94,
    }


def test_a_case_takes_the_parameter_file(fitted, tmp_path):
    fitted.to_toml(tmp_path / "h.toml")
    loading = {
        "mean_pressure_N_per_mm2": 0.25,
        "velocity_mm_per_s": 300.0,
        "distance_mm": 120.0,
    }
    case = Case.from_dict({"loading": loading, "heat": {"parameters": "h.toml"}}, folder=tmp_path)
    h = float(case.heat.conductance_object().conductance(0.3))
    assert h == pytest.approx(fitted.values["h_W_per_m2K"], rel=1e-12)


def test_constant_of_the_law_gives_the_conductance_back(fitted):
    constant = conductance_constant(fitted, SURFACE)
    h = fitted.values["h_W_per_m2K"]
    assert float(mikic_conductance(0.3, SURFACE, C=constant.value)) == pytest.approx(h, rel=1e-12)
    assert constant.stderr / constant.value == pytest.approx(fitted.stderr["h_W_per_m2K"] / h)


def test_constant_of_another_fit_is_refused(fitted):
    other: FitResult = replace(fitted, model=None, metadata={"kind": "friction"})
    with pytest.raises(ValueError, match="a fit of friction, expected a fit of a conductance"):
        conductance_constant(other, SURFACE)


def broken(record, column, value, row=5):
    record = record.copy()
    record.loc[row, column] = value
    return record


GOOD = short_record(noise_K=0.0)


@pytest.mark.parametrize(
    ("record", "parts"),
    [
        (GOOD.drop(columns="time_s"), ["column time_s", "expected a column named time_s"]),
        (GOOD.drop(columns="heater_power_W"), ["no heater column", "heater_power_W or heater_C"]),
        (GOOD.assign(heater_C=50.0), ["both heater columns"]),
        (GOOD[["time_s", "heater_power_W", "C1_C"]], ["C1", "one in the asphalt"]),
        (GOOD[["time_s", "heater_power_W", "D1_C"]], ["D1", "one column in the rubber"]),
        (broken(GOOD, "C2_C", np.nan), ["row 6", "column C2_C", "a finite number"]),
        (broken(GOOD, "D1_C", -300.0), ["row 6", "D1_C", "-300.0", "from -200 to 250"]),
        (broken(GOOD, "time_s", 0.0), ["row 6", "time_s", "a time after the row before"]),
        (broken(GOOD, "heater_power_W", -2.0), ["heater_power_W", "-2.0", "from 0 to 1e+06 W"]),
        (GOOD.assign(heater_power_W=0.0), ["no power in any row", "heating"]),
        (broken(GOOD, "C1_C", 60.0, row=0), ["row 1", "40 K apart", "uniform temperature"]),
        (GOOD.iloc[:2], ["2 usable points", "at least 3"]),
        (GOOD.iloc[:0], ["no rows of data"]),
    ],
)
def test_bad_records_are_refused_in_one_line(record, parts):
    with pytest.raises(DataError) as caught:
        fit_conductance(record, KNOWN)
    text = str(caught.value)
    assert "\n" not in text
    for part in parts:
        assert part in text


def test_a_heater_that_stays_cold_is_refused():
    record = short_record(heater="temperature", noise_K=0.0).assign(heater_C=20.2)
    with pytest.raises(DataError, match="a heater that stays cold"):
        read_heating_record(record, KNOWN)


def test_unknown_parameters_are_refused():
    with pytest.raises(ValueError, match="also = conductivity, expected names of loss"):
        fit_conductance(GOOD, KNOWN, also=("conductivity",))


def test_csv_file_and_table_give_the_same_result(tmp_path):
    path = tmp_path / "heating.csv"
    record = short_record(every_s=60.0)
    record.to_csv(path, index=False)
    one, other = fit_conductance(path, KNOWN), fit_conductance(record, KNOWN)
    assert one.values["h_W_per_m2K"] == pytest.approx(other.values["h_W_per_m2K"], rel=1e-9)
    assert one.metadata["data_file"] == str(path)


RIG_FILE = """
[rig]
asphalt_length_mm = 200
ambient_C = 22.5
[rig.rubber]
conductivity_W_per_mK = 0.30
density_kg_per_m3 = 1200
specific_heat_kJ_per_kgK = 1.5
[rig.thermocouples]
C1 = {x_mm = 0.0, y_mm = 6.0}
D1 = {x_mm = 0.0, y_mm = -3.0}
"""


def test_rig_file_states_what_differs_from_the_defaults(tmp_path):
    path = tmp_path / "rig.toml"
    path.write_text(RIG_FILE)
    rig = read_heating_rig(path)
    assert rig.asphalt_length_mm == 200.0
    assert rig.ambient_C == 22.5
    assert rig.rubber.conductivity == 0.30
    assert rig.asphalt == HeatingRig().asphalt
    assert list(rig.thermocouples) == ["C1", "D1"]
    assert rig.block_height_mm == HeatingRig().block_height_mm
    assert set(default_thermocouples()) == {"C1", "C2", "C3", "D1", "D2", "E1", "E2"}


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("", ["[rig]", "found nothing", "a table [rig]"]),
        ("[rig", ["expected TOML"]),
        ("[rig]\nblock_heigth_mm = 8", ["block_heigth_mm", "expected block_height_mm"]),
        ("[rig]\nblock_height_mm = 'tall'", ["block_height_mm", '"tall"', "a number"]),
        ("[rig]\nblock_height_mm = -8", ["block_height_mm = -8.0", "above 0"]),
        ("[rig.rubber]\nconductivity_W_per_mK = 1.0", ["density_kg_per_m3", "nothing", "a number"]),
        ("[rig.thermocouples]\nC1 = 4.0", ["C1", "4.0", "a table"]),
    ],
)
def test_bad_rig_files_are_refused_in_one_line(tmp_path, text, parts):
    path = tmp_path / "rig.toml"
    path.write_text(text)
    with pytest.raises(DataError) as caught:
        read_heating_rig(path)
    assert "\n" not in str(caught.value)
    assert str(path) in str(caught.value)
    for part in parts:
        assert part in str(caught.value)


SURFACE_TABLE = """
[surface]
mean_conductivity_W_per_mK = 0.404
effective_modulus_N_per_mm2 = 8.0
rms_roughness_um = 80.0
mean_slope = 0.4
"""


def test_rig_file_may_describe_the_surface(tmp_path):
    path = tmp_path / "rig.toml"
    path.write_text(RIG_FILE + SURFACE_TABLE)
    assert read_contact_surface(path) == SURFACE
    assert read_heating_rig(path).asphalt_length_mm == 200.0
    path.write_text(RIG_FILE)
    assert read_contact_surface(path) is None


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("[surface]\nmean_slope = 0.4", ["mean_conductivity_W_per_mK", "a number"]),
        (SURFACE_TABLE.replace("= 0.4\n", "= -0.4\n"), ["[surface]", "mean_slope"]),
        (SURFACE_TABLE + "slope = 0.4", ["the key slope", "mean_slope"]),
    ],
)
def test_bad_surfaces_are_refused_in_one_line(tmp_path, text, parts):
    path = tmp_path / "rig.toml"
    path.write_text(text)
    with pytest.raises(DataError) as caught:
        read_contact_surface(path)
    assert "\n" not in str(caught.value)
    for part in parts:
        assert part in str(caught.value)


def test_missing_rig_file_is_refused(tmp_path):
    with pytest.raises(DataError, match="a readable TOML file"):
        read_heating_rig(tmp_path / "no.toml")
