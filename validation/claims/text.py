"""The ledger for a terminal: what differs first told in full, every row wrapped."""

import textwrap

import pandas as pd

from validation.claims.ledger import counts

_WIDTH = 100
_FIELDS = ("computed", "ours", "criterion", "explanation", "experiment")
_HEADING = (
    "What the paper says in sections 2.1, 4.1, 4.2, 5.1, 5.2 and 6, in other words, and what comes "
    "out here. Every verdict is a comparison of the numbers shown."
)


def ledger_text(table: pd.DataFrame) -> str:
    """The whole ledger, by section, with the counts in the closing line."""
    parts = [textwrap.fill(_HEADING, _WIDTH)]
    for section, rows in table.groupby("section", sort=False):
        parts.append(f"Section {section}\n{'-' * (8 + len(str(section)))}")
        parts += [_row(row) for _, row in rows.iterrows()]
    return "\n\n".join([*parts, closing_line(table)]) + "\n"


def closing_line(table: pd.DataFrame) -> str:
    """How many claims there are, and how many of each verdict."""
    hold, differ, unchecked = counts(table).values()
    return f"{len(table)} claims: {hold} hold, {differ} differ, {unchecked} cannot be checked"


def _row(row: pd.Series) -> str:
    head = f"{row['number']:>3}  {row['claim']}  [{row['verdict']}]"
    lines = [textwrap.fill(head, _WIDTH, subsequent_indent=" " * 5)]
    for name in _FIELDS:
        if row[name] not in ("", "-"):
            label = f"     {name + ':':<13}"
            below = " " * len(label)
            lines.append(
                textwrap.fill(row[name], _WIDTH, initial_indent=label, subsequent_indent=below)
            )
    return "\n".join(lines)
