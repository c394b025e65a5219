"""Scalars of a run: shares over the second half of the slide."""

import pandas as pd
import pytest

from fem.run_summary import steady_share


def history(distances, part, whole):
    return pd.DataFrame({"sliding_distance_mm": distances, "part": part, "whole": whole})


def test_the_share_counts_the_second_half_of_the_slide_only():
    table = history([0.0, 4.0, 5.0, 10.0], [0.0, 8.0, 9.0, 9.5], [0.0, 40.0, 50.0, 90.0])
    assert steady_share(table, "part", "whole") == pytest.approx((9.5 - 8.0) / (90.0 - 40.0))


def test_without_sliding_there_is_no_share():
    assert steady_share(history([0.0, 0.0], [0.0, 1.0], [0.0, 2.0]), "part", "whole") == 0.0
    assert steady_share(history([], [], []), "part", "whole") == 0.0
