"""The command line of treadfem: parses, calls, prints.

Exit codes: 0 done; 2 bad input (one line on stderr, nothing written) or a machine that cannot (no
space, no memory, a folder in use; one line, what was kept stays); 3 did not converge (what was
accepted is written); 4 finished, but with `--strict` there is a warning; 130 interrupted (what was
accepted is written, `--resume` goes on from it).
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from fem.case import CaseError
from fem.files import (
    BAD_INPUT,
    DONE,
    INTERRUPTED,
    NOT_CONVERGED,
    WARNED,
    cause,
    gently,
    lenient_streams,
    listening,
    one_line,
    open_standard_descriptors,
    say_of,
    version_of,
    warn,
)
from fem.results import check_output_file, chosen_output, output_folder
from validation import add_arguments as add_paper_commands
from validation.drawing import draw_missing

if TYPE_CHECKING:
    from fem import Case
    from fem.results import RunFolder

_STATUS_CODES = {"ok": DONE, "interrupted": INTERRUPTED}

# Everything that takes time to load is imported by the commands that need it.


class _Parser(argparse.ArgumentParser):
    """Argument parser that complains in one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(BAD_INPUT, f"{self.prog}: {message} (see {self.prog} --help)\n")


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code."""
    if argv is None:
        open_standard_descriptors()
    words = list(sys.argv[1:] if argv is None else argv)
    with lenient_streams() as (out, err), listening(to_the_end=argv is None):
        arguments = _parser(words[0] if words else "").parse_args(words)
        code = _guarded(arguments)
        out.flush()
        if out.lost:
            print(f"treadfem: {out.lost}", file=err)
            # For some commands what they print is all they make.
            code = BAD_INPUT if arguments.command in (_check, _template) else code
        return code


def _guarded(arguments: argparse.Namespace) -> int:
    """Exit code of a command; what goes wrong by input, user or machine is said in one line."""
    try:
        return int(arguments.command(arguments))
    except KeyboardInterrupt:
        print("treadfem: interrupted", file=sys.stderr)
        return INTERRUPTED
    except CaseError as error:
        line = str(error)
    except (OSError, MemoryError) as error:
        line = one_line(error)
    print(f"treadfem: {line}", file=sys.stderr)
    return BAD_INPUT


def _parser(command: str) -> argparse.ArgumentParser:
    about = "Sliding rubber tread block with friction and heat."
    parser = _Parser(prog="treadfem", description=about)
    parser.add_argument("--version", action="version", version=f"treadfem {version_of()}")
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    _add_run(commands)
    _add_check(commands)
    _add_template(commands)
    _add_calibrate(commands, wanted=command == "calibrate")
    _add_sweep(commands)
    _add_compare(commands)
    add_paper_commands(commands)
    _add_export(commands)
    return parser


def _add_case_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("case", metavar="CASE.toml", help="case file")
    parser.add_argument(
        "--set",
        metavar="section.key=value",
        action="append",
        default=[],
        dest="overrides",
        help="set a key of the case; may be repeated",
    )
    _add_accept_unusual(parser)


def _add_output(parser: argparse.ArgumentParser, metavar: str, text: str) -> None:
    parser.add_argument("-o", "--output", metavar=metavar, help=text)


def _add_accept_unusual(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--accept-unusual",
        action="store_true",
        help="no warning of numbers outside their usual range (the results keep it)",
    )


def _load(arguments: argparse.Namespace) -> Case:
    """The case of a command that may run it: what cannot be is refused, what is unusual said."""
    from fem import Case
    from fem.case import parse_override
    from fem.stepping import refuse_unaffordable

    overrides = dict(parse_override(text) for text in arguments.overrides)
    case = Case.from_toml(arguments.case, overrides)
    if case.block.file is not None:
        from fem.stepping import sized

        case = sized(case)
    refuse_unaffordable(case)
    if not arguments.accept_unusual:
        warn(f"{case.source}: {sentence}" for sentence in case.warnings)
    return case


# -- run ---------------------------------------------------------------------------------------


def _add_run(commands: Any) -> None:
    parser = commands.add_parser("run", help="simulate a case", description="Simulate a case.")
    _add_case_arguments(parser)
    _add_output(parser, "DIR", "folder of the results (default: results/CASE)")
    parser.add_argument(
        "--resume",
        action="store_true",
        help="go on from the checkpoint that an interrupted (or killed) run left in DIR; "
        "the result is that of an uninterrupted run",
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    _add_strict(parser)
    parser.set_defaults(command=_run)


def _add_strict(parser: argparse.ArgumentParser) -> None:
    text = "end with code 4 if a result comes with a warning"
    parser.add_argument("--strict", action="store_true", help=text)


def _run(arguments: argparse.Namespace) -> int:
    from fem.results import CHECKPOINT_FILE, FIGURES_FOLDER, RUN_FILES

    case = _load(arguments)
    directory = chosen_output(arguments.output, Path("results") / Path(arguments.case).stem)
    files = (*RUN_FILES, CHECKPOINT_FILE)
    with output_folder(directory, files=files, folders=[FIGURES_FOLDER]):
        return _run_in(directory, case, arguments)


def _run_in(directory: Path, case: Case, arguments: argparse.Namespace) -> int:
    from fem import simulate
    from fem.results import RunFolder, read_summary
    from fem.stepping import RunProgress

    folder = RunFolder(directory, case)
    checkpoint = folder.checkpoint
    found = folder.offers() if arguments.resume else "nothing"
    if not arguments.quiet:
        _say_how_it_starts(found, folder, resume=arguments.resume)
    if found == "finished":
        folder.export()
        if case.output.figures:
            draw_missing(directory)
        return _code(read_summary(directory), said=case.warnings, arguments=arguments)
    # Whatever is asked for meanwhile, what was accepted is written.
    with gently():
        with RunProgress(case, quiet=arguments.quiet) as progress:
            result = simulate(
                case, progress=progress, checkpoint=checkpoint, resume=found == "checkpoint"
            )
        try:
            result.write(directory)
        except OSError as error:
            goes_on = f"; --resume goes on from {checkpoint}" if checkpoint.is_file() else ""
            print(
                f"treadfem: {directory}: {cause(error)}: results not written{goes_on}",
                file=sys.stderr,
            )
            return BAD_INPUT
    if case.output.figures:
        draw_missing(directory)
    if result.summary["status"] == "ok":
        # Only now: whatever came before can be interrupted, too.
        checkpoint.unlink(missing_ok=True)
    return _close(result.summary, directory, case.warnings, arguments)


def _say_how_it_starts(found: str, folder: RunFolder, *, resume: bool) -> None:
    if found == "finished":
        print(f"{folder.directory} holds the finished run of this case: nothing to do")
        kept, wanted = folder.snapshots, folder.case.output.snapshots
        if kept != wanted:
            print(f"it has {kept} snapshots, not {wanted}: without --resume it is run again")
    elif found == "checkpoint":
        print(f"going on from {folder.checkpoint}", flush=True)
    elif resume:
        print(f"no checkpoint in {folder.directory}: starting from the beginning", flush=True)
    elif folder.checkpoint.exists():
        print(f"starting from the beginning; --resume goes on from {folder.checkpoint}", flush=True)


def _close(
    summary: dict[str, Any], directory: Path, said: Sequence[str], arguments: argparse.Namespace
) -> int:
    from fem.results import CHECKPOINT_FILE

    if not arguments.quiet:
        print(_summary_table(summary))
        print(f"results in {directory}")
    code = _code(summary, said=said, arguments=arguments)
    if code not in (DONE, WARNED):
        status = str(summary.get("status"))
        advice = [str(summary[key]) for key in ("reason", "advice") if summary.get(key)]
        if (directory / CHECKPOINT_FILE).exists() and status != "not converged":
            advice.append("--resume goes on from there")
        text = ": ".join([f"treadfem: {status}", "; ".join(advice)] if advice else [status])
        print(" ".join(text.split()), file=sys.stderr)
    return code


def _code(summary: dict[str, Any], *, said: Sequence[str], arguments: argparse.Namespace) -> int:
    """Exit code of a run; its warnings are printed, those of the case were `said` before."""
    code = _STATUS_CODES.get(str(summary.get("status", "not converged")), NOT_CONVERGED)
    if code != DONE:
        # Why it has not finished is what matters; the summary has the warnings.
        return code
    found = [warning for warning in summary.get("warnings") or [] if warning not in said]
    warn(found)
    counted = bool(found) or (bool(said) and not arguments.accept_unusual)
    return WARNED if counted and arguments.strict else DONE


def _summary_table(summary: dict[str, Any]) -> str:
    width = max(map(len, summary), default=0)
    shown = {k: f"{v:.6g}" if isinstance(v, float) else str(v) for k, v in summary.items()}
    return "\n".join(f"  {key:<{width}}  {text}" for key, text in shown.items())


# -- sweep -------------------------------------------------------------------------------------


def _add_sweep(commands: Any) -> None:
    text = "Run all cases of a study file in parallel."
    parser = commands.add_parser("sweep", help="run a study", description=text)
    parser.add_argument("study", metavar="STUDY.toml", help="study file: base case and grid")
    _add_output(parser, "DIR", "folder of the results (default: results/STUDY)")
    parser.add_argument("--base", metavar="CASE.toml", help="another base case for the grid")
    place = parser.add_mutually_exclusive_group()
    text = "local processes (default: one per core)"
    place.add_argument("--workers", metavar="N", type=int, help=text)
    text = "dask scheduler to use instead"
    place.add_argument("--scheduler", metavar="tcp://host:port", help=text)
    text = "keep the cases that are finished already"
    parser.add_argument("--resume", action="store_true", help=text)
    text = "begin a study of more than 1000 cases without asking"
    parser.add_argument("--yes", action="store_true", help=text)
    _add_strict(parser)
    _add_accept_unusual(parser)
    parser.set_defaults(command=_sweep)


def _sweep(arguments: argparse.Namespace) -> int:
    from fem.sweeps import SchedulerLostError, SweepBar, closing_line, sweep
    from validation.studies import BASES

    directory = chosen_output(arguments.output, Path("results") / Path(arguments.study).stem)
    try:
        with SweepBar() as bar:
            state = sweep(
                arguments.study,
                directory,
                workers=arguments.workers,
                scheduler=arguments.scheduler,
                resume=arguments.resume,
                bases=BASES,
                base=arguments.base,
                draw=draw_missing,
                progress=bar,
                confirm=lambda size: arguments.yes or _agreed(size),
                warn=None if arguments.accept_unusual else _warn_of(arguments.study),
            )
    except SchedulerLostError as error:
        print(f"treadfem: {error}; --resume goes on from {directory}", file=sys.stderr)
        return NOT_CONVERGED
    print(closing_line(state, directory))
    if not state.all_ok:
        return NOT_CONVERGED
    return WARNED if state.warned and arguments.strict else DONE


def _warn_of(file: str) -> Callable[[str], None]:
    return lambda sentence: warn([f"{file}: {sentence}"])


def _agreed(size: str) -> bool:
    """Whether somebody at a terminal wants that much."""
    if not (sys.stdin is not None and sys.stdin.isatty() and sys.stderr.isatty()):
        return False
    print(f"{size}. Go on? [y/N] ", end="", file=sys.stderr, flush=True)
    return sys.stdin.readline().strip().lower() in ("y", "yes")


# -- compare -----------------------------------------------------------------------------------


def _add_compare(commands: Any) -> None:
    text = "Compare measurements with the results of a sweep or a run."
    parser = commands.add_parser("compare", help="compare with measurements", description=text)
    parser.add_argument("measured", metavar="MEASURED.csv", help="profiles, or a row per test")
    parser.add_argument("results", metavar="RESULTS_DIR", help="folder of a sweep or a run")
    _add_output(parser, "DIR", "folder of tables and pictures (default: results/comparison)")
    parser.add_argument(
        "--pyrometer",
        action="store_true",
        help="temperatures are what the [pyrometer] of the cases reads off the road's end",
    )
    _add_accept_unusual(parser)
    parser.set_defaults(command=_compare)


def _compare(arguments: argparse.Namespace) -> int:
    from calibration.data import DataError
    from validation.measured import write_comparison

    directory = chosen_output(arguments.output, Path("results/comparison"))
    try:
        with output_folder(directory):
            report = write_comparison(
                arguments.measured, arguments.results, directory, pyrometer=arguments.pyrometer
            )
    except DataError as error:
        print(f"treadfem: {error}", file=sys.stderr)
        return BAD_INPUT
    say_of(arguments.measured, report.notes, () if arguments.accept_unusual else report.unusual)
    print(report.text)
    return DONE


# -- check, template ---------------------------------------------------------------------------


def _add_check(commands: Any) -> None:
    text = "Check a case file and print it with every key as it would be used."
    parser = commands.add_parser(
        "check", help="check a case and print it resolved", description=text
    )
    _add_case_arguments(parser)
    parser.set_defaults(command=_check)


def _check(arguments: argparse.Namespace) -> int:
    from fem.stepping import estimated_cost

    case = _load(arguments)
    heading = f"{arguments.case}, every key as it is used.\nA run: {estimated_cost(case)}."
    if not case.block.plain:
        from fem.stepping import mesh_described

        heading += f"\nThe mesh: {mesh_described(case)}."
    sys.stdout.write(case.to_toml(heading))
    return DONE


def _add_template(commands: Any) -> None:
    text = "Print a commented case or study file that runs as it is."
    what = "print a commented file to start from"
    parser = commands.add_parser("template", help=what, description=text)
    parser.add_argument("kind", nargs="?", choices=["case", "study"], default="case")
    parser.set_defaults(command=_template)


def _template(arguments: argparse.Namespace) -> int:
    from fem.case import case_template, study_template

    sys.stdout.write(study_template() if arguments.kind == "study" else case_template())
    return DONE


# -- calibrate ---------------------------------------------------------------------------------


def _add_calibrate(commands: Any, *, wanted: bool) -> None:
    if wanted:
        from calibration import add_arguments

        add_arguments(commands)
    else:
        commands.add_parser("calibrate", help="fit parameters to measurements")


# -- export ------------------------------------------------------------------------------------


def _add_export(commands: Any) -> None:
    what = "write a case as an input deck of CalculiX"
    text = f"W{what[1:]}: mesh, rubber, road, constant friction, pressing and sliding."
    parser = commands.add_parser("export", help=what, description=text)
    _add_case_arguments(parser)
    parser.add_argument("--format", choices=["inp"], default="inp", help="CalculiX")
    parser.add_argument("--depth-mm", metavar="W", type=float, help="half of a slab W mm deep")
    parser.add_argument("--cells-z", metavar="N", type=int, help="layers of bricks over that half")
    _add_output(parser, "FILE", "file of the deck (default: CASE.inp, here)")
    parser.set_defaults(command=_export)


def _export(arguments: argparse.Namespace) -> int:
    from validation.calculix import DeckOptions, friction_remark, slab_layers, write_deck

    case = _load(arguments)
    layers = slab_layers(case.source, arguments.depth_mm, arguments.cells_z)
    path = chosen_output(arguments.output, Path(f"{Path(arguments.case).stem}.inp"))
    check_output_file(path)
    if not path.parent.is_dir():
        raise CaseError(str(path), "-o", f"no folder {path.parent}", "a file in a folder")
    write_deck(case, path, DeckOptions(layers=layers))
    if remark := friction_remark(case):
        print(f"treadfem: {remark}", file=sys.stderr)
    print(path)
    return DONE


if __name__ == "__main__":
    sys.exit(main())
