"""How a run says that it leaves the ranges that its laws were fitted to."""

import numpy as np
import pytest

from fem import Case, simulate
from fem.case.errors import CaseError
from fem.results.fitted_window import contact_columns, rubber_columns, window_lines

LOADING = {"mean_pressure_N_per_mm2": 0.25, "velocity_mm_per_s": 300.0, "distance_mm": 2.0}
COARSE = {"cells_x": 12, "cells_y": 6, "smallest_x_mm": 0.8, "smallest_y_mm": 0.3}
OUTPUT = {"vtu": False, "figures": False}
FLAT = {"law": "coulomb", "mu": 0.5, "wlf": False}


def case(**sections):
    return Case.from_dict({"loading": LOADING, "output": OUTPUT, **sections})


def shares(case, **changes):
    state = {
        "p": np.array([0.1, 0.3, 0.6]),
        "v": np.array([-300.0, 300.0, 0.0]),
        "T": np.array([20.0, 40.0, 60.0]),
        "length": np.array([1.0, 2.0, 1.0]),
        "slipping": np.array([True, True, False]),
    }
    return contact_columns(case, **{**state, **changes})


def test_shares_of_the_contact_are_by_length():
    window = {"p_N_per_mm2": [0.2, 0.5], "v_mm_per_s": [10.0, 299.0], "T_C": [20.0, 30.0]}
    assert shares(case(friction={**FLAT, "window": window})) == {
        "outside_friction_pressure": 0.5,
        "outside_friction_speed": 0.75,  # the sticking node has no speed to judge
        "outside_friction_temperature": 0.75,
    }


def test_ends_of_a_window_belong_to_it():
    window = {"p_N_per_mm2": [0.1, 0.6], "v_mm_per_s": [300.0, 300.0]}
    assert set(shares(case(friction={**FLAT, "window": window})).values()) == {0.0}


def test_speeds_are_judged_as_the_law_sees_them():
    # 40 K hotter is a slower slide by orders of magnitude, below the data of the law
    friction = {"window": {"v_mm_per_s": [1.0, 1000.0]}}
    hot, cold = (
        shares(case(friction=friction), T=np.full(3, T), slipping=np.ones(3, dtype=bool))
        for T in (90.0, 20.0)
    )
    assert cold["outside_friction_speed"] == 0.25  # the node at rest
    assert hot["outside_friction_speed"] == 1.0


def test_the_partition_is_judged_by_the_mean_pressure():
    window = {"p_N_per_mm2": [0.3, 0.4]}
    assert shares(case(heat={"window": window})) == {"outside_heat_pressure": 0.0}
    assert shares(case(heat={"window": {"p_N_per_mm2": [0.1, 0.3]}})) == {
        "outside_heat_pressure": 1.0
    }


def test_stretch_is_the_largest_in_the_plane_or_across_it():
    rubber = case(rubber={"window": {"largest_stretch": 1.5}})
    stretches = np.array([[1.4, 1 / 1.4], [1.6, 1 / 1.6], [0.6, 0.6]])  # the last: 0.36^(-1/3) 1
    I1, J = (stretches**2).sum(axis=1) + 1.0, stretches.prod(axis=1)
    found = rubber_columns(rubber, I1, J, np.array([1.0, 2.0, 1.0]))
    assert found == {"outside_rubber_stretch": 0.5}
    assert 0.36 ** (-1 / 3) < 1.5
    assert rubber_columns(case(), I1, J, np.ones(3)) == {}


@pytest.mark.parametrize("rigid", [True, False])
def test_a_run_outside_says_how_much_of_it(rigid):
    friction = {"window": {"p_N_per_mm2": [0.01, 20.0], "v_mm_per_s": [1.0, 5.0]}}
    rubber = {"window": {"largest_stretch": 1.01}}
    block = {"mesh": COARSE, "rigid": rigid}
    loading = {**LOADING, "distance_mm": 5.0}  # the block has been sheared and slides in full
    result = simulate(case(block=block, friction=friction, rubber=rubber, loading=loading))
    speed = [line for line in result.summary["warnings"] if "speed" in line]
    assert len(speed) == 1
    assert "of the contact is outside the speed it was fitted to, 1 to 5 mm/s" in speed[0]
    assert any(speed[0] in line for line in result.log)
    stretched = [line for line in result.summary["warnings"] if "stretched beyond" in line]
    assert len(stretched) == (0 if rigid else 1)
    share = result.history["outside_friction_speed"].iloc[-1]
    assert 0.8 < share <= 1.0  # at full speed; a few nodes are hot or still slow


def test_a_run_inside_says_nothing_and_no_window_leaves_no_columns():
    wide = {"p_N_per_mm2": [1e-9, 99.0], "v_mm_per_s": [0.0, 1e9], "T_C": [-50.0, 900.0]}
    block = {"mesh": COARSE, "rigid": True}
    result = simulate(case(block=block, friction={"window": wide}))
    assert not any("fitted" in line for line in result.summary["warnings"])
    assert not any("outside" in column for column in simulate(case(block=block)).history)


def test_little_outside_is_in_the_log_only():
    friction = case(friction={**FLAT, "window": {"p_N_per_mm2": [0.2, 0.5]}})
    rows = [
        {"sliding_distance_mm": at, "contact_length_mm": 10.0, "outside_friction_pressure": out}
        for at, out in ((1.0, 1.0), (200.0, 0.0))
    ]
    ((share, line),) = window_lines(friction, rows)
    assert share == pytest.approx(1.0 / 200.0)
    assert line == (
        "friction law: 0.5% of the contact is outside the pressure it was fitted to, "
        "0.2 to 0.5 N/mm^2"
    )
    assert window_lines(friction, []) == []


def test_windows_stay_with_their_law():
    window = {"v_mm_per_s": [1.0, 5.0]}
    fitted = case(friction={"law": "exponential", "A": 0.9, "B": -0.1, "C": 0.0, "window": window})
    assert fitted.with_overrides({"friction.A": 0.8}).friction.window is not None
    other = fitted.with_overrides({"friction.law": "coulomb", "friction.mu": 0.5})
    assert other.friction.window is None
    assert Case.from_dict(fitted.to_dict()) == fitted


@pytest.mark.parametrize(
    ("window", "message"),
    [
        ({"v_mm_per_s": [5.0, 1.0]}, "friction.window.v_mm_per_s: found an array of 2 values"),
        ({"v_mm_per_s": [5.0]}, "found an array of 1 values, expected an array of at least 2"),
        ({"v_mm_per_s": [5.0] * 3}, "found an array of 3 values, expected an array of at most 2"),
        ({"v_mm_per_s": 5.0}, "v_mm_per_s: found 5.0, expected an array of numbers"),
        ({"v": [1.0, 5.0]}, "friction.window.v: found an unknown key, expected one of p_N"),
    ],
)
def test_wrong_windows_are_refused_in_one_line(window, message):
    with pytest.raises(CaseError, match=message):
        case(friction={"window": window})
