"""Tables and pictures of rubber that remembers, from short runs and by hand."""

from types import SimpleNamespace

import pandas as pd
import pytest

from fem import Case, simulate
from validation import bulk_memory
from validation.analysis import force_at, onset_difference
from validation.bulk_memory import bulk_share, main, rubber_of

SPEC = {"cells_x": 12, "cells_y": 5, "smallest_x_mm": 1.0, "smallest_y_mm": 1.0}
RUBBERS = {
    "elastic": {},
    "branches": {"viscoelastic": {"g": [1.5], "tau_s": [1e-4]}},
    "softening": {"mullins": {"r": 2.0, "m_N_per_mm2": 0.1}},
}
SLIDE = {"kind": "slide", "velocity_mm_per_s": 300.0, "distance_mm": 0.3}
PHASES = [
    {"kind": "press", "mean_pressure_N_per_mm2": 0.25},
    SLIDE,
    {"kind": "lift", "time_s": 0.01},
]


def case_of(loading, **rubber):
    return Case.from_dict(
        {
            "loading": loading,
            "block": {"mesh": SPEC},
            "rubber": rubber,
            "friction": {"law": "coulomb", "mu": 0.3, "wlf": False},
            "output": {"snapshots": 1, "vtu": False, "figures": False},
        }
    )


def test_runs_are_named_by_their_rubber():
    for name, rubber in RUBBERS.items():
        case = case_of({"phase": PHASES}, **rubber)
        assert rubber_of(SimpleNamespace(case=case)) == name


def test_forces_and_shares_are_read_off_a_history():
    history = pd.DataFrame(
        {
            "sliding_distance_mm": [0.0, 1.0, 3.0],
            "friction_force_N_per_mm": [9.0, 1.0, 2.0],
            "bulk_heat_mJ_per_mm": [0.0, 0.5, 1.0],
            "frictional_heat_mJ_per_mm": [0.0, 1.0, 4.0],
        }
    )
    assert force_at(history, 2.0) == pytest.approx(1.5)
    assert bulk_share(history) == 0.25
    twice = history.assign(friction_force_N_per_mm=2.0 * history["friction_force_N_per_mm"])
    assert onset_difference(history, twice, 3.0) == pytest.approx(0.5)
    assert onset_difference(history, history, 3.0) == 0.0


def test_two_studies_give_two_tables_and_two_pictures(tmp_path, monkeypatch, capsys):
    for table in ("SLIDES", "EVENT"):
        monkeypatch.setattr(bulk_memory, table, tmp_path / f"{table}.csv")
    slide = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 0.3}
    for name, rubber in RUBBERS.items():
        simulate(case_of(slide, **rubber)).write(tmp_path / "slides" / "runs" / name)
        event = case_of({"repeat": 2, "phase": PHASES}, **rubber)
        simulate(event).write(tmp_path / "event" / "runs" / name)
    main([str(tmp_path / "slides"), str(tmp_path / "event"), "-o", str(tmp_path)])
    slides = pd.read_csv(tmp_path / "SLIDES.csv").set_index("rubber")
    assert list(slides.index) == list(RUBBERS)
    assert (slides["status"] == "ok").all()
    assert slides.loc["elastic", "bulk_heat_share"] == 0.0
    assert (slides["bulk_heat_share"].iloc[1:] > 0.0).all()
    # faster rubber is stiffer in the onset
    assert slides.loc["branches", "force_at_0.5_mm"] > slides.loc["elastic", "force_at_0.5_mm"]
    event = pd.read_csv(tmp_path / "EVENT.csv")
    assert list(event["contact"]) == 3 * [1, 2]
    heat = event.set_index(["rubber", "contact"])["bulk_heat_mJ_per_mm"]
    assert (heat["elastic"] == 0.0).all()
    assert heat["branches", 2] == pytest.approx(heat["branches", 1], rel=0.2)
    # a virgin block softens once
    assert heat["softening", 2] < 0.2 * heat["softening", 1]
    for name in ("memory_force.png", "memory_event.png"):
        assert (tmp_path / name).stat().st_size > 10_000
