"""The commands that make the paper's figures, tables and claims: arguments and what they do.

What draws or simulates is imported by the command that needs it.
"""

import argparse
import sys
from collections.abc import Callable, Sequence
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

from fem.case import CaseError
from fem.files import BAD_INPUT, DONE, NOT_CONVERGED, say_of
from fem.results import check_output_file, chosen_output, output_folder

#: Figures and tables share a folder, since some are made of the same runs.
_PAPER = "results/figures"
_PAGE = "results/report.html"
_Command = Callable[[argparse.Namespace], int]


def add_arguments(commands: Any) -> None:
    """Add `figure`, `table`, `claims`, `sensitivity` and `report` to the sub-commands."""
    figure = _add_numbered(commands, "figure", _figure)
    figure.add_argument(
        "--measured", metavar="FILE.csv", help="measurements to draw into figures 11 and 12"
    )
    _add_numbered(commands, "table", _table)
    text = "Check the paper's statements against the simulation, one by one."
    _add_study(commands, "claims", "check the paper's claims", text, "ledger and its runs")
    text = "Vary what the paper leaves open, one parameter at a time."
    _add_study(commands, "sensitivity", "vary what is left open", text, "table, picture and runs")
    _add_report(commands)


def _in_folder(command: _Command, arguments: argparse.Namespace) -> int:
    """Execute a command while its folder is nobody else's."""
    folder = chosen_output(arguments.output, Path(_PAPER))
    with output_folder(folder, folders=("made", "runs")):
        return command(arguments)


def _add_numbered(commands: Any, what: str, command: _Command) -> argparse.ArgumentParser:
    parser: argparse.ArgumentParser = commands.add_parser(
        what, help=f"make a {what} of the paper", description=f"Make a {what} of the paper."
    )
    parser.add_argument("number", metavar="N|all", help=f"number of the {what}, or all")
    _add_folder(parser, f"{what}s", command)
    return parser


def _add_folder(parser: argparse.ArgumentParser, what: str, command: _Command) -> None:
    text = f"folder of the {what} (default: {_PAPER})"
    parser.add_argument("-o", "--output", metavar="DIR", default=_PAPER, help=text)
    parser.add_argument("--again", action="store_true", help="make what is up to date, too")
    parser.set_defaults(command=partial(_in_folder, command))


def _figure(arguments: argparse.Namespace) -> int:
    from calibration.data import DataError
    from validation.measured import read_measurements
    from validation.paper import FIGURES, MEASURABLE, make_figure

    numbers = _numbers("figure", arguments, list(FIGURES))
    measured, inputs = None, []
    if arguments.measured is not None:
        try:
            measured, inputs = read_measurements(arguments.measured), [arguments.measured]
            say_of(arguments.measured, measured.notes, measured.unusual)
        except DataError as error:
            print(f"treadfem: {error}", file=sys.stderr)
            return BAD_INPUT
        if not set(numbers) & set(MEASURABLE):
            expected = "a figure that shows measurements: 11, 12 or all"
            raise CaseError("figure", "--measured", f"figure {arguments.number}", expected)
    for number in numbers:
        make = partial(make_figure, number, arguments.output, measured)
        own_inputs = inputs if number in MEASURABLE else []
        if not _made(arguments, f"fig{number}", make, own_inputs):
            return NOT_CONVERGED
    if arguments.number == "all":
        print("figures 1 and 5 of the paper are a sketch and photographs")
    return DONE


def _table(arguments: argparse.Namespace) -> int:
    from validation.paper import TABLES, make_table

    for number in _numbers("table", arguments, list(TABLES)):
        make = partial(make_table, number, arguments.output)
        if not _made(arguments, f"table{number}", make, show=True):
            return NOT_CONVERGED
    return DONE


def _numbers(what: str, arguments: argparse.Namespace, known: list[int]) -> list[int]:
    """Numbers that are asked for, once it is clear that they can be made."""
    if arguments.number == "all":
        return sorted(known)
    if arguments.number not in map(str, known):
        expected = f"one of {', '.join(map(str, sorted(known)))} or all"
        raise CaseError(what, "N", repr(arguments.number), expected)
    return [int(arguments.number)]


def _add_study(commands: Any, name: str, words: str, description: str, folder: str) -> None:
    """A command that writes a table and a text, which it shows."""
    parser = commands.add_parser(name, help=words, description=description)
    _add_folder(parser, folder, partial(_study, name))


def _study(name: str, arguments: argparse.Namespace) -> int:
    write = getattr(import_module(f"validation.{name}.write"), f"write_{name}")
    make = partial(write, arguments.output)
    return DONE if _made(arguments, name, make, show=True) else NOT_CONVERGED


def _made(
    arguments: argparse.Namespace,
    name: str,
    make: Callable[[], Path],
    inputs: Sequence[str] = (),
    *,
    show: bool = False,
) -> bool:
    """Make something unless it is up to date, and say so; False if one of its runs failed."""
    from fem.sweeps import StudyError
    from validation.paper import kept

    directory = Path(arguments.output)
    try:
        made = kept(name, directory, make, inputs, again=arguments.again)
    except StudyError as error:
        print(f"treadfem: {name}: {error}", file=sys.stderr)
        return False
    if show:
        print(made.path.read_text(encoding="utf-8"))
    print(made.path if made.again else f"{made.path} (up to date)", flush=True)
    return True


def _add_report(commands: Any) -> None:
    text = "Put all figures, tables and claims that are made into one HTML page."
    parser = commands.add_parser("report", help="one page with everything", description=text)
    text = f"the page (default: {_PAGE})"
    parser.add_argument("-o", "--output", metavar="FILE.html", default=_PAGE, help=text)
    text = f"folder of figures, tables, claims and sensitivity (default: {_PAPER})"
    parser.add_argument("--figures", metavar="DIR", default=_PAPER, help=text)
    parser.set_defaults(command=_report)


def _report(arguments: argparse.Namespace) -> int:
    from validation.report import write_report

    figures = Path(arguments.figures)
    path = chosen_output(arguments.output, Path(_PAGE))
    if not figures.is_dir():
        raise CaseError(str(figures), "--figures", "no such folder", "what make figures made")
    check_output_file(path)
    print(write_report(figures, path))
    return DONE
