"""Rubber with branches and softening in the block: balances, records, relaxation, damping."""

from dataclasses import replace

import numpy as np
import pytest

from fem import Case, Result, simulate
from fem.mechanics.regularisation import snap_damping
from fem.newton import Failure
from fem.stepping.coupled_state import RejectedStep
from fem.stepping.coupled_step import CoupledModel
from fem.stepping.model_parts import mesh_of
from materials import WLF, NeoHooke, OgdenRoxburgh, Prony, Rubber
from tests.fem.contact_steps import load_of, small_block, solved

SMALL = {"cells_x": 24, "cells_y": 8, "smallest_x_mm": 0.4, "smallest_y_mm": 0.3}
#: Made up, of the kind of a tread rubber: more loss the faster it is strained.
SPECTRUM = {"g": [1.5, 0.8, 0.4, 0.3], "tau_s": [1e-4, 1e-3, 1e-2, 1e-1]}
MULLINS = {"r": 2.0, "m_N_per_mm2": 0.1, "beta": 0.1}


def case_of(distance=3.0, *, loading=None, solver=None, heat=None, **rubber):
    slide = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": distance}
    return Case.from_dict(
        {
            "loading": loading or slide,
            "block": {"mesh": SMALL},
            "rubber": rubber,
            "heat": heat or {},
            "solver": solver or {},
            "output": {"snapshots": 2, "figures": False},
        }
    )  # fmt: skip


@pytest.fixture(scope="module")
def run():
    spectrum = SPECTRUM | {"C1": 7.0, "C2_K": 120.0}
    return simulate(case_of(viscoelastic=spectrum, mullins=MULLINS))


def column(result, name):
    return result.history[f"{name}_mJ_per_mm"]


# ------------------------------------------------------------------------- balances, records


def test_energy_is_stored_dissipated_or_consumed(run):
    last = run.history.iloc[-1]
    parts = ("strain_energy", "friction_dissipation", "viscous_dissipation", "damage_energy",
             "kinetic_energy")  # fmt: skip
    found = sum(last[f"{part}_mJ_per_mm"] for part in parts)
    assert run.summary["energy_error"] < 0.01
    assert found == pytest.approx(last["work_in_mJ_per_mm"], rel=0.01)
    assert run.summary["rubber_dissipation_share"] > 0.01
    assert run.summary["damage_share"] > 0.01


def test_what_branches_dissipate_and_damage_consumes_heats_the_block(run):
    assert run.summary["heat_error"] < 1e-9
    heat = column(run, "bulk_heat")
    lost = column(run, "rubber_dissipation") + column(run, "damage_energy")
    np.testing.assert_allclose(heat, lost, rtol=1e-12)
    found = sum(column(run, name) for name in ("heat_in_rubber", "heat_in_road", "radiated"))
    np.testing.assert_allclose(found, column(run, "frictional_heat") + heat, rtol=1e-9)


def test_dissipation_and_damage_only_grow(run):
    for name in ("rubber_dissipation", "damage_energy"):
        assert (np.diff(column(run, name)) >= 0.0).all()


def test_nothing_is_damped_by_artificial_means_and_the_log_says_so(run):
    assert run.summary["regularisation_share_with_onset"] == run.summary["snap_share"] == 0.0
    np.testing.assert_array_equal(
        column(run, "viscous_dissipation"), column(run, "rubber_dissipation")
    )
    assert any(line.startswith("no artificial damping: the rubber damps") for line in run.log)


def test_fields_have_softening_and_dissipation_and_are_read_back(run, tmp_path):
    run.write(tmp_path / "run")
    last = Result.read(tmp_path / "run").snapshots[-1]
    assert last == run.snapshots[-1]
    assert last.softening.min() < 0.99
    assert last.softening.max() <= 1.0
    assert last.viscous_dissipation.min() >= 0.0
    corners = mesh_of(run.case).points[mesh_of(run.case).cells]
    area = np.prod(corners[:, 2] - corners[:, 0], axis=1)
    assert last.viscous_dissipation @ area == pytest.approx(
        column(run, "rubber_dissipation").iloc[-1], rel=1e-12
    )
    text = (tmp_path / "run" / "block_0001.vtu").read_bytes()
    assert b"softening" in text
    assert b"viscous_dissipation_mJ_per_mm3" in text


@pytest.mark.parametrize("part", ["viscoelastic", "mullins"])
def test_heat_of_the_bulk_may_be_left_out_part_by_part(part):
    parts = {"viscoelastic": SPECTRUM, "mullins": MULLINS}
    lost = {"viscoelastic": "damage_energy", "mullins": "rubber_dissipation"}[part]
    result = simulate(case_of(0.5, **parts | {part: parts[part] | {"heats": False}}))
    for name in ("rubber_dissipation", "damage_energy"):
        assert column(result, name).iloc[-1] > 0.0
    np.testing.assert_allclose(column(result, "bulk_heat"), column(result, lost), rtol=1e-12)
    assert result.summary["heat_error"] < 1e-9


