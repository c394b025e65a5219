"""Tables that are no tables, and tables that can be read in more than one way."""

from __future__ import annotations

import os
from pathlib import Path

from tests.wrong_inputs.rows import COMPARE, FRICTION, HYPERELASTIC, SLIDES, WLF, table

READING = [
    table("Excel workbook", FRICTION, b"PK\x03\x04rest", "found an Excel workbook or zip archive"),
    table("old Excel workbook", WLF, b"\xd0\xcf\x11\xe0rest", "found an old Excel workbook"),
    table("gzip archive", COMPARE, b"\x1f\x8brest", "found a gzip archive", "a CSV file"),
    table("PDF", HYPERELASTIC, b"%PDF-1.4", "found a PDF"),
    table("bytes that are no text", COMPARE, bytes(range(256)), "found bytes that are no text"),
    table("named pipe", COMPARE, os.mkfifo, "found a device or a pipe"),
    table("directory", FRICTION, Path.mkdir, "found Is a directory"),
    table("no such file", COMPARE, lambda path: None, "found No such file"),
    table("empty file", COMPARE, "", "found no header line"),
    table("spaces only", WLF, " \n\t\n", "found no header line"),
    table("header only", COMPARE, "T_max_C\n", "found no rows of data"),
    table(
        "long cell",
        COMPARE,
        'T_max_C,run\n30,"' + 140_000 * "a" + '"\n',
        "row 2: found a cell of more than 131072 characters",
    ),
    table(
        "open quote",
        FRICTION,
        SLIDES + '0.3,30,"0.9\n0.4,30,0.9\n',
        "row 2: found a quote that is never closed",
    ),
    table("stray quote", FRICTION, SLIDES + '0.3,30,"0"9\n', "row 2", "quotes in pairs"),
    table("short row", WLF, "T_C,aT\n20\n", "row 2: found 1 comma-separated entries, expected 2"),
    table(
        "decimal commas between commas",
        FRICTION,
        SLIDES + "0,3,30,0,9\n",
        "row 2: found 5 comma-separated entries",
        "decimal commas need ;",
    ),
    table(
        "decimal commas and points",
        FRICTION,
        SLIDES.replace(",", ";") + "0,3;30;0.9\n",
        "row 2, column p_N_per_mm2: found '0,3', expected decimal points or decimal commas",
    ),
    table(
        "thousands or decimals",
        WLF,
        "T_C;aT\n20;1\n30;1,250\n",
        "row 3, column aT: found '1,250'",
        "comma of thousands",
    ),
    table("name twice", COMPARE, "T_max_C,T_max_C\n30,30\n", "row 1", "the name twice"),
    table(
        "unit in the header that is another",
        FRICTION,
        "p_N_per_mm2,v [m/s],mu\n0.3,0.3,0.9\n",
        "row 1, column v_mm_per_s: found the columns p_N_per_mm2, v [m/s], mu",
    ),
    table("text", COMPARE, "T_max_C\nwarm\n", "row 2, column T_max_C: found 'warm'"),
    table("block before the first", COMPARE, "T_max_C,block\n30,0\n", "column block", "above 0"),
    table("overflow", COMPARE, "T_max_C\n1e400\n", "row 2, column T_max_C: found '1e400'"),
    table(
        "huge text in the wrong place",
        COMPARE,
        "T_max_C\n" + 100_000 * "9" + "\n",
        "row 2, column T_max_C: found '9999",
        "...",
    ),
]
