"""The `calibrate` command: its arguments, and what happens when it fails."""

import argparse
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, get_args

from calibration.conductance.fit import ALSO
from calibration.data.errors import DataError
from calibration.fitting.progress import watched
from calibration.friction.curves import forms
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
from calibration.partition.fit import MOST_SIMULATIONS
from calibration.partition.simulation_store import SIMULATIONS_FOLDER, SimulationStoppedError
from calibration.rubber.stress_models import STRESS_MODELS
from calibration.rubber.stress_zero import Zero
from calibration.shifting.master_curve import Vertical
from fem.case.case import Case
from fem.case.errors import CaseError, describe
from fem.case.reading import parse_override
from fem.files.messages import BAD_INPUT, DONE, NOT_CONVERGED, say_of
from fem.results.output_folder import chosen_output, output_folder
from materials.hyperelastic import MODES
from materials.units import ABSOLUTE_ZERO_C
from materials.wlf import WLF

CONSTANTS = WLF()


def add_arguments(commands: Any) -> None:
    """Add `calibrate` with its kinds of data to the sub-commands of a parser."""
    parser = commands.add_parser(
        "calibrate",
        help="fit parameters to measurements",
        description="Fit parameters to measurements and write a parameter file for a case.",
    )
    kinds = parser.add_subparsers(metavar="KIND", required=True, dest="kind")
    for name, (add, description) in KINDS.items():
        kind = kinds.add_parser(name, help=description, description=f"Fit {description}.")
        kind.add_argument("data", metavar="DATA.csv", help="measurements")
        kind.add_argument("-o", "--output", metavar="DIR", help="folder of the results")
        kind.add_argument("--quiet", action="store_true", help="print nothing but errors")
        kind.add_argument(
            "--accept-unusual",
            action="store_true",
            help="no warning of numbers outside their usual range (the result file keeps it)",
        )
        add(kind)
        kind.set_defaults(command=run)


def run(arguments: argparse.Namespace) -> int:
    """Run one calibration; bad data end with one line and exit code 2."""
    directory = _folder(arguments)
    with output_folder(directory, files=[PARAMETERS_FILE], folders=[SIMULATIONS_FOLDER]):
        try:
            # The fit of the partition shows its simulations.
            quiet = arguments.quiet or arguments.kind == "partition"
            with watched(f"fit to {arguments.data}", quiet=quiet):
                outcome: Outcome = arguments.calibrate(arguments)
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


def _folder(arguments: argparse.Namespace) -> Path:
    default = Path("results") / "calibration" / arguments.kind
    return chosen_output(arguments.output, default)


