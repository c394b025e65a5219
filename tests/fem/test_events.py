"""Events of several phases: contacts, lift-off, rest, touch-down, reversal and wear."""

import numpy as np
import pytest
from scipy.special import erfcx

from fem import Case, Result, simulate
from fem.results.contacts import CONTACTS
from tests.reference_solutions.conduction import train_of_pulses
from tests.reference_solutions.conduction_columns import Contacts

PRESS = {"kind": "press", "mean_pressure_N_per_mm2": 0.25, "time_s": 1e-3}
LIFT = {"kind": "lift", "time_s": 0.02}
COULOMB = {"law": "coulomb", "mu": 0.4, "wlf": False}
SMALL = {"cells_x": 16, "cells_y": 8, "smallest_x_mm": 0.6, "smallest_y_mm": 0.4}


def slide(velocity, **length):
    return {"kind": "slide", "velocity_mm_per_s": velocity, **length}


def event(*phases, **tables):
    loading = {"phase": list(phases), **tables.pop("loading", {})}
    block = {"mesh": SMALL, **tables.pop("block", {})}
    base = {"friction": COULOMB, "output": {"figures": False, "vtu": False}}
    return Case.from_dict({**base, **tables, "block": block, "loading": loading})


# -- heat of a rigid block -------------------------------------------------------------------------

#: Cells flat enough for the heat of milliseconds.
FLAT = {"cells_x": 4, "cells_y": 60, "smallest_x_mm": 5.0, "smallest_y_mm": 0.006}
#: A block that neither conducts to the road nor radiates, as the closed forms have it.
INSULATED = {
    "block": {
        "rigid": True,
        "mesh": FLAT,
    },
    "friction": {"law": "coulomb", "mu": 0.9, "wlf": False},
    "heat": {
        "emissivity": 0.0,
        "conductance_W_per_m2K": 1e-6,
        "partition": {"law": "constant", "prefactor": 1.0},
    },
    "rubber": {
        "conductivity_W_per_mK": 0.284,
        "density_kg_per_m3": 1207.0,
        "specific_heat_kJ_per_kgK": 1.45,
    },
}
EFFUSIVITY = 705.012
#: The same block with the paper's conductance to the road, whose heat differs along it.
CONDUCTING = INSULATED | {
    "block": {"rigid": True, "mesh": FLAT | {"cells_x": 20, "smallest_x_mm": 1.0}},
    "heat": INSULATED["heat"] | {"conductance_W_per_m2K": 1600.0},
}


def test_a_train_of_contacts_heats_a_half_space_as_the_closed_form_says():
    """0.3 N/mm^2, 0.9, 1.39 m/s: 375.3 kW/m^2 for 7.9 ms of every 135.7 ms."""
    count = 20
    case = event(
        {"kind": "press", "mean_pressure_N_per_mm2": 0.3, "time_s": 1e-6},
        slide(1390.0, time_s=7.9e-3),
        {"kind": "lift", "time_s": 0.1278 - 1e-6},
        loading={"repeat": count},
        **INSULATED,
    )
    result = simulate(case)
    ends = 0.1357 * np.arange(count) + 7.9e-3
    expected = train_of_pulses(
        ends, flux=375.3e3, effusivity=EFFUSIVITY, duration=7.9e-3, period=0.1357
    )
    found = result.contacts["T_max_C"].to_numpy() - 20.0
    np.testing.assert_allclose(found, expected, rtol=0.01)
    assert found[[0, 1, 2, 4, 9, 19]] == pytest.approx(
        [53.389, 59.739, 64.260, 71.170, 83.511, 100.670], rel=0.01
    )
    before = train_of_pulses(
        0.1357 * np.arange(1, count),
        flux=375.3e3,
        effusivity=EFFUSIVITY,
        duration=7.9e-3,
        period=0.1357,
    )
    np.testing.assert_allclose(result.contacts["T_before_C"][1:] - 20.0, before, rtol=0.01)
    assert result.summary["heat_error"] < 1e-12


def test_a_half_space_cools_between_contacts_as_the_closed_form_says():
    """At every step in the air of the third rest: from milliseconds to seconds after contact."""
    period, on = 3.0079, 7.9e-3
    case = event(
        {"kind": "press", "mean_pressure_N_per_mm2": 0.3, "time_s": 1e-6},
        slide(1390.0, time_s=on),
        {"kind": "lift", "time_s": period - on - 1e-6},
        loading={"repeat": 3},
        **INSULATED,
    )
    history = simulate(case).history
    air = history[(history["contact"] == 3) & (history["phase"] == 3)]
    expected = train_of_pulses(
        air["time_s"].to_numpy(), flux=375.3e3, effusivity=EFFUSIVITY, duration=on, period=period
    )
    assert air["time_s"].diff().max() > 0.2  # steps grow with the time at rest
    late = air["time_s"] > 2.0 * period + on + 1e-3
    np.testing.assert_allclose((air["T_max_C"] - 20.0)[late], expected[late], rtol=0.01)


