"""The same block computed here and by CalculiX: compression, and sliding at mu = 0.3."""

from __future__ import annotations

import pandas as pd
import pytest

from fem import simulate
from fem.case.sections import Solver
from tests.validation.calculix.comparison import (
    compare_with_calculix,
    compared,
    largest_differences,
)
from tests.validation.sliding_cases import sliding_case
from validation.calculix.deck_mesh import PLANE, half_slab
from validation.calculix.deck_results import deck_history, read_dat
from validation.calculix.deck_run import CalculixError, calculix_program, run_calculix
from validation.calculix.export_deck import DeckOptions, write_deck

needs_calculix = pytest.mark.skipif(
    calculix_program() is None, reason="CalculiX (ccx, Debian package calculix-ccx) is missing"
)
#: Seconds after which CalculiX is given up; on a free processor each run takes up to 20.
TIMEOUT = 300.0
BONDED = DeckOptions(bonded=True)
#: Back to the solver's defaults in `sliding_case`.
DEFAULTS = {f"solver__{key}": getattr(Solver(), key) for key in ("inertia", "viscous_distance_mm")}


def bonded_case(nx):
    """A 20 x 10 mm block that sticks to the road everywhere, pressed in by about 1 mm."""
    return sliding_case(
        nx, nx // 2, height=10.0, friction__mu=6.0, loading__distance_mm=0.02,
        loading__mean_pressure_N_per_mm2=0.72, rubber__bulk_ratio=200.0 / 0.7588,
    )  # fmt: skip


def difference_of_bonded_block(nx, folder):
    """Largest difference of the platen's displacement, relative; nothing slips with us."""
    case = bonded_case(nx)
    assert simulate(case).history["slipping_nodes"].max() == 0
    table = compare_with_calculix(case, folder, BONDED, timeout_s=TIMEOUT)
    assert set(table["phase"]) == {"pressing"}
    assert table["coordinate"].max() == pytest.approx(14.4)
    largest = largest_differences(table)
    assert largest["pressing", "contact_length_mm"] < 1e-6
    return largest["pressing", "platen_displacement_mm"]


@needs_calculix
def test_bonded_block_is_pressed_in_alike(tmp_path):
    assert difference_of_bonded_block(40, tmp_path) < 0.02


@needs_calculix
@pytest.mark.slow
def test_bonded_blocks_agree_better_on_a_finer_mesh(tmp_path):
    """The difference is one of elements: it goes down with the mesh width, at least linearly."""
    coarse, fine = (difference_of_bonded_block(nx, tmp_path) for nx in (40, 80))
    assert fine < 0.005
    assert fine < 0.5 * coarse


@needs_calculix
@pytest.mark.slow
@pytest.mark.parametrize(
    "top, velocity", [("platen", 300.0), ("platen", -300.0), ("pressure", 300.0)]
)
def test_sliding_block_at_mu_0_3(top, velocity, tmp_path):
    """Cells of 0.31 mm: a node that lifts off a step sooner changes the length by 1.6 %."""
    case = sliding_case(64, 20, loading__top=top, loading__velocity_mm_per_s=velocity)
    table = compare_with_calculix(case, tmp_path, timeout_s=TIMEOUT)
    assert largest_differences(table).max() < 0.02
    sliding = table[table["phase"] == "sliding"]
    assert sliding["coordinate"].max() == pytest.approx(2.0)
    end = sliding[sliding["coordinate"] == sliding["coordinate"].max()].set_index("quantity")
    assert end.loc["friction_force_N_per_mm", "ours"] == pytest.approx(1.5, rel=1e-6)
    assert (end["relative_difference"].abs() < 0.01).all()


@needs_calculix
@pytest.mark.slow
def test_default_settings_agree_with_calculix_at_every_step(tmp_path):
    """Inertia, damping of snaps and everything else as it comes; K = 200 N/mm^2.

    Found: 0.6 % at most, which is the contact length; force 0.2 %, platen 0.1 %.
    """
    case = sliding_case(
        64, 32, height=10.0, loading__velocity_mm_per_s=10.0, loading__distance_mm=2.5,
        rubber__bulk_ratio=200.0 / 0.7588, **DEFAULTS,
    )  # fmt: skip
    assert case.solver == Solver()
    table = compare_with_calculix(case, tmp_path, timeout_s=TIMEOUT)
    # CalculiX steps over the end of pressing; the first sliding step, of 0.02 mm, stands for it.
    at = table.groupby("phase")["coordinate"].agg(["min", "max"])
    assert at.loc["pressing", "max"] == pytest.approx(0.75 * 5.0, rel=1e-4)
    assert at.loc["sliding"].tolist() == pytest.approx([0.02, 2.5])
    assert len(largest_differences(table)) == 5
    assert largest_differences(table).max() < 0.03


@needs_calculix
@pytest.mark.slow
def test_block_at_mu_0_6_before_its_edge_rolls_under(tmp_path):
    """Behind the snap there are several folded equilibria, and nothing to compare."""
    case = sliding_case(64, 20, friction__mu=0.6, loading__distance_mm=0.9)
    table = compare_with_calculix(case, tmp_path, timeout_s=TIMEOUT)
    assert table["coordinate"][table["phase"] == "sliding"].max() == pytest.approx(0.9)
    assert largest_differences(table).max() < 0.02