def _add_hyperelastic(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--model", choices=STRESS_MODELS, default="yeoh")
    parser.add_argument("--cycle", type=_cycle, help='"last-full", "all" or a number')
    parser.add_argument("--branch", choices=("both", "load", "unload"), default="both")
    parser.add_argument(
        "--window", nargs=2, type=_finite, metavar=("LOW", "HIGH"), help="stretches used"
    )
    parser.add_argument("--mode", choices=MODES, action="append", help="may be repeated")
    parser.add_argument(
        "--zero",
        choices=get_args(Zero),
        default="none",
        help="subtract the stress of the first row (preload), or refer the test to the length at "
        "which the loop comes back to zero stress (permanent set)",
    )
    parser.add_argument("--weights", choices=("equal", "modes", "relative"), default="equal")
    _add_common(parser, "N/mm^2")

    def calibrate(arguments: argparse.Namespace) -> Outcome:
        return calibrate_hyperelastic(
            arguments.data,
            model=arguments.model,
            cycle=arguments.cycle,
            branch=arguments.branch,
            window=None if arguments.window is None else tuple(arguments.window),
            modes=arguments.mode,
            zero=arguments.zero,
            weights=arguments.weights,
            noise_N_per_mm2=0.05 if arguments.noise is None else arguments.noise,
            **_common(arguments),
        )

    parser.set_defaults(calibrate=calibrate)


def _add_viscoelastic(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--model", choices=STRESS_MODELS, help="elastic law of histories (yeoh)")
    parser.add_argument(
        "--branches", type=_count, metavar="N", help="number (default: as few as the data support)"
    )
    _add_histories(parser)
    parser.add_argument("--weights", choices=("equal", "tests"), help="rows or tests alike")
    parser.add_argument("--C1", type=_positive, help="WLF constant for histories with T_C")
    parser.add_argument("--C2", type=_positive, metavar="K", help="the other one")
    parser.add_argument(
        "--T-ref",
        type=_celsius,
        metavar="C",
        dest="T_ref_C",
        help="temperature of the relaxation times (default: 20, or the sweep in the middle)",
    )
    _add_shifting(parser, vertical=None, expansion=None)
    _add_robust(parser, "N/mm^2, of sweeps relative")

    def calibrate(arguments: argparse.Namespace) -> Outcome:
        if (arguments.C1 is None) != (arguments.C2 is None):
            raise ValueError("one of --C1 and --C2 is missing; expected both or neither")
        shift = None if arguments.C1 is None else WLF(d1=arguments.C1, d2_K=arguments.C2)
        return calibrate_viscoelastic(
            arguments.data,
            intervals=arguments.intervals,
            loss=arguments.loss,
            **_given(
                model=arguments.model,
                branches=arguments.branches,
                weights=arguments.weights,
                shift=shift,
                T_ref_C=arguments.T_ref_C,
                vertical=arguments.vertical,
                expansion_per_K=arguments.expansion,
                T_tolerance_K=arguments.T_tolerance_K,
                noise=arguments.noise,
                **_histories(arguments),
            ),
        )

    parser.set_defaults(calibrate=calibrate)


def _add_mullins(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--model", choices=STRESS_MODELS, default="yeoh")
    _add_histories(parser)
    _add_robust(parser, "N/mm^2")

    def calibrate(arguments: argparse.Namespace) -> Outcome:
        return calibrate_mullins(
            arguments.data,
            model=arguments.model,
            intervals=arguments.intervals,
            loss=arguments.loss,
            **_given(noise_N_per_mm2=arguments.noise, **_histories(arguments)),
        )

    parser.set_defaults(calibrate=calibrate)


def _add_histories(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--mode", choices=MODES, help="of a table without that column (uniaxial)")
    parser.add_argument(
        "--from-cycle",
        type=_count,
        metavar="N",
        help="rows of earlier cycles load the rubber and are not compared",
    )
    parser.add_argument(
        "--fix", metavar="NAME=VALUE", type=_fixed, action="append", help="hold a parameter"
    )


def _histories(arguments: argparse.Namespace) -> dict[str, Any]:
    fixed = None if arguments.fix is None else dict(arguments.fix)
    return {"mode": arguments.mode, "from_cycle": arguments.from_cycle, "fixed": fixed}


def _given(**options: Any) -> dict[str, Any]:
    """Options that were given; the fits know the defaults of the others."""
    return {name: value for name, value in options.items() if value is not None}


def _add_friction(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--law", choices=forms(), default="huemer")
    parser.add_argument(
        "--wlf",
        choices=("none", "given", "fit"),
        default="none",
        help="shift of the speed by T_C: none, with --d1 and --d2, or fitted together",
    )
    parser.add_argument("--d1", type=_positive, default=CONSTANTS.d1)
    parser.add_argument("--d2", type=_positive, default=CONSTANTS.d2_K, metavar="K")
    parser.add_argument(
        "--T-ref",
        type=_celsius,
        default=20.0,
        metavar="C",
        dest="T_ref_C",
        help="temperature of the fitted law (default %(default)g)",
    )
    parser.add_argument(
        "--wlf-T-ref",
        type=_celsius,
        metavar="C",
        dest="wlf_T_ref_C",
        help="temperature --d1 and --d2 refer to; they are rebased to --T-ref (default: the same)",
    )
    _add_common(parser, "of mu")

    def calibrate(arguments: argparse.Namespace) -> Outcome:
        shift = {"none": lambda: None, "given": lambda: _wlf(arguments), "fit": lambda: "fit"}
        return calibrate_friction(
            arguments.data,
            law=arguments.law,
            wlf=shift[arguments.wlf](),
            T_ref_C=arguments.T_ref_C,
            noise=0.05 if arguments.noise is None else arguments.noise,
            **_common(arguments),
        )

    parser.set_defaults(calibrate=calibrate)


def _wlf(arguments: argparse.Namespace) -> WLF:
    given = WLF(d1=arguments.d1, d2_K=arguments.d2)
    if arguments.wlf_T_ref_C is None:
        return given
    return given.rebased(arguments.wlf_T_ref_C, arguments.T_ref_C)


def _add_wlf(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--T-ref",
        type=_celsius,
        metavar="C",
        dest="T_ref_C",
        help="temperature the constants refer to",
    )
    parser.add_argument(
        "--window",
        nargs=2,
        type=_finite,
        metavar=("LOW", "HIGH"),
        help="temperatures used [deg C]; what lies outside is named",
    )
    parser.add_argument(
        "--other-sign",
        action="store_true",
        help="the table holds 1/a_T, which rises with temperature",
    )
    _add_shifting(parser, vertical="auto", expansion=0.0)

    def calibrate(arguments: argparse.Namespace) -> Outcome:
        return calibrate_wlf(
            arguments.data,
            T_ref_C=arguments.T_ref_C,
            window=None if arguments.window is None else tuple(arguments.window),
            other_sign=arguments.other_sign,
            vertical=arguments.vertical,
            expansion_per_K=arguments.expansion,
            T_tolerance_K=arguments.T_tolerance_K,
        )

    parser.set_defaults(calibrate=calibrate)


def _add_shifting(
    parser: argparse.ArgumentParser, *, vertical: str | None, expansion: float | None
) -> None:
    parser.add_argument(
        "--vertical",
        choices=get_args(Vertical),
        default=vertical,
        help="vertical shift T rho/(T_0 rho_0) of the moduli, none, or the better of the two",
    )
    parser.add_argument(
        "--expansion",
        type=_not_negative,
        default=expansion,
        metavar="PER_K",
        help="thermal expansion of the volume, for rho/rho_0 (default: rho stays)",
    )
    parser.add_argument(
        "--T-tolerance",
        type=_not_negative,
        metavar="K",
        dest="T_tolerance_K",
        help="rows within that of each other are one sweep (default: 1 K where needed)",
    )


def _add_conductance(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--rig", metavar="RIG.toml", help="dimensions of the rig and its parts")
    parser.add_argument(
        "--also", choices=ALSO, action="append", default=[], help="heat losses to fit as well"
    )
    parser.set_defaults(
        calibrate=lambda arguments: calibrate_conductance(
            arguments.data, rig_file=arguments.rig, also=arguments.also
        )
    )


def _add_partition(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--case",
        metavar="CASE.toml",
        required=True,
        help="the block that slid; pressure and velocity come from the data",
    )
    parser.add_argument(
        "--set",
        metavar="section.key=value",
        action="append",
        default=[],
        dest="overrides",
        help="set a key of the case; may be repeated",
    )
    parser.add_argument(
        "--profile",
        choices=("whole", "peak"),
        default="whole",
        help="compare whole temperature profiles (where the data hold some) or their peaks",
    )
    parser.add_argument(
        "--simulations",
        type=_count,
        default=MOST_SIMULATIONS,
        metavar="N",
        help="at most that many per pressure and velocity (default %(default)s)",
    )
    parser.add_argument(
        "--workers", type=_count, metavar="N", help="simulations at a time (default: one per core)"
    )
    parser.add_argument(
        "--intervals",
        choices=("student", "profile"),
        default="student",
        help="95 %% intervals from the covariance or the profile of the sum of squares",
    )

    def calibrate(arguments: argparse.Namespace) -> Outcome:
        case = Case.from_toml(arguments.case, dict(map(parse_override, arguments.overrides)))
        return calibrate_partition(
            arguments.data,
            case,
            _folder(arguments),
            profile=arguments.profile,
            simulations=arguments.simulations,
            intervals=arguments.intervals,
            workers=arguments.workers,
            quiet=arguments.quiet,
        )

    parser.set_defaults(calibrate=calibrate)


def _add_common(parser: argparse.ArgumentParser, unit: str) -> None:
    parser.add_argument(
        "--fix", metavar="NAME=VALUE", type=_fixed, action="append", help="hold a parameter"
    )
    parser.add_argument("--starts", type=_count, default=20, help="starting points")
    _add_robust(parser, unit)
    parser.add_argument("--no-compare", action="store_true", help="leave out the other models")


def _add_robust(parser: argparse.ArgumentParser, unit: str) -> None:
    parser.add_argument(
        "--loss",
        choices=("linear", "soft_l1", "huber", "cauchy"),
        default="linear",
        help="a robust loss bounds the pull of outliers",
    )
    parser.add_argument("--noise", type=_positive, help=f"residual where that begins [{unit}]")
    parser.add_argument(
        "--intervals",
        choices=("student", "profile", "bootstrap"),
        default="student",
        help="95 %% intervals from the covariance, the profile or resampling",
    )


def _common(arguments: argparse.Namespace) -> dict[str, Any]:
    fixed = None if arguments.fix is None else dict(arguments.fix)
    return {
        "fixed": fixed,
        "starts": arguments.starts,
        "loss": arguments.loss,
        "compare": not arguments.no_compare,
        "intervals": arguments.intervals,
    }


def _finite(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"found {describe(text)}, expected a finite number")
    return value


def _positive(text: str) -> float:
    value = _finite(text)
    if value <= 0.0:
        raise argparse.ArgumentTypeError(f"found {text}, expected a number above 0")
    return value


def _not_negative(text: str) -> float:
    value = _finite(text)
    if value < 0.0:
        raise argparse.ArgumentTypeError(f"found {text}, expected 0 or more")
    return value


def _celsius(text: str) -> float:
    value = _finite(text)
    if value <= ABSOLUTE_ZERO_C:
        expected = f"a temperature above absolute zero, {ABSOLUTE_ZERO_C} deg C"
        raise argparse.ArgumentTypeError(f"found {text}, expected {expected}")
    return value


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


KINDS: dict[str, tuple[Callable[[argparse.ArgumentParser], None], str]] = {
    "hyperelastic": (_add_hyperelastic, "a hyperelastic model to stress-stretch tests"),
    "viscoelastic": (
        _add_viscoelastic,
        "relaxation times to stress histories or frequency sweeps",
    ),
    "mullins": (_add_mullins, "softening to first and later cycles"),
    "friction": (_add_friction, "a friction law to friction coefficients"),
    "partition": (_add_partition, "the heat partition to surface temperatures of sliding blocks"),
    "conductance": (_add_conductance, "the gap conductance to a static heating test"),
    "wlf": (_add_wlf, "the WLF shift to shift factors or frequency sweeps"),
}
