"""The `calibrate` command: its arguments, and what happens when it fails."""

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from calibration.conductance import ALSO
from calibration.errors import DataError
from calibration.friction import LAWS
from calibration.outcomes import (
    PARAMETERS_FILE,
    Outcome,
    calibrate_conductance,
    calibrate_friction,
    calibrate_hyperelastic,
    calibrate_partition,
    calibrate_wlf,
)
from calibration.partition import MOST_SIMULATIONS
from calibration.simulation_store import SIMULATIONS_FOLDER, SimulationStoppedError
from calibration.stress_models import STRESS_MODELS
from fem.case import Case
from fem.case_errors import CaseError
from fem.case_reading import parse_override
from fem.output_folder import chosen_output, output_folder
from materials.hyperelastic import MODES
from materials.wlf import WLF

BAD_INPUT, NOT_CONVERGED = 2, 3
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
            "--accept-unusual", action="store_true",
            help="no warning of numbers outside their usual range (the result file keeps it)",
        )  # fmt: skip
        add(kind)
        kind.set_defaults(command=run)


def run(arguments: argparse.Namespace) -> int:
    """Run one calibration; bad data end with one line and exit code 2."""
    directory = _folder(arguments)
    with output_folder(directory, files=[PARAMETERS_FILE], folders=[SIMULATIONS_FOLDER]):
        try:
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
        for line in (*outcome.notes, *unusual):
            print(f"treadfem: {arguments.data}: {line}", file=sys.stderr)
        print(outcome.text)
        print(f"results in {directory}")
    return 0


def _folder(arguments: argparse.Namespace) -> Path:
    default = Path("results") / "calibration" / arguments.kind
    return chosen_output(arguments.output, default)


def _add_hyperelastic(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--model", choices=STRESS_MODELS, default="yeoh")
    parser.add_argument("--cycle", type=_cycle, help='"last-full", "all" or a number')
    parser.add_argument("--branch", choices=("both", "load", "unload"), default="both")
    parser.add_argument(
        "--window", nargs=2, type=float, metavar=("LOW", "HIGH"), help="stretches used"
    )
    parser.add_argument("--mode", choices=MODES, action="append", help="may be repeated")
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
            weights=arguments.weights,
            noise_N_per_mm2=0.05 if arguments.noise is None else arguments.noise,
            **_common(arguments),
        )

    parser.set_defaults(calibrate=calibrate)


def _add_friction(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--law", choices=LAWS, default="huemer")
    parser.add_argument(
        "--wlf", choices=("none", "given", "fit"), default="none",
        help="shift of the speed by T_C: none, with --d1 and --d2, or fitted together",
    )  # fmt: skip
    parser.add_argument("--d1", type=float, default=CONSTANTS.d1)
    parser.add_argument("--d2", type=float, default=CONSTANTS.d2_K, metavar="K")
    parser.add_argument("--T-ref", type=float, default=20.0, metavar="C", dest="T_ref_C")
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
    return WLF(d1=arguments.d1, d2_K=arguments.d2)


def _add_wlf(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--T-ref", type=float, metavar="C", dest="T_ref_C")
    parser.set_defaults(
        calibrate=lambda arguments: calibrate_wlf(arguments.data, T_ref_C=arguments.T_ref_C)
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
        "--case", metavar="CASE.toml", required=True,
        help="the block that slid; pressure and velocity come from the data",
    )  # fmt: skip
    parser.add_argument(
        "--set", metavar="section.key=value", action="append", default=[], dest="overrides",
        help="set a key of the case; may be repeated",
    )  # fmt: skip
    parser.add_argument(
        "--profile", choices=("whole", "peak"), default="whole",
        help="compare whole temperature profiles (where the data hold some) or their peaks",
    )  # fmt: skip
    parser.add_argument(
        "--simulations", type=_count, default=MOST_SIMULATIONS, metavar="N",
        help="at most that many per pressure and velocity (default %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--intervals", choices=("student", "profile"), default="student",
        help="95 %% intervals from the covariance or the profile of the sum of squares",
    )  # fmt: skip

    def calibrate(arguments: argparse.Namespace) -> Outcome:
        case = Case.from_toml(arguments.case, dict(map(parse_override, arguments.overrides)))
        return calibrate_partition(
            arguments.data,
            case,
            _folder(arguments),
            profile=arguments.profile,
            simulations=arguments.simulations,
            intervals=arguments.intervals,
            quiet=arguments.quiet,
        )

    parser.set_defaults(calibrate=calibrate)


def _add_common(parser: argparse.ArgumentParser, unit: str) -> None:
    parser.add_argument(
        "--fix", metavar="NAME=VALUE", type=_fixed, action="append", help="hold a parameter"
    )
    parser.add_argument("--starts", type=_count, default=20, help="starting points")
    parser.add_argument(
        "--loss", choices=("linear", "soft_l1", "huber", "cauchy"), default="linear",
        help="a robust loss bounds the pull of outliers",
    )  # fmt: skip
    parser.add_argument("--noise", type=float, help=f"residual where that begins [{unit}]")
    parser.add_argument(
        "--intervals", choices=("student", "profile", "bootstrap"), default="student",
        help="95 %% intervals from the covariance, the profile or resampling",
    )  # fmt: skip
    parser.add_argument("--no-compare", action="store_true", help="leave out the other models")


def _common(arguments: argparse.Namespace) -> dict[str, Any]:
    fixed = None if arguments.fix is None else dict(arguments.fix)
    return {
        "fixed": fixed,
        "starts": arguments.starts,
        "loss": arguments.loss,
        "compare": not arguments.no_compare,
        "intervals": arguments.intervals,
    }


def _cycle(text: str) -> str | int:
    return text if text in ("last-full", "all") else int(text)


def _count(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text} starts; expected 1 or more")
    return number


def _fixed(text: str) -> tuple[str, float]:
    name, _, value = text.partition("=")
    return name.strip(), float(value)


KINDS: dict[str, tuple[Callable[[argparse.ArgumentParser], None], str]] = {
    "hyperelastic": (_add_hyperelastic, "a hyperelastic model to stress-stretch tests"),
    "friction": (_add_friction, "a friction law to friction coefficients"),
    "partition": (_add_partition, "the heat partition to surface temperatures of sliding blocks"),
    "conductance": (_add_conductance, "the gap conductance to a static heating test"),
    "wlf": (_add_wlf, "the WLF shift to shift factors or frequency sweeps"),
}