def test_convection_cools_a_half_space_as_the_closed_form_says():
    """After a short contact the heat is a sheet at the surface; a film takes it away.

    T/T_insulated = 1 - sqrt(pi) b erfcx(b) with b = h sqrt(t)/e (Carslaw and Jaeger, 14.2).
    """
    film = 100.0

    def end(h):
        lift = {"kind": "lift", "time_s": 1.0, "convection_W_per_m2K": h}
        press = {"kind": "press", "mean_pressure_N_per_mm2": 0.3, "time_s": 1e-6}
        result = simulate(event(press, slide(3000.0, time_s=5e-4), lift, **INSULATED))
        return result.summary["T_max_C"] - 20.0, result.history.iloc[-1]

    (cold, last), (warm, _) = end(film), end(0.0)
    b = film * np.sqrt(1.0) / EFFUSIVITY
    assert cold / warm == pytest.approx(1.0 - np.sqrt(np.pi) * b * erfcx(b), rel=0.01)
    kept = last["heat_in_rubber_mJ_per_mm"]
    lost = last["convected_mJ_per_mm"]
    assert kept + lost == pytest.approx(last["frictional_heat_mJ_per_mm"], rel=1e-6)


@pytest.mark.parametrize("where", ["in air", "held"])
def test_the_strongest_film_over_the_longest_steps_never_cools_below_the_air(where):
    """Steps at rest grow to seconds, far beyond what an explicit film could bear."""
    hold = {"kind": "slide", "velocity_mm_per_s": 0.0, "time_s": 30.0}
    lift = {"kind": "lift", "time_s": 30.0}
    press = {"kind": "press", "mean_pressure_N_per_mm2": 0.3, "time_s": 1e-3}
    last = lift if where == "in air" else hold
    heat = {"convection_W_per_m2K": 1e4}
    result = simulate(event(press, slide(300.0, time_s=0.02), last, heat=heat))
    T = result.snapshots[-1].temperature
    assert T.min() > 20.0 - 1e-6
    assert T.max() < result.history["T_max_C"].max()
    assert result.summary["heat_error"] < 1e-10


def test_a_track_that_is_met_again_leaves_the_block_warmer_than_a_fresh_road():
    press = {"kind": "press", "mean_pressure_N_per_mm2": 0.3, "time_s": 1e-4}
    lift = {"kind": "lift", "time_s": 0.05}
    ends = {}
    for road in ("fresh", "same"):
        result = simulate(
            event(
                press, slide(300.0, distance_mm=10.0), lift,
                block={"rigid": True, "mesh": "coarse"}, loading={"repeat": 2, "road": road},
            )
        )  # fmt: skip
        assert result.summary["heat_error"] < 1e-12
        ends[road] = result.contacts["T_max_C"].tolist()
    assert ends["same"][0] == pytest.approx(ends["fresh"][0], abs=1e-9)
    assert ends["same"][1] > ends["fresh"][1] + 0.05


@pytest.mark.parametrize("road", ["fresh", "same"])
def test_contacts_with_conduction_to_the_road_match_columns(road):
    """Three contacts of ABS braking, 0.1 s apart; a track that is met again is the warmer one."""
    count, way, speed, pause = 3, 11.0, 1390.0, 0.1
    case = event(
        {"kind": "press", "mean_pressure_N_per_mm2": 0.3, "time_s": 1e-6},
        slide(speed, distance_mm=way),
        {"kind": "lift", "time_s": pause},
        loading={"repeat": count, "road": road},
        **CONDUCTING,
    )
    found = simulate(case).contacts
    columns = Contacts(
        velocity=speed,
        distance=way,
        length=20.0,
        pressure=0.3,
        friction=lambda T: np.full_like(T, 0.9),
        kappa=1.0,
        conductance=1.6,
        block=(0.284, 1.207e-9 * 1.45e9),
        road=(0.70, 2.0e-9 * 0.92e9),
        stations=160,
        first_cell=0.002,
        pause=pause,
        count=count,
    )
    ends = []
    for number in range(count):
        if number:
            columns.in_air(pause, fresh=road == "fresh")
        ends.append(columns.contact())
    rise = [end.T_max_C - 20.0 for end in ends]
    np.testing.assert_allclose(found["T_max_C"] - 20.0, rise, rtol=0.01)
    area = [end.excess_area(20.0, 20.0) for end in ends]
    np.testing.assert_allclose(found["A_T_K_mm"], area, rtol=0.01)
    # Without conduction to the road it would be 53.4 K after the first contact.
    assert rise[0] < 47.0