def test_a_virgin_block_is_warmed_by_its_first_pressing_only():
    """Heat of damage comes with loads larger than before."""
    press = {"kind": "press", "time_s": 0.01}
    loads = [{**press, "mean_pressure_N_per_mm2": p} for p in (0.4, 0.02, 0.4, 0.5)]
    slide = {"kind": "slide", "velocity_mm_per_s": 300.0, "distance_mm": 0.02}
    history = simulate(case_of(loading={"phase": [*loads, slide]}, mullins=MULLINS)).history
    ends = history.groupby("phase").bulk_heat_mJ_per_mm.last()
    assert ends[1] > 0.0
    assert ends[2] == pytest.approx(ends[1], rel=1e-6)
    assert ends[3] == pytest.approx(ends[1], rel=0.02)
    assert ends[4] > 1.2 * ends[3]


def test_rubber_without_a_memory_has_none_of_it():
    result = simulate(case_of(0.5))
    assert not column(result, "rubber_dissipation").any()
    assert not column(result, "damage_energy").any()
    assert result.snapshots[-1].softening is None


@pytest.mark.parametrize(("tau", "factor"), [(1e-9, 1.0), (1e9, 1.5)])
def test_very_fast_and_very_slow_branches_give_the_elastic_answers(tau, factor):
    """Of pressing and the first motion, in which nothing snaps; G + g G is the stiffer one."""
    solver = {"snap_damping": "never"}
    memory = case_of(0.3, solver=solver, model="neo-hooke", G_N_per_mm2=0.8, bulk_ratio=50.0,
                     viscoelastic={"g": [0.5], "tau_s": [tau]})  # fmt: skip
    elastic = case_of(0.3, solver=solver, model="neo-hooke", G_N_per_mm2=0.8 * factor,
                      bulk_ratio=50.0 / factor)  # fmt: skip
    one, other = (simulate(case).history.iloc[-1] for case in (memory, elastic))
    for name in ("friction_force_N_per_mm", "platen_displacement_mm", "A_T_K_mm"):
        assert one[name] == pytest.approx(other[name], rel=1e-4), name


def test_balances_hold_over_slides_lifts_and_rests_and_the_second_contact_is_softer():
    phases = [
        {"kind": "press", "mean_pressure_N_per_mm2": 0.25},
        {"kind": "slide", "velocity_mm_per_s": 300.0, "distance_mm": 1.5},
        {"kind": "lift", "time_s": 0.5},
    ]
    case = case_of(viscoelastic=SPECTRUM, mullins=MULLINS).to_dict()
    case["loading"] = {"repeat": 2, "phase": phases}
    case["block"]["mesh"] = {
        "cells_x": 12,
        "cells_y": 5,
        "smallest_x_mm": 1.0,
        "smallest_y_mm": 1.0,
    }
    result = simulate(Case.from_dict(case))
    assert result.summary["status"] == "ok"
    assert result.summary["energy_error"] < 0.01
    assert result.summary["heat_error"] < 1e-9
    pressed, _, rested, again, _, _ = (
        rows.iloc[-1] for _, rows in result.history.groupby(["contact", "phase"])
    )
    stored = "strain_energy_mJ_per_mm"
    assert rested[stored] < 1e-3 * pressed[stored]
    assert again["platen_displacement_mm"] > 1.02 * pressed["platen_displacement_mm"]
    # the largest load of before is not reached again by pressing alone
    consumed = "damage_energy_mJ_per_mm"
    assert again[consumed] - rested[consumed] < 0.1 * pressed[consumed]


# ------------------------------------------------------------------- relaxation of a block


def held(system, state, force, dt):
    return solved(system, state, load_of(system, force=force, dt=dt))[2]


def lowered(system, state):
    return -state.u[system.mesh.top, 1].mean()


def test_a_pressed_block_creeps_to_its_slow_state_and_recovers():
    slow = NeoHooke(G=0.8)
    system = small_block(model=Rubber(elastic=slow, viscous=Prony(g=[1.0], tau_s=[0.1])))
    elastic = small_block(model=slow)
    end = lowered(elastic, held(elastic, elastic.initial_state(), 1.0, 1.0))
    state, depths = system.initial_state(), []
    for dt in (1e-6, 0.02, 0.05, 0.2, 1.0, 10.0, 100.0):
        state = held(system, state, 1.0, dt)
        depths.append(lowered(system, state))
    assert (np.diff(depths) >= -1e-9).all()
    assert depths[0] == pytest.approx(0.5 * end, rel=0.05)  # twice as stiff
    assert depths[-1] == pytest.approx(end, rel=1e-6)
    for dt in (1e-6, 0.1, 1.0, 100.0, 100.0):
        state = held(system, state, 0.0, dt)
    assert abs(lowered(system, state)) < 1e-6 * end


