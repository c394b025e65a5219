"""The `calibrate` command: its arguments, and what happens when it fails."""

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, get_args

from calibration.conductance import ALSO
from calibration.data import DataError
from calibration.fitting import watched
from calibration.friction import forms
from calibration.outcomes import (
    PARAMETERS_FILE,
    Outcome,
    calibrate_conductance,
    calibrate_friction,
    calibrate_hyperelastic,
    calibrate_mullins,
    calibrate_partition,
    calibrate_viscoelastic,
    calibrate_wlf,
)
from calibration.partition import MOST_SIMULATIONS, SIMULATIONS_FOLDER, SimulationStoppedError
from calibration.rubber import STRESS_MODELS, Zero
from calibration.shifting import Vertical
from fem.case import Case, CaseError, describe, parse_override
from fem.files import BAD_INPUT, DONE, NOT_CONVERGED, say_of
from fem.results import chosen_output, output_folder
from materials.hyperelastic import MODES
from materials.units import ABSOLUTE_ZERO_C
from materials.wlf import WLF

CONSTANTS = WLF()
#: Arguments that are no options of a fit.
_GENERAL = ("command", "kind", "data", "output", "quiet", "accept_unusual")


def add_arguments(commands: Any) -> None:
    """Add `calibrate` with its kinds of data to the sub-commands of a parser."""
    parser = commands.add_parser(
        "calibrate",
        help="fit parameters to measurements",
        description="Fit parameters to measurements and write a parameter file for a case.",
    )
    kinds = parser.add_subparsers(metavar="KIND", required=True, dest="kind")
    for name, (description, add, _) in KINDS.items():
        kind = kinds.add_parser(name, help=description, description=f"Fit {description}.")
        kind.add_argument("data", metavar="DATA.csv", help="measurements")
        kind.add_argument("-o", "--output", metavar="DIR", help="folder of the results")
        kind.add_argument("--quiet", action="store_true", help="print nothing but errors")
        kind.add_argument(
            "--accept-unusual",
            action="store_true",
            help="no warning of numbers outside their usual range (the result file keeps it)",
        )
        add(kind.add_argument)
        kind.set_defaults(command=run)


def run(arguments: argparse.Namespace) -> int:
    """Run one calibration; bad data end with one line and exit code 2."""
    default = Path("results") / "calibration" / arguments.kind
    directory = chosen_output(arguments.output, default)
    with output_folder(directory, files=[PARAMETERS_FILE], folders=[SIMULATIONS_FOLDER]):
        # The fit of the partition keeps and shows its simulations.
        simulates = arguments.kind == "partition"
        shown = {"directory": directory, "quiet": arguments.quiet} if simulates else {}
        try:
            with watched(f"fit to {arguments.data}", quiet=arguments.quiet or simulates):
                _, _, calibrate = KINDS[arguments.kind]
                outcome = calibrate(arguments.data, **_given(arguments), **shown)
        except ValueError as error:
            # DataError and CaseError say the file; other messages are about the options
            place = "" if isinstance(error, DataError | CaseError) else f"{arguments.data}: "
            print(f"treadfem: {place}{error}", file=sys.stderr)
            return BAD_INPUT
        except SimulationStoppedError as error:
            print(f"treadfem: {error} (finished simulations stay in {directory})", file=sys.stderr)
            return NOT_CONVERGED
        outcome.write(directory)
    if not arguments.quiet:
        unusual = () if arguments.accept_unusual else outcome.unusual
        say_of(arguments.data, outcome.notes, unusual)
        print(outcome.text)
        print(f"results in {directory}")
    return DONE


def _given(arguments: argparse.Namespace) -> dict[str, Any]:
    """The options that were given, under the names of the fits, which know the other defaults."""
    given = {
        name: value
        for name, value in vars(arguments).items()
        if value is not None and name not in _GENERAL
    }
    made = {"fixed": dict, "window": tuple}
    return {name: made[name](value) if name in made else value for name, value in given.items()}


# -- options of each kind, stored under the names that the fits give them --------------------------


def _add_hyperelastic(add: Callable[..., Any]) -> None:
    add("--model", choices=STRESS_MODELS)
    add("--cycle", type=_cycle, help='"last-full", "all" or a number')
    add("--branch", choices=("both", "load", "unload"))
    add("--window", nargs=2, type=_finite, metavar=("LOW", "HIGH"), help="stretches used")
    add("--mode", choices=MODES, action="append", dest="modes", help="may be repeated")
    add(
        "--zero",
        choices=get_args(Zero),
        help="subtract the stress of the first row (preload), or refer the test to the length at "
        "which the loop comes back to zero stress (permanent set)",
    )
    add("--weights", choices=("equal", "modes", "relative"))
    _add_comparing(add, "N/mm^2", "noise_N_per_mm2")


