"""How deep a block must be for plane strain: slabs with free sides in CalculiX (``make slab``).

``python -m validation.slab DIR`` runs the block of ``studies/slab_base.toml`` as slabs of several
depths with their decks in DIR, writes the committed table ``validation/slab.csv`` and renews its
block of ``docs/verification.md``. Each slab is compared with plane strain on the same plane mesh,
in a layer as thick as its own: the one-point bricks get softer with their thickness. Results that
DIR has of the same decks are kept.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fem import Case
from fem.files import BAD_INPUT, lenient_streams, write_table, write_text
from fem.stepping import mesh_of
from materials.arrays import FloatArray, IntArray
from validation.analysis import markdown_table, with_block
from validation.calculix import (
    PRESSING_TIME,
    CalculixError,
    DatTable,
    DeckOptions,
    Layers,
    calculix_program,
    deck_history,
    half_slab,
    input_deck,
    normal_stiffness,
    read_dat,
    run_calculix,
)
from validation.studies import STUDIES

TABLE = Path(__file__).with_name("slab.csv")
PAGE = Path(__file__).parents[1] / "docs" / "verification.md"
#: Layers of bricks over half the depth, by depth over height.
LAYERS = {1.0: 4, 2.5: 10, 5.0: 20, 10.0: 10}
#: Distances slid at which forces are compared; all of the bottom slips at the last one [mm].
MOTIONS = (0.25, 0.5, 1.0, 2.0)
FORCE, SINK, PEAK = "friction_force_N_per_mm", "platen_displacement_mm", "middle_peak_N_per_mm2"
LOAD = "middle_load_N_per_mm"
#: What is compared with plane strain pressed and slid, by its name in the table.
RATIOS = {
    "platen": SINK,
    "middle_load": LOAD,
    "middle_contact_length": "contact_length_mm",
    "middle_peak": PEAK,
}
#: Seconds after which CalculiX is given up.
TIMEOUT = 3600.0


@dataclass(frozen=True, kw_only=True)
class Run:
    """A deck's history with what its middle section and its free side do, a row per increment."""

    history: pd.DataFrame

    def at(self, motion: float, column: str) -> float:
        """Number after a distance slid [mm]; at 0 the block is pressed."""
        time = PRESSING_TIME + motion
        return float(np.interp(time, self.history["deck_time"], self.history[column]))

    def sink_at(self, middle_load: float) -> float:
        """Platen displacement at which the middle section carries a load per depth [mm]."""
        before = self.history["deck_time"].shift(fill_value=0.0)
        pressing = self.history[before < PRESSING_TIME]
        return float(np.interp(middle_load, pressing[LOAD], pressing[SINK]))


def computed(case: Case, layers: Layers, folder: Path, *, timeout_s: float = TIMEOUT) -> Run:
    """What CalculiX makes of a deck; results that a folder has of the same deck are kept."""
    folder.mkdir(parents=True, exist_ok=True)
    options = DeckOptions(layers=layers)
    deck, text = folder / "deck.inp", input_deck(case, options)
    tables = kept_tables(deck, text, end=PRESSING_TIME + case.loading.distance_mm)
    if not tables:
        write_text(deck, text)
        tables = read_dat(run_calculix(deck, timeout_s=timeout_s))
    stiffness = normal_stiffness(case, mesh_of(case), options)
    history = deck_history(case, tables, layers)
    parts = [
        _sections(case, layers, _moved(tables, time), stiffness) for time in history["deck_time"]
    ]
    return Run(history=pd.concat([history, pd.DataFrame(parts)], axis=1))


def kept_tables(deck: Path, text: str, *, end: float) -> list[DatTable]:
    """Tables of an earlier run of the same deck, if it got to its end."""
    results = deck.with_suffix(".dat")
    if not (results.is_file() and deck.is_file() and deck.read_text(encoding="utf-8") == text):
        return []
    try:
        tables = read_dat(results)
    except ValueError:
        return []
    return tables if np.isclose(tables[-1].time, end) else []


def _moved(tables: list[DatTable], time: float) -> dict[int, FloatArray]:
    """Displacement of every printed node at a time."""
    chosen = [t for t in tables if t.time == time and t.quantity == "displacements"]
    return {node: u for t in chosen for node, u in zip(t.entities, t.values, strict=True)}


