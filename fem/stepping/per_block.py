"""What of the results belongs to which of several blocks on one platen."""

from typing import Any

import numpy as np
import pandas as pd

from fem.mesh import BlockMesh
from fem.results import excess_area, interior_peak
from fem.stepping.road_contact import RoadContact
from fem.stepping.summary import last_values, sliding_means
from materials.arrays import FloatArray

TEMPERATURES = ("T_max_C", "T_edge_C", "A_T_K_mm")


def temperature_columns(
    mesh: BlockMesh, T_C: FloatArray, ambient_C: float, block: int | None = None
) -> dict[str, float]:
    """T_max, T_edge and A_T of one block or of all, from the nodal temperatures `T_C` (n,).

    A front edge may have rolled under: it is the leading part of a bottom (see `interior_peak`)
    and the leading face. Of several bottoms the hottest counts, and the sum of their areas.
    """
    chains = [chain for chain in mesh.chains if block in (None, chain.block)]
    bottoms = [chain.nodes for chain in chains if chain.kind == "bottom"]
    profiles = [(mesh.from_trailing(nodes), T_C[nodes]) for nodes in bottoms]
    peaks = [interior_peak(X, T) for X, T in profiles]
    edges = [peak.T_edge_C for peak in peaks] + [T_C[nodes[-1]] for nodes in bottoms]
    edges += [T_C[chain.nodes].max() for chain in chains if chain.kind == "leading"]
    return {
        "T_max_C": max(peak.T_max_C for peak in peaks),
        "T_edge_C": float(max(edges)),
        "A_T_K_mm": sum(excess_area(X, T, ambient_C) for X, T in profiles),
    }


def block_columns(
    mesh: BlockMesh, contact: RoadContact, T_C: FloatArray, ambient_C: float
) -> dict[str, float]:
    """Columns of the history for each of several blocks, ``block_1_...`` the rearmost."""
    if mesh.blocks == 1:
        return {}
    counts = [chain.nodes.size for chain in mesh.chains]
    of_block = np.repeat([chain.block for chain in mesh.chains], counts)
    columns: dict[str, float] = {}
    for block in range(1, mesh.blocks + 1):
        own = of_block == block
        normal, length = float(contact.normal[own].sum()), float(contact.length[own].sum())
        friction = -mesh.direction * float(contact.shear[own].sum())
        values = {
            "normal_force_N_per_mm": normal,
            "friction_force_N_per_mm": friction,
            "friction_coefficient": friction / normal if normal > 0.0 else 0.0,
            "contact_length_mm": length,
            "mean_contact_pressure_N_per_mm2": normal / length if length > 0.0 else 0.0,
            **temperature_columns(mesh, T_C, ambient_C, block),
        }
        columns |= {f"block_{block}_{name}": value for name, value in values.items()}
    return columns


def block_summaries(history: pd.DataFrame, blocks: int) -> dict[str, list[dict[str, Any]]]:
    """Entry `blocks` of the summary: what it says of the whole, of each block; none of one."""
    if blocks == 1:
        return {}
    summaries = []
    shared = ["sliding_distance_mm", "velocity_mm_per_s"]
    for block in range(1, blocks + 1) if len(history) else ():
        start = f"block_{block}_"
        names = [str(name) for name in history if str(name).startswith(start)]
        own = {name: name.removeprefix(start) for name in names}
        table = history[[*shared, *own]].rename(columns=own)
        values = last_values(table, TEMPERATURES) | sliding_means(table)
        normal = sliding_means(table, ("normal_force_N_per_mm",))
        summaries.append({"block": block} | values | normal)
    return {"blocks": summaries}
