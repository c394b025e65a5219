"""Checkpoints: everything a run needs to go on, in one file that is either complete or not there.

The file is a NumPy archive of plain arrays and one JSON text. It says which format and program
version wrote it and which case it belongs to; what does not fit is refused, never guessed at.
"""

import hashlib
import io
import json
import time
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from fem.case import Case, CaseError, describe
from fem.files import PackingError, cause, pack, program_version, replacing, unpack
from materials.arrays import AnyArray

T = TypeVar("T")

#: Name of the file in the folder of a run.
CHECKPOINT_FILE = "checkpoint.npz"
#: Version of the layout of the file.
FORMAT = 7
#: Largest share of the run time that may go into checkpoints; longer intervals keep to it.
COST_SHARE = 0.01
_ABOUT = "about"


class CheckpointError(CaseError):
    """A checkpoint that cannot be used; one line with file, key, found and expected."""


class Checkpoint:
    """The checkpoint of one run, written now and then.

    Parameters
    ----------
    path : str or Path
        The file.
    case : Case
        Case of the run; its `output.checkpoint_s` is the time between two checkpoints.
    clock : callable, optional
        Seconds since whenever.
    """

    def __init__(
        self, path: str | Path, case: Case, *, clock: Callable[[], float] = time.perf_counter
    ) -> None:
        self.path, self.case, self.clock = Path(path), case, clock
        self.interval = case.output.checkpoint_s
        self.last = clock()
        self.written = 0
        self.seconds = 0.0
        self.problem = ""

    def keep(self, content: Callable[[], Any], *, now: bool = False) -> None:
        """Write what `content` returns (a dataclass) if the time has come, or `now`.

        A full disk does not end the run: `problem` then says what happened.
        """
        start = self.clock()
        if not now and start - self.last < self.interval:
            return
        try:
            write_checkpoint(self.path, self.case, content())
            self.written += 1
            self.problem = ""
        except OSError as error:
            self.problem = f"no checkpoint since then: {cause(error)}"
        self.last = self.clock()
        cost = self.last - start
        self.seconds += cost
        if self.case.output.checkpoint_s > 0.0:
            self.interval = max(self.case.output.checkpoint_s, cost / COST_SHARE)

    def read(self, kind: type[T]) -> T | None:
        """What was kept, or None where there is no checkpoint; raises `CheckpointError`."""
        return read_checkpoint(self.path, self.case, kind) if self.path.exists() else None


def notes(checkpoint: Checkpoint | None) -> list[str]:
    """Lines for the log of a run on its checkpoints."""
    if checkpoint is None or not (checkpoint.written or checkpoint.problem):
        return []
    line = f"{checkpoint.written} checkpoints in {checkpoint.seconds:.3f} s"
    return [f"{line}; {checkpoint.problem}" if checkpoint.problem else line]


def write_checkpoint(path: str | Path, case: Case, content: Any) -> None:
    """Write a checkpoint so that the earlier one stays in place until the new one is complete."""
    tree, arrays = pack(content)
    about = {
        "format": FORMAT,
        "digest": _digest(tree, arrays),
        "program": program_version(),
        "case_hash": case.hash(),
        "case": case.physics(),
        "content": tree,
    }
    text = np.frombuffer(json.dumps(about).encode(), dtype=np.uint8)
    members: dict[str, Any] = {_ABOUT: text, **arrays}
    # Into an open file: NumPy would add .npz to a name that has another ending.
    with replacing(path) as temporary, temporary.open("wb") as file:
        np.savez(file, **members)


def read_checkpoint(path: str | Path, case: Case, kind: type[T]) -> T:
    """What `write_checkpoint` wrote, as an instance of `kind`.

    Raises
    ------
    CheckpointError
        If the file is damaged, or of another format, program version or case.
    """
    path = Path(path)
    about, arrays = check_checkpoint(path, case)
    try:
        return unpack(kind, about["content"], arrays)
    except (PackingError, KeyError) as error:
        raise _refused(path, "content", str(error), "what this version writes") from None


def check_checkpoint(path: str | Path, case: Case) -> tuple[dict[str, Any], dict[str, AnyArray]]:
    """Description and arrays of a checkpoint that is complete and belongs to version and case."""
    path = Path(path)
    about, arrays = _contents(path)
    _check_version(path, about)
    _check_case(path, about, case)
    if about.get("digest") != _digest(about.get("content"), arrays):
        found = "arrays or numbers that were changed after it was written"
        raise _refused(path, "content", found, "a checkpoint as the program wrote it")
    return about, arrays


def _digest(tree: Any, arrays: Mapping[str, AnyArray]) -> str:
    """Of everything that is kept: what was changed by hand afterwards is not gone on with."""
    digest = hashlib.sha256(json.dumps(tree, sort_keys=True).encode())
    for name, array in sorted(arrays.items()):
        digest.update(f"{name} {array.dtype.str} {array.shape}".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


def _contents(path: Path) -> tuple[dict[str, Any], dict[str, AnyArray]]:
    try:
        data = path.read_bytes()
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            broken = archive.testzip()
        if broken is not None:
            raise ValueError(f"{broken} has a wrong check sum")
        with np.load(io.BytesIO(data), allow_pickle=False) as archive:
            arrays = {name: np.asarray(archive[name]) for name in archive.files}
        about = json.loads(arrays.pop(_ABOUT).tobytes())
        if not isinstance(about, dict):
            raise ValueError("not a table")
    # A damaged archive makes the reading libraries raise almost anything.
    except Exception as error:
        found = f"a damaged file ({error or type(error).__name__})"
        raise _refused(path, "content", found, "a complete checkpoint") from None
    return about, arrays


def _check_version(path: Path, about: Mapping[str, Any]) -> None:
    found = about.get("format")
    if found != FORMAT:
        raise _refused(path, "format", describe(found), str(FORMAT))
    if about.get("program") != program_version():
        raise _refused(path, "program version", str(about.get("program")), program_version())


def _check_case(path: Path, about: Mapping[str, Any], case: Case) -> None:
    if about.get("case_hash") == case.hash():
        return
    difference = first_difference(about.get("case"), case.physics())
    if difference is None:
        raise _refused(path, "case", f"hash {about.get('case_hash')}", case.hash())
    key, found, expected = difference
    raise _refused(path, key, found, f"{expected} as in the case")


def first_difference(found: Any, expected: Any) -> tuple[str, str, str] | None:
    """First dotted key in which two cases (nested tables) differ, and both values in words."""
    one, other = _flat(found), _flat(expected)
    for key in [*other, *one]:
        if one.get(key) != other.get(key):
            return key, describe(one.get(key)), describe(other.get(key))
    return None


def _flat(tables: Any, prefix: str = "") -> dict[str, Any]:
    """Nested tables and lists as one table with dotted keys, places in a list from 0 on."""
    if isinstance(tables, list | tuple):
        tables = {str(place): value for place, value in enumerate(tables)}
    if not isinstance(tables, dict):
        return {prefix: tables}
    flat: dict[str, Any] = {}
    for key, value in tables.items():
        flat |= _flat(value, f"{prefix}.{key}" if prefix else key)
    return flat


def _refused(path: Path, key: str, found: str, expected: str) -> CheckpointError:
    return CheckpointError(
        file=str(path), key=key, found=found, expected=f"{expected} (or no --resume, to start anew)"
    )