def test_a_block_is_softer_when_pressed_again_and_as_before_above_its_largest_load():
    damage = OgdenRoxburgh(r=1.6, m=0.005, beta=0.1)
    system = small_block(model=Rubber(elastic=NeoHooke(G=0.8), damage=damage))
    depths, state = [], system.initial_state()
    for force in (0.5, 1.0, 2.0, 1.0, 0.0, 0.5, 1.0, 2.0, 3.0):
        state = held(system, state, force, 1.0)
        depths.append(lowered(system, state))
    virgin, again = depths[:3], depths[5:8]
    assert again[0] > 1.05 * virgin[0]
    assert again[2] == pytest.approx(virgin[2], rel=1e-6)
    fresh = held(system, held(system, system.initial_state(), 2.0, 1.0), 3.0, 1.0)
    assert depths[-1] == pytest.approx(lowered(system, fresh), rel=1e-6)


def test_each_element_relaxes_at_its_own_temperature():
    spectrum = Prony(g=[1.0], tau_s=[0.1], shift=WLF(d1=7.0, d2_K=120.0), T_ref_C=20.0)
    system = small_block(model=Rubber(elastic=NeoHooke(G=0.8), viscous=spectrum))
    state, mesh = system.initial_state(), system.mesh
    T = np.where(mesh.points[:, 0] < 3.0, 20.0, 60.0)
    load = replace(load_of(system, force=1.0, dt=0.05), T_C=T)
    _, result, after = solved(system, state, load)
    mean = T[mesh.cells].mean(axis=1)[:, None]
    step = system.elements.model.step(state.rubber, 0.05, mean)
    np.testing.assert_array_equal(
        step.end(system.elements.kinematics(result.x.u)).state, after.rubber
    )
    # the hot half has relaxed: its branch follows the deformation
    follows = np.abs(after.rubber[3:] - after.rubber[:3]).max(axis=(0, 2))
    strained = np.abs(after.rubber[:3] - state.rubber[:3]).max(axis=(0, 2))
    share = follows / strained
    assert share[mean[:, 0] == 60.0].mean() < 0.3 * share[mean[:, 0] == 20.0].mean()


# ------------------------------------------------------------------------ damping of snaps


@pytest.mark.parametrize(
    ("rubber", "ambient_C", "choice", "damped"),
    [
        ({}, 20.0, "auto", True),
        ({}, 20.0, "never", False),
        ({"viscoelastic": SPECTRUM}, 20.0, "auto", False),
        ({"viscoelastic": SPECTRUM}, 20.0, "always", True),
        ({"viscoelastic": {"g": [1.5], "tau_s": [1e-1]}}, 20.0, "auto", True),
        ({"viscoelastic": {"g": [0.1], "tau_s": [1e-4]}}, 20.0, "auto", True),
        # 60 K warmer the slow branch is the one that counts
        ({"viscoelastic": {"g": [1.5], "tau_s": [1e-2], "C1": 7.0, "C2_K": 120.0}}, 20.0, "auto",
         True),
        ({"viscoelastic": {"g": [1.5], "tau_s": [1e-2], "C1": 7.0, "C2_K": 120.0}}, 80.0, "auto",
         False),
    ],
)  # fmt: skip
def test_rubber_that_damps_at_the_rate_of_the_snaps_gets_no_help(rubber, ambient_C, choice, damped):
    case = case_of(heat={"ambient_C": ambient_C}, solver={"snap_damping": choice}, **rubber)
    found = snap_damping(case, mesh_of(case))
    assert (found is not None and not found.last_resort) == damped


def test_where_no_step_length_has_a_solution_damping_helps_and_it_is_said(monkeypatch):
    """A made-up place that steps without damping do not pass."""
    advance = CoupledModel.advance

    def without_a_solution(model, state, target, help_level=0.0, guess=None):
        if help_level == 0.0 and 0.1 < state.position < 0.15 and guess is None:
            return RejectedStep(failure=Failure.STALLED, detail="", iterations=1)
        return advance(model, state, target, help_level, guess)

    monkeypatch.setattr(CoupledModel, "advance", without_a_solution)
    result = simulate(case_of(0.3, viscoelastic=SPECTRUM))
    assert result.summary["status"] == "ok"
    assert sum("no step length has a solution" in line for line in result.log) > 0
    assert result.summary["energy_error"] < 0.01
    never = simulate(case_of(0.3, viscoelastic=SPECTRUM, solver={"snap_damping": "never"}))
    assert never.summary["status"] == "not converged"
