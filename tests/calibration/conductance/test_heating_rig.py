"""Heat model of the static conductance test."""

from dataclasses import replace

import numpy as np
import pytest

from calibration.conductance.heating_rig import (
    HeatingRig,
    RigModel,
    Thermocouple,
    default_thermocouples,
)
from tests.reference_solutions.resistance_chain import interface_temperatures

ON_AXIS = {name: place for name, place in default_thermocouples().items() if name[0] != "E"}
ENDS = {
    "rubber top": Thermocouple(x_mm=5.0, y_mm=8.0),
    "rubber bottom": Thermocouple(x_mm=5.0, y_mm=0.0),
    "asphalt top": Thermocouple(x_mm=5.0, y_mm=-1e-9),
    "asphalt bottom": Thermocouple(x_mm=5.0, y_mm=-50.0),
}
#: Asphalt as narrow as the block, no losses but through the base: heat flows in one direction.
NARROW = HeatingRig(asphalt_length_mm=20.0, loss_W_per_m2K=0.0, thermocouples=ENDS)


def chain(h, hot):
    """Temperatures from the heater down to the surroundings, resistances in m^2 K/W."""
    layers = [20e-3 / 398.0, 8e-3 / 0.284, 1.0 / h, 50e-3 / 0.70, 1.0 / 100.0]
    return interface_temperatures(hot, 0.0, layers)


@pytest.mark.parametrize("h", [50.0, 1600.0, 30000.0])
def test_stationary_state_of_the_narrow_rig_is_the_resistance_chain(h):
    model = RigModel(NARROW, "temperature")
    T = model.read(model.steady(70.0, h, 0.0, 100.0), tuple(ENDS))
    expected, _ = chain(h, 70.0)
    np.testing.assert_allclose(T, expected[1:5], rtol=1e-6)


def test_power_and_temperature_drive_the_same_chain():
    _, flux = chain(1600.0, 70.0)
    model = RigModel(NARROW, "power")
    power = flux * 20e-3 * 60e-3
    T = model.read(model.steady(power, 1600.0, 0.0, 100.0), tuple(ENDS))
    np.testing.assert_allclose(T, chain(1600.0, 70.0)[0][1:5], rtol=1e-6)


@pytest.mark.parametrize("heater", ["power", "temperature"])
def test_a_long_record_ends_in_the_stationary_state(heater):
    rig = HeatingRig()
    model = RigModel(rig, heater)
    names = tuple(rig.thermocouples)
    coefficients = {"h": 1600.0, "loss": 10.0, "base": 100.0}
    readings = model.record(np.full(401, 5.0), 500.0, names, **coefficients)
    steady = model.read(model.steady(5.0, **coefficients), names)
    np.testing.assert_allclose(readings[-1], steady, rtol=1e-8)


def test_heat_balance_of_the_stationary_state():
    """The heater's power leaves through the free surfaces and the base."""
    rig = HeatingRig()
    model = RigModel(rig, "power")
    T = model.steady(6.0, 1600.0, 10.0, 100.0)
    out = 1e-3 * (10.0 * model.free_length + 100.0 * model.base_length) @ T
    assert 2.0 * out * rig.depth_mm / 1e3 == pytest.approx(6.0, rel=1e-10)


def test_free_surface_has_the_length_of_the_outline():
    """Half a section: sides of rubber and copper, asphalt beside the block and its side."""
    model = RigModel(HeatingRig(), "power")
    assert model.free_length.sum() == pytest.approx(28.0 + 65.0 + 50.0)
    assert model.base_length.sum() == pytest.approx(75.0)
    assert model.top_length.sum() == pytest.approx(10.0)


def test_the_wider_asphalt_is_cooler_and_not_one_dimensional():
    wide = replace(NARROW, asphalt_length_mm=150.0, thermocouples=default_thermocouples())
    model = RigModel(wide, "temperature")
    readings = model.read(model.steady(70.0, 1600.0, 0.0, 100.0), tuple(default_thermocouples()))
    T = dict(zip(default_thermocouples(), readings, strict=True))
    assert T["D1"] < chain(1600.0, 70.0)[0][3]
    assert T["E1"] < 0.7 * T["D1"]


def time_error(steps):
    rig = HeatingRig(thermocouples=ON_AXIS)
    model = RigModel(rig, "power")
    time = np.linspace(0.0, 1.0, steps + 1)
    fine = np.linspace(0.0, 1.0, 641)
    options = {"h": 1600.0, "loss": 10.0, "base": 100.0}
    names = tuple(ON_AXIS)
    one = model.record(time, 3200.0 / steps, names, **options)[-1]
    exact = model.record(fine, 5.0, names, **options)[-1]
    return np.abs(one - exact).max()


def test_time_scheme_has_order_two():
    errors = [time_error(n) for n in (20, 40, 80)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert np.all((orders > 1.8) & (orders < 2.3)), orders


def test_a_suddenly_hot_heater_does_not_make_the_readings_ring():
    rig = HeatingRig()
    model = RigModel(rig, "temperature")
    names = tuple(rig.thermocouples)
    drive = np.full(60, 70.0)
    drive[0] = 0.0
    readings = model.record(drive, 30.0, names, h=1600.0, loss=10.0, base=100.0)
    assert readings.min() > -0.05
    assert np.all(np.diff(readings[5:, 0]) > 0.0)


def test_finer_cells_change_the_readings_by_less_than_a_tenth_of_the_noise():
    names = tuple(default_thermocouples())
    readings = []
    for cells in (0.5, 0.25):
        model = RigModel(HeatingRig(cells_mm=cells), "power")
        readings.append(model.read(model.steady(6.0, 1600.0, 10.0, 100.0), names))
    assert np.abs(readings[0] - readings[1]).max() < 0.1


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"block_height_mm": 0.0}, "block_height_mm = 0.0, expected a number above 0"),
        ({"depth_mm": float("nan")}, "depth_mm = nan"),
        ({"loss_W_per_m2K": -1.0}, "loss_W_per_m2K = -1.0, expected a number of at least 0"),
        ({"asphalt_length_mm": 10.0}, "expected at least the length of the block, 20.0"),
        ({"block_height_mm": 5.0}, "thermocouple C1 at x = 0.0, y = 7.0 mm"),
        (
            {"thermocouples": {"E1": Thermocouple(x_mm=80.0, y_mm=-2.0)}},
            r"expected a place in the asphalt: \|x\| <= 75.0",
        ),
    ],
)
def test_rigs_that_cannot_be_are_refused(change, message):
    with pytest.raises(ValueError, match=message):
        HeatingRig(**change)
