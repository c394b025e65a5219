"""The sensitivity study in words and numbers, for a terminal or a mail."""

import textwrap

import pandas as pd

from validation.sensitivity.parameters import NUMERICS, PARAMETERS, PHYSICS, first_key
from validation.sensitivity.tornado import by_influence, signed

_HEADINGS = {
    PHYSICS: "What the paper leaves open",
    NUMERICS: "Numerics, on which the results should not depend",
}
_COLUMNS = {
    "T_max_difference_K": "T_max [K]",
    "A_T_difference_percent": "A_T [%]",
    "friction_force_difference_percent": "F_T [%]",
    "contact_pressure_difference_percent": "pressure [%]",
}
_SENTENCES = {PHYSICS: "Of what the paper leaves open", NUMERICS: "Of the numerics"}
#: How many parameters of each group the first paragraph names.
_NAMED = 3
_WIDTH = 100


def sensitivity_text(table: pd.DataFrame) -> str:
    """Base values, the changes of each group with the strongest first, and why these ranges."""
    base, rows = table.iloc[0], by_influence(table)
    parts = [_wrapped(f"{_base_words(base)} {_strongest(rows)}")]
    for group, heading in _HEADINGS.items():
        parts.append(f"{heading}\n\n{_changes(rows[rows['group'] == group])}")
    parts += [_stopped(table), _reasons(rows)]
    return "\n\n".join(part for part in parts if part) + "\n"


def _base_words(base: pd.Series) -> str:
    if base["status"] != "ok":
        return f"The base did not get to its end ({base['reason']}): nothing can be compared."
    return (
        "Sensitivity of the introductory example, one parameter at a time. Base: "
        f"T_max {base['T_max_C']:.2f} °C, A_T {base['A_T_K_mm']:.1f} K mm, friction force F_T "
        f"{base['friction_force_N_per_mm']:.3f} N/mm, mean contact pressure "
        f"{base['mean_contact_pressure_N_per_mm2']:.3f} N/mm²."
    )


def _strongest(rows: pd.DataFrame) -> str:
    """Name the parameters that move T_max most, each with its strongest change."""
    sentences = []
    for group, words in _SENTENCES.items():
        own = rows[(rows["group"] == group) & rows["T_max_difference_K"].notna()]
        order = own["T_max_difference_K"].abs().sort_values(ascending=False, kind="stable").index
        strongest = own.loc[order].drop_duplicates("parameter").head(_NAMED)
        named = [
            f"{_change(row)} ({signed(row['T_max_difference_K'])} K)"
            for _, row in strongest.iterrows()
        ]
        if named:
            sentences.append(f"{words}, T_max is moved most by {'; '.join(named)}.")
    return " ".join(sentences)


def _changes(rows: pd.DataFrame) -> str:
    shown = pd.DataFrame({"change": rows.apply(_change, axis=1)})
    for column, title in _COLUMNS.items():
        shown[title] = rows[column].map(lambda value: "-" if pd.isna(value) else signed(value))
    width = max(map(len, shown["change"]), default=0)
    shown["change"] = shown["change"].str.ljust(width)
    return shown.to_string(index=False)


def _change(row: pd.Series) -> str:
    unit = PARAMETERS[first_key(row["parameter"])].unit
    return f"{row['label']}: {row['from']} to {row['to']} {unit}".strip()


def _stopped(table: pd.DataFrame) -> str:
    rows = table[(table["status"] != "ok") & (table["parameter"] != "base")]
    said = [
        f"- {_change(row)}: {row['status']} at {row['reached_mm']:.3g} mm; {row['reason']}"
        for _, row in rows.iterrows()
    ]
    lines = map(_wrapped, said)
    return "Did not get to their end\n\n" + "\n".join(lines) if said else ""


def _reasons(rows: pd.DataFrame) -> str:
    keys = dict.fromkeys(map(first_key, rows["parameter"]))
    lines = [_wrapped(f"- {PARAMETERS[key].label} ({key}): {PARAMETERS[key].why}") for key in keys]
    return "Why these ranges\n\n" + "\n".join(lines)


def _wrapped(text: str) -> str:
    return textwrap.fill(text, _WIDTH, subsequent_indent="  " if text.startswith("- ") else "")