# -- a deformable block ----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def two_contacts():
    """Without heat, so that the second contact is that of a cold block."""
    case = event(
        PRESS,
        slide(300.0, distance_mm=3.0),
        LIFT,
        loading={"repeat": 2},
        heat={"partition": {"law": "constant", "prefactor": 0.0}},
        friction=COULOMB | {"rubber_on_rubber_mu": 0.0},
        wear={"coefficient_mm3_per_J": 2.15e-3},
    )
    return simulate(case)


def test_the_block_springs_back_in_air(two_contacts):
    u = two_contacts.snapshots[-1].displacement
    assert np.abs(u - u[0]).max() < 1e-6
    assert two_contacts.summary["status"] == "ok"


def test_nothing_acts_in_air(two_contacts):
    air = two_contacts.history[two_contacts.history["contact_length_mm"] == 0.0]
    assert len(air) > 20
    forces = air[["normal_force_N_per_mm", "friction_force_N_per_mm"]].abs()
    assert forces.to_numpy().max() < 1e-9


def test_a_cold_block_repeats_its_first_contact_on_fresh_road(two_contacts):
    first, second = (g for _, g in two_contacts.history.groupby("contact"))
    for column in ("normal_force_N_per_mm", "friction_force_N_per_mm", "contact_length_mm"):
        np.testing.assert_allclose(first[column], second[column], rtol=1e-6, atol=1e-6)


def test_energy_of_the_whole_event_balances(two_contacts):
    assert two_contacts.summary["energy_error"] < 0.01


def test_a_row_per_contact_adds_up_to_the_event(two_contacts, tmp_path):
    table, last = two_contacts.contacts, two_contacts.history.iloc[-1]
    assert list(table.columns) == list(CONTACTS)
    assert table["contact"].tolist() == [1, 2]
    assert table["slid_mm"].sum() == pytest.approx(last["sliding_distance_mm"])
    work = table["friction_work_mJ_per_mm"].sum()
    assert work == pytest.approx(last["friction_dissipation_mJ_per_mm"], rel=1e-6)
    assert (table["T_before_C"] == 20.0).all()
    two_contacts.write(tmp_path)
    assert (tmp_path / "contacts.csv").is_file()
    assert Result.read(tmp_path).contacts.equals(table)


def test_what_wears_off_is_the_coefficient_times_the_friction_work(two_contacts):
    last, boundary = two_contacts.history.iloc[-1], two_contacts.boundary
    work = last["friction_dissipation_mJ_per_mm"]
    assert last["wear_volume_mm3_per_mm"] == pytest.approx(2.15e-6 * work, rel=1e-9)
    depth, energy = boundary["wear_depth_um"], boundary["wear_energy_mJ_per_mm2"]
    np.testing.assert_allclose(depth, 1e3 * 2.15e-6 * energy, rtol=1e-12)


def test_wear_is_linear_in_its_coefficient_and_changes_nothing_else():
    phases = (PRESS, slide(300.0, distance_mm=1.0))
    one, three = (simulate(event(*phases, wear={"coefficient_mm3_per_J": k})) for k in (2e-3, 6e-3))
    ratio = three.boundary["wear_depth_um"] / one.boundary["wear_depth_um"]
    np.testing.assert_allclose(ratio.dropna(), 3.0, rtol=1e-12)
    assert three.summary["wear_volume_mm3_per_mm"] == pytest.approx(
        3.0 * one.summary["wear_volume_mm3_per_mm"], rel=1e-12
    )
    assert three.summary["wear_front_share"] == pytest.approx(one.summary["wear_front_share"])
    columns = ["friction_force_N_per_mm", "T_max_C", "friction_dissipation_mJ_per_mm"]
    assert three.history[columns].equals(one.history[columns])


def test_what_wears_off_does_not_depend_on_the_mesh():
    """In all; over the first 3 mm, where the block takes up its deformation."""
    volumes = []
    for cells in (16, 32):
        mesh = {
            "cells_x": cells,
            "cells_y": cells // 2,
            "smallest_x_mm": 10.0 / cells,
            "smallest_y_mm": 6.4 / cells,
        }
        wear, block = {"coefficient_mm3_per_J": 2e-3}, {"mesh": mesh}
        result = simulate(event(PRESS, slide(300.0, distance_mm=3.0), wear=wear, block=block))
        volumes.append(result.summary["wear_volume_mm3_per_mm"])
    assert volumes[0] == pytest.approx(volumes[1], rel=0.02)


