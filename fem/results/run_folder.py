"""A folder and the run of a case: whether it has finished there, and what a resumed run finds.

This is the one place that answers "is this the finished run of this physics by this program?",
for `--resume`, sweeps, figures, claims, calibrations and the report. A run is of a case if all of
its keys but those of `[output]` are the same; it is of this program if `program_version` is.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from fem.case import Case, CaseError, describe
from fem.files import program_version, staged_directory
from fem.results.checkpoint import (
    CHECKPOINT_FILE,
    CheckpointError,
    check_checkpoint,
    first_difference,
)
from fem.results.columns import HISTORY, SURFACE
from fem.results.fields import FIELDS_FILE, read_fields
from fem.results.outcome import NOT_CONVERGED, OK
from fem.results.result import (
    CASE_FILE,
    HISTORY_FILE,
    LAST_VTU_FILE,
    RUN_FILES,
    SUMMARY_JSON,
    SURFACE_FILE,
    read_summary,
    read_table,
)

#: A repetition by the same program would end in the same way.
FINAL = (OK, NOT_CONVERGED)
_INSTEAD = "(or another folder, or no --resume)"


@dataclass(frozen=True)
class RunFolder:
    """A folder in which the run of a case is, or is to be.

    Parameters
    ----------
    directory : Path
    case : Case

    Examples
    --------
    >>> import tempfile
    >>> case = Case.from_toml("examples/introductory.toml")
    >>> RunFolder(Path(tempfile.gettempdir()) / "nowhere", case).finished() is None
    True
    """

    directory: Path
    case: Case

    @property
    def checkpoint(self) -> Path:
        """Where a run keeps its checkpoint."""
        return self.directory / CHECKPOINT_FILE

    @property
    def snapshots(self) -> int:
        """How many snapshots the case of the run that is here asks for."""
        return Case.from_toml(self.directory / CASE_FILE).output.snapshots

    def finished(self) -> dict[str, Any] | None:
        """Summary of the run of the case that this program has brought to its end, or None."""
        summary = self.of_case()
        if summary is None or summary["status"] not in FINAL:
            return None
        return summary if summary.get("program_version") == program_version() else None

    def of_case(self) -> dict[str, Any] | None:
        """Summary of the run of the case that some program has written, or None."""
        summary = self._complete()
        try:
            self._check_case()
        except CheckpointError:
            return None
        return summary

    def offers(self) -> Literal["checkpoint", "finished", "nothing"]:
        """What a run that is to be resumed here finds.

        Raises
        ------
        CheckpointError
            If the checkpoint is damaged, or if checkpoint or result are of another case or program.
        """
        if self.checkpoint.exists():
            check_checkpoint(self.checkpoint, self.case)
            return "checkpoint"
        summary = self._complete()
        if summary is None or summary["status"] != OK:
            return "nothing"
        self._check_case()
        if (found := summary.get("program_version")) != program_version():
            raise self._refused(SUMMARY_JSON, "program version", describe(found), program_version())
        return "finished"

    def export(self) -> None:
        """Write the VTU files that the case asks for out of the fields, if they are not there."""
        if not self.case.output.vtu or (self.directory / LAST_VTU_FILE).exists():
            return
        geometry, snapshots = read_fields(self.directory / FIELDS_FILE)
        if snapshots:
            from fem.results.vtu import write_vtu

            with staged_directory(self.directory, last=LAST_VTU_FILE) as stage:
                write_vtu(stage, geometry, snapshots)

    def forget(self, *, checkpoint: bool = True) -> None:
        """Let the folder no longer hold a finished run, so that the case is run again."""
        (self.directory / SUMMARY_JSON).unlink(missing_ok=True)
        if checkpoint:
            self.checkpoint.unlink(missing_ok=True)

    def _complete(self) -> dict[str, Any] | None:
        """The summary of a run that is all there, tables readable; it is written last."""
        try:
            summary = read_summary(self.directory)
            for name, columns in ((HISTORY_FILE, HISTORY), (SURFACE_FILE, SURFACE)):
                read_table(self.directory / name, columns)
        except ValueError:
            return None
        whole = all((self.directory / name).is_file() for name in RUN_FILES)
        return summary if whole else None

    def _check_case(self) -> None:
        path = self.directory / CASE_FILE
        try:
            physics = Case.from_toml(path).physics()
        except CaseError as error:
            raise CheckpointError(
                file=str(path), key=error.key, found=error.found, expected="the case of the run"
            ) from None
        if (difference := first_difference(physics, self.case.physics())) is not None:
            key, found, expected = difference
            raise self._refused(CASE_FILE, key, found, f"{expected} as in the case")

    def _refused(self, file: str, key: str, found: str, expected: str) -> CheckpointError:
        return CheckpointError(
            file=str(self.directory / file),
            key=key,
            found=f"{found} in a finished run",
            expected=f"{expected} {_INSTEAD}",
        )
