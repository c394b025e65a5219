"""Tables of CalculiX read from text, and the history made of them."""

from __future__ import annotations

import numpy as np
import pytest

from fem.stepping.model_parts import mesh_of
from tests.validation.sliding_cases import sliding_case
from validation.calculix.deck_results import contact_length, deck_history, read_dat

TEXT = """
 displacements (vx,vy,vz) for set TOP and time  0.5000000E+00

         5  0.000000E+00 -1.250000E-01  0.000000E+00
        10  0.000000E+00 -1.250000E-01  1.234567-101

 total force (fx,fy,fz) for set ROAD and time  0.5000000E+00

       -1.500000E+00  5.000000E+00  0.000000E+00
"""


def written(folder, text):
    path = folder / "deck.dat"
    path.write_text(text)
    return path


def test_tables_and_totals_are_read(tmp_path):
    top, road = read_dat(written(tmp_path, TEXT))
    assert (top.quantity, top.set_name, top.time) == ("displacements", "TOP", 0.5)
    assert top.entities == (5, 10)
    np.testing.assert_array_equal(top.values[:, 1], [-0.125, -0.125])
    assert (road.quantity, road.set_name, road.entities) == ("total force", "ROAD", ())
    np.testing.assert_array_equal(road.values, [[-1.5, 5.0, 0.0]])


def test_exponent_without_its_letter_is_read(tmp_path):
    assert read_dat(written(tmp_path, TEXT))[0].values[1, 2] == pytest.approx(1.234567e-101)


@pytest.mark.parametrize(
    "text, says",
    [
        ("", "no table"),
        (TEXT.replace(" 1.234567-101", ""), "row of 3 numbers"),
        (TEXT.replace("1.234567-101", "*" * 12), "where a number was expected"),
    ],
    ids=["empty", "cut off", "overflow"],
)
def test_damaged_file_is_refused_by_name(text, says, tmp_path):
    with pytest.raises(ValueError, match=says) as caught:
        read_dat(written(tmp_path, text))
    assert "deck.dat" in str(caught.value)


def printed(case, u, *, time, order):
    """What CalculiX prints of plane displacements `u` (n, 2), its surface nodes in an order."""
    mesh = mesh_of(case)
    tables = {"SURFACE": mesh.boundary[order], "TOP": mesh.top}
    lines = []
    for name, chosen in tables.items():
        lines += [f" displacements (vx,vy,vz) for set {name} and time {time:15.7E}", ""]
        lines += [f"{i + 1:10d}{u[i, 0]:14.6E}{u[i, 1]:14.6E}{0.0:14.6E}" for i in chosen]
        lines += [""]
    lines += [f" total force (fx,fy,fz) for set ROAD and time {time:15.7E}", ""]
    return "\n".join([*lines, "      -1.200000E+00  4.000000E+00  0.000000E+00", ""])


@pytest.mark.parametrize("velocity", [300.0, -300.0])
def test_history_of_a_known_displacement(velocity, tmp_path):
    """All nodes 0.1 mm down, but the two of the leading edge, which hang over the road."""
    case = sliding_case(loading__velocity_mm_per_s=velocity)
    mesh = mesh_of(case)
    u = np.full_like(mesh.points, -0.1)
    u[mesh.bottom[-2:], 1] = 0.05
    order = np.random.default_rng(3).permutation(mesh.boundary.size)
    history = deck_history(
        case,
        read_dat(written(tmp_path, printed(case, u, time=1.5, order=order))),
    )
    (row,) = history.to_dict("records")
    assert row["sliding_distance_mm"] == pytest.approx(0.5)
    assert row["contact_length_mm"] == pytest.approx(20.0 * 6 / 8, rel=1e-6)
    assert row["platen_displacement_mm"] == pytest.approx(0.1)
    assert row["normal_force_N_per_mm"] == 4.0
    assert row["friction_force_N_per_mm"] == pytest.approx(1.2 * np.sign(velocity))


def test_increment_that_was_not_printed_in_full_is_left_out(tmp_path):
    case = sliding_case()
    u, order = np.zeros_like(mesh_of(case).points), slice(None)
    whole = printed(case, u, time=0.5, order=order)
    half = printed(case, u, time=0.7, order=order).split(" total force")[0]
    history = deck_history(case, read_dat(written(tmp_path, whole + half)))
    assert history["deck_time"].to_list() == [0.5]


def test_contact_length_counts_edges_with_both_ends_down():
    points = np.array([[0, 1], [0, 0], [1, -0.1], [3, 0.1], [4, 0], [6, -0.1], [6, 2]], dtype=float)
    assert contact_length(points, np.ones(len(points) - 1, dtype=bool)) == pytest.approx(1.0 + 2.0)
