"""The study of slip: pieces of a locked wheel, table and picture."""

import numpy as np
import pandas as pd
import pytest

from fem import simulate
from tests.fem.test_events import LIFT, PRESS, event, slide
from tests.validation.checks import assert_labelled, assert_nothing_overlaps
from validation import braking
from validation.braking import CONTACT_S, VEHICLE, contacts_of, draw_slips, slip_table
from validation.studies import cases_of

WEAR = {"coefficient_mm3_per_J": 2e-3}


@pytest.fixture(scope="module")
def results():
    """A rigid block in two contacts at a twentieth of the speed, and one that slides on."""
    base = {"block": {"rigid": True}, "wear": WEAR}
    rolls = event(
        PRESS, slide(VEHICLE / 20.0, time_s=CONTACT_S), LIFT, loading={"repeat": 2}, **base
    )
    locked = event(PRESS, slide(VEHICLE / 10.0, time_s=3.0 * CONTACT_S), **base)
    return [simulate(rolls), simulate(locked)]


def test_a_locked_wheel_is_cut_into_pieces_as_long_as_a_contact(results):
    pieces = contacts_of(results[1])
    assert pieces["contact"].tolist() == [1, 2, 3]
    np.testing.assert_allclose(pieces["slid_mm"], VEHICLE / 10.0 * CONTACT_S)
    np.testing.assert_allclose(pieces["friction_coefficient"], 0.4, rtol=1e-9)
    last = results[1].history.iloc[-1]
    work = pieces["friction_work_mJ_per_mm"].sum()
    assert work == pytest.approx(last["friction_dissipation_mJ_per_mm"])
    assert pieces["T_max_C"].iloc[-1] == pytest.approx(last["T_max_C"])
    assert pieces["T_max_C"].is_monotonic_increasing


def test_contacts_of_a_rolling_wheel_are_those_of_its_table(results):
    assert contacts_of(results[0])["T_max_C"].equals(results[0].contacts["T_max_C"])


def test_the_table_has_slip_wear_and_the_picture_its_curves(results):
    table = slip_table(results)
    assert table["slip_percent"].tolist() == [5.0, 10.0]
    work = table["friction_work_mJ_per_mm"]
    depth = 1e3 * 2e-6 * work / 20.0
    np.testing.assert_allclose(table["wear_depth_um"], depth, rtol=1e-3)
    figure = draw_slips(results)
    assert_nothing_overlaps(figure)
    assert_labelled(figure)
    assert [len(axes.lines) for axes in figure.axes] == [2] * 4


def test_the_study_has_three_slips_and_a_locked_wheel():
    cases = [case.case.loading for case in cases_of("braking")]
    slips = sorted(100.0 * loading.velocity_mm_per_s / VEHICLE for loading in cases)
    assert slips == [5.0, 10.0, 20.0, 100.0]
    sliding = [loading.repeat * loading.phases[1].duration for loading in cases]
    np.testing.assert_allclose(sliding, 5.0 * CONTACT_S)


def test_the_command_writes_table_and_picture(results, tmp_path):
    for number, result in enumerate(results):
        result.write(tmp_path / "runs" / str(number))
    braking.main(str(tmp_path))
    table = pd.read_csv(tmp_path / "slip.csv")
    assert table["slip_percent"].tolist() == [5.0, 10.0]
    assert (tmp_path / "slip.png").stat().st_size > 10_000
