"""What a pyrometer behind the end of the road reads of a block that runs off it."""

import numpy as np
import pytest

from fem import Case, Result, simulate
from fem.mesh.block import block_mesh
from fem.mesh.grading import Grading
from fem.stepping.pyrometer import Spot
from tests.fem.test_events import COULOMB, EFFUSIVITY, INSULATED, LIFT, PRESS, SMALL, event, slide
from tests.reference_solutions.conduction import train_of_pulses

SPEED, TIME = 1390.0, 7.9e-3
PULSE = (PRESS | {"mean_pressure_N_per_mm2": 0.3, "time_s": 1e-6}, slide(SPEED, time_s=TIME))
FLUX = 0.9 * 0.3 * SPEED * 1e3


def read(gap, spot=0.0, *phases, **tables):
    pyrometer = {"gap_mm": gap, "spot_mm": spot}
    base = INSULATED if not tables else {}
    return simulate(event(*(phases or PULSE), pyrometer=pyrometer, **base, **tables))


@pytest.mark.parametrize("gap", [0.5, 5.0, 50.0])
def test_an_insulated_half_space_is_read_after_the_time_it_takes_to_cross_the_gap(gap):
    result = read(gap)
    (expected,) = train_of_pulses(
        TIME + gap / SPEED, flux=FLUX, effusivity=EFFUSIVITY, duration=TIME, period=1.0
    )
    np.testing.assert_allclose(result.pyrometer["T_pyrometer_C"] - 20.0, expected, rtol=0.01)
    assert result.summary["T_max_pyrometer_C"] == pytest.approx(20.0 + expected, rel=0.01)
    assert result.summary["pyrometer_speed_mm_per_s"] == pytest.approx(SPEED)


def test_a_spot_of_an_insulated_half_space_is_the_mean_over_the_times_it_has_been_free():
    """In its middle; at a corner it is the part that lies on the bottom."""
    gap, spot = 2.0, 8.0
    table = read(gap, spot).pyrometer.set_index("X_mm")
    free = (gap + spot * (np.arange(1000) + 0.5) / 1000) / SPEED
    rise = train_of_pulses(TIME + free, flux=FLUX, effusivity=EFFUSIVITY, duration=TIME, period=1.0)
    seen = table["T_pyrometer_C"] - 20.0
    assert seen[10.0] == pytest.approx(rise.mean(), rel=0.01)
    assert seen[20.0] == pytest.approx(rise[:500].mean(), rel=0.01)
    assert seen[0.0] == pytest.approx(rise[500:].mean(), rel=0.01)
    assert table["spot_covered"].to_dict() == {0.0: 0.5, 5.0: 1.0, 10.0: 1.0, 15.0: 1.0, 20.0: 0.5}


def test_without_gap_and_width_it_reads_the_profile_at_the_end_of_contact():
    phases = (PRESS, slide(300.0, distance_mm=2.0), LIFT)
    result = read(0.0, 0.0, *phases, friction=COULOMB)
    table = result.pyrometer
    np.testing.assert_array_equal(table["T_pyrometer_C"], table["T_C"])
    last = result.contacts.iloc[-1]
    assert result.summary["T_max_pyrometer_C"] == last["T_max_C"]
    assert result.summary["A_T_pyrometer_K_mm"] == pytest.approx(last["A_T_K_mm"], rel=1e-12)
    assert last["T_max_C"] != result.summary["T_max_C"]  # that is after the rest in air


def average(T_of_X, spot, parts):
    """Average over a profile that does not cool, on a uniform mesh."""
    mesh = block_mesh(20.0, 8.0, Grading(cells_x=2000, cells_y=1, smallest_x=1.0, smallest_y=8.0))
    X = mesh.from_trailing(mesh.bottom)
    surfaces = np.array([T_of_X(X)] * 2)
    looks = Spot(gap=0.0, width=spot, parts=parts)
    seen, covered = looks._average(mesh, np.array([0.0, 1.0]), surfaces, 1e3, 1.0)
    return X, seen, covered


def test_a_spot_leaves_a_linear_profile_as_it_is_and_takes_the_covered_part_at_a_corner():
    X, seen, covered = average(lambda X: 20.0 + 3.0 * X, 4.0, 64)
    whole = (X >= 2.0) & (X <= 18.0)
    np.testing.assert_allclose(seen[whole], 20.0 + 3.0 * X[whole], rtol=1e-12)
    np.testing.assert_array_equal(covered[whole], 1.0)
    assert seen[0] == pytest.approx(20.0 + 3.0 * 1.0)
    assert seen[-1] == pytest.approx(20.0 + 3.0 * 19.0)
    assert covered[[0, -1]].tolist() == [0.5, 0.5]


