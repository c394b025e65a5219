"""What a folder offers to a run that is to be resumed in it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Literal

from fem.case import Case
from fem.case_errors import CaseError
from fem.checkpoint import (
    CHECKPOINT_FILE,
    CheckpointError,
    check_checkpoint,
    first_difference,
    remove_checkpoint,
)
from fem.outcome import OK
from fem.results import CASE_FILE, Result, read_summary


def resumable(directory: str | Path, case: Case) -> Literal["checkpoint", "finished", "nothing"]:
    """Whether a folder holds a checkpoint of a case, its finished result, or neither.

    Raises
    ------
    CheckpointError
        If the checkpoint is damaged or of another version, or if checkpoint or result are of
        another case.
    """
    directory = Path(directory)
    if (directory / CHECKPOINT_FILE).exists():
        check_checkpoint(directory / CHECKPOINT_FILE, case)
        return "checkpoint"
    if not _finished(directory):
        return "nothing"
    _check_same_case(directory / CASE_FILE, case)
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


def _finished(directory: Path) -> bool:
    try:
        return bool(read_summary(directory)["status"] == OK)
    except ValueError:
        return False


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
