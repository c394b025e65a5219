"""A case and a study beside it, for the tests of this folder."""

from __future__ import annotations

import pytest

BASE = """
[loading]
mean_pressure_N_per_mm2 = 0.25
velocity_mm_per_s = 300.0
distance_mm = 120.0
"""


@pytest.fixture
def write_study(tmp_path):
    (tmp_path / "case.toml").write_text(BASE)

    def write(text: str):
        path = tmp_path / "study.toml"
        path.write_text(text)
        return path

    return write
