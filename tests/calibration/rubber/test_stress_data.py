"""Which points of a stress-stretch table are fitted, and what is said of the others."""

import numpy as np
import pandas as pd
import pytest

from calibration import DataError
from calibration.rubber.stress_data import select_data
from calibration.synthetic import synthetic_bar_cycles
from materials import NeoHooke


def test_modes_without_a_full_cycle_keep_their_rows():
    bars = synthetic_bar_cycles(1, points=10)
    sheet = pd.DataFrame(
        {
            "stretch": [1.2, 1.5],
            "nominal_stress_N_per_mm2": [0.55, 1.22],
            "mode": "equibiaxial",
            "cycle": 1,
            "branch": "load",
        }
    )
    data = select_data(pd.concat([bars, sheet], ignore_index=True))
    assert np.count_nonzero(data.mode == "equibiaxial") == 2
    assert data.selection["cycle"].endswith("all of equibiaxial, which has no full cycle")
    only = select_data(bars[bars["branch"] == "load"])
    assert len(only.stretch) == np.count_nonzero(bars["branch"] == "load")


def test_every_row_is_used_or_its_number_and_reason_are_told():
    bars = synthetic_bar_cycles(1, points=10)
    data = select_data(bars, branch="load", window=(1.0, 2.0))
    told = data.selection["rows_left_out"]
    assert [text.split(": ")[1] for text in told] == [
        "of another cycle",
        "not on the load path",
        "outside the window 1 to 2",
    ]
    assert sum(int(text.split()[0]) for text in told) + len(data.stretch) == len(bars)
    assert data.selection["rows_used"] == len(data.stretch)


STRETCH = np.array([0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.5, 2.0])
RUBBER = NeoHooke(G=0.8)


def table(stretch, **columns):
    stress = RUBBER.nominal_stress(stretch).round(6)
    return pd.DataFrame(
        {"stretch": stretch, "nominal_stress_N_per_mm2": stress, "mode": "uniaxial", **columns}
    )


@pytest.mark.parametrize("order", [slice(None), slice(None, None, -1)])
def test_a_table_sorted_from_compression_to_tension_is_all_loading(order):
    data = select_data(table(STRETCH[order]), branch="load")
    assert len(data.stretch) == STRETCH.size
    assert data.selection["rows_left_out"] == []


def test_branches_go_away_from_the_undeformed_state_in_compression_too():
    record = np.concatenate([np.linspace(1, 2, 9), np.linspace(2, 0.6, 9), np.linspace(0.6, 1, 9)])
    data = select_data(table(record), branch="load")
    assert np.count_nonzero(data.stretch < 1.0) == 2
    assert np.count_nonzero(data.stretch > 1.0) > 6
    assert [text.split(": ")[1] for text in data.selection["rows_left_out"]] == [
        "not on the load path"
    ]


def test_rows_in_no_order_of_recording_have_no_branches():
    shuffled = np.random.default_rng(1).permutation(np.linspace(0.6, 2.0, 30))
    assert len(select_data(table(shuffled)).stretch) == 30  # a fit needs none
    loop = np.repeat(np.linspace(1.0, 2.0, 12), 2)
    for record in (shuffled, loop):
        with pytest.raises(DataError, match="rows that are in no order of recording"):
            select_data(table(record), branch="load")


def test_strains_are_read_as_stretches_and_that_is_said():
    plain = select_data(table(STRETCH))
    for column, factor in (("strain", 1.0), ("strain_percent", 100.0)):
        strains = table(STRETCH).rename(columns={"stretch": column})
        strains[column] = factor * (strains[column] - 1.0)
        found = select_data(strains)
        np.testing.assert_allclose(found.stretch, plain.stretch, rtol=1e-14)
        assert found.selection["notes"][0].startswith(f"the stretch is 1 + {column}")
    told = select_data(table(STRETCH).drop(columns="mode"), modes=["planar"])
    assert set(told.mode) == {"planar"}
    assert "every row is planar" in told.selection["notes"][0]


def test_small_strains_in_per_cent_are_refused_and_large_stretches_are_not():
    percent = np.array([2.0, 4.0, 6.0, 8.0, 10.0, 11.5])
    strains = table(1.0 + percent / 100).assign(stretch=percent)
    with pytest.raises(DataError, match=r"strain in per cent \(G 0.8\)"):
        select_data(strains)
    assert len(select_data(table(np.linspace(2.0, 6.0, 9))).stretch) == 9


def test_stress_at_rest_is_unusual_until_the_zero_is_moved():
    loaded = table(STRETCH[4:])
    loaded["nominal_stress_N_per_mm2"] += 0.1
    source = select_data(loaded).table
    assert "0.1 at the stretch 1 is unusual" in source.unusual[0]
    moved = select_data(loaded, zero="first")
    np.testing.assert_allclose(moved.stress, table(STRETCH[4:])["nominal_stress_N_per_mm2"])
    assert moved.table.unusual == []
    assert "the stress of row 1, 0.1 N/mm^2, is subtracted" in moved.selection["notes"][0]
    with pytest.raises(DataError, match="found 1.2 in the first row of its mode"):
        select_data(table(STRETCH[5:]), zero="first")


@pytest.mark.parametrize("mode", ["uniaxial", "equibiaxial", "planar"])
def test_a_loop_with_permanent_set_is_the_rubber_of_its_own_length(mode):
    own = np.concatenate([np.linspace(1.0, 1.8, 60), np.linspace(1.8, 1.0, 60)])
    set_stretch = 1.06
    loop = pd.DataFrame(
        {
            "stretch": own * set_stretch,  # as measured, with the length of the virgin rubber
            "nominal_stress_N_per_mm2": RUBBER.nominal_stress(own, mode) / set_stretch,
            "mode": mode,
            "cycle": 1,
        }
    )
    data = select_data(loop, zero="loop")
    np.testing.assert_allclose(data.stretch, own, rtol=1e-9)
    np.testing.assert_allclose(data.stress, RUBBER.nominal_stress(own, mode), atol=1e-9)
    assert "permanent set 0.06" in data.selection["notes"][0]
    # a loop that ends just above zero stress is extended to it, one that ends far above is not
    short = select_data(loop.iloc[:-1], zero="loop")
    np.testing.assert_allclose(short.stretch[0], 1.0, atol=2e-3)
    with pytest.raises(DataError, match="where the .* loop ends, expected an unloading path"):
        select_data(loop.iloc[:-12], zero="loop")
    with pytest.raises(DataError, match="no unloading path of the"):
        select_data(loop.iloc[:60], zero="loop")
