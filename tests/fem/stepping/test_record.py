"""Phases that follow what a rig measured: ways, forces, contacts, noise."""

from itertools import pairwise

import numpy as np
import pytest

from fem import Case, simulate
from fem.case import CaseError
from fem.case.signals import Signal
from fem.stepping.phases import Rest
from fem.stepping.programme import programme
from fem.stepping.record import Follow

MESH = {"cells_x": 12, "cells_y": 6, "smallest_x_mm": 1.2, "smallest_y_mm": 0.8}
SPEED, PRESSURE, TURN, ON = 300.0, 0.25, 0.05, 0.03


def table(rows, noise=0.0):
    """Two contacts and the first part of a third, each with rising and falling pressure."""
    t = np.linspace(0.0, 2.0 * TURN + 0.02, rows)
    since = t % TURN
    rise = np.minimum(since, ON - since) / 0.004
    p, v = PRESSURE * np.clip(rise, 0.0, 1.0), SPEED * np.clip(since / 0.002, 0.0, 1.0)
    rng = np.random.default_rng(1)
    scatter = noise * rng.normal(size=(2, rows))
    in_air = 0.1 * noise * PRESSURE * rng.normal(size=rows)
    p = np.where(p > 0.0, p * (1.0 + scatter[0]), in_air)
    return np.column_stack([t, v + SPEED * scatter[1], p])


def case_of(folder, name, rows, *, rigid=False, **tables):
    header = "time_s,velocity_mm_per_s,mean_pressure_N_per_mm2"
    np.savetxt(folder / name, rows, delimiter=",", header=header, comments="", fmt="%.9g")
    return Case.from_dict(
        {
            "loading": {"phase": [{"kind": "record", "file": name}]},
            "block": {"mesh": MESH, "rigid": rigid},
            "friction": {"law": "coulomb", "mu": 0.5, "wlf": False},
            "output": {"snapshots": 1},
            **tables,
        },
        folder=folder,
    )


def test_a_record_is_cut_into_contacts_and_rests_whatever_its_noise(tmp_path):
    for rows, noise in ((1201, 0.0), (100_001, 0.02)):
        phases = programme(case_of(tmp_path, "s.csv", table(rows, noise), rigid=True))
        assert [type(phase) for phase in phases] == [Follow, Rest, Follow, Rest, Follow]
        assert [phase.contact for phase in phases] == [1, 1, 2, 2, 3]
        starts = np.cumsum([0.0, *(phase.end for phase in phases)])
        np.testing.assert_allclose(starts[[0, 2, 4]], [0.0, TURN, 2.0 * TURN], atol=5e-4)


def test_steps_of_any_length_do_the_way_that_was_measured(tmp_path):
    follow = programme(case_of(tmp_path, "s.csv", table(1201), rigid=True))[0]
    for count in (1, 7, 50):
        ends = np.linspace(0.0, follow.end, count + 1)
        targets = [follow.target(a, b) for a, b in pairwise(ends)]
        assert sum(target.sweep for target in targets) == pytest.approx(follow.slid(follow.end))
    middle = follow.target(0.01, 0.012)
    assert middle.force == pytest.approx(PRESSURE * 20.0)
    assert middle.sweep / middle.dt == pytest.approx(SPEED)


def test_steps_are_chosen_by_what_happens_and_not_by_rows(tmp_path):
    counts = []
    for rows, noise in ((1201, 0.0), (100_001, 0.02)):
        follow = programme(case_of(tmp_path, "s.csv", table(rows, noise)))[0]
        at, count = 0.0, 0
        while at < follow.end:
            at, count = at + follow.longest(at), count + 1
        counts.append(count)
    assert 10 < counts[0] < 100
    assert counts[1] == pytest.approx(counts[0], rel=0.3)


@pytest.mark.parametrize("rigid", [True, pytest.param(False, marks=pytest.mark.slow)])
def test_a_hundred_thousand_noisy_rows_give_what_the_smooth_ones_give(rigid, tmp_path):
    smooth, noisy = (
        simulate(case_of(tmp_path, f"{rows}.csv", table(rows, noise), rigid=rigid))
        for rows, noise in ((1201, 0.0), (100_001, 0.02))
    )
    for result in (smooth, noisy):
        assert result.summary["status"] == "ok"
        assert result.summary["energy_error"] < 0.01
        assert result.history["contact"].max() == 3
    rise = [result.summary["T_max_C"] - 20.0 for result in (smooth, noisy)]
    work = [result.history["friction_dissipation_mJ_per_mm"].iloc[-1] for result in (smooth, noisy)]
    assert rise[1] == pytest.approx(rise[0], rel=0.01)
    assert work[1] == pytest.approx(work[0], rel=0.01)


def test_a_record_of_constant_speed_and_pressure_is_a_slide(tmp_path):
    rows = np.array([[0.0, 300.0, 0.25], [0.02, 300.0, 0.25]])
    record = simulate(case_of(tmp_path, "s.csv", rows, rigid=True))
    phases = [
        {"kind": "press", "mean_pressure_N_per_mm2": 0.25, "time_s": 1e-6},
        {"kind": "slide", "velocity_mm_per_s": 300.0, "distance_mm": 6.0},
    ]
    slide = record.case.to_dict() | {"loading": {"phase": phases}}
    for column, tolerance in (("T_max_C", 1e-3), ("friction_force_N_per_mm", 1e-9)):
        ends = [r.history[column].iloc[-1] for r in (record, simulate(Case.from_dict(slide)))]
        assert ends[0] == pytest.approx(ends[1], rel=tolerance)


def test_a_file_that_was_changed_is_not_the_resolved_case(tmp_path):
    case = case_of(tmp_path, "s.csv", table(301))
    (tmp_path / "resolved.toml").write_text(case.to_toml())
    assert Case.from_toml(tmp_path / "resolved.toml") == case
    other = case_of(tmp_path, "s.csv", table(302))
    assert other.hash() != case.hash()
    with pytest.raises(CaseError, match=r"loading.phase.0.sha256: found .* of the file"):
        Case.from_toml(tmp_path / "resolved.toml")


def test_a_mean_between_two_times_is_that_of_the_lines_between_rows():
    signal = Signal(t=np.array([0.0, 1.0, 3.0]), v=np.array([0.0, 2.0, 2.0]), p=np.ones(3))
    assert signal.mean(signal.position, 0.0, 1.0) == pytest.approx(1.0)
    assert signal.mean(signal.position, 1.5, 2.5) == pytest.approx(2.0)
    assert signal.contacts() == [(0.0, 3.0, True)]
