"""The table of contacts from a history: where a contact begins and ends, and what it adds."""

import numpy as np
import pandas as pd
import pytest

from fem.results import contacts_table

#: Two contacts: pressed, slid, lifted. The first loses the road for a step, and touches it again.
HISTORY = pd.DataFrame(
    {
        "time_s": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 1.1, 1.2, 1.3, 1.4],
        "contact": [1, 1, 1, 1, 1, 1, 2, 2, 2, 2],
        "phase": [1, 2, 3, 3, 3, 3, 1, 2, 3, 3],
        "mean_pressure_N_per_mm2": [0.2, 0.2, 0.0, 0.0, 0.0, 0.0, 0.2, 0.2, 0.0, 0.0],
        "contact_length_mm": [9.0, 8.0, 0.0, 4.0, 0.0, 0.0, 9.0, 8.0, 0.0, 0.0],
        "sliding_distance_mm": [0.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 5.0, 5.0, 5.0],
        "friction_coefficient": [0.0, 0.8, 0.0, 0.5, 0.0, 0.0, 0.0, 0.7, 0.0, 0.0],
        "T_max_C": [20.0, 40.0, 39.0, 38.0, 37.0, 30.0, 30.0, 50.0, 45.0, 40.0],
        "A_T_K_mm": np.arange(10.0),
        "friction_dissipation_mJ_per_mm": [0.0, 3.0, 3.5, 4.0, 4.25, 4.25, 4.25, 9.0, 9.5, 9.5],
        "heat_in_rubber_mJ_per_mm": [0.0, 1.0, 1.2, 1.4, 1.3, 1.0, 1.0, 3.0, 3.2, 3.0],
    }
)


def test_the_works_of_the_contacts_add_up_to_all_of_the_friction() -> None:
    table = contacts_table(HISTORY, 20.0)
    assert table["friction_work_mJ_per_mm"].tolist() == [4.25, 5.25]
    total = HISTORY["friction_dissipation_mJ_per_mm"].iloc[-1]
    assert table["friction_work_mJ_per_mm"].sum() == pytest.approx(total)


def test_heat_is_taken_when_the_road_is_left_for_good() -> None:
    assert contacts_table(HISTORY, 20.0)["heat_in_rubber_mJ_per_mm"].tolist() == pytest.approx(
        [1.3, 3.2 - 1.0]
    )


def test_temperatures_are_those_before_and_at_the_end_of_a_contact() -> None:
    table = contacts_table(HISTORY, 20.0)
    assert table["T_before_C"].tolist() == [20.0, 30.0]
    assert table["T_max_C"].tolist() == [40.0, 50.0]
    assert table["end_s"].tolist() == [0.2, 1.2]
    assert table["slid_mm"].tolist() == [2.0, 3.0]


def test_a_history_that_ends_in_contact_counts_to_its_end() -> None:
    table = contacts_table(HISTORY.iloc[:8], 20.0)
    assert table["friction_work_mJ_per_mm"].tolist() == [4.25, 4.75]
