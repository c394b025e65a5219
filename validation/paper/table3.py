"""Table 3: thermo-mechanical parameters of rubber and asphalt, as a case file has them."""

from pathlib import Path

import pandas as pd

from fem.files import write_table, write_text
from validation.paper.introductory import introductory_case

#: Row of the paper, unit, section and key of a case; asphalt has the keys of rubber.
_ROWS = (
    ("d1", "-", "friction", "d1"),
    ("d2", "K", "friction", "d2_K"),
    ("density", "kg/m^3", "rubber", "density_kg_per_m3"),
    ("conductivity", "W/(m K)", "rubber", "conductivity_W_per_mK"),
    ("specific heat", "kJ/(kg K)", "rubber", "specific_heat_kJ_per_kgK"),
)


def make(directory: Path) -> Path:
    """Write table 3 as CSV and as text; the text's path is returned."""
    table = thermal_table()
    write_table(directory / "table3.csv", table)
    text = "Table 3: parameters of rubber and asphalt, read back from the default case.\n\n"
    write_text(directory / "table3.txt", text + table.to_string(index=False, na_rep="-") + "\n")
    return directory / "table3.txt"


def thermal_table() -> pd.DataFrame:
    """Parameters with unit, a column per body, from the introductory case."""
    case = introductory_case().to_dict()
    return pd.DataFrame(
        [
            {
                "parameter": name,
                "unit": unit,
                "rubber": case[section][key],
                "asphalt": case["road"][key] if section == "rubber" else None,
            }
            for name, unit, section, key in _ROWS
        ]
    )
