"""Tables as measuring programs and spreadsheets write them are read, or refused in one line."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from calibration.conductance.fit import read_heating_record
from calibration.conductance.heating_rig import HeatingRig
from calibration.data.errors import DataError
from calibration.data.table_text import KNOWN_COLUMNS, read_cells
from calibration.data.tables import read_table
from calibration.friction.data import read_friction
from calibration.partition.data import read_partition_data
from calibration.rubber.hyperelastic import select_data
from calibration.wlf import fit_wlf
from fem.case.case import Case
from validation.measured.measurements import read_measurements

PLAIN = "p_N_per_mm2,v_mm_per_s,mu,T_C\n0.3,300,0.9,20\n0.4,30,1.25,21.5\n"
GERMAN = "p_N_per_mm2;v_mm_per_s;mu;T_C\n0,3;300;0,9;20\n0,4;30;1,25;21,5\n"
UNITS = PLAIN.replace("p_N_per_mm2,v_mm_per_s,mu,T_C", "p [N/mm²],v (mm/s),mu [-],T [°C]")

#: Ways to write the same table, and a part of what is said about each.
VARIANTS = {
    "plain": (PLAIN, ""),
    "byte order mark": (b"\xef\xbb\xbf" + PLAIN.encode(), ""),
    "UTF-16": (PLAIN.encode("utf-16"), "UTF-16"),
    "UTF-16 without a mark": (PLAIN.encode("utf-16-le"), "UTF-16"),
    "UTF-16, other end first": (PLAIN.encode("utf-16-be"), "UTF-16"),
    "Latin-1 degree sign": (UNITS.encode("latin-1"), "Latin-1"),
    "units in the header": (UNITS, "column p [N/mm²] read as p_N_per_mm2"),
    "megapascal": (PLAIN.replace("p_N_per_mm2", "p (MPa)"), "p (MPa) read as p_N_per_mm2"),
    "capitals in the header": (PLAIN.replace("mu", "MU"), "column MU read as mu"),
    "semicolons": (PLAIN.replace(",", ";"), "semicolons"),
    "semicolons and decimal commas": (GERMAN, "decimal commas"),
    "tabs": (PLAIN.replace(",", "\t"), "tabs"),
    "tabs and decimal commas": (GERMAN.replace(";", "\t"), "decimal commas"),
    "spaces between": (PLAIN.replace(",", "  "), "spaces between"),
    "spaces around": (PLAIN.replace(",", " , "), ""),
    "hard spaces": (PLAIN.replace(",", "\u00a0,"), ""),
    "quotes": (PLAIN.replace("0.3", '"0.3"').replace("mu", '"mu"'), ""),
    "quoted decimal commas": (
        'p_N_per_mm2,v_mm_per_s,mu,T_C\n"0,3",300,"0,9",20\n"0,4",30,"1,25","21,5"\n',
        "decimal commas",
    ),
    "DOS line ends": (PLAIN.replace("\n", "\r\n"), ""),
    "old line ends": (PLAIN.replace("\n", "\r"), ""),
    "no line end": (PLAIN.rstrip(), ""),
    "empty rows": (PLAIN.replace("\n", "\n\n,,,\n , , , \n"), ""),
    "trailing empty columns": (PLAIN.replace("\n", ",,\n"), ""),
    "trailing commas in the rows": (PLAIN.replace("\n0", ",\n0").replace(",\n0", "\n0", 1), ""),
    "comments": ('# rig 7, "open\n' + PLAIN.replace("\n0.4", "\n # later\n0.4"), ""),
    "header in a comment": ("# " + PLAIN, "header read from the comment in line 1"),
    "metadata above": ("Specimen;7\nDate: 2020-01-02\n\n" + PLAIN, "before the header in line 4"),
    "line break in a cell": (
        PLAIN.replace("T_C\n", 'T_C,"remark\n(operator)"\n')
        .replace("20\n", '20,"good\n# run"\n')
        .replace("21.5\n", "21.5,\n"),
        "",
    ),
}


def table_of(content, tmp_path):
    path = tmp_path / "table.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_table(path, ["p_N_per_mm2", "mu"])


@pytest.mark.parametrize("name", VARIANTS)
def test_all_ways_to_write_a_table_give_the_same_numbers(name, tmp_path):
    content, said = VARIANTS[name]
    table = table_of(content, tmp_path)
    for column, numbers in {
        "p_N_per_mm2": [0.3, 0.4],
        "v_mm_per_s": [300.0, 30.0],
        "mu": [0.9, 1.25],
        "T_C": [20.0, 21.5],
    }.items():
        assert table.numbers(column).tolist() == numbers
    assert said in " | ".join(table.notes)
    assert bool(table.notes) == bool(said)


def test_rows_keep_the_number_of_the_line_they_begin_on(tmp_path):
    text = '# note\nmu,p_N_per_mm2,run\n\n1,0.3,"a\nb"\n# later\n,,\n0.9,0.3,c\n'
    assert table_of(text, tmp_path).rows.tolist() == [4, 8]


def test_columns_without_a_name_are_kept_when_they_hold_something(tmp_path):
    table = table_of("mu,p_N_per_mm2,,\n0.9,0.3,x\n", tmp_path)
    assert list(table.frame.columns) == ["mu", "p_N_per_mm2", "(column 3)", "(column 4)"]
    assert table.frame["(column 3)"].tolist() == ["x"]


def test_places_in_small_and_in_capital_letters_stay_apart():
    for name in ("x_mm", "X_mm", "x [mm]", "X [mm]"):
        cells = read_cells(f"run,{name}\na,1\n".encode(), "table.csv")
        assert list(cells.columns) == ["run", f"{name[0]}_mm"]


def test_unusual_numbers_are_kept_with_the_table_and_those_selected_from_it(tmp_path):
    table = table_of("mu,p_N_per_mm2\n0.9,0.3\n0.9,3.0\n", tmp_path)
    half = table.select(np.array([False, True]))
    half.numbers("p_N_per_mm2")
    assert half.unusual == table.unusual
    assert table.origin["unusual"][0].startswith("row 3, column p_N_per_mm2: 3 is unusual")
    assert "bar (0.3 N/mm^2)" in table.origin["unusual"][0]


# -- nothing but its own error ---------------------------------------------------------------------

CASE = Case.from_dict(
    {
        "loading": {
            "mean_pressure_N_per_mm2": 0.3,
            "velocity_mm_per_s": 300.0,
            "distance_mm": 1.0,
        }
    }
)
READERS = {
    "friction": read_friction,
    "hyperelastic": select_data,
    "wlf": fit_wlf,
    "conductance": lambda source: read_heating_record(source, HeatingRig()),
    "partition": lambda source: read_partition_data(source, CASE),
    "compare": read_measurements,
}
NUMBERS = st.one_of(
    st.floats(-10.0, 400.0).map(lambda number: f"{number:.3g}"),
    st.floats().map(repr),
    st.integers().map(str),
    st.sampled_from(["0,3", "1,250", "1.5e3", "1_0", "0x1F", "1e999", "-0", "٣", "½"]),
)
WORDS = st.one_of(
    st.sampled_from(["uniaxial", "planar", "load", "huemer", "a", "", " ", '"', "#", "nan", "="]),
    st.text(max_size=6),
)
ROWS = st.lists(st.lists(st.one_of(NUMBERS, NUMBERS, WORDS), max_size=6), max_size=8)
HEADERS = st.lists(
    st.one_of(st.sampled_from([*KNOWN_COLUMNS, "C1_C", "E1_C", "T [°C]", ""]), st.text(max_size=6)),
    max_size=6,
)
MARKS = st.sampled_from([b"", b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff"])
TABLES = st.builds(
    lambda mark, header, rows, separator, end, encoding: (
        mark + end.join(separator.join(row) for row in [header, *rows]).encode(encoding, "ignore")
    ),
    MARKS,
    HEADERS,
    ROWS,
    st.sampled_from([",", ";", "\t", " ", "|"]),
    st.sampled_from(["\n", "\r\n", "\r"]),
    st.sampled_from(["utf-8", "utf-16-le", "latin-1"]),
)
FITTING = {
    "friction": ["p_N_per_mm2", "v_mm_per_s", "mu", "T_C"],
    "hyperelastic": ["stretch", "nominal_stress_N_per_mm2", "mode"],
    "wlf": ["T_C", "log10_aT"],
    "conductance": ["time_s", "heater_power_W", "C1_C", "E1_C"],
    "partition": ["p_N_per_mm2", "v_mm_per_s", "X_mm", "T_C", "run"],
    "compare": ["run", "x_mm", "T_C", "v_mm_per_s", "T_0_C"],
}


def reads_or_refuses(reader, source):
    """One line about the table, or none at all; any other exception is a fault of the reader."""
    said = ""
    try:
        reader(source)
    except DataError as error:
        said = str(error)
    assert len(said.splitlines()) <= 1
    assert len(said) < 1200


@pytest.mark.parametrize("name", READERS)
@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
@given(content=st.one_of(TABLES, st.binary(max_size=200)))
@example(content=b'mu,"a\nb')
@example(content="T_C;aT\n\x85\u2028;1".encode())
def test_no_file_makes_a_reader_raise_anything_but_its_own_error(name, content, tmp_path):
    path = tmp_path / "table.csv"
    path.write_bytes(content)
    reads_or_refuses(READERS[name], path)


@pytest.mark.parametrize("name", READERS)
@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_no_entries_under_the_right_header_do_either(name, data, tmp_path):
    header = FITTING[name]
    entry = st.one_of(NUMBERS, NUMBERS, NUMBERS, WORDS)
    rows = data.draw(st.lists(st.tuples(*[entry] * len(header)), min_size=1, max_size=8))
    path = tmp_path / "table.csv"
    pd.DataFrame(rows, columns=header).to_csv(path, index=False)
    reads_or_refuses(READERS[name], path)
