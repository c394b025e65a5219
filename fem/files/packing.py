"""Dataclasses to plain data and arrays, and back again without running anything from the file.

What is packed is data only: numbers, texts and arrays. Which classes they become is decided by
the type hints of the reader, so a file cannot make the reader build anything else.
"""

import functools
import types
import typing
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any, TypeVar

import numpy as np

from materials.arrays import AnyArray

T = TypeVar("T")


class PackingError(ValueError):
    """Data that do not fit the class they are to become."""


def pack(value: Any) -> tuple[Any, dict[str, AnyArray]]:
    """Plain data that JSON can hold, and the arrays they refer to by name.

    Parameters
    ----------
    value : Any
        Dataclass, mapping with text keys, list, tuple, number, text, None, or array; nested.

    Returns
    -------
    tree : Any
        Numbers, texts, None, lists and dictionaries; an array is the text of its name.
    arrays : dict
        Names to arrays. One that occurs several times is kept once.

    Raises
    ------
    TypeError
        For anything else.
    """
    names: dict[int, str] = {}
    arrays: dict[str, AnyArray] = {}

    def packed(value: Any) -> Any:
        if value is None or isinstance(value, (bool, int, float, str)):
            return value.item() if isinstance(value, np.generic) else value
        if isinstance(value, np.generic):
            return value.item()
        if isinstance(value, np.ndarray):
            return _kept(value)
        if is_dataclass(value):
            return {f.name: packed(getattr(value, f.name)) for f in fields(value)}
        if isinstance(value, Mapping):
            return {str(key): packed(item) for key, item in value.items()}
        if isinstance(value, (list, tuple)):
            return [packed(item) for item in value]
        raise TypeError(f"a {type(value).__name__} cannot be packed")

    def _kept(array: AnyArray) -> str:
        if array.dtype.hasobject:
            raise TypeError("an array of objects cannot be packed")
        name = names.setdefault(id(array), f"a{len(names)}")
        arrays[name] = array
        return name

    return packed(value), arrays


def unpack(kind: type[T], tree: Any, arrays: Mapping[str, AnyArray]) -> T:
    """What was packed, as an instance of the class it was.

    Parameters
    ----------
    kind : type
        Class that was packed; its type hints and those of its parts decide what is made.
    tree, arrays
        What `pack` returned.

    Raises
    ------
    PackingError
        If a field is missing, unknown, or of another type.
    """
    value: T = _unpacked(kind, tree, arrays, kind.__name__)
    return value


def _unpacked(hint: Any, tree: Any, arrays: Mapping[str, AnyArray], where: str) -> Any:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        if tree is None and type(None) in arguments:
            return None
        (hint,) = [a for a in arguments if a is not type(None)]
        return _unpacked(hint, tree, arrays, where)
    if origin is np.ndarray or hint is np.ndarray:
        if not isinstance(tree, str) or tree not in arrays:
            raise PackingError(f"{where} is not an array")
        return _checked(arrays[tree], hint, where)
    if origin in (list, tuple):
        if not isinstance(tree, list):
            raise PackingError(f"{where} is not a list")
        return origin(
            _unpacked(arguments[0], item, arrays, f"{where}[{i}]") for i, item in enumerate(tree)
        )
    if origin is dict:
        if not isinstance(tree, dict):
            raise PackingError(f"{where} is not a table")
        return {k: _unpacked(arguments[1], v, arrays, f"{where}.{k}") for k, v in tree.items()}
    if is_dataclass(hint):
        return _dataclass(hint, tree, arrays, where)
    # bool is an int to Python, but not here
    if hint not in (bool, int, float, str) or type(tree) is not hint:
        raise PackingError(f"{where} is a {type(tree).__name__}")
    return tree


def _checked(array: AnyArray, hint: Any, where: str) -> AnyArray:
    """The array, if it holds the kind of numbers that the hint says."""
    *_, dtype = typing.get_args(hint) or (Any,)
    (wanted,) = typing.get_args(dtype) or (Any,)
    if wanted is not Any and not np.issubdtype(array.dtype, wanted):
        raise PackingError(f"{where} is an array of {array.dtype}")
    return array


def _dataclass(kind: Any, tree: Any, arrays: Mapping[str, AnyArray], where: str) -> Any:
    hints = _hints(kind)
    if not isinstance(tree, dict) or set(tree) != set(hints):
        raise PackingError(f"{where} has other fields")
    return kind(**{n: _unpacked(h, tree[n], arrays, f"{where}.{n}") for n, h in hints.items()})


@functools.cache
def _hints(kind: Any) -> dict[str, Any]:
    hints = typing.get_type_hints(kind)
    return {f.name: hints[f.name] for f in fields(kind)}
