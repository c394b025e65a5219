"""Checks all claims with the runs of a folder and writes the ledger there."""

from pathlib import Path

from fem.files import write_table, write_text
from validation.claims.evidence import Evidence
from validation.claims.ledger import ledger_table
from validation.claims.text import ledger_text


def write_claims(directory: str | Path) -> Path:
    """Write ``claims.csv`` and ``claims.txt``; the text's path is returned.

    Runs of the paper's studies that are missing in ``directory/runs`` are simulated there first.
    """
    directory = Path(directory)
    table = ledger_table(Evidence(directory))
    csv, text = directory / "claims.csv", directory / "claims.txt"
    write_table(csv, table)
    write_text(text, ledger_text(table))
    return text
