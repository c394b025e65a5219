"""Which numbers can be meant: physical and usual ranges, and the units that are mistaken for them.

The one table behind the checks of case files, of calibrations and of measurements to compare with.
A number outside the physical range cannot be meant and is refused. One outside the usual range may
be meant; it is used, and said. Either way the likely slip is named: a temperature of 293.15 in a
column of degrees Celsius "looks like kelvin (20 deg C)".
"""

from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import ArrayLike

from materials.arrays import BoolArray, FloatArray, IndexArray

_NO_LIMIT = (0.0, np.inf)


@dataclass(frozen=True)
class Slip:
    """A unit that numbers are often given in by mistake: ours is ``(number - zero) * factor``."""

    unit: str
    factor: float
    zero: float = 0.0

    def converted(self, number: ArrayLike) -> FloatArray:
        """The number in the unit of the quantity."""
        with np.errstate(over="ignore"):  # infinite is as impossible as the number was
            return (np.asarray(number, dtype=float) - self.zero) * self.factor


@dataclass(frozen=True)
class Quantity:
    """What a column or a key holds.

    Parameters
    ----------
    what : str
        For messages, e.g. "a temperature".
    unit : str
        The unit of the numbers; empty for ratios.
    possible, usual : (low, high)
        Physical and usual range. For a quantity with a direction (`signed`) they hold for the
        amount.
    largest : (low, high)
        Usual range of the largest amount in a column: a whole column of tiny numbers is suspect
        where one of them is not.
    signed : bool
        Whether only the amount counts.
    zero : bool
        Whether zero is possible and usual, whatever the ranges say.
    slips : tuple of Slip
        The most likely first.
    """

    what: str
    unit: str
    _: KW_ONLY
    possible: tuple[float, float]
    usual: tuple[float, float]
    largest: tuple[float, float] = _NO_LIMIT
    signed: bool = False
    zero: bool = False
    slips: tuple[Slip, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Finding:
    """What is wrong with numbers: the first one, how many there are, and what is likely meant.

    Attributes
    ----------
    index : int
        Position of the first number that is out of range.
    value : float
        That number.
    impossible : bool
        Outside the physical range; otherwise only outside the usual one.
    count : int
        How many are out of that range.
    likely : str
        ``looks like kelvin (20 deg C)``; empty where no slip explains the number.
    expected : str
        ``a temperature from -200 to 250 deg C``.
    """

    index: int
    value: float
    impossible: bool
    count: int
    likely: str
    expected: str

    @property
    def found(self) -> str:
        """The number and what it looks like, for an error message."""
        return f"{self.value:g}" + (f", which {self.likely}" if self.likely else "")

    @property
    def sentence(self) -> str:
        """One line for a warning: number, how many more, the likely slip, the usual range."""
        more = f" and {self.count - 1} more" if self.count > 1 else ""
        likely = f"; it {self.likely}" if self.likely else ""
        return f"{self.value:g}{more} is unusual{likely}; usual is {self.expected}"


def judge(values: ArrayLike, quantity: Quantity) -> Finding | None:
    """Judge numbers by the ranges of a quantity.

    Parameters
    ----------
    values : array_like
        Any shape; NaN stands for nothing and is passed over.

    Returns
    -------
    Finding or None
        The first number outside the physical range, else the first outside the usual one.

    Examples
    --------
    >>> judge([20.0, 293.15], TEMPERATURE).found
    '293.15, which looks like kelvin (20 deg C)'
    >>> judge(0.25, PRESSURE) is None
    True
    """
    numbers = np.ravel(np.asarray(values, dtype=float))
    amounts = np.abs(numbers) if quantity.signed else numbers
    stated = ~np.isnan(numbers)
    if quantity.zero:
        stated &= numbers != 0.0
    for limits, impossible in ((quantity.possible, True), (quantity.usual, False)):
        out = np.flatnonzero(stated & ~((amounts >= limits[0]) & (amounts <= limits[1])))
        if out.size:
            return _finding(numbers, out, quantity, limits, impossible=impossible)
    if np.any(stated):
        low, high = quantity.largest
        peak = float(np.max(np.abs(numbers[stated])))
        if not low <= peak <= high:
            at = np.flatnonzero(stated & (np.abs(numbers) == peak))
            return _finding(numbers, at, quantity, (low, high), impossible=False)
    return None


def _finding(
    numbers: FloatArray,
    out: IndexArray,
    quantity: Quantity,
    limits: tuple[float, float],
    *,
    impossible: bool,
) -> Finding:
    return Finding(
        index=int(out[0]),
        value=float(numbers[out[0]]),
        impossible=impossible,
        count=int(out.size),
        likely=_likely(numbers, float(numbers[out[0]]), quantity),
        expected=_expected(quantity, limits),
    )


def _likely(numbers: FloatArray, worst: float, quantity: Quantity) -> str:
    """The slip that explains the number that stands out, and fits the rest of the column best."""
    stated = numbers[~np.isnan(numbers)]
    explaining = [slip for slip in quantity.slips if _usual(slip.converted(worst), quantity).all()]
    if not explaining:
        return ""
    rest = stated[_usual(stated, quantity)]
    if rest.size and quantity.largest[0] <= np.max(np.abs(rest)):
        # A single slip among good numbers: the one that takes it among them.
        low, high = rest.min(), rest.max()
        fitting = [slip for slip in explaining if low <= slip.converted(worst) <= high]
    else:
        fitting = [slip for slip in explaining if _usual(slip.converted(stated), quantity).all()]
    best = (fitting or explaining)[0]
    meant = f"{float(best.converted(worst)):.4g} {quantity.unit}".strip()
    return f"looks like {best.unit} ({meant})"


def _usual(numbers: FloatArray, quantity: Quantity) -> BoolArray:
    amounts = np.abs(numbers) if quantity.signed else numbers
    low, high = quantity.usual
    usual = (amounts >= low) & (amounts <= high)
    return np.asarray(usual | (quantity.zero & (numbers == 0.0)))


def _expected(quantity: Quantity, limits: tuple[float, float]) -> str:
    low, high = limits
    unit = f" {quantity.unit}" if quantity.unit else ""
    if low <= 0.0 and np.isinf(high):
        return quantity.what
    if np.isinf(high):
        return f"{quantity.what} that reaches {low:g}{unit}"
    return f"{quantity.what} from {low:g} to {high:g}{unit}"


_PASCALS = (
    Slip("kPa", 1e-3),
    Slip("bar", 0.1),
    Slip("psi", 6.894757e-3),
    Slip("kgf/cm^2", 9.80665e-2),
    Slip("Pa", 1e-6),
    Slip("GPa", 1e3),
)
_DEGREES = (Slip("kelvin", 1.0, 273.15), Slip("Fahrenheit", 5.0 / 9.0, 32.0))
_METRES = (Slip("metres", 1e3), Slip("micrometres", 1e-3), Slip("inches", 25.4))

#: Of rubber or road, measured or reached; rubber decomposes above.
TEMPERATURE = Quantity(
    "a temperature", "deg C", possible=(-200.0, 250.0), usual=(-100.0, 150.0), slips=_DEGREES
)
#: Of the surroundings, before anything slides.
START_TEMPERATURE = Quantity(
    "a temperature of road and air",
    "deg C",
    possible=(-90.0, 200.0),
    usual=(-40.0, 60.0),
    slips=_DEGREES,
)
#: On a block of rubber, or between it and the road.
PRESSURE = Quantity(
    "a pressure on rubber", "N/mm^2", possible=(1e-6, 20.0), usual=(5e-3, 1.5), slips=_PASCALS
)
SPEED = Quantity(
    "a sliding speed",
    "mm/s",
    possible=(1e-6, 1e5),
    usual=(1e-4, 3e4),
    largest=(1.0, np.inf),
    signed=True,
    slips=(Slip("m/s", 1e3),),
)
FRICTION = Quantity(
    "a friction coefficient",
    "",
    possible=(0.0, 6.0),
    usual=(1e-3, 3.0),
    largest=(0.02, np.inf),
    zero=True,
    slips=(Slip("per cent", 1e-2),),
)
SLIDING_DISTANCE = Quantity(
    "a sliding distance", "mm", possible=(1e-4, 1e6), usual=(0.5, 5e3), slips=_METRES
)
BLOCK_SIZE = Quantity(
    "a size of a tread block", "mm", possible=(0.1, 1e3), usual=(1.0, 200.0), slips=_METRES
)
SIPE_WIDTH = Quantity(
    "the width of a sipe", "mm", possible=(0.02, 20.0), usual=(0.1, 3.0), slips=_METRES
)
#: Between the end of the road and the pyrometer's spot.
PYROMETER_GAP = Quantity(
    what="a gap from the end of the road to the spot of a pyrometer",
    unit="mm",
    possible=(0.0, 1e4),
    usual=(0.5, 500.0),
    zero=True,
    slips=_METRES,
)
PYROMETER_SPOT = Quantity(
    what="the width of a pyrometer's spot",
    unit="mm",
    possible=(0.0, 200.0),
    usual=(0.1, 20.0),
    zero=True,
    slips=_METRES,
)
#: On the bottom of a block.
POSITION = Quantity(
    "a position",
    "mm",
    possible=(0.0, 1e5),
    usual=(0.0, 1e3),
    largest=(1.0, np.inf),
    signed=True,
    zero=True,
    slips=_METRES,
)
STRETCH = Quantity(
    "a stretch (1 is undeformed)",
    "",
    possible=(0.02, 12.0),
    usual=(0.2, 9.0),
    slips=(Slip("strain in per cent", 1e-2, -100.0),),
)
STRESS = Quantity(
    "a nominal stress",
    "N/mm^2",
    possible=(0.0, 1e3),
    usual=(0.0, 100.0),
    signed=True,
    zero=True,
    slips=_PASCALS,
)
#: Initial shear modulus of a rubber.
SHEAR_MODULUS = Quantity(
    "a shear modulus of rubber", "N/mm^2", possible=(1e-3, 200.0), usual=(0.1, 20.0), slips=_PASCALS
)
#: Storage and loss modulus over frequency, glass included.
DYNAMIC_MODULUS = Quantity(
    "a modulus",
    "N/mm^2",
    possible=(1e-5, 2e4),
    usual=(1e-3, 5e3),
    largest=(0.05, np.inf),
    slips=_PASCALS,
)
FREQUENCY = Quantity("a frequency", "Hz", possible=(1e-12, 1e12), usual=(1e-6, 1e8))
RUBBER_DENSITY = Quantity(
    "a density of rubber",
    "kg/m^3",
    possible=(100.0, 6e3),
    usual=(850.0, 2e3),
    slips=(Slip("g/cm^3", 1e3), Slip("t/mm^3", 1e12)),
)
SOLID_DENSITY = Quantity(
    "a density",
    "kg/m^3",
    possible=(100.0, 2.5e4),
    usual=(800.0, 1e4),
    slips=(Slip("g/cm^3", 1e3), Slip("t/mm^3", 1e12)),
)
SPECIFIC_HEAT = Quantity(
    "a specific heat",
    "kJ/(kg K)",
    possible=(0.05, 20.0),
    usual=(0.1, 4.3),
    slips=(Slip("J/(kg K)", 1e-3), Slip("mJ/(t K)", 1e-9)),
)
CONDUCTIVITY = Quantity(
    "a thermal conductivity",
    "W/(m K)",
    possible=(1e-3, 5e3),
    usual=(0.02, 20.0),
    slips=(Slip("mW/(m K)", 1e-3),),
)
#: Of metals, too.
SOLID_CONDUCTIVITY = Quantity(
    "a thermal conductivity",
    "W/(m K)",
    possible=(1e-3, 5e3),
    usual=(0.02, 500.0),
    slips=(Slip("mW/(m K)", 1e-3),),
)
CONDUCTANCE = Quantity(
    "a gap conductance",
    "W/(m^2 K)",
    possible=(1e-6, 1e9),
    usual=(20.0, 1e5),
    zero=True,
    slips=(Slip("kW/(m^2 K)", 1e3), Slip("N/(mm s K)", 1e3)),
)
AREA_OF_RISE = Quantity(
    "a temperature rise times length",
    "K mm",
    possible=(0.0, 1e5),
    usual=(0.0, 2e4),
    signed=True,
    zero=True,
)
TIME = Quantity("a time", "s", possible=(-1e9, 1e9), usual=(-1e9, 1e6))
POWER = Quantity(
    "a heating power",
    "W",
    possible=(0.0, 1e6),
    usual=(0.0, 1e4),
    zero=True,
    slips=(Slip("mW", 1e-3),),
)
WLF_D1 = Quantity("a WLF constant d1", "", possible=(1e-4, 1e4), usual=(1.0, 200.0))
WLF_D2 = Quantity("a WLF constant d2", "K", possible=(1.0, 1e5), usual=(10.0, 2e3))

#: What the columns of measured tables hold (stretch and stress are judged together, where read).
COLUMNS = {
    "T_C": TEMPERATURE,
    "T_max_C": TEMPERATURE,
    "T_0_C": START_TEMPERATURE,
    "heater_C": TEMPERATURE,
    "heater_power_W": POWER,
    "p_N_per_mm2": PRESSURE,
    "mean_pressure_N_per_mm2": PRESSURE,
    "v_mm_per_s": SPEED,
    "mu": FRICTION,
    "friction_coefficient": FRICTION,
    "A_T_K_mm": AREA_OF_RISE,
    "x_mm": POSITION,
    "X_mm": POSITION,
    "frequency_Hz": FREQUENCY,
    "omega_rad_per_s": FREQUENCY,
    "modulus_N_per_mm2": DYNAMIC_MODULUS,
    "loss_modulus_N_per_mm2": DYNAMIC_MODULUS,
    "time_s": TIME,
}