def test_the_front_edge_is_the_leading_fifth_and_the_leading_face():
    """Of a rigid block, which wears alike along the bottom, and not at the faces."""
    mesh = {"cells_x": 40, "cells_y": 4, "smallest_x_mm": 0.5, "smallest_y_mm": 2.0}
    phases, block = (PRESS, slide(-300.0, distance_mm=1.0)), {"rigid": True, "mesh": mesh}
    result = simulate(event(*phases, wear={"coefficient_mm3_per_J": 2e-3}, block=block))
    # With half a cell behind the limit.
    assert result.summary["wear_front_share"] == pytest.approx(0.2 + 0.25 / 20.0, abs=2e-3)


def test_a_slide_that_is_cut_in_two_is_one_slide():
    whole = simulate(event(PRESS, slide(300.0, distance_mm=2.0)))
    parts = simulate(event(PRESS, slide(300.0, distance_mm=0.7), slide(300.0, distance_mm=1.3)))
    for column in ("friction_force_N_per_mm", "T_max_C", "time_s"):
        np.testing.assert_allclose(whole.history[column], parts.history[column], rtol=1e-12)


def test_a_block_slid_forth_and_back_gives_a_symmetric_loop():
    """Without heat; the loop is closed by the way there and back."""
    case = event(
        PRESS,
        *(slide(v, distance_mm=4.0) for v in (100.0, -100.0, 100.0, -100.0)),
        heat={"partition": {"law": "constant", "prefactor": 0.0}},
    )
    history = simulate(case).history
    ends = history.groupby("phase")["friction_force_N_per_mm"].last()
    assert ends[3] == pytest.approx(-ends[2], rel=0.01)
    assert ends[4] == pytest.approx(ends[2], rel=0.01)
    assert ends[5] == pytest.approx(ends[3], rel=0.01)
    assert history["sliding_distance_mm"].iloc[-1] == pytest.approx(16.0)
    # The loop of the last way there and back encloses the friction work.
    loop = history.iloc[np.flatnonzero(history["phase"] == 4)[0] - 1 :]
    steps = np.sign(loop["velocity_mm_per_s"]) * loop["sliding_distance_mm"].diff()
    area = np.trapezoid(loop["friction_force_N_per_mm"], steps.fillna(0.0).cumsum())
    friction = loop["friction_dissipation_mJ_per_mm"]
    assert area == pytest.approx(friction.iloc[-1] - friction.iloc[0], rel=0.01)


def test_an_event_to_the_left_is_the_mirror_image():
    def run(sense):
        phases = (PRESS, slide(sense * 300.0, distance_mm=1.0), LIFT)
        return simulate(event(*phases, loading={"repeat": 2}))

    right, left = run(1.0), run(-1.0)
    for column in ("time_s", "friction_force_N_per_mm", "T_max_C", "contact_length_mm"):
        np.testing.assert_allclose(
            left.history[column], right.history[column], rtol=1e-8, atol=1e-8
        )
    names = ["friction_coefficient", "T_max_C", "friction_work_mJ_per_mm"]
    np.testing.assert_allclose(left.contacts[names], right.contacts[names], rtol=1e-8)


def test_a_block_that_is_held_sticks():
    case = event(PRESS, slide(100.0, distance_mm=3.0), slide(0.0, time_s=0.01))
    result = simulate(case)
    held = result.history[result.history["phase"] == 3]
    assert (held["slipping_nodes"] == 0).all()
    assert held["mean_slip_velocity_mm_per_s"].abs().max() < 1e-9
    assert held["sliding_distance_mm"].nunique() == 1


@pytest.mark.parametrize("after", [6, 25, 40])
def test_an_event_is_resumed_to_the_same_result(after, tmp_path):
    case = event(PRESS, slide(300.0, distance_mm=1.0), LIFT, loading={"repeat": 2})
    whole, seen, path = simulate(case), [], tmp_path / "checkpoint.npz"

    def stop(report):
        seen.append(report)
        if len(seen) == after:
            raise KeyboardInterrupt

    assert simulate(case, checkpoint=path, progress=stop).summary["status"] == "interrupted"
    again = simulate(case, checkpoint=path, resume=True)
    assert again.history.equals(whole.history)
    assert again.boundary.equals(whole.boundary)
