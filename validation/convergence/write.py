"""Tables of the studies to the limit and of robustness, and what `docs/verification.md` says.

``python -m validation.convergence.write FOLDER`` takes the sweeps of the studies ``convergence``,
``onset`` and ``snaps`` in a folder, writes their tables ``validation/convergence.csv``,
``onset.csv`` and ``snaps.csv``, and renews the page's block; without a folder it renews the block
from the tables that are there.
"""

import sys
from pathlib import Path

import pandas as pd

from fem.files import write_table, write_text
from validation.analysis import with_block
from validation.convergence.onset import swept_runs
from validation.convergence.robustness import BLOCKS, TABLES, VISCOELASTIC
from validation.convergence.table import (
    CONVERGENCE,
    ONSET,
    SNAPS,
    convergence_table,
    onset_table,
    snaps_table,
)
from validation.convergence.text import convergence_text, onset_text, robustness_text, snaps_text

PAGE = Path(__file__).parents[2] / "docs" / "verification.md"
#: Its part that is written here.
BLOCK = "convergence"
#: The committed table of each study, by which it is called, and what makes it.
MADE = {CONVERGENCE: convergence_table, ONSET: onset_table, SNAPS: snaps_table}


def write_tables(folder: Path) -> None:
    """Write the committed tables from the folder of their sweeps."""
    for path, table in MADE.items():
        write_table(path, table(swept_runs(path.stem, folder / path.stem)))


def block() -> str:
    """What stands between the page's markers, from the committed tables."""
    return (
        "The introductory example to its limit "
        "([validation/convergence.csv](../validation/convergence.csv)):\n\n"
        f"{convergence_text(pd.read_csv(CONVERGENCE))}\n\n"
        "The onset of other cases against its limit: the largest difference of the force at the "
        "same distances\nin per cent of the force of full slip, and in brackets the force that the "
        "damping itself takes there\n([validation/onset.csv](../validation/onset.csv)):\n\n"
        f"{onset_text(pd.read_csv(ONSET))}\n\n"
        "Large snaps, where friction and pressure are high, with a third of the damping, the "
        "default, and\nthree times as much, and in steps of a tenth, after 40 mm of sliding\n"
        "([validation/snaps.csv](../validation/snaps.csv)):\n\n"
        f"{snaps_text(pd.read_csv(SNAPS))}\n\n"
        "The robustness study runs all rubbers of Table 1 with both friction laws and with "
        f"constant\ncoefficients, with one set of solver settings ({_link('')}):\n\n"
        f"{robustness_text(pd.read_csv(TABLES['']))}\n\n"
        "The same with a rubber that remembers and damps its snaps itself, on the coarse mesh\n"
        f"({_link(VISCOELASTIC)}):\n\n{robustness_text(pd.read_csv(TABLES[VISCOELASTIC]))}\n\n"
        "Chamfered and siped blocks and two in a row, of three rubbers\n"
        f"({_link(BLOCKS)}):\n\n{robustness_text(pd.read_csv(TABLES[BLOCKS]))}\n"
    )


def _link(variant: str) -> str:
    """Link to a table of robustness from the page."""
    name = TABLES[variant].name
    return f"[validation/{name}](../validation/{name})"


def main(folders: list[str]) -> None:
    """Renew the tables, if there is a folder, and the page."""
    for folder in folders:
        write_tables(Path(folder))
    write_text(PAGE, with_block(PAGE.read_text(encoding="utf-8"), BLOCK, block()))
    names = ", ".join(path.name for path in MADE)
    print(f"{PAGE}: renewed from {names} and those of robustness")


if __name__ == "__main__":
    main(sys.argv[1:])
