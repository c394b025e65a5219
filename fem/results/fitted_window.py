"""How much of a run leaves the ranges that the laws of its case were fitted to.

A fitted law is a description of its data; outside of them it is a guess, and a run says how much of
it was guessed. Every accepted step leaves in the history the share of the contact (by length) or of
the rubber (by area) outside; over the slide these are averaged by contact length and distance.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fem.case import Case, ContactWindow
from materials.arrays import BoolArray, FloatArray

Rows = Sequence[Mapping[str, Any]]

#: Share of contact or rubber outside from which a run warns; less is in its log. The block starts
#: from rest and its edges are hardly pressed, so that a little is always outside.
WORTH_A_WARNING = 0.01
#: Part of the lowest and highest value by which a window is wider than its data.
_WIDER = 1e-6

_NAMES = {"p_N_per_mm2": "pressure", "v_mm_per_s": "speed", "T_C": "temperature"}
_UNITS = {"p_N_per_mm2": "N/mm^2", "v_mm_per_s": "mm/s", "T_C": "deg C"}
_LAWS = {"friction": "friction law", "heat": "heat partition"}


def contact_columns(
    case: Case,
    *,
    p: FloatArray,
    v: FloatArray,
    T: FloatArray,
    length: FloatArray,
    slipping: BoolArray,
) -> dict[str, float]:
    """Shares of the contact outside the windows, for a row of the history.

    Parameters
    ----------
    p, v, T : ndarray, shape (n,)
        Pressure [N/mm^2], slip velocity [mm/s] and temperature [deg C] of the nodes in contact.
    length : ndarray, shape (n,)
        Contact length of each node [mm].
    slipping : ndarray of bool, shape (n,)
        Speeds are judged where the node slips.
    """
    found = {}
    total = float(length.sum())
    # the partition is fitted to mean contact pressures: local ones would compare unlike with like
    mean_p = np.full(p.size, float(p @ length) / total if total > 0.0 else 0.0)
    for section in _LAWS:
        window: ContactWindow | None = getattr(case, section).window
        for key, limits in _limits(window).items():
            pressure = mean_p if section == "heat" else p
            values = {"p_N_per_mm2": pressure, "v_mm_per_s": np.abs(v), "T_C": T}[key]
            judged = np.ones(p.size, dtype=bool)
            if key == "v_mm_per_s":
                judged = slipping
                friction = case.friction.law_object()
                if section == "friction" and friction.wlf is not None:
                    values = friction.wlf.equivalent_velocity(values, T, friction.T_ref_C)
            out = judged & _outside(values, limits)
            found[_column(section, key)] = float(length[out].sum()) / total if total > 0.0 else 0.0
    return found


def rubber_columns(
    case: Case, I1: FloatArray, J: FloatArray, weights: FloatArray
) -> dict[str, float]:
    """Share of the rubber stretched beyond its tests, for a row of the history.

    The largest principal stretch of the isochoric deformation counts, in the plane or across it.

    Parameters
    ----------
    I1, J : ndarray
        First invariant F:F + 1 and determinant of F at the Gauss points [-].
    weights : ndarray
        Reference area of each Gauss point [mm^2].
    """
    window = case.rubber.window
    if window is None:
        return {}
    half = 0.5 * (I1 - 1.0)
    in_plane = np.sqrt(half + np.sqrt(np.maximum(half**2 - J**2, 0.0)))
    stretch = np.maximum(in_plane, 1.0) * np.cbrt(1.0 / J)
    out = stretch > window.largest_stretch * (1.0 + _WIDER)
    return {_column("rubber", "stretch"): float(weights[out].sum() / weights.sum())}


def window_lines(case: Case, rows: Rows) -> list[tuple[float, str]]:
    """Share outside over the slide [-] and a line that says it, for each window that was left."""
    slid = np.diff(_values(rows, "sliding_distance_mm"), prepend=0.0).clip(min=0.0)
    contact = slid * _values(rows, "contact_length_mm")
    lines = []
    for section, law in _LAWS.items():
        for key, (low, high) in _limits(getattr(case, section).window).items():
            share = _mean(rows, _column(section, key), contact)
            lines.append(
                (
                    share,
                    f"{law}: {share:.1%} of the contact is outside the {_NAMES[key]} it was fitted "
                    f"to, {low:g} to {high:g} {_UNITS[key]}",
                )
            )
    if case.rubber.window is not None:
        share = _mean(rows, _column("rubber", "stretch"), slid)
        text = f"rubber: {share:.1%} of the block is stretched beyond the tests it was fitted to, "
        lines.append((share, f"{text}{case.rubber.window.largest_stretch:g}"))
    return [(share, text) for share, text in lines if share > 0.0]


def window_warnings(case: Case, rows: Rows) -> list[str]:
    """Lines for the summary: windows that a part worth a word of the run has left."""
    return [text for share, text in window_lines(case, rows) if share >= WORTH_A_WARNING]


def window_notes(case: Case, rows: Rows) -> list[str]:
    """Lines for the log only: windows that little of the run has left."""
    return [text for share, text in window_lines(case, rows) if share < WORTH_A_WARNING]


def _limits(window: ContactWindow | None) -> Mapping[str, tuple[float, float]]:
    content: dict[str, Any] = {} if window is None else window.model_dump(exclude_none=True)
    return {key: (limits[0], limits[1]) for key, limits in content.items()}


def _outside(values: FloatArray, limits: tuple[float, float]) -> BoolArray:
    low, high = limits
    room = _WIDER * max(abs(low), abs(high))
    return (values < low - room) | (values > high + room)


def _column(section: str, key: str) -> str:
    return f"outside_{section}_{_NAMES.get(key, key)}"


def _mean(rows: Rows, column: str, weights: FloatArray) -> float:
    if not weights.sum() > 0.0:
        return 0.0
    return float(np.average(_values(rows, column), weights=weights))


def _values(rows: Rows, column: str) -> FloatArray:
    return np.array([row.get(column, 0.0) for row in rows], dtype=float)
