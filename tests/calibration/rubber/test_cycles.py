"""Choice of the load cycle."""

import numpy as np
import pytest

from calibration import DataError, fit_hyperelastic
from calibration.rubber.cycles import label_cycles, last_full_cycle
from calibration.rubber.stress_data import select_data
from calibration.synthetic import synthetic_bar_cycles, synthetic_dumbbell_cycles
from materials import compound


def test_last_full_cycle_leaves_out_the_path_to_failure():
    table = synthetic_bar_cycles(1)
    assert table["cycle"].max() == 6
    data = select_data(table)
    assert set(data.table.frame["cycle"]) == {5}
    assert data.selection["cycle"] == "last full cycle at the highest strain (uniaxial 5)"


def test_highest_strain_level_counts_before_the_last_cycle():
    cycle = np.repeat([1, 2, 3, 4], 4)
    branch = np.tile(["load", "load", "unload", "unload"], 4)
    stretch = np.concatenate([np.array([1.0, t, t, 1.0]) for t in (1.5, 2.0, 2.01, 1.2)])
    assert last_full_cycle(stretch, cycle, branch) == 3
    assert last_full_cycle(stretch, cycle, np.full(16, "load")) is None
    assert last_full_cycle(stretch, cycle, None) == 3


def test_the_papers_choice_of_data_leads_to_the_papers_parameters():
    bars = synthetic_bar_cycles(1)
    for branch, name in [("both", "yeoh-bars-series-1"), ("load", "yeoh-bars-series-1-load")]:
        found = fit_hyperelastic(bars, "yeoh", branch=branch).values
        assert found == pytest.approx(vars(compound(name)), rel=1e-9)
    found = fit_hyperelastic(synthetic_bar_cycles(2), "yeoh").values
    assert found == pytest.approx(vars(compound("yeoh-bars-series-2")), rel=1e-9)
    found = fit_hyperelastic(synthetic_dumbbell_cycles(), "mooney-rivlin").values
    assert found == pytest.approx(vars(compound("mooney-rivlin-dumbbells")), rel=1e-9)


def test_first_cycle_gives_a_stiffer_rubber():
    first = fit_hyperelastic(synthetic_bar_cycles(2), "yeoh", cycle=1).values["C10"]
    assert first > 1.2 * compound("yeoh-bars-series-2").C10


def test_all_cycles_and_single_branches_can_be_asked_for():
    bars = synthetic_bar_cycles(1, points=20)
    assert len(select_data(bars, cycle="all").stretch) == len(bars)
    assert len(select_data(bars, cycle=2, branch="unload").stretch) == 20


def test_cycles_of_a_plain_record_are_found():
    bars = synthetic_bar_cycles(2, points=40)
    noisy = bars["stretch"] + np.random.default_rng(0).normal(0, 0.004, len(bars))
    cycle, branch = label_cycles(noisy.to_numpy())
    assert cycle[-1] == 6
    assert np.mean(cycle == bars["cycle"]) > 0.98
    assert np.mean(branch == bars["branch"]) > 0.98


def test_a_record_without_cycle_columns_gives_the_same_fit():
    bars = synthetic_bar_cycles(1)
    bare = bars.drop(columns=["cycle", "branch"])
    labelled = fit_hyperelastic(bars, "yeoh").values
    found = fit_hyperelastic(bare, "yeoh", cycle="last-full")
    assert found.values == pytest.approx(labelled, rel=1e-2)
    assert fit_hyperelastic(bare, "yeoh").n_data == len(bars)


def test_numbered_cycles_without_branches_leave_out_the_path_to_failure_as_well():
    bars = synthetic_bar_cycles(1)
    found = select_data(bars.drop(columns=["branch"]))
    assert set(found.table.frame["cycle"]) == {5}
    loading = select_data(bars.drop(columns=["branch"]), branch="load")
    assert len(loading.stretch) == pytest.approx(60, abs=1)
    assert loading.stretch[0] < loading.stretch[-1]


def test_a_cycle_that_is_not_there_is_refused():
    bars = synthetic_bar_cycles(1, points=10)
    with pytest.raises(
        DataError, match="column cycle: found the cycles 1, 2, 3, 4, 5, 6, expected"
    ):
        select_data(bars, cycle=9)
    with pytest.raises(DataError, match="found no cycle with both a load and an unload branch"):
        select_data(bars[bars["branch"] == "load"], cycle="last-full")