def test_the_average_over_the_spot_is_of_second_order_in_its_parts():
    """A wave of length L is damped by sin(a)/a with a = pi s/L."""
    spot, length = 5.0, 8.0
    a = np.pi * spot / length
    errors = []
    for parts in (4, 8, 16):
        X, seen, _ = average(lambda X: np.cos(2 * np.pi * (X - 10.0) / length), spot, parts)
        middle = np.argmin(np.abs(X - 10.0))
        errors.append(seen[middle] - np.sin(a) / a)
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 2.0, atol=0.1)


def test_a_mirrored_block_is_read_alike_and_one_that_runs_off_backwards_from_its_rear():
    def table(*velocities):
        phases = (PRESS, *(slide(v, distance_mm=2.0) for v in velocities))
        return read(3.0, 6.0, *phases, friction=COULOMB, block={"rigid": True}).pyrometer

    right, left, back = table(300.0), table(-300.0), table(300.0, -300.0)
    np.testing.assert_allclose(left["T_pyrometer_C"], right["T_pyrometer_C"], rtol=1e-12)
    # What leaves the road first has cooled for longer where the spot looks beyond the middle.
    assert right["T_pyrometer_C"].iloc[0] < right["T_pyrometer_C"].iloc[-1]
    assert back["T_pyrometer_C"].iloc[0] > back["T_pyrometer_C"].iloc[-1]


def test_a_film_cools_what_crosses_the_gap():
    def T(film):
        heat = {"convection_W_per_m2K": film}
        phases = (PRESS, slide(30.0, distance_mm=2.0))
        rigid = {"rigid": True, "mesh": SMALL}
        return read(30.0, 0.0, *phases, friction=COULOMB, heat=heat, block=rigid).pyrometer

    still, windy = T(0.0)["T_pyrometer_C"], T(200.0)["T_pyrometer_C"]
    assert (windy - 20.0 < 0.7 * (still - 20.0)).all()


def test_grooves_are_not_read():
    block = {"rigid": True, "mesh": "coarse", "blocks": 2, "groove_mm": 4.0}
    phases = (PRESS, slide(300.0, distance_mm=2.0))
    table = read(0.0, 2.0, *phases, friction=COULOMB, block=block).pyrometer
    covered = table.set_index("X_mm")["spot_covered"]
    assert covered[[0.0, 20.0, 24.0, 44.0]].tolist() == [0.5] * 4
    assert (covered[(covered.index > 1.0) & (covered.index < 19.0)] == 1.0).all()


@pytest.mark.parametrize("after", [10, 45])
def test_a_run_that_is_resumed_reads_the_same(after, tmp_path):
    """Before the end of the contact, and in the air after it."""
    case = event(
        PRESS,
        slide(300.0, distance_mm=2.0),
        LIFT,
        block={"rigid": True},
        pyrometer={"gap_mm": 5.0, "spot_mm": 2.0},
    )
    whole, seen, path = simulate(case), [], tmp_path / "checkpoint.npz"

    def stop(report):
        seen.append(report)
        if len(seen) == after:
            raise KeyboardInterrupt

    part = simulate(case, checkpoint=path, progress=stop)
    assert (part.pyrometer is None) == (after == 10)
    again = simulate(case, checkpoint=path, resume=True)
    assert again.pyrometer.equals(whole.pyrometer)
    part.write(tmp_path / "run")
    whole.write(tmp_path / "run")
    assert Result.read(tmp_path / "run").pyrometer.equals(whole.pyrometer)
    part.write(tmp_path / "run")
    assert (Result.read(tmp_path / "run").pyrometer is None) == (after == 10)


def test_a_case_with_a_pyrometer_is_written_and_read_again():
    case = event(*PULSE, pyrometer={"gap_mm": 5.0, "spot_mm": 2.0}, **INSULATED)
    assert "[pyrometer]\ngap_mm = 5.0" in case.to_toml()
    assert Case.from_dict(case.to_dict()) == case
    plain = event(*PULSE, **INSULATED)
    assert "pyrometer" not in plain.to_toml()
    assert plain.hash() != case.hash()
    assert simulate(plain).pyrometer is None