def _add_viscoelastic(add: Callable[..., Any]) -> None:
    add("--model", choices=STRESS_MODELS, help="elastic law of histories (yeoh)")
    add("--branches", type=_count, metavar="N", help="number (default: as few as the data support)")
    _add_histories(add)
    add("--weights", choices=("equal", "tests"), help="rows or tests alike")
    add("--C1", type=_positive, help="WLF constant for histories with T_C")
    add("--C2", type=_positive, metavar="K", help="the other one")
    _add_T_ref(add, "of the relaxation times (default: 20, or the sweep in the middle)")
    _add_shifting(add)
    _add_robust(add, "N/mm^2, of sweeps relative")


def _viscoelastic(
    path: str, *, C1: float | None = None, C2: float | None = None, **options: Any
) -> Outcome:
    if (C1 is None) != (C2 is None):
        raise ValueError("one of --C1 and --C2 is missing; expected both or neither")
    if C1 is not None and C2 is not None:
        options["shift"] = WLF(d1=C1, d2_K=C2)
    return calibrate_viscoelastic(path, **options)


def _add_mullins(add: Callable[..., Any]) -> None:
    add("--model", choices=STRESS_MODELS)
    _add_histories(add)
    _add_robust(add, "N/mm^2", "noise_N_per_mm2")


def _add_histories(add: Callable[..., Any]) -> None:
    add("--mode", choices=MODES, help="of a table without that column (uniaxial)")
    text = "rows of earlier cycles load the rubber and are not compared"
    add("--from-cycle", type=_count, metavar="N", help=text)
    _add_fix(add)


def _add_friction(add: Callable[..., Any]) -> None:
    add("--law", choices=forms())
    text = "shift of the speed by T_C: none, with --d1 and --d2, or fitted together"
    add("--wlf", choices=("none", "given", "fit"), help=text)
    add("--d1", type=_positive, default=CONSTANTS.d1)
    add("--d2", type=_positive, default=CONSTANTS.d2_K, metavar="K")
    _add_T_ref(add, "of the fitted law (default %(default)g)", default=20.0)
    add(
        "--wlf-T-ref",
        type=_celsius,
        metavar="C",
        dest="wlf_T_ref_C",
        help="temperature --d1 and --d2 refer to; they are rebased to --T-ref (default: the same)",
    )
    _add_comparing(add, "of mu")


def _friction(
    path: str,
    *,
    d1: float,
    d2: float,
    T_ref_C: float,
    wlf: str = "none",
    wlf_T_ref_C: float | None = None,
    **options: Any,
) -> Outcome:
    def given() -> WLF:
        constants = WLF(d1=d1, d2_K=d2)
        return constants if wlf_T_ref_C is None else constants.rebased(wlf_T_ref_C, T_ref_C)

    shift = given() if wlf == "given" else {"none": None, "fit": "fit"}[wlf]
    return calibrate_friction(path, wlf=shift, T_ref_C=T_ref_C, **options)


def _add_wlf(add: Callable[..., Any]) -> None:
    _add_T_ref(add, "the constants refer to")
    text = "temperatures used [deg C]; what lies outside is named"
    add("--window", nargs=2, type=_finite, metavar=("LOW", "HIGH"), help=text)
    text = "the table holds 1/a_T, which rises with temperature"
    add("--other-sign", action="store_true", help=text)
    _add_shifting(add)


def _add_shifting(add: Callable[..., Any]) -> None:
    text = "vertical shift T rho/(T_0 rho_0) of the moduli, none, or the better of the two"
    add("--vertical", choices=get_args(Vertical), help=text)
    add(
        "--expansion",
        type=_not_negative,
        metavar="PER_K",
        dest="expansion_per_K",
        help="thermal expansion of the volume, for rho/rho_0 (default: rho stays)",
    )
    add(
        "--T-tolerance",
        type=_not_negative,
        metavar="K",
        dest="T_tolerance_K",
        help="rows within that of each other are one sweep (default: 1 K where needed)",
    )


def _add_conductance(add: Callable[..., Any]) -> None:
    text = "dimensions of the rig and its parts"
    add("--rig", metavar="RIG.toml", dest="rig_file", help=text)
    add("--also", choices=ALSO, action="append", help="heat losses to fit as well")


