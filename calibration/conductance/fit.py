"""Identification of the gap conductance h from thermocouple records of a static heating test.

The rig of `heating_rig` is simulated with the recorded heater as its input, and h is the value
whose readings fit the recorded ones best (section 3.4 of the paper, which found
1600 W/(m^2 K) at 0.3 N/mm^2). With h, the constant C of eq. (11) follows for a given surface.

What limits the result is rarely the noise: h acts through the temperature step across the gap,
a few per cent of the drop across the rubber, so an error of the rubber's conductivity or of a
thermocouple's place shifts h. The metadata of the result state how much the readings change for
5 % of h; compare that with what the installation can guarantee. The heater's column is taken as
linear between the rows: a row every 10 s or so keeps that error far below the noise.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pandas as pd

from calibration.conductance.heating_rig import Heater, HeatingRig, RigModel
from calibration.data import Table, read_table
from calibration.fitting import FitResult, Loss, Problem, fit
from contact.conductance import ContactSurface, GapConductance, mikic_constant
from fem.files import version_of
from materials.arrays import FloatArray
from materials.plausible import TEMPERATURE

HEATER_COLUMNS: dict[Heater, str] = {"power": "heater_power_W", "temperature": "heater_C"}

#: Parameters that can be fitted with h, with bounds.
ALSO = {"loss_W_per_m2K": (0.0, 200.0), "base_W_per_m2K": (0.0, 1e5)}
CONDUCTANCE = "h_W_per_m2K"
AMBIENT = "ambient_C"
BOUNDS = (10.0, 1e5)
#: One start is enough: the readings are monotonic in h.
START = 1000.0

#: Largest time step of the simulation [s], and largest number of steps.
LARGEST_STEP_S = 30.0
MOST_STEPS = 20_000
#: Allowed spread of the thermocouples in the first row [K].
UNIFORM_START_K = 5.0


@dataclass(frozen=True, kw_only=True)
class HeatingRecord:
    """A checked record of a heating test.

    Attributes
    ----------
    table : Table
        Where it came from.
    time : (n,) float array
        Times from the first row on [s].
    heater : {"power", "temperature"}
        What the heater's column holds.
    drive : (n,) float array
        The heater's column [W] or [C].
    names : tuple of str
        Thermocouples, s of them.
    readings : (n, s) float array
        Their temperatures [C].
    """

    table: Table
    time: FloatArray
    heater: Heater
    drive: FloatArray
    names: tuple[str, ...]
    readings: FloatArray


def read_heating_record(source: str | Path | pd.DataFrame, rig: HeatingRig) -> HeatingRecord:
    """Read and check a record of a heating test.

    Parameters
    ----------
    source : path or DataFrame
        Columns `time_s`, either `heater_power_W` or `heater_C`, and `<name>_C` for the
        thermocouples of the rig that were recorded (`C1_C` ... `E2_C`).
    rig : HeatingRig

    Raises
    ------
    DataError
        Naming file, row, column, what was found and what was expected.
    """
    table = read_table(source, ["time_s"])
    heater = _heater(table)
    names = tuple(name for name in rig.thermocouples if table.has(f"{name}_C"))
    _check_thermocouples(table, rig, names)
    table.require_rows(3, "a heating test")
    time = table.numbers("time_s")
    table.require_all("time_s", np.append(True, np.diff(time) > 0.0), "a time after the row before")
    readings = np.column_stack([table.numbers(f"{name}_C", TEMPERATURE) for name in names])
    spread = float(np.ptp(readings[0]))
    if spread > UNIFORM_START_K:
        table.refuse_at(
            0,
            "",
            f"thermocouples {spread:.3g} K apart",
            f"a start at uniform temperature (within {UNIFORM_START_K:g} K)",
        )
    return HeatingRecord(
        table=table,
        time=time - time[0],
        heater=heater,
        drive=_drive(table, heater, float(readings[0].mean())),
        names=names,
        readings=readings,
    )


def _heater(table: Table) -> Heater:
    present: list[Heater] = [key for key, column in HEATER_COLUMNS.items() if table.has(column)]
    if len(present) != 1:
        table.refuse(
            found="both heater columns" if present else "no heater column",
            expected="either heater_power_W or heater_C",
        )
    return present[0]


def _check_thermocouples(table: Table, rig: HeatingRig, names: tuple[str, ...]) -> None:
    above = [name for name in names if rig.thermocouples[name].y_mm >= 0.0]
    if not above or len(above) == len(names):
        table.refuse(
            found=f"the thermocouples {', '.join(names) or 'none'}",
            expected="at least one column in the rubber and one in the asphalt, of "
            + ", ".join(f"{name}_C" for name in rig.thermocouples),
        )


def _drive(table: Table, heater: Heater, start_C: float) -> FloatArray:
    column = HEATER_COLUMNS[heater]
    values = table.numbers(column)
    if heater == "temperature" and np.abs(values - start_C).max() < 1.0:
        table.refuse(column=column, found="a heater that stays cold", expected="heating")
    if heater == "power" and not values.any():
        table.refuse(column=column, found="no power in any row", expected="heating")
    return values


@dataclass(frozen=True, kw_only=True)
class RigPrediction:
    """Readings of a rig for the heater of a record, as a function of the fitted parameters.

    Attributes
    ----------
    rig : HeatingRig
    model : RigModel
    record : HeatingRecord
    names : tuple of str
        Parameters in their order.
    """

    rig: HeatingRig
    model: RigModel
    record: HeatingRecord
    names: tuple[str, ...]

    def __call__(self, theta: FloatArray) -> FloatArray:
        """Readings at the times of the record, (n, s) flattened [C]."""
        values = dict(zip(self.names, map(float, theta), strict=True))
        ambient = values.get(AMBIENT, self.rig.ambient_C)
        if ambient is None:
            raise ValueError("the rig has no ambient temperature, and it is not fitted")
        excess = simulate_readings(
            self.model,
            self.record,
            h=values[CONDUCTANCE],
            loss=values.get("loss_W_per_m2K", self.rig.loss_W_per_m2K),
            base=values.get("base_W_per_m2K", self.rig.base_W_per_m2K),
            ambient_C=ambient,
        )
        return (ambient + excess).ravel()


def simulate_readings(
    model: RigModel,
    record: HeatingRecord,
    *,
    h: float,
    loss: float,
    base: float,
    ambient_C: float,
) -> FloatArray:
    """Readings above ambient at the times of a record, (n, s) [K]."""
    time = record.time
    longest = min(float(np.median(np.diff(time))), LARGEST_STEP_S)
    steps = min(max(int(np.ceil(time[-1] / longest - 1e-9)), 1), MOST_STEPS)
    grid = np.linspace(0.0, time[-1], steps + 1)
    drive = np.interp(grid, time, record.drive)
    if record.heater == "temperature":
        drive = drive - ambient_C
    found = model.record(drive, grid[1], record.names, h=h, loss=loss, base=base)
    return np.column_stack([np.interp(time, grid, column) for column in found.T])


def fit_conductance(
    source: str | Path | pd.DataFrame,
    rig: HeatingRig | None = None,
    *,
    also: Sequence[str] = (),
    loss: Loss = "linear",
) -> FitResult:
    """Identify the gap conductance from a heating test.

    Parameters
    ----------
    source : path or DataFrame
        See `read_heating_record`.
    rig : HeatingRig, optional
        Dimensions, materials, losses. Without an ambient temperature it is fitted as well.
    also : sequence of str
        Loss coefficients to fit as well: "loss_W_per_m2K", "base_W_per_m2K".
    loss : {"linear", "soft_l1", "huber", "cauchy"}
        Robust losses bound the pull of outliers.

    Returns
    -------
    FitResult
        `.values["h_W_per_m2K"]`, with `.model` the `GapConductance` through it.
    """
    rig = rig or HeatingRig()
    unknown = set(also) - set(ALSO)
    if unknown:
        raise ValueError(
            f"also = {', '.join(sorted(unknown))}, expected names of {', '.join(ALSO)}"
        )
    record = read_heating_record(source, rig)
    ambient = (AMBIENT,) if rig.ambient_C is None else ()
    names = (CONDUCTANCE, *ambient, *(name for name in ALSO if name in also))
    record.table.require_rows(len(names) + 1, f"{len(names)} parameters")
    predict = RigPrediction(rig=rig, model=RigModel(rig, record.heater), record=record, names=names)
    start = float(record.readings[0].mean())
    begin = {CONDUCTANCE: START, AMBIENT: start, **{name: getattr(rig, name) for name in ALSO}}
    bounds = {CONDUCTANCE: BOUNDS, AMBIENT: (start - 10.0, start + 10.0), **ALSO}
    problem = Problem(
        names=names,
        predict=predict,
        observed=record.readings.ravel(),
        lower=np.array([bounds[name][0] for name in names]),
        upper=np.array([bounds[name][1] for name in names]),
    )
    result = fit(problem, np.array([begin[name] for name in names]), loss=loss, noise=0.5)
    return _completed(result, rig, record)


def _completed(result: FitResult, rig: HeatingRig, record: HeatingRecord) -> FitResult:
    h = result.values[CONDUCTANCE]
    law = GapConductance(h_ref=h, p_ref=rig.pressure_N_per_mm2)
    problem = result.problem
    assert problem is not None
    slope = problem.slopes(result.theta)[:, 0]
    metadata = {
        "kind": "conductance",
        "model": "static heating of the rig, plane",
        **record.table.origin,
        "thermocouples": list(record.names),
        "heater": record.heater,
        "pressure_N_per_mm2": rig.pressure_N_per_mm2,
        "reading_change_for_5_percent_K": float(0.05 * h * np.abs(slope).max()),
        "version": version_of(),
    }
    heat = {
        "conductance_W_per_m2K": h,
        "pressure_N_per_mm2": rig.pressure_N_per_mm2,
        "exponent": law.exponent,
    }
    return replace(result, model=law, metadata=metadata, section={"heat": heat})


@dataclass(frozen=True, kw_only=True)
class MikicConstant:
    """Constant C of eq. (11) with its standard error [-]."""

    value: float
    stderr: float


def conductance_constant(result: FitResult, surface: ContactSurface) -> MikicConstant:
    """Constant C of eq. (11) from an identified conductance.

    Parameters
    ----------
    result : FitResult
        From `fit_conductance`.
    surface : ContactSurface
        Conductivity, modulus, roughness and slope of the surfaces in the test; their own
        uncertainty is not part of the standard error.
    """
    law = result.model
    if not isinstance(law, GapConductance):
        raise ValueError(
            f"a fit of {result.metadata.get('kind', 'something else')}, expected a fit of a "
            "conductance"
        )
    C = mikic_constant(law.h_ref, law.p_ref, surface)
    return MikicConstant(value=C, stderr=C * result.stderr[CONDUCTANCE] / law.h_ref)


def synthetic_heating_record(
    rig: HeatingRig | None = None,
    *,
    h_W_per_m2K: float = 1600.0,
    noise_K: float = 0.3,
    seed: int = 0,
    heating_s: float = 5400.0,
    cooling_s: float = 3600.0,
    every_s: float = 10.0,
    heater: Heater = "power",
    power_W: float = 6.0,
    heater_C: float = 90.0,
) -> pd.DataFrame:
    """Made-up record of a heating test: heating, then cooling, with normal noise.

    Only for tests and demonstrations. The simulation behind it takes steps four times finer than
    the fit does.

    Parameters
    ----------
    rig : HeatingRig, optional
        An ambient temperature of None is taken as 20 C.
    h_W_per_m2K : float
    noise_K : float
        Standard deviation of every thermocouple reading.
    heating_s, cooling_s, every_s : float
        Duration of both phases and interval of the rows [s].
    heater, power_W, heater_C
        Kind of the heater's column, and its value during heating. While cooling, the power is
        zero or the heater's temperature decays to the ambient one within about 15 minutes.
    """
    rig = rig or HeatingRig()
    ambient = 20.0 if rig.ambient_C is None else rig.ambient_C
    fine = 4
    steps = round((heating_s + cooling_s) / every_s) * fine
    time = np.arange(steps + 1) * every_s / fine
    drive = _schedule(time, heating_s, every_s, heater, power_W, heater_C - ambient)
    names = tuple(rig.thermocouples)
    excess = RigModel(rig, heater).record(
        drive,
        every_s / fine,
        names,
        h=h_W_per_m2K,
        loss=rig.loss_W_per_m2K,
        base=rig.base_W_per_m2K,
    )[::fine]
    noise = np.random.default_rng(seed).normal(scale=noise_K, size=excess.shape)
    shown = drive[::fine] + (ambient if heater == "temperature" else 0.0)
    columns = {"time_s": time[::fine], HEATER_COLUMNS[heater]: shown}
    readings = ambient + excess + noise
    return pd.DataFrame(columns | {f"{n}_C": readings[:, k] for k, n in enumerate(names)})


def _schedule(
    time: FloatArray, heating_s: float, ramp_s: float, heater: Heater, power_W: float, rise_K: float
) -> FloatArray:
    """Heater over time; switched within one row of the record, as the fit takes it."""
    after = time - heating_s
    if heater == "power":
        return np.asarray(power_W * np.clip(1.0 - after / ramp_s, 0.0, 1.0))
    warming = rise_K * (1.0 - np.exp(-time / 600.0))
    return np.asarray(np.where(after > 0.0, rise_K * np.exp(-after / 900.0), warming))
