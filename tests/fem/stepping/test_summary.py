"""Scalars of a run: shares over the second half of the slide."""

import pandas as pd
import pytest

from fem.stepping.summary import steady_share, steady_shares


def history(distances, part, whole):
    return pd.DataFrame({"sliding_distance_mm": distances, "part": part, "whole": whole})


def test_the_share_counts_the_second_half_of_the_slide_only():
    table = history([0.0, 4.0, 5.0, 10.0], [0.0, 8.0, 9.0, 9.5], [0.0, 40.0, 50.0, 90.0])
    assert steady_share(table, "part", "whole") == pytest.approx((9.5 - 8.0) / (90.0 - 40.0))


def test_without_sliding_there_is_no_share():
    assert steady_share(history([0.0, 0.0], [0.0, 1.0], [0.0, 2.0]), "part", "whole") == 0.0
    assert steady_share(history([], [], []), "part", "whole") == 0.0


def test_what_is_stored_and_dissipated_in_the_second_half_is_told_apart():
    table = pd.DataFrame({
        "sliding_distance_mm": [0.0, 5.0, 10.0],
        "work_in_mJ_per_mm": [0.0, 40.0, 90.0],
        "strain_energy_mJ_per_mm": [0.0, 6.0, 7.0],
        "viscous_dissipation_mJ_per_mm": [0.0, 3.0, 3.5],
        "snap_dissipation_mJ_per_mm": [0.0, 0.5, 1.5],
        "rubber_dissipation_mJ_per_mm": [0.0, 0.1, 0.3],
    })  # fmt: skip
    shares = steady_shares(table)
    # The span starts with the last row before the middle.
    assert shares["storage_share"] == pytest.approx(7.0 / 90.0)
    assert shares["regularisation_share"] == pytest.approx((3.5 - 1.5 - 0.3) / 90.0)
