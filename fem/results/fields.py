"""The fields of a run in one file, `fields.npz`: what reads a run back reads them from there."""

from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from fem.results.snapshot import BlockGeometry, Snapshot
from materials.arrays import AnyArray

FIELDS_FILE = "fields.npz"
_PARTS = tuple(part.name for part in fields(Snapshot))


def write_fields(path: str | Path, geometry: BlockGeometry, snapshots: Sequence[Snapshot]) -> None:
    """Write a NumPy archive.

    It holds `points` and `cells` of the block, and of the snapshot number n each attribute of
    `Snapshot` as ``attribute_n``, e.g. ``temperature_0``.
    """
    arrays = {
        f"{name}_{number}": getattr(snapshot, name)
        for number, snapshot in enumerate(snapshots)
        for name in _PARTS
        if getattr(snapshot, name) is not None
    }
    np.savez_compressed(path, points=geometry.points, cells=geometry.cells, **arrays)


def read_fields(path: str | Path) -> tuple[BlockGeometry, list[Snapshot]]:
    """Read what `write_fields` wrote.

    Raises
    ------
    ValueError
        If the file is missing or damaged, naming it.
    """
    if not Path(path).is_file():
        raise ValueError(f"{path} is missing; expected a folder that a finished run wrote")
    try:
        with np.load(path, allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
        geometry = BlockGeometry(points=arrays.pop("points"), cells=arrays.pop("cells"))
        count = sum(name.startswith("time_s_") for name in arrays)
        snapshots = [Snapshot(**_parts(arrays, number)) for number in range(count)]
        for snapshot in snapshots:
            snapshot.check(geometry)
    # A damaged archive makes the reading libraries raise almost anything.
    except Exception as error:
        raise ValueError(f"{path} is damaged ({error or type(error).__name__})") from None
    return geometry, snapshots


def _parts(arrays: dict[str, AnyArray], number: int) -> dict[str, Any]:
    """What the archive has of a snapshot."""
    names = {name: f"{name}_{number}" for name in _PARTS}
    return {name: _plain(arrays[key]) for name, key in names.items() if key in arrays}


def _plain(array: AnyArray) -> Any:
    """The array, or the number it is."""
    return array if array.ndim else float(array)
