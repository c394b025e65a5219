"""Table 4: mean friction force in the slip phase for the six parameter sets."""

from pathlib import Path

import pandas as pd

from fem.files import write_table, write_text
from fem.sweeps import StudyRun
from validation.analysis import PAPER_N_PER_MM
from validation.drawing import COMPOUND_LOOKS
from validation.paper.fig9 import COMPOUND
from validation.studies import runs_of

_HEADING = """\
Table 4: friction force, mean over the sliding phase, per mm of depth.
The paper's unit is kN for a plane model 1 m deep, which is the same number in N per mm.
"""


def make(directory: Path) -> Path:
    """Write table 4 as CSV and as text; the text's path is returned."""
    table = force_table(runs_of("compounds", directory))
    write_table(directory / "table4.csv", table)
    readable = table.to_string(index=False, float_format=lambda value: f"{value:.2f}", na_rep="-")
    write_text(directory / "table4.txt", f"{_HEADING}\n{readable}\n")
    return directory / "table4.txt"


def force_table(runs: list[StudyRun]) -> pd.DataFrame:
    """Computed and published friction force, a row per parameter set."""
    found = {run[COMPOUND]: run.result.summary for run in runs}
    rows = []
    for name, paper in PAPER_N_PER_MM.items():
        summary = found.get(name, {"status": "not run"})
        force = summary.get("friction_force_N_per_mm")
        rows.append(
            {
                "set": COMPOUND_LOOKS[name].label,
                "status": summary["status"],
                "computed_N_per_mm": float("nan") if force is None else force,
                "paper_N_per_mm": paper,
            }
        )
    table = pd.DataFrame(rows)
    ratio = table["computed_N_per_mm"] / table["paper_N_per_mm"]
    return table.assign(difference_percent=100.0 * (ratio - 1.0))