def _add_partition(add: Callable[..., Any]) -> None:
    text = "the block that slid; pressure and velocity come from the data"
    add("--case", metavar="CASE.toml", required=True, help=text)
    text = "set a key of the case; may be repeated"
    add("--set", metavar="section.key=value", action="append", dest="overrides", help=text)
    text = "compare whole temperature profiles (where the data hold some) or their peaks"
    add("--profile", choices=("whole", "peak"), help=text)
    text = f"at most that many per pressure and velocity (default {MOST_SIMULATIONS})"
    add("--simulations", type=_count, metavar="N", help=text)
    add("--workers", type=_count, metavar="N", help="simulations at a time (default: one per core)")
    text = "95 %% intervals from the covariance or the profile of the sum of squares"
    add("--intervals", choices=("student", "profile"), help=text)


def _partition(path: str, *, case: str, overrides: Sequence[str] = (), **options: Any) -> Outcome:
    block = Case.from_toml(case, dict(map(parse_override, overrides)))
    return calibrate_partition(path, block, **options)


def _add_T_ref(add: Callable[..., Any], of: str, default: float | None = None) -> None:
    text = f"temperature {of}"
    add("--T-ref", type=_celsius, default=default, metavar="C", dest="T_ref_C", help=text)


def _add_fix(add: Callable[..., Any]) -> None:
    text = "hold a parameter"
    add("--fix", metavar="NAME=VALUE", type=_fixed, action="append", dest="fixed", help=text)


def _add_comparing(add: Callable[..., Any], unit: str, noise: str = "noise") -> None:
    _add_fix(add)
    add("--starts", type=_count, help="starting points")
    _add_robust(add, unit, noise)
    text = "leave out the other models"
    add("--no-compare", action="store_const", const=False, dest="compare", help=text)


def _add_robust(add: Callable[..., Any], unit: str, noise: str = "noise") -> None:
    text = "a robust loss bounds the pull of outliers"
    add("--loss", choices=("linear", "soft_l1", "huber", "cauchy"), help=text)
    text = f"residual where that begins [{unit}]"
    add("--noise", type=_positive, dest=noise, metavar="NOISE", help=text)
    text = "95 %% intervals from the covariance, the profile or resampling"
    add("--intervals", choices=("student", "profile", "bootstrap"), help=text)


def _finite(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"found {describe(text)}, expected a finite number")
    return value


def _number(valid: Callable[[float], bool], expected: str) -> Callable[[str], float]:
    """Reader of a finite number that must be valid besides."""

    def read(text: str) -> float:
        value = _finite(text)
        if not valid(value):
            raise argparse.ArgumentTypeError(f"found {text}, expected {expected}")
        return value

    return read


_positive = _number(lambda value: value > 0.0, "a number above 0")
_not_negative = _number(lambda value: value >= 0.0, "0 or more")
_celsius = _number(
    lambda value: value > ABSOLUTE_ZERO_C,
    f"a temperature above absolute zero, {ABSOLUTE_ZERO_C} deg C",
)


def _cycle(text: str) -> str | int:
    if text in ("last-full", "all"):
        return text
    if not text.isdecimal() or len(text) > 9:
        raise argparse.ArgumentTypeError(
            f'found {describe(text)}, expected "last-full", "all" or a cycle\'s number'
        )
    return int(text)


def _count(text: str) -> int:
    if not text.isdecimal() or len(text) > 6 or int(text) < 1:
        raise argparse.ArgumentTypeError(
            f"found {describe(text)}, expected a whole number, 1 or more"
        )
    return int(text)


def _fixed(text: str) -> tuple[str, float]:
    name, equals, value = text.partition("=")
    if not equals or not name.strip():
        raise argparse.ArgumentTypeError(f"found {describe(text)}, expected NAME=VALUE")
    return name.strip(), _finite(value)


#: What is fitted, its options, and how; the path of the data comes first.
KINDS: dict[str, tuple[str, Callable[[Callable[..., Any]], None], Callable[..., Outcome]]] = {
    "hyperelastic": (
        "a hyperelastic model to stress-stretch tests",
        _add_hyperelastic,
        calibrate_hyperelastic,
    ),
    "viscoelastic": (
        "relaxation times to stress histories or frequency sweeps",
        _add_viscoelastic,
        _viscoelastic,
    ),
    "mullins": ("softening to first and later cycles", _add_mullins, calibrate_mullins),
    "friction": ("a friction law to friction coefficients", _add_friction, _friction),
    "partition": (
        "the heat partition to surface temperatures of sliding blocks",
        _add_partition,
        _partition,
    ),
    "conductance": (
        "the gap conductance to a static heating test",
        _add_conductance,
        calibrate_conductance,
    ),
    "wlf": ("the WLF shift to shift factors or frequency sweeps", _add_wlf, calibrate_wlf),
}
