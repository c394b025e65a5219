"""Tables that cannot be read or fitted, beside the rows of `tests/wrong_inputs`."""

import numpy as np
import pandas as pd
import pytest

import treadfem
from calibration import DataError, fit_friction, fit_hyperelastic

TABLE = (
    "stretch,nominal_stress_N_per_mm2,mode\n1.1,0.2,uniaxial\n1.3,0.5,uniaxial\n1.6,0.8,uniaxial\n"
)


def run(words):
    return treadfem.main(["calibrate", *words])


def test_files_that_cannot_be_read_are_named(tmp_path, capsys):
    assert run(["hyperelastic", str(tmp_path / "none.csv")]) == 2
    assert "none.csv: found No such file or directory, expected" in capsys.readouterr().err
    assert run(["hyperelastic", str(tmp_path)]) == 2
    assert "found Is a directory" in capsys.readouterr().err
    binary = tmp_path / "binary.csv"
    binary.write_bytes(b"\x00\x01\x80\x81")
    assert run(["hyperelastic", str(binary)]) == 2
    assert "found bytes that are no text" in capsys.readouterr().err


def test_wrong_options_end_in_one_line(tmp_path, capsys):
    path = tmp_path / "data.csv"
    path.write_text(TABLE)
    for words in (["--window", "2", "1"], ["--fix", "C11=1"], ["--cycle", "7"]):
        assert run(["hyperelastic", str(path), *words]) == 2
        printed = capsys.readouterr().err
        assert printed.count("\n") == 1
        assert "expected" in printed


def test_an_output_folder_that_is_a_file_is_refused(tmp_path, capsys):
    path = tmp_path / "data.csv"
    path.write_text(TABLE)
    assert run(["hyperelastic", str(path), "-o", str(path)]) == 2
    assert "expected a writable folder" in capsys.readouterr().err


def test_rows_of_a_data_frame_are_counted_from_one():
    table = pd.DataFrame(
        {"stretch": [1.1, np.nan], "nominal_stress_N_per_mm2": 0.2, "mode": "planar"}
    )
    with pytest.raises(DataError, match=r"^table, row 2, column stretch: found 'nan', expected a"):
        fit_hyperelastic(table)
    table = pd.DataFrame({"p_N_per_mm2": [0.3], "v_mm_per_s": [10.0], "mu": [-1.0]})
    with pytest.raises(DataError, match=r"^table, row 1, column mu: found -1.0, expected"):
        fit_friction(table)
