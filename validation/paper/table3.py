"""Table 3: thermo-mechanical parameters of rubber and asphalt, as a case file has them."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from validation.paper.introductory import introductory_case

#: Row of the paper, unit, section and key for rubber, section and key for asphalt.
_ROWS = (
    ("d1", "-", ("friction", "d1"), None),
    ("d2", "K", ("friction", "d2_K"), None),
    ("density", "kg/m^3", ("rubber", "density_kg_per_m3"), ("road", "density_kg_per_m3")),
    ("conductivity", "W/(m K)", ("rubber", "conductivity_W_per_mK"),
     ("road", "conductivity_W_per_mK")),
    ("specific heat", "kJ/(kg K)", ("rubber", "specific_heat_kJ_per_kgK"),
     ("road", "specific_heat_kJ_per_kgK")),
)  # fmt: skip


def make(directory: Path) -> Path:
    """Write table 3 as CSV and as text; the text's path is returned."""
    table = thermal_table()
    table.to_csv(directory / "table3.csv", index=False, lineterminator="\n")
    text = "Table 3: parameters of rubber and asphalt, read back from the default case.\n\n"
    path = directory / "table3.txt"
    path.write_text(text + table.to_string(index=False, na_rep="-") + "\n", encoding="utf-8")
    return path


def thermal_table() -> pd.DataFrame:
    """Parameters with unit, a column per body, from the introductory case."""
    case = introductory_case().to_dict()
    return pd.DataFrame(
        [
            {
                "parameter": name,
                "unit": unit,
                "rubber": case[rubber[0]][rubber[1]],
                "asphalt": None if asphalt is None else case[asphalt[0]][asphalt[1]],
            }
            for name, unit, rubber, asphalt in _ROWS
        ]
    )
