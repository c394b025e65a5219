"""Packed dataclasses come back as they were, and only as what the reader asks for."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.typing import NDArray

from fem.files.packing import PackingError, pack, unpack


@dataclass(frozen=True)
class Inner:
    values: NDArray[np.float64]
    same: NDArray[np.float64] | None = None


@dataclass(frozen=True)
class Outer:
    count: int
    share: float
    name: str
    done: bool
    inner: Inner
    columns: dict[str, NDArray[np.int64]]
    lines: list[str]
    parts: tuple[Inner, ...] = ()


SHARED = np.array([0.1, -0.0, np.nan, np.inf, 5e-324])
OUTER = Outer(
    count=3,
    share=0.1 + 0.2,
    name="µ",
    done=True,
    inner=Inner(values=SHARED, same=SHARED),
    columns={"b": np.arange(3), "a": np.arange(2)},
    lines=["one", "two"],
    parts=(Inner(values=np.zeros((2, 0))),),
)


def there_and_back(value):
    tree, arrays = pack(value)
    return unpack(type(value), json.loads(json.dumps(tree)), arrays)


def test_everything_comes_back_bit_by_bit():
    again = there_and_back(OUTER)
    assert (again.count, again.share, again.name, again.done) == (3, 0.1 + 0.2, "µ", True)
    assert again.inner.values.tobytes() == SHARED.tobytes()
    assert list(again.columns) == ["b", "a"]
    assert again.lines == ["one", "two"]
    assert again.parts[0].values.shape == (2, 0)
    assert again.parts[0].same is None


@pytest.mark.parametrize("number", [float("inf"), -0.0, 5e-324, 1 / 3])
def test_numbers_come_back_exactly(number):
    again = there_and_back(replace(OUTER, share=number)).share
    assert np.float64(again).tobytes() == np.float64(number).tobytes()


def test_numpy_numbers_become_plain_ones():
    again = there_and_back(replace(OUTER, count=np.int64(3), share=np.float64(2.0)))
    assert type(again.count) is int
    assert type(again.share) is float


def test_an_array_that_occurs_twice_is_kept_once():
    tree, arrays = pack(OUTER.inner)
    assert len(arrays) == 1
    again = unpack(Inner, tree, arrays)
    assert again.values is again.same


@pytest.mark.parametrize("value", [{1, 2}, object(), np.array([None]), lambda: 0])
def test_what_is_not_data_is_refused(value):
    with pytest.raises(TypeError, match="cannot be packed"):
        pack([value])


@pytest.mark.parametrize(
    "change",
    [
        {"count": 3.0},
        {"count": True},
        {"done": 1},
        {"share": "a0"},
        {"name": None},
        {"inner": None},
        {"inner": {"values": "a0"}},
        {"inner": {"values": "missing", "same": None}},
        {"inner": {"values": [1.0], "same": None}},
        {"inner": {"values": None, "same": None}},
        {"lines": "one"},
        {"lines": [1]},
        {"columns": ["a0"]},
        {"unknown": 1},
    ],
    ids=str,
)
def test_other_content_is_refused_by_name(change):
    tree, arrays = pack(OUTER)
    with pytest.raises(PackingError, match="Outer"):
        unpack(Outer, tree | change, arrays)
