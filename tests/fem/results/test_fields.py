"""The fields of a run come back from one file, bit by bit, or the file is named."""

from __future__ import annotations

import numpy as np
import pytest

from fem.results.fields import FIELDS_FILE, read_fields, write_fields
from tests.made_up_result import made_up_result


@pytest.mark.parametrize("snapshots", [0, 1, 12])
def test_reading_gives_the_snapshots_back(snapshots, tmp_path):
    result = made_up_result(snapshots=max(snapshots, 1))
    kept = result.snapshots[:snapshots]
    write_fields(tmp_path / FIELDS_FILE, result.geometry, kept)
    geometry, again = read_fields(tmp_path / FIELDS_FILE)
    assert again == kept
    assert np.array_equal(geometry.points, result.geometry.points)
    assert np.array_equal(geometry.cells, result.geometry.cells)


@pytest.mark.parametrize("damage", ["cut", "empty", "text", "part", "shape"])
def test_a_damaged_file_is_named_in_one_line(damage, tmp_path):
    path, result = tmp_path / FIELDS_FILE, made_up_result(snapshots=1)
    write_fields(path, result.geometry, result.snapshots)
    with np.load(path) as archive:
        arrays = {name: archive[name] for name in archive.files}
    if damage == "part":
        arrays["heat_0"] = arrays.pop("temperature_0")
    elif damage == "shape":
        arrays["temperature_0"] = arrays["temperature_0"][:-1]
    if damage in ("part", "shape"):
        np.savez(path, **arrays)
    else:
        whole = path.read_bytes()
        path.write_bytes({"cut": whole[: len(whole) // 2], "empty": b"", "text": b"5\n"}[damage])
    with pytest.raises(ValueError, match=r"fields\.npz is damaged") as error:
        read_fields(path)
    assert "\n" not in str(error.value)
