"""A checkpoint is complete, of this version and this case, or it is refused in one line."""

from __future__ import annotations

import json
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

import fem.results.checkpoint
from fem import Case
from fem.results.checkpoint import (
    COST_SHARE,
    FORMAT,
    Checkpoint,
    CheckpointError,
    notes,
    read_checkpoint,
    write_checkpoint,
)

LOADING = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 1.0}
CASE = Case.from_dict({"loading": LOADING, "output": {"checkpoint_s": 5.0}})


@dataclass(frozen=True)
class Content:
    T: NDArray[np.float64]
    steps: int


@dataclass(frozen=True)
class OtherContent:
    T: NDArray[np.float64]
    steps: int
    more: float


CONTENT = Content(T=np.linspace(20.0, 50.0, 40), steps=7)


@pytest.fixture
def path(tmp_path):
    file = tmp_path / "checkpoint.npz"
    write_checkpoint(file, CASE, CONTENT)
    return file


def refusal(path, case=CASE, kind=Content):
    """The one line of a refusal, without the name of the file it begins with."""
    with pytest.raises(CheckpointError) as caught:
        read_checkpoint(path, case, kind)
    text = str(caught.value)
    assert len(text.splitlines()) == 1
    assert text.startswith(f"{path}: ")
    return text.removeprefix(f"{path}: ")


def test_what_was_written_is_read(path):
    again = read_checkpoint(path, CASE, Content)
    assert again.T.tobytes() == CONTENT.T.tobytes()
    assert again.steps == 7


def test_the_file_is_a_numpy_archive_without_objects(path):
    with np.load(path, allow_pickle=False) as archive:
        about = json.loads(archive["about"].tobytes())
    assert about["case_hash"] == CASE.hash()


def test_a_foreign_one_names_the_key_that_differs(path):
    other = CASE.with_overrides({"loading.velocity_mm_per_s": 50.0})
    text = refusal(path, other)
    assert text.startswith("loading.velocity_mm_per_s: found 300.0, expected 50.0 as in the case")


def test_a_key_that_the_other_case_does_not_have_is_named(path):
    mesh = {"cells_x": 12, "cells_y": 5, "smallest_x_mm": 0.8, "smallest_y_mm": 0.6}
    assert refusal(path, CASE.with_overrides({"block.mesh": mesh})).startswith("block.mesh")


def test_one_of_another_program_version_is_refused(path, monkeypatch):
    monkeypatch.setattr(fem.results.checkpoint, "program_version", lambda: "9.9+abc")
    assert "expected 9.9+abc" in refusal(path)


def test_one_of_another_format_is_refused(path, monkeypatch):
    monkeypatch.setattr(fem.results.checkpoint, "FORMAT", 9)
    assert refusal(path).startswith(f"format: found {FORMAT}, expected 9")


def test_one_with_other_content_is_refused(path):
    assert refusal(path, kind=OtherContent).startswith("content: found OtherContent has other")


def test_one_cut_short_is_refused(path):
    whole = path.read_bytes()
    for size in (0, 1, 10, len(whole) // 2, len(whole) - 1):
        path.write_bytes(whole[:size])
        assert "damaged" in refusal(path)


def test_something_else_is_refused(path):
    for content in (b"hello", np.zeros(3).tobytes()):
        path.write_bytes(content)
        assert "damaged" in refusal(path)
    np.savez(path, T=np.zeros(3))
    assert "damaged" in refusal(path)
    np.save(path.with_suffix(".npy"), np.zeros(3))
    path.with_suffix(".npy").rename(path)
    assert "damaged" in refusal(path)


def test_a_flipped_byte_is_refused_or_does_not_matter(path):
    """Some bytes of an archive (dates, permissions) have no meaning for its content."""
    whole, refused = path.read_bytes(), 0
    places = range(0, len(whole), 7)
    for place in places:
        path.write_bytes(whole[:place] + bytes([whole[place] ^ 0xFF]) + whole[place + 1 :])
        try:
            again = read_checkpoint(path, CASE, Content)
        except CheckpointError:
            refused += 1
            continue
        assert again.T.tobytes() == CONTENT.T.tobytes()
        assert again.steps == CONTENT.steps
    assert refused > 0.8 * len(places)


def test_an_interrupted_write_leaves_the_earlier_one(path, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(np, "savez", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_checkpoint(path, CASE, Content(T=np.zeros(2), steps=8))
    monkeypatch.undo()
    assert read_checkpoint(path, CASE, Content).steps == 7


def test_a_file_may_have_any_name(tmp_path):
    """NumPy would add an ending."""
    for name in ("ck", "a.checkpoint", "b" * 250):
        write_checkpoint(tmp_path / name, CASE, CONTENT)
        assert read_checkpoint(tmp_path / name, CASE, Content).steps == 7
    assert len(list(tmp_path.iterdir())) == 3


# -- when it is written ----------------------------------------------------------------------------


class Clock:
    """A clock that is set by hand."""

    now = 0.0

    def __call__(self):
        return self.now


def test_a_checkpoint_is_written_when_its_time_has_come(tmp_path):
    clock = Clock()
    checkpoint = Checkpoint(tmp_path / "a.npz", CASE, clock=clock)
    for clock.now in (0.0, 2.5, 4.9):
        checkpoint.keep(lambda: CONTENT)
    assert checkpoint.read(Content) is None
    clock.now = 5.0
    checkpoint.keep(lambda: CONTENT)
    clock.now = 9.9
    checkpoint.keep(lambda: CONTENT)
    assert checkpoint.written == 1
    checkpoint.keep(lambda: CONTENT, now=True)
    assert checkpoint.written == 2


def test_zero_seconds_means_each_step(tmp_path):
    case = CASE.with_overrides({"output.checkpoint_s": 0.0})
    checkpoint = Checkpoint(tmp_path / "a.npz", case, clock=Clock())
    for _ in range(3):
        checkpoint.keep(lambda: CONTENT)
    assert checkpoint.written == 3


def test_dear_checkpoints_are_written_less_often(tmp_path):
    """Writing takes 0.5 s here, so that a checkpoint each 5 s would cost 10 % of the run."""
    clock = Clock()
    checkpoint = Checkpoint(tmp_path / "a.npz", CASE, clock=clock)

    def dear():
        clock.now += 0.5
        return CONTENT

    while clock.now < 1000.0:
        clock.now += 1.0
        checkpoint.keep(dear)
    assert 0.5 * COST_SHARE < checkpoint.seconds / clock.now <= 2.0 * COST_SHARE


def test_a_full_disk_is_noted_and_does_not_end_the_run(tmp_path, monkeypatch):
    checkpoint = Checkpoint(tmp_path / "a.npz", CASE, clock=Clock())

    def full(*_, **__):
        raise OSError("No space left on device")

    monkeypatch.setattr(np, "savez", full)
    checkpoint.keep(lambda: CONTENT, now=True)
    assert "No space left" in notes(checkpoint)[0]
    monkeypatch.undo()
    checkpoint.keep(lambda: CONTENT, now=True)
    assert "No space left" not in notes(checkpoint)[0]
