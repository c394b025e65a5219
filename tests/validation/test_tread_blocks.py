"""Table and pictures of blocks side by side, from two short runs."""

import pandas as pd
import pytest

from fem import Case, simulate
from validation.tread_blocks import described, main, onset_stiffness

SPEC = {"cells_x": 16, "cells_y": 8, "smallest_x_mm": 0.5, "smallest_y_mm": 0.3}


def case_of(**block):
    return Case.from_dict(
        {
            "loading": {
                "mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 0.6,
            },
            "block": {"mesh": SPEC} | block,
            "friction": {"law": "coulomb", "mu": 0.3, "wlf": False},
            "wear": {"coefficient_mm3_per_J": 2e-3},
            "output": {"snapshots": 1, "vtu": False, "figures": False},
        }
    )  # fmt: skip


def test_blocks_are_described_by_their_outline():
    sipe = {"position_mm": 10.0, "depth_mm": 5.0}
    assert described(case_of()) == "plain"
    assert described(case_of(sipes=[sipe], chamfer_leading_mm=1.0)) == "1 sipe, chamfered"
    assert described(case_of(blocks=2)) == "2 blocks"


def test_the_onset_stiffness_is_a_secant():
    history = pd.DataFrame(
        {"sliding_distance_mm": [0.0, 0.4, 0.6], "friction_force_N_per_mm": [0.0, 0.8, 1.2]}
    )
    assert onset_stiffness(history) == pytest.approx(2.0)


def test_a_study_gives_a_table_and_two_pictures(tmp_path, capsys):
    for name, block in {"plain": {}, "two": {"blocks": 2}}.items():
        simulate(case_of(**block)).write(tmp_path / "runs" / name)
    main(str(tmp_path))
    table = pd.read_csv(tmp_path / "blocks.csv")
    assert list(table["block"]) == ["plain", "2 blocks"]
    plain, two = table["friction_force_per_block_N_per_mm"]
    assert two == pytest.approx(plain, rel=5e-3)
    for name in ("blocks.png", "blocks_curves.png"):
        assert (tmp_path / name).stat().st_size > 10_000
