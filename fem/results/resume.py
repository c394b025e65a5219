"""What a folder offers to a run that is to be resumed in it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Literal

from fem.case.case import Case
from fem.case.errors import CaseError, describe
from fem.files.program_version import program_version
from fem.results.checkpoint import (
    CHECKPOINT_FILE,
    CheckpointError,
    check_checkpoint,
    first_difference,
    remove_checkpoint,
)
from fem.results.columns import HISTORY, SURFACE
from fem.results.outcome import OK
from fem.results.result import (
    CASE_FILE,
    HISTORY_FILE,
    SUMMARY_JSON,
    SURFACE_FILE,
    Result,
    missing_files,
    read_summary,
    read_table,
)


def resumable(directory: str | Path, case: Case) -> Literal["checkpoint", "finished", "nothing"]:
    """Whether a folder holds a checkpoint of a case, its finished result, or neither.

    Raises
    ------
    CheckpointError
        If the checkpoint is damaged, or if checkpoint or result are of another case or version.
    """
    directory = Path(directory)
    if (directory / CHECKPOINT_FILE).exists():
        check_checkpoint(directory / CHECKPOINT_FILE, case)
        return "checkpoint"
    if not _finished(directory, case):
        return "nothing"
    _check_same_case(directory / CASE_FILE, case)
    _check_same_program(directory)
    return "finished"


def gone_on_with(
    run: Callable[..., Result], case: Case, checkpoint: Path, **options: Any
) -> Result:
    """Result of a case, from its checkpoint on if there is one that can be used."""
    try:
        return run(case, checkpoint=checkpoint, resume=True, **options)
    except CheckpointError:
        remove_checkpoint(checkpoint)
        return run(case, checkpoint=checkpoint, **options)


def _finished(directory: Path, case: Case) -> bool:
    """Whether a run ended here as it should and all of its files are there, tables readable."""
    try:
        for name, columns in ((HISTORY_FILE, HISTORY), (SURFACE_FILE, SURFACE)):
            read_table(directory / name, columns)
        return read_summary(directory)["status"] == OK and not missing_files(directory, case)
    except ValueError:
        return False


def _check_same_program(directory: Path) -> None:
    found = read_summary(directory).get("program_version")
    if found != program_version():
        raise CheckpointError(
            file=str(directory / SUMMARY_JSON),
            key="program version",
            found=f"{describe(found)} in a finished run",
            expected=f"{program_version()} (or another folder, or no --resume)",
        )


def _check_same_case(path: Path, case: Case) -> None:
    try:
        tables = Case.from_toml(path).to_dict()
    except CaseError as error:
        raise CheckpointError(
            file=str(path), key=error.key, found=error.found, expected="the case of the run"
        ) from None
    difference = first_difference(tables, case.to_dict())
    if difference is not None:
        key, found, expected = difference
        raise CheckpointError(
            file=str(path), key=key, found=f"{found} in a finished run",
            expected=f"{expected} as in the case (or another folder, or no --resume)",
        )  # fmt: skip