def _sections(
    case: Case, layers: Layers, moved: dict[int, FloatArray], stiffness: float
) -> dict[str, float]:
    """Contact of middle section and free side, and how much the middle stretches along z."""
    mesh = mesh_of(case)
    n, back = len(mesh.points), layers.cells if layers.free else 0

    def displacement(nodes: IntArray, layer: int) -> FloatArray:
        return np.array([moved[node + 1 + n * layer] for node in nodes.tolist()])

    def pressure(layer: int) -> FloatArray:
        y = mesh.points[mesh.candidates, 1] + displacement(mesh.candidates, layer)[:, 1]
        return stiffness * np.maximum(-y, 0.0)

    # CalculiX takes pressure over the deformed surface.
    surface = mesh.points[mesh.boundary] + displacement(mesh.boundary, 0)[:, :2]
    edges = np.linalg.norm(np.diff(surface, axis=0), axis=1)
    lengths = mesh.at_candidates(np.where(mesh.joined, 0.5 * edges, 0.0))
    strain, lowest = 0.0, float(surface[:, 1].min())
    if layers.free:
        strain = float(displacement(mesh.bottom, 1)[:, 2].mean()) * layers.cells / layers.depth
        lowest = float((mesh.points + displacement(np.arange(n), back)[:, :2])[:, 1].min())
    middle = pressure(0)
    return {
        LOAD: float(middle @ lengths) * (1.0 + strain),
        PEAK: float(middle.max()),
        "side_peak_N_per_mm2": float(pressure(back).max()),
        "depth_strain": strain,
        "side_lowest_mm": lowest,
    }


def compared(case: Case, slab: Run, plane: Run) -> dict[str, float]:
    """Numbers of a slab, most of them over those of plane strain."""
    end, height = MOTIONS[-1], mesh_of(case).height
    ends = {"pressed": 0.0, "slid": end}
    # The load up to which both are known.
    carried = min(plane.at(0.0, LOAD), slab.at(0.0, LOAD))
    found = {f"force_at_{at:g}_mm": slab.at(at, FORCE) / plane.at(at, FORCE) for at in MOTIONS}
    for name, column in RATIOS.items():
        for state, at in ends.items():
            found[f"{name}_{state}"] = slab.at(at, column) / plane.at(at, column)
    found["middle_platen_at_equal_load"] = slab.sink_at(carried) / plane.sink_at(carried)
    for state, at in ends.items():
        strain = slab.at(at, "depth_strain")
        found[f"depth_strain_share_{state}"] = strain * height / slab.at(at, SINK)
    found["side_peak_over_middle"] = slab.at(end, "side_peak_N_per_mm2") / slab.at(end, PEAK)
    found["side_lowest_um"] = 1e3 * float(slab.history["side_lowest_mm"].min())
    return found


def row(case: Case, ratio: float, cells: int, folder: Path) -> dict[str, Any]:
    """Row of the table; what CalculiX does not finish has its reason and no numbers."""
    depth = ratio * mesh_of(case).height
    layers = half_slab(depth, cells)
    plane = Layers(depth=layers.depth / cells)
    head = {"depth_over_height": ratio, "depth_mm": depth, "layers": cells}
    try:
        slab, reference = (
            computed(case, each, folder / f"{name}_{ratio:g}")
            for name, each in (("slab", layers), ("plane", plane))
        )
    except CalculixError as error:
        return head | {"status": str(error)}
    numbers = {key: float(f"{x:.4g}") for key, x in compared(case, slab, reference).items()}
    return head | {"status": "ok"} | numbers


#: Columns of the page and what they are called there.
SHOWN = {
    "depth_over_height": "W/h",
    "force_at_0.5_mm": "force at 0.5 mm",
    "force_at_1_mm": "1 mm",
    "force_at_2_mm": "2 mm",
    "platen_pressed": "platen, pressed",
    "platen_slid": "slid",
    "middle_platen_at_equal_load": "platen where the middle carries the same",
    "middle_load_slid": "load of the middle",
    "middle_contact_length_slid": "its contact length",
    "middle_peak_slid": "its peak pressure",
    "side_peak_over_middle": "peak pressure, side over middle",
    "depth_strain_share_pressed": "strain along z over compression, pressed",
    "depth_strain_share_slid": "slid",
}


def block(table: pd.DataFrame) -> str:
    """What stands between the page's markers."""
    rows = []
    for _, run in table.iterrows():
        ok = run["status"] == "ok"
        numbers = [f"{run[key]:.3f}" for key in list(SHOWN)[1:]] if ok else [run["status"]]
        rows.append([f"{run['depth_over_height']:g}", *numbers])
    return markdown_table(SHOWN.values(), rows) + "\n"


def main(directory: str) -> int:
    """Run the slabs, write their table, and renew the page."""
    if calculix_program() is None:
        print("make slab: CalculiX (ccx, Debian package calculix-ccx) is missing", file=sys.stderr)
        return BAD_INPUT
    case = Case.from_toml(STUDIES / "slab_base.toml")
    rows = []
    for ratio, cells in LAYERS.items():
        rows.append(row(case, ratio, cells, Path(directory)))
        print(f"W/h = {ratio:g}: {rows[-1]['status']}", flush=True)
    table = pd.DataFrame(rows)
    write_table(TABLE, table)
    write_text(PAGE, with_block(PAGE.read_text(encoding="utf-8"), "slab", block(table)))
    print(table.T.to_string(header=False))
    return 0


if __name__ == "__main__":
    with lenient_streams():
        sys.exit(main(sys.argv[1]))