@needs_calculix
@pytest.mark.slow
def test_graded_mesh_at_mu_0_3(tmp_path):
    case = sliding_case(block__mesh="coarse")
    table = compare_with_calculix(case, tmp_path, timeout_s=TIMEOUT)
    assert largest_differences(table).max() < 0.02


#: Cells that are small enough for chamfers and sipes, which CalculiX computes in seconds.
SHAPED = {"cells_x": 40, "cells_y": 16, "smallest_x_mm": 0.25, "smallest_y_mm": 0.2}
SIPE = {"position_mm": 10.0, "depth_mm": 3.0, "width_mm": 1.0}


@needs_calculix
@pytest.mark.slow
@pytest.mark.parametrize(
    "shape",
    [
        {"block__chamfer_leading_mm": 1.0},
        {"block__length_mm": 10.0, "block__blocks": 2, "block__groove_mm": 4.0},
        {"block__sipes": [SIPE | {"base": "flat"}]},
        {"block__sipes": [SIPE | {"angle_deg": 15.0}]},
    ],
    ids=["chamfer", "two blocks", "sipe", "sipe at an angle"],
)
def test_blocks_of_other_shapes_before_an_edge_rolls_under(shape, tmp_path):
    """Found: force 0.5 %, platen 0.4 %, and one node of the chamfered bottom that lifts off later.

    Behind 1.36 mm CalculiX finds no equilibrium where the edge behind a sipe rolls under.
    """
    case = sliding_case(loading__distance_mm=1.0, block__mesh=SHAPED, **shape)
    table = compare_with_calculix(case, tmp_path, timeout_s=TIMEOUT)
    assert table["coordinate"][table["phase"] == "sliding"].max() == pytest.approx(1.0)
    assert largest_differences(table).max() < 0.02


def slab_history(case, folder, layers, *, plane=False):
    """History of a slab in CalculiX; `plane` holds all of it along z."""
    deck = write_deck(case, folder / "deck.inp", DeckOptions(layers=layers))
    if plane:
        free, held = "MIDDLE, 3, 3\nHELD, 3, 3\n", "BLOCK, 3, 3\n"
        assert free in deck.read_text()
        deck.write_text(deck.read_text().replace(free, held))
    return deck_history(case, read_dat(run_calculix(deck, timeout_s=TIMEOUT)), layers)


@needs_calculix
@pytest.mark.slow
def test_slab_held_along_z_is_in_plane_strain_and_a_free_one_is_softer(tmp_path):
    """The layers add nothing of their own: what differs is the depth."""
    case = sliding_case(10, 4, loading__distance_mm=1.0)
    plane = slab_history(case, tmp_path, PLANE).iloc[-1]
    held = slab_history(case, tmp_path, half_slab(8.0, 4), plane=True).iloc[-1]
    assert held["deck_time"] == plane["deck_time"] == 2.0
    for column in ("friction_force_N_per_mm", "contact_length_mm", "platen_displacement_mm"):
        assert held[column] == pytest.approx(plane[column], rel=1e-5)
    free = slab_history(case, tmp_path, half_slab(8.0, 4)).iloc[-1]
    assert free["normal_force_N_per_mm"] == pytest.approx(0.25 * 20.0, rel=1e-3)
    assert free["platen_displacement_mm"] > 1.3 * plane["platen_displacement_mm"]


@needs_calculix
def test_deck_that_does_not_converge_is_an_error_in_one_line(tmp_path):
    deck = write_deck(sliding_case(), tmp_path / "deck.inp")
    deck.write_text(deck.read_text().replace("TYPE=C3D8R", "TYPE=C3D99"))
    with pytest.raises(CalculixError, match="did not finish") as caught:
        run_calculix(deck)
    assert "\n" not in str(caught.value)


def test_missing_calculix_is_named_with_its_package(tmp_path, monkeypatch):
    monkeypatch.setattr("validation.calculix.deck_run.PROGRAM", "no-such-program")
    with pytest.raises(CalculixError, match="calculix-ccx"):
        run_calculix(tmp_path / "deck.inp")


@pytest.fixture(scope="module")
def result():
    return simulate(sliding_case())


COLUMNS = [
    "sliding_distance_mm",
    "normal_force_N_per_mm",
    "friction_force_N_per_mm",
    "contact_length_mm",
    "platen_displacement_mm",
]


def test_equal_histories_differ_by_nothing(result):
    table = compared(result, result.history[COLUMNS])
    assert set(table["phase"]) == {"pressing", "sliding"}
    assert table["relative_difference"].abs().max() < 1e-12


def test_a_difference_shows_at_its_size(result):
    theirs = result.history[COLUMNS].assign(
        platen_displacement_mm=1.03 * result.history["platen_displacement_mm"]
    )
    largest = largest_differences(compared(result, theirs))
    assert largest["sliding", "platen_displacement_mm"] == pytest.approx(0.03)
    unchanged = [key for key in largest.index if key[1] != "platen_displacement_mm"]
    assert len(unchanged) == 3
    assert largest[unchanged].max() < 1e-12


def test_only_what_the_other_code_reached_is_compared(result):
    half = result.history[COLUMNS][result.history["sliding_distance_mm"] < 1.0]
    table = compared(result, half)
    reached = table.loc[table["phase"] == "sliding", "coordinate"]
    assert reached.max() == pytest.approx(half["sliding_distance_mm"].max())
    assert isinstance(table, pd.DataFrame)
