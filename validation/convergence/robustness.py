"""The committed tables of the robustness study (``make robustness`` repeats the study).

``python -m validation.convergence.robustness SUMMARY.csv [VARIANT]`` takes from the summary of its
sweep the columns that tell how each case went, four digits each, and writes
``validation/robustness.csv`` or that of a variant: the same grid from another base case, or the
study of chamfered and siped blocks and of two in a row.
"""

import sys
from pathlib import Path

import pandas as pd

from fem.files import write_table
from validation.analysis import rounded

TABLE = Path(__file__).parents[1] / "robustness.csv"
#: Rubber that damps its snaps itself, on the coarse mesh (`studies/viscoelastic_block.toml`).
VISCOELASTIC = "viscoelastic"
#: Chamfers, sipes, two blocks in a row (`studies/block_robustness.toml`).
BLOCKS = "blocks"
TABLES = {
    "": TABLE,
    VISCOELASTIC: TABLE.with_name("robustness_viscoelastic.csv"),
    BLOCKS: TABLE.with_name("block_robustness.csv"),
}
#: What was varied, under shorter names.
VARIED = {
    "rubber.compound": "compound",
    "loading.mean_pressure_N_per_mm2": "mean_pressure_N_per_mm2",
    "friction.law": "law",
    "friction.mu": "mu",
}
#: The same of blocks' outlines; of sipes it is their number.
OUTLINES = {
    "block.blocks": "blocks",
    "block.chamfer_leading_mm": "chamfer_leading_mm",
    "block.sipes": "sipes",
}
#: How it went. Each share and error is explained in `docs/files.md`.
FOUND = (
    "status",
    "reason",
    "T_max_C",
    "friction_coefficient",
    "contact_length_mm",
    "steps",
    "rejected_steps",
    "newton_iterations",
    "energy_error",
    "heat_error",
    "regularisation_share",
    "storage_share",
    "regularisation_share_with_onset",
    "snap_share",
    "sliding_regime",
    "friction_lag_error",
    "largest_self_penetration",
    "min_J",
    "program_version",
)


def robustness_table(summary: pd.DataFrame) -> pd.DataFrame:
    """The columns of the committed table, of a sweep's summary; of blocks their outlines, too."""
    blocks = OUTLINES.keys() <= set(summary)
    varied = OUTLINES | VARIED if blocks else VARIED
    columns = [*varied, *FOUND, *(["advice"] if blocks else [])]
    table = summary[columns].rename(columns=varied)
    if blocks:
        # The summary has the text of the list.
        table["sipes"] = table["sipes"].astype(str).str.count("position_mm")
    return rounded(table, 4)


def main(path: str, variant: str = "") -> None:
    """Write the committed table of a variant anew."""
    table = robustness_table(pd.read_csv(path))
    write_table(TABLES[variant], table)
    print(f"{TABLES[variant]}: {len(table)} cases, {(table['status'] == 'ok').sum()} ok")


if __name__ == "__main__":
    main(*sys.argv[1:])
