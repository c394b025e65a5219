"""Results that CalculiX printed into a .dat file, and the history of a deck from them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fem.case import Case
from fem.mesh import BlockMesh
from fem.stepping import mesh_of
from materials.arrays import FloatArray
from validation.calculix.deck_event import PRESSING_TIME
from validation.calculix.deck_mesh import PLANE, Layers

_TITLE = re.compile(
    r"^\s*(?P<quantity>[a-z][a-z ()-]*?)\s*\((?P<columns>[^)]*)\)\s*for set\s+(?P<set>\S+)"
    r"\s+and time\s+(?P<time>\S+)\s*$"
)
#: Fortran drops the letter of an exponent with three digits: 1.0-101.
_BARE_EXPONENT = re.compile(r"(?<=\d)(?=[+-]\d{3}\b)")


@dataclass(frozen=True, kw_only=True)
class DatTable:
    """One printed table.

    Attributes
    ----------
    quantity, set_name : str
        E.g. ``displacements`` or ``total force``, and the node or element set.
    time : float
        Total time of the deck.
    entities : tuple of int
        Node (or element) numbers of the rows; empty for a total.
    values : (rows, columns) float array
    """

    quantity: str
    set_name: str
    time: float
    entities: tuple[int, ...]
    values: FloatArray


def read_dat(path: str | Path) -> list[DatTable]:
    """Read all tables of a .dat file, in the order they were printed.

    Raises
    ------
    ValueError
        If the file holds no table, or a row that does not fit its table's heading.
    """
    tables: list[DatTable] = []
    title: re.Match[str] | None = None
    rows: list[list[str]] = []
    for line in Path(path).read_text(encoding="utf-8", errors="replace").splitlines():
        found = _TITLE.match(line)
        if found is not None:
            if title is not None:
                tables.append(_table(title, rows, path))
            title, rows = found, []
        elif line.strip() and title is not None:
            rows.append(_BARE_EXPONENT.sub("E", line).split())
    if title is None:
        raise ValueError(f"{path} holds no table of results; expected the .dat file of CalculiX")
    tables.append(_table(title, rows, path))
    return tables


def _table(title: re.Match[str], rows: Sequence[Sequence[str]], path: str | Path) -> DatTable:
    columns = title["columns"].count(",") + 1
    total = title["quantity"].startswith("total")
    numbered = 0 if total else 1
    head = f"{path}: {title['quantity']} of set {title['set']} at time {title['time']}"
    for row in rows:
        if len(row) != columns + numbered:
            raise ValueError(f"{head} has a row of {len(row)} numbers; expected {columns}")
    try:
        values = np.array([[float(word) for word in row[numbered:]] for row in rows])
        entities = () if total else tuple(int(row[0]) for row in rows)
    except ValueError:
        raise ValueError(f"{head} has a word where a number was expected") from None
    return DatTable(
        quantity=title["quantity"],
        set_name=title["set"],
        time=float(title["time"]),
        entities=entities,
        values=values.reshape(-1, columns),
    )


def deck_history(case: Case, tables: Sequence[DatTable], layers: Layers = PLANE) -> pd.DataFrame:
    """History of an exported deck, a row per increment, with the columns of ``history.csv``.

    Parameters
    ----------
    case : Case
        The case that was exported.
    tables : sequence of DatTable
        From `read_dat`.
    layers : Layers
        Those of the deck. Forces of a slab are per depth, its contact is that of its middle.

    Returns
    -------
    DataFrame
        ``deck_time, sliding_distance_mm, normal_force_N_per_mm, friction_force_N_per_mm,
        friction_coefficient, contact_length_mm, mean_contact_pressure_N_per_mm2,
        platen_displacement_mm``. A node is in contact where it dips into the road. Increments of a
        run that broke off are left out if they were not printed in full.
    """
    mesh = mesh_of(case)
    surface = _by_time(tables, "displacements", {"SURFACE"})
    platen = _by_time(tables, "displacements", {"TOP"})
    reaction = _by_time(tables, "total force", {"ROAD", "GLUED"})
    rows = [
        _row(mesh, surface[t], platen[t].values, reaction[t].values[0] / layers.depth)
        for t in sorted(surface.keys() & platen.keys() & reaction.keys())
    ]
    return pd.DataFrame(rows)


def _by_time(tables: Sequence[DatTable], quantity: str, sets: set[str]) -> dict[float, DatTable]:
    return {t.time: t for t in tables if t.quantity == quantity and t.set_name in sets}


def _row(
    mesh: BlockMesh, surface: DatTable, platen: FloatArray, reaction: FloatArray
) -> dict[str, float]:
    # Looked up by number: CalculiX prints a set in an order of its own.
    u = np.full_like(mesh.points, np.nan)
    u[np.array(surface.entities) - 1] = surface.values[:, :2]
    length = contact_length((mesh.points + u)[mesh.boundary], mesh.joined)
    normal, friction = float(reaction[1]), -mesh.direction * float(reaction[0])
    return {
        "deck_time": surface.time,
        "sliding_distance_mm": max(surface.time - PRESSING_TIME, 0.0),
        "normal_force_N_per_mm": normal,
        "friction_force_N_per_mm": friction,
        "friction_coefficient": friction / normal if normal > 0.0 else 0.0,
        "contact_length_mm": length,
        "mean_contact_pressure_N_per_mm2": normal / length if length > 0.0 else 0.0,
        "platen_displacement_mm": -float(platen[:, 1].mean()),
    }


def contact_length(boundary: FloatArray, joined: NDArray[np.bool_]) -> float:
    """Length of the road that edges with both ends on or in it cover [mm].

    `boundary` has the current positions of the free boundary's nodes in order, (m, 2) [mm], and
    `joined` says whether an edge joins a node and the next one, (m - 1,).
    """
    touching = boundary[:, 1] <= 0.0
    both = touching[:-1] & touching[1:] & joined
    return float(np.abs(np.diff(boundary[:, 0]))[both].sum())
